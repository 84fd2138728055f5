"""What is selected: a pyramid whose alpha counts, and how it limits what strokes do."""
