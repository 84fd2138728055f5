"""The first start: brushes are made ready by processes beside the window, and what needs one meanwhile waits."""
