"""Pen samples to spaced dabs to the (A, B) form in which every brush changes the canvas."""
