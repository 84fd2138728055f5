"""Masks that are painted on, as the window knows of them."""
