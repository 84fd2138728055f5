"""Kernels compiled in the background, and what waits for them."""
