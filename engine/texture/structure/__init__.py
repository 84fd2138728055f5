"""Textures by their joint statistics, and by layouts of an example's patches."""
