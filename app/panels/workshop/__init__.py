"""The workshop, in which textures are written."""
