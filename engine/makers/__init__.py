"""Definitions of textures, and the makers that turn them into textures."""
