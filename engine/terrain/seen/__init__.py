"""Land as a window shows it while the eye moves: which tiles are seen, what they hold, where a ray meets them."""
