"""The journal: what was asked of the engine and what it made of it, on disk before anything can be lost."""
