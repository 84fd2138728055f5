"""Colours as the screen has to be sent them, and as another device would show them."""
