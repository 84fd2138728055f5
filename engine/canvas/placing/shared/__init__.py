"""What is shown by many placements: where it lies, and its pictures."""
