"""Strokes that place things."""
