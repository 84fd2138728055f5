"""A selection as a value: a pyramid whose alpha tells how far each place is selected, at every level."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from immutables import Map

from engine.canvas.evaluate import evaluate_sparse
from engine.canvas.placing.pose import Pose
from engine.canvas.store import Pyramid
from engine.canvas.tile_cache import TileCache
from engine.numeric.address import Rect

_ALPHA = 3
_ONE = np.float32(1.0)


@dataclass(frozen=True, eq=False, slots=True)
class Selection:
    """`pyramid`: its alpha is how far a place is selected; `inverse`: how far it is not.  Its colour is black.
    `off`: as the mask of a layer it is put aside, and hides nothing.  `pose`: where the placement was whose mask it is
    when it was made, and it goes along with that from there; None: it lies where it is seen."""

    pyramid: Pyramid
    inverse: bool = False
    off: bool = False
    pose: Pose | None = None

    @property
    def everything(self) -> bool:
        """Tells whether all the canvas is selected."""
        return self.inverse and self.pyramid.coarsest is None

    def inverted(self) -> Selection:
        """Returns what is not selected."""
        return replace(self, inverse=not self.inverse)

    def part(self, level: int, rect: Rect, cache: TileCache | None = None) -> np.ndarray | float:
        """Returns how far the pixels of a rectangle are selected, 0..1: a float where all are alike, else float32
        (h, w), not to be written to."""
        value = evaluate_sparse(self.pyramid, level, rect, cache)
        return self.share(None if value is None else value.rgba)

    def share(self, planes: np.ndarray | None) -> np.ndarray | float:
        """As `part`, of pixels of its pyramid, (4, h, w); None: nothing lies there."""
        if planes is None:
            return float(self.inverse)
        alpha = planes[_ALPHA]
        first = alpha[0, 0]
        if (alpha == first).all():
            return 1.0 - float(first) if self.inverse else float(first)
        out: np.ndarray = _ONE - alpha if self.inverse else alpha
        return out

    def chosen(self, level: int, rect: Rect, cache: TileCache | None = None) -> np.ndarray:
        """Returns the pixels that are selected at least half: bool (h, w)."""
        part = self.part(level, rect, cache)
        out = np.empty((rect.height, rect.width), np.bool_)
        out[...] = part >= 0.5 if isinstance(part, float) else np.greater_equal(part, 0.5)
        return out


Saved = Map[str, Selection]  # by name
NONE_SAVED: Saved = Map()
EVERYTHING = Selection(Pyramid(), inverse=True)
