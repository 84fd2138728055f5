"""The panel of the painting's past."""
