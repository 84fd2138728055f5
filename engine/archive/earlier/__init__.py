"""Packs of tiles as earlier formats have them, which are still read."""
