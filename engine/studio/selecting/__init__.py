"""What the window sees of the selection."""
