"""ICC profiles: what colours of a file, or of a screen, mean."""
