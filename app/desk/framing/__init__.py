"""The frame while it is edited."""
