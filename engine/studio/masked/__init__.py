"""Masks as the window shows them: alone, and as small pictures."""
