"""The op `predict`: a stroke filled by linear prediction from the painting around it (Lewis 1984, section 6.1).

The sample lies around the place where the stroke begins; the predictor fitted to it fills the stroke in raster order,
and its memory is what is painted around.  A stroke is filled as a whole, so that its tiles have no seams.

If the sample is opaque, so is what is foretold, and what is not painted tells nothing.  If not, alpha is foretold with
the premultiplied colours, so that the gaps of a texture stay gaps.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from engine.brush.mask import Coverage
from engine.numeric.address import Rect
from engine.numeric.arithmetic import LIBRARY
from engine.numeric.prediction import REACH_CAP, Predictor, fit, noise_at
from engine.texture.planes import Planes

AREA_CAP = 1 << 22  # pixels of the rectangle around a stroke
_ALPHA = 3
_OPAQUE = np.float32(0.998)  # half a step of 8 bits below 1
_TINY = np.float32(1e-6)

Read = Callable[[Rect], Planes]


@dataclass(frozen=True, eq=False, slots=True)
class Foretold:
    """Premultiplied paint, float32 (4, h, w), of the pixels of `rect`: those of the stroke are foretold."""

    rect: Rect
    paint: np.ndarray

    def over(self, rect: Rect) -> np.ndarray:
        """Returns the paint over a tile: float32 (4, h, w), 0 where the stroke is not."""
        out = np.zeros((4, rect.height, rect.width), np.float32)
        part = rect.intersect(self.rect)
        if not part.empty:
            rows, columns = part.slices(rect)
            out[:, rows, columns] = self.paint[:, *part.slices(self.rect)]
        return out


def predictor(
    read: Read, start: tuple[int, int], window: int, reach: int, arithmetic: int = LIBRARY
) -> Predictor | None:
    """Fitted to the `window` x `window` pixels around `start`, less the rows and columns at their sides in which there
    is no paint: of 3 channels if all of that is opaque, else of 4.  None if there is no paint at all."""
    paint = _paint(read(Rect.at(start[0] - window // 2, start[1] - window // 2, window, window)))
    rows, columns = (np.flatnonzero(paint[_ALPHA].any(axis=axis)) for axis in (1, 0))
    if not rows.size:
        return None
    sample = paint[:, rows[0] : rows[-1] + 1, columns[0] : columns[-1] + 1]
    return fit(_straight(sample) if float(sample[_ALPHA].min()) >= _OPAQUE else sample, reach, arithmetic)


def foretell(coverage: Coverage, read: Read, found: Predictor, seed: int) -> Foretold:
    """Returns the stroke's pixels from what lies around them; noise by place, under `seed`."""
    rect = coverage.rect.grown(REACH_CAP)
    mask = np.zeros((rect.height, rect.width), np.bool_)
    for key in coverage.keys:
        part = key.rect.intersect(rect)
        if not part.empty:
            mask[part.slices(rect)] = coverage.on_grid(key)[part.slices(key.rect)] > 0.0
    paint = _paint(read(rect))
    opaque = len(found.mean) == _ALPHA
    around, known = (_straight(paint), paint[_ALPHA] > 0.0) if opaque else (paint, None)
    noise = noise_at(seed, rect.x0, rect.y0, around.shape)
    filled = found.continue_into(around, mask, noise, known, (rect.x0, rect.y0))
    alpha = np.ones(mask.shape, np.float32) if opaque else np.clip(filled[_ALPHA], 0.0, 1.0)
    return Foretold(rect, np.concatenate([np.clip(filled[:_ALPHA], 0.0, alpha), alpha[None]]))


def _paint(planes: Planes) -> np.ndarray:
    """Premultiplied colours no brighter than their alpha, and alpha: float32 (4, h, w)."""
    alpha = planes.data[_ALPHA]
    return np.concatenate([np.clip(planes.data[:_ALPHA], 0.0, alpha), alpha[None]], dtype=np.float32)


def _straight(paint: np.ndarray) -> np.ndarray:
    """Straight colours, float32 (3, h, w); black where there are none."""
    return np.ascontiguousarray(paint[:_ALPHA] / np.maximum(paint[_ALPHA], _TINY))
