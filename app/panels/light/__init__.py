"""The panel of the light."""
