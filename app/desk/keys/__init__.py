"""What the artist has bound to keys, to buttons and to wheels."""
