"""What is kept of the painting's file besides itself: what it was, whose it is, what it was before."""
