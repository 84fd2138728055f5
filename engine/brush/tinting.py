"""The colour of a stroke whose dabs have their own: beside the coverage, the mean of what was laid at each pixel.

A dab of strength k, opacity times flow times its profile, over a coverage that is M once it is laid, brings the mean c
to c + (t - c) k / M, t being the dab's own: a dab that covers in full leaves nothing of what lay there.
"""

from __future__ import annotations

import numpy as np

from engine.brush.blending import lay_round
from engine.brush.print_form import Planes4, Print, TwoInts
from engine.numeric.address import TILE
from engine.numeric.kernel import Array

_Tiles = dict[TwoInts, np.ndarray]


class Tinted:
    """A print that lays the dabs of another one, round if that is None, with their tints: the last `count` columns of
    discs.  `tiles`: by the corner of a tile, float32 (count, 128, 128), and where dabs are `placed`
    two planes more: where their textures lie."""

    def __init__(self, laid: Print | None, count: int, placed: bool = False) -> None:
        self._laid, self._count, self._all = laid, count, count + 2 * placed
        self.tiles: dict[TwoInts, np.ndarray] = {}
        self._lent: set[TwoInts] = set()
        self._strength = np.zeros((TILE, TILE), np.float32)

    def lay(self, coverage: Array, discs: Array, which: Array, count: TwoInts, corner: TwoInts) -> None:
        """Lays the discs `which` into a tile's coverage, as `Pattern.lay`, and their tints over those there."""
        tints = self.tiles.get(corner)
        if tints is None or corner in self._lent:
            tints = np.zeros((self._all, TILE, TILE), np.float32) if tints is None else tints.copy()
            self._lent.discard(corner)
        self.tiles[corner] = tints
        planes = coverage, self._strength, tints[: self._count], tints[self._count :]
        if self._laid is None:
            lay_round(planes, discs, which, corner)
        else:
            self._laid.lay_tinted(planes, discs, which, count, corner)

    def lay_tinted(self, planes: Planes4, discs: Array, which: Array, count: TwoInts, corner: TwoInts) -> None:
        """As `Print.lay_tinted`: its own tints take the place of others."""
        self.lay(planes[0], discs, which, count, corner)

    def of_copy(self, number: int) -> Print:
        """Returns what the dabs of one copy alone look like."""
        return self if self._laid is None else self._laid.of_copy(number)

    def told(self) -> tuple[_Tiles | None, _Tiles | None]:
        """Returns the tints so far, which later dabs do not change, and where textures lie; None where there are no
        such."""
        self._lent, n = set(self.tiles), self._count
        tints = {corner: tile[:n] for corner, tile in self.tiles.items()} if n else None
        return tints, {corner: tile[n:] for corner, tile in self.tiles.items()} if self._all > n else None
