"""The op `predict`: a stroke filled by linear prediction from the painting around it (Lewis 1984, section 6.1).

The sample lies around the place where the stroke begins; the predictor fitted to it fills the stroke in raster order,
and its memory is what is painted around.  A stroke is filled as a whole, so that its tiles have no seams.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from engine.brush.mask import Coverage
from engine.numeric.address import Rect
from engine.numeric.prediction import REACH_CAP, Predictor, fit, noise_at
from engine.texture.planes import Planes

AREA_CAP = 1 << 22  # pixels of the rectangle around a stroke
_ALPHA = 3
_TINY = np.float32(1e-6)

Read = Callable[[Rect], Planes]


@dataclass(frozen=True, eq=False, slots=True)
class Foretold:
    """Straight colours, float32 (3, h, w), of the pixels of `rect`: those of the stroke are foretold."""

    rect: Rect
    colours: np.ndarray

    def over(self, rect: Rect) -> np.ndarray:
        """Premultiplied, opaque paint over a tile: float32 (4, h, w), 0 where the stroke is not."""
        out = np.zeros((4, rect.height, rect.width), np.float32)
        part = rect.intersect(self.rect)
        if not part.empty:
            rows, columns = part.slices(rect)
            out[:_ALPHA, rows, columns] = self.colours[:, *part.slices(self.rect)]
            out[_ALPHA, rows, columns] = 1.0
        return out


def predictor(read: Read, start: tuple[int, int], window: int, reach: int) -> Predictor:
    """Fitted to the colours of the `window` x `window` pixels around `start`."""
    colours, _ = _straight(read(Rect.at(start[0] - window // 2, start[1] - window // 2, window, window)))
    return fit(colours, reach)


def foretell(coverage: Coverage, read: Read, found: Predictor, seed: int) -> Foretold:
    """The stroke's pixels from what lies around them; noise by place, under `seed`."""
    rect = coverage.rect.grown(REACH_CAP)
    mask = np.zeros((rect.height, rect.width), np.bool_)
    for key in coverage.keys:
        part = key.rect.intersect(rect)
        if not part.empty:
            mask[part.slices(rect)] = coverage.on_grid(key)[part.slices(key.rect)] > 0.0
    colours, known = _straight(read(rect))
    noise = noise_at(seed, rect.x0, rect.y0, colours.shape)
    filled = found.continue_into(colours, mask, noise, known, (rect.x0, rect.y0))
    return Foretold(rect, np.clip(filled, 0.0, 1.0))


def _straight(planes: Planes) -> tuple[np.ndarray, np.ndarray]:
    """Straight colours, float32 (3, h, w), and where there are any, bool (h, w)."""
    alpha = planes.data[_ALPHA]
    colours = planes.data[:_ALPHA] / np.maximum(alpha, _TINY)
    return np.ascontiguousarray(np.clip(colours, 0.0, 1.0), np.float32), alpha > 0.0
