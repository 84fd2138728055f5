"""Solids: what is set, and how they are carved."""
