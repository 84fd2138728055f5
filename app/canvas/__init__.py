"""The canvas as the window shows it: the view, and the tiles, pictures and panels on the graphics card."""
