"""The matching panel."""
