"""What is selected of a layer, taken out of it and moved."""
