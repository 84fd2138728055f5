"""The one form in which every edit of pixels reaches the canvas: v' = snap(A v) + B."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from engine.brush import coat
from engine.numeric.address import Rect, TileKey
from engine.texture.planes import COLOURS, Planes
from engine.texture.record import Instance


@dataclass(frozen=True, eq=False, slots=True)
class Stamp:
    """What an edit does to one tile; not to be written to (tiles with the same change share one stamp).

    `keep`: A, float32 (128, 128) on the grid, -1..2: the part of every plane, and of all finer detail, that stays.
    Paint has 0..1; more than 1 raises the contrast of what lies there, below 0 turns it round.  An edit whose A is not
    within 0..1 sees to it that ink stays within -2..2.
    `paint`: B, as `add` gives it, or a colour, float32 (3,), of which it is snap((1 - A) colour), and of alpha 1 - A.
    `inks`: the n instances of B's amplitudes, sorted by key.
    `plain`: B is 0 wherever A is 1, so that A alone tells which pixels change.
    """

    keep: np.ndarray
    paint: np.ndarray
    inks: tuple[Instance, ...] = ()
    plain: bool = False

    @property
    def add(self) -> np.ndarray:
        """Gives B, float32 (4 + 3n, 128, 128) on the grid: premultiplied R, G, B, A, then red, green and blue amplitude
        of each of the inks."""
        if self.paint.ndim > 1:
            return self.paint
        out = np.empty((COLOURS, *self.keep.shape), np.float32)
        coat.lay(self.keep, self.paint, out)
        return out


class Edit(Protocol):
    """A change of some tiles of one level."""

    @property
    def level(self) -> int:
        """Gives the level of the pixels that it changes."""
        ...

    @property
    def tiles(self) -> Sequence[TileKey]:
        """Returns the tiles that may change, sorted by row, then column."""
        ...

    @property
    def rect(self) -> Rect:
        """Returns a rectangle of pixels of `level` outside which nothing changes."""
        ...

    @property
    def spares_alpha(self) -> bool:
        """Tells whether alpha stays as it is at every level, whatever A is; B of alpha then counts for nothing."""
        ...

    def stamp(self, key: TileKey, old: Planes) -> Stamp | None:
        """Returns the change of one tile whose present values are `old`; None if there is none.  Same key and old, same
        stamp."""
        ...
