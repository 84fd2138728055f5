"""The land as the window knows it: where the eye is, which tiles it holds."""
