"""Strangers' bytes: ZIP, PNG, TIFF, XML, strict JSON, atomic replacement, limits and faults."""
