"""The brush in the hand: its colour and its size."""
