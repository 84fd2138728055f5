"""What is heaped on the layer of a stroke in progress, as it will be."""

from __future__ import annotations

import numpy as np

from engine.canvas.heaps.heaping import heaped_by
from engine.numeric.address import Rect
from engine.strokes.paint_stroke import LiveStroke


def live_heaps(live: LiveStroke, rect: Rect) -> np.ndarray | float:
    """Returns it in `rect` of the stroke's level, in its pixels: float32 (h, w), or 0 where nothing is."""
    return heaped_by(live.layer, live.heap_edits, live.level, rect, live.cache)
