"""Strokes while they are drawn, of every mode."""
