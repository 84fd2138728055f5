"""What one draws by: guides of a painting."""
