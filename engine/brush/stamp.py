"""The one form in which every edit of pixels reaches the canvas: v' = snap(A v) + B."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from engine.numeric.address import Rect, TileKey
from engine.texture.planes import Planes
from engine.texture.record import Instance


@dataclass(frozen=True, eq=False, slots=True)
class Stamp:
    """What an edit does to one tile; not to be written to (tiles with the same change share one stamp).

    `keep`: A, float32 (128, 128) on the grid, 0..1: the part of every plane, and of all finer detail, that stays.
    `add`: B, float32 (4 + 3n, 128, 128) on the grid: premultiplied R, G, B, A, then red, green and blue amplitude of
    each of the n `inks`, which are sorted by key.
    """

    keep: np.ndarray
    add: np.ndarray
    inks: tuple[Instance, ...] = ()


class Edit(Protocol):
    """A change of some tiles of one level."""

    @property
    def level(self) -> int: ...

    @property
    def tiles(self) -> Sequence[TileKey]:
        """The tiles that may change, sorted by row, then column."""
        ...

    @property
    def rect(self) -> Rect:
        """A rectangle of pixels of `level` outside which nothing changes."""
        ...

    def stamp(self, key: TileKey, old: Planes) -> Stamp | None:
        """The change of one tile whose present values are `old`; None if there is none.  Same key and old, same
        stamp."""
        ...
