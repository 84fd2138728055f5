"""The log of a session: what was done, of which the oldest lies on disk."""
