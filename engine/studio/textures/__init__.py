"""Textures and examples that are made while one looks: the lab, matching, regions, swatches."""
