"""A layer's mask as compositing reads it: at any level, and through whatever the layer is seen."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from engine.canvas.evaluate import shown
from engine.canvas.placing.through import Seen, looked_through
from engine.canvas.selecting.selection import Selection
from engine.numeric.address import Rect

_ALPHA = 3
_ONE = np.float32(1)


@dataclass(frozen=True, slots=True)
class Mask:
    """How far each place of a node shows."""

    selection: Selection

    def planes(self, level: int, rect: Rect, seen: Seen) -> np.ndarray | None:
        """Returns its pixels, (4, h, w), of which the alpha counts, where the node is seen so; None: nothing shows."""
        pixels = looked_through(lambda at, part: shown(self.selection.pyramid, at, part), level, rect, seen)
        if not self.selection.inverse:
            return pixels
        out = np.ones((4, rect.height, rect.width), np.float32)
        if pixels is not None:
            out[_ALPHA] = _ONE - pixels[_ALPHA]
        return out
