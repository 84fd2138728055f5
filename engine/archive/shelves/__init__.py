"""What a file holds of a painting, and is decoded when somebody looks at it."""
