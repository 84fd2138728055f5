"""Textures by their names within written ones, those that other makers make."""
