"""The land in the window: drawn by the card while the eye moves, fading into a picture by rays while it rests."""
