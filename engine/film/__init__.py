"""Films of a painting: how it was made, and flights through its levels."""
