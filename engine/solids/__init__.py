"""Solid textures that are worked out place by place, objects to show them on, and pictures of these.

Heeger & Bergen 1995, sections 4 and 6; Perlin 1985, "An Image Synthesizer"; Lewis 1989, "Algorithms for Solid Noise
Synthesis".
"""
