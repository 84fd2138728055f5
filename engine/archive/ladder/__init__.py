"""Ladders: a rectangle of a painting at many levels at once, as files that viewers read piece by piece."""
