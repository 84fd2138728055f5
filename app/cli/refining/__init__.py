"""The command that makes pictures finer."""
