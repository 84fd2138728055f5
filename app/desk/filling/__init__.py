"""Fills, as the window knows of them."""
