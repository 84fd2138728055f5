"""The watercolour tree: paper and sky, hills and meadow, the tree, all in washes."""
