"""Pictures for other programs."""
