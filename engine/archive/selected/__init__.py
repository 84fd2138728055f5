"""Selections in a painting's file."""
