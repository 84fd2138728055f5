"""A tile of land as the card draws it, and how its corners come to lie.  Light: the window imports it.

A tile (level, x, y) covers QUADS x QUADS pixels of its level, from corner to corner; a corner of a level is a corner of
every finer one.  Heights are whole numbers of 2^-8 pixels of the tile's level, so that sums of them are exact in the
card's float32: where two tiles meet they have the same numbers to add, and come to the same ones, bit for bit.

**Morphing** (CDLOD: Strugar 2010).  Each corner knows its own height and that of the corner of the next coarser level
which it moves onto as it gets farther away: k = 0 is the tile's own mesh, k = 1 that of the tile it is a quarter of,
with the same corners, heights and diagonals.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from typing import NamedTuple

import numpy as np

QUADS = 16  # a side of the mesh
FINER = 3  # levels from a mesh to the texels on it
TEXELS = QUADS << FINER
TEXEL_RIM = 2  # texels around those of the tile
UNIT = 8  # bits: heights are told in 2^-8 pixels of the level
BRIGHTEST = 4.0  # linear light that is written as 255
_SKIRT = 2.0  # pixels of the level that a skirt hangs down, as long as a tile's neighbours are being made


class TileKey(NamedTuple):
    """A tile of land."""

    level: int
    x: int
    y: int

    def children(self) -> tuple[TileKey, TileKey, TileKey, TileKey]:
        """Returns its four quarters."""
        x, y, level = 2 * self.x, 2 * self.y, self.level + 1
        return (
            TileKey(level, x, y),
            TileKey(level, x + 1, y),
            TileKey(level, x, y + 1),
            TileKey(level, x + 1, y + 1),
        )

    @property
    def parent(self) -> TileKey:
        """Returns the tile that it is a quarter of."""
        return TileKey(self.level - 1, self.x >> 1, self.y >> 1)


@dataclass(frozen=True, slots=True, eq=False)
class LandTile:
    """`heights` float32 (QUADS + 1, QUADS + 1, 2): each corner's own and the coarser one's that it moves onto, units of
    2^-UNIT pixels of the level above `base` of them; `low`, `high`: of these.  `surface` float32 (TEXELS + 1,
    TEXELS + 1): corners of the texels' level, in pixels of the tile's level above the base.  `colours` uint8 (n, n, 3):
    roots of lit colours over BRIGHTEST, with TEXEL_RIM texels around."""

    key: TileKey
    base: int
    heights: np.ndarray
    low: float
    high: float
    surface: np.ndarray
    colours: np.ndarray

    @property
    def held(self) -> int:
        """Returns its bytes, but for those on the card."""
        return self.heights.nbytes + self.surface.nbytes + self.colours.nbytes


@cache
def grid() -> np.ndarray:
    """Returns the corners of a mesh, with those of its skirt after them: float32 (n, 3), column, row, how far down."""
    n = np.arange(QUADS + 1)
    rows, columns = np.meshgrid(n, n, indexing="ij")
    inner = np.stack([columns.ravel(), rows.ravel(), np.zeros(columns.size)], axis=1)
    rims = [np.stack([*side, np.full(QUADS + 1, _SKIRT * (1 << UNIT))], axis=1) for side in _sides()]
    return np.concatenate([inner, *rims]).astype(np.float32)


def _sides() -> list[tuple[np.ndarray, np.ndarray]]:
    """Returns columns and rows of the four rims."""
    n, first, last = np.arange(QUADS + 1), np.zeros(QUADS + 1, int), np.full(QUADS + 1, QUADS)
    return [(n, first), (last, n), (n[::-1], last), (first, n[::-1])]


@cache
def triangles() -> np.ndarray:
    """Returns the corners of all triangles, int32 (n, 3): every quad is cut from its first corner to its last one."""
    j, i = (a.ravel() for a in np.meshgrid(np.arange(QUADS), np.arange(QUADS), indexing="ij"))
    wide = QUADS + 1
    a = j * wide + i
    faces = [np.stack([a, a + 1, a + wide + 1], axis=1), np.stack([a, a + wide + 1, a + wide], axis=1)]
    for s, (columns, rows) in enumerate(_sides()):
        top, low = rows * wide + columns, wide * wide + s * wide + np.arange(wide)
        faces += [np.stack([top[:-1], low[:-1], low[1:]], axis=1), np.stack([top[:-1], low[1:], top[1:]], axis=1)]
    return np.concatenate(faces).astype(np.int32)


def corner_heights(tile: LandTile) -> np.ndarray:
    """Returns the two heights of each of the `grid`'s corners, float32 (n, 2)."""
    at = grid()[:, :2].astype(np.int64)
    return np.ascontiguousarray(tile.heights[at[:, 1], at[:, 0]])


class Placed(NamedTuple):
    """Where a tile lies for the card, all numbers exact in float32: first corner and base from an anchor near the eye,
    the side of a pixel and of a unit of height; all in pixels of one level, the finest seen.  `begins`, `ends`: the
    distances between which it morphs."""

    corner: tuple[float, float, float]
    step: float
    unit: float
    begins: float
    ends: float


def morphed(tile: LandTile, placed: Placed, eye: tuple[float, float, float], clear: float) -> np.ndarray:
    """Returns what `terrain.vert` makes of a tile's corners: float32 (QUADS + 1, QUADS + 1, 3), from the eye, which is
    at `eye` from the anchor and `clear` above the ground below."""
    f = np.float32
    ij = grid()[: (QUADS + 1) ** 2, :2]
    corner, seen = np.array(placed.corner, f), np.array(eye, f)
    away = np.abs(corner[:2] + ij * f(placed.step) - seen[:2]).max(axis=1)
    k = (np.maximum(away, f(clear)) - f(placed.begins)) / (f(placed.ends) - f(placed.begins))
    k = np.clip(k, f(0), f(1))
    moved = ij - (ij % f(2)) * k[:, None]
    h = tile.heights.reshape(-1, 2)
    height = h[:, 0] + np.floor((h[:, 1] - h[:, 0]) * k + f(0.5))
    at = np.empty((len(ij), 3), f)
    at[:, :2] = corner[:2] + moved * f(placed.step)
    at[:, 2] = corner[2] + height * f(placed.unit)
    out: np.ndarray = (at - seen).reshape(QUADS + 1, QUADS + 1, 3)
    return out
