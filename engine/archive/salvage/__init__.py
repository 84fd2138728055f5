"""Damaged paintings: what is whole of them, and the ways in which they are opened."""
