"""Where panels lie: in columns, over the canvas, or nowhere; kept, and under names."""
