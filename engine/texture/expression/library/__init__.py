"""Textures that users write: a text of named lines, the last of which is the texture (Perlin & Velho 1995, 8.2)."""
