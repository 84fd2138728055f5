"""Files of layers, as other programs write them: what lies in them, and their pictures side by side."""
