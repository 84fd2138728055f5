"""Textures while they are written: looked into, line by line."""
