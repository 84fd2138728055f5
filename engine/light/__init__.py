"""A painting in the light: lit by its own relief."""
