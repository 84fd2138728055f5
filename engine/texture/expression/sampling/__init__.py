"""How many samples a pixel of a written texture takes."""
