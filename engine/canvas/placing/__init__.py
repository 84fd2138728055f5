"""Placements: layers, groups or the whole painting, shown again elsewhere through a similarity."""
