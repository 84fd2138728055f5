"""What pens tell, seen while one tries them."""
