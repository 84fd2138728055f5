"""What brushes heap on a layer: heights beside its paint."""
