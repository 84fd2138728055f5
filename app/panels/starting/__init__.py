"""The page that the first start shows."""
