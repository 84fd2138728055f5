"""Pictures as land: their heights, at any depth."""
