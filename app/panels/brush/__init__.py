"""The brush panel."""
