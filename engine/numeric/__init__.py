"""Arrays in, arrays out: the grid, addresses, expand and reduce, hashing, blend modes, colour."""
