"""The ground of one colour under all layers."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from engine.numeric.address import Rect


@dataclass(frozen=True, slots=True)
class Paper:
    """The ground under all layers, of one colour "#rrggbb", opaque and without end."""

    colour: str

    def planes(self, rect: Rect) -> np.ndarray:
        """Returns its pixels, (4, h, w), not to be written to."""
        out = np.ones((4, rect.height, rect.width), np.float32)
        for c in range(3):
            out[c] = np.float32(int(self.colour[1 + 2 * c : 3 + 2 * c], 16)) / np.float32(255)
        return out
