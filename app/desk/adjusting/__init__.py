"""Adjustments of a layer, as the window knows of them."""
