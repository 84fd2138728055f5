"""What is seen elsewhere while it is dragged or painted."""
