"""The makers of texture, one module each, and the record they share."""
