"""Several nodes of the tree made one layer."""
