"""Detail below a picture's own pixels, as its finest pixels follow from coarser ones (Perlin & Velho 1995, 7.2)."""
