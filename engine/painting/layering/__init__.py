"""The commands about layers, by subject."""
