"""The panel of solids."""
