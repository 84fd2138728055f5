"""Data of old states in fewer bytes."""
