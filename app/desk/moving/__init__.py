"""What is held of a layer that is moved: its box, its handles, where a drag takes it."""
