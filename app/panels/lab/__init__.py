"""The texture lab and the analysis."""
