"""Paintings in files: saving, opening, packs of tiles, import and export."""
