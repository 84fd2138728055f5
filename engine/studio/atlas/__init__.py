"""Where there is paint: the map, pictures of places, and the way back to paint."""
