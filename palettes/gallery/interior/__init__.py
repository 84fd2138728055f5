"""The room that hangs on its own wall, part by part."""
