"""The panel of example textures."""
