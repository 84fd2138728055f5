"""The settings of tools, in a bar above the canvas."""
