"""Files of the painting on the easel."""
