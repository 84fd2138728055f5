"""What lies on a ground, found by itself: its region, how far each pixel of the rim belongs to it, and colours without
the ground (Ritter et al. 2006, section 9)."""
