"""What is held in memory, told to the window."""
