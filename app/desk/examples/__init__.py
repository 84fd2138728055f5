"""Examples: the bundled ones, one's own, their regions and thumbnails."""
