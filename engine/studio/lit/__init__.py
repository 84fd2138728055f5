"""The heights that the light in the window needs."""
