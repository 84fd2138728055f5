"""The controls that all panels share."""
