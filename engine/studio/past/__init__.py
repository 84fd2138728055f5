"""What was done: the steps with small pictures, looking and jumping back, and what was painted at a place."""
