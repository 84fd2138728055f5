"""What lies on the artist's desk: the brush, its presets and textures, and what the panels know."""
