"""The panel of places."""
