"""What the tool Move shows on the canvas."""
