"""Palettes of colours, as other programs write them."""
