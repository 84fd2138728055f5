"""Changes of a whole layer, seen before they are done."""
