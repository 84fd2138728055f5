"""The columns beside the canvas, and panels that float over it."""
