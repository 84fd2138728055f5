"""Requests and what becomes of them, as the journal is told of them."""
