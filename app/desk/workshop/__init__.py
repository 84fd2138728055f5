"""The texture that is being written: what is set, and what lies in files."""
