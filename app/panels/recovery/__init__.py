"""Cards of paintings that can be had back."""
