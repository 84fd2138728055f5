"""Layers as the panel shows them: small pictures of them, and one of them seen alone."""
