"""The artist's preferences, as the window changes them."""
