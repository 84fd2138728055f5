"""What changes heights as a whole: erosion, ground from files."""
