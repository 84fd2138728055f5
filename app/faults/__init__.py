"""Faults: the log that they go to, and what looks out for them on the window's thread."""
