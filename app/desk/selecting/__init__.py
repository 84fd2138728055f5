"""The selection as the window knows it."""
