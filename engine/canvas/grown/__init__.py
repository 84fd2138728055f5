"""What was painted with examples, as other levels than its own show it."""
