"""The painting as land, as the window shows it: tiles while the eye moves, a picture by rays while it rests."""
