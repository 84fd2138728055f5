"""The commands about textures that users write."""
