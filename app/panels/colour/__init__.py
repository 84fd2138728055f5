"""The panels of colour and ink."""
