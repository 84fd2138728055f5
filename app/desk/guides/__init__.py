"""What one draws by: symmetry, shapes, guides."""
