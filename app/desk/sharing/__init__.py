"""Brushes that are named, grouped, changed and handed on."""
