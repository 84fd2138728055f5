"""The guides over the canvas: their lines and handles, and the bar with their numbers."""
