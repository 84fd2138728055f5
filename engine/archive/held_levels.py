"""How much of a painting's coarser levels is held while a picture or a file of it is written."""

from __future__ import annotations

from engine.keeping import memory
from engine.painting.cascade import PIXEL
from engine.painting.rendering import HELD_OF_ALL

_PART = 16  # of the budget of memory, that they may take


def held_pixels() -> int:
    """Returns the pixels of all layers' coarser levels up to which these are held."""
    return min(HELD_OF_ALL, memory.budget() // (_PART * PIXEL))
