"""What was painted at a place: how each layer came to its paint, and which strokes show there."""
