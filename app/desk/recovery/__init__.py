"""Paintings that were not closed, and those in the bin."""
