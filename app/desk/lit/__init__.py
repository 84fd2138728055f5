"""The light on the canvas, as it is set on the desk."""
