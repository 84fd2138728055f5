"""Layers as the window looks at them."""
