"""Things that written textures place by hash: along a stroke, about it, and within one another."""
