"""The language of the window: catalogues, imgui's texts in it, and fonts for it."""
