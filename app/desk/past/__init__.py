"""The past of the painting as the window knows it."""
