"""Shapes cut or torn from examples, for the collage and the orange."""
