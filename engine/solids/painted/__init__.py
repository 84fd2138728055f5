"""Paint on solids."""
