"""Edges made of whole copies: strokes with a field of scattered copies end where the copies do (Lewis 1984, 5.2, 6.1).

A sparse field is a sum of displaced windows.  Of its points only those under the stroke count, so the stroke's edge is
that of the windows which lie there, and merges with the surroundings as they do.  The coverage is the sum of the
windows of these points, over half of what an endless field would have and at most 1.  Coverage that varies is taken
in steps: each is the coverage of the points that lie where the stroke's is above it.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace

import numpy as np

from engine.brush.ink import Texture, named
from engine.brush.mask import Coverage
from engine.brush.rim import Tiles
from engine.brush.settings import Brush
from engine.numeric import sparse
from engine.numeric.address import TILE, Rect, TileKey
from engine.numeric.memo import remembered
from engine.numeric.spectra import radial_window
from engine.texture.image import ImageSource
from engine.texture.spectral import Sparse

STEPS = 6  # of coverage between none and the brush's opacity
FULL = 0.5  # of the mean sum of windows, which counts as covered
WIDEST = 512  # px of the stroke's level: copies wider than that have no part in the edge


@dataclass(frozen=True, eq=False)
class Extent:
    """`impulse`: the window, as it is seen at the stroke's level; `noise`: the points; `opacity`: of the brush."""

    impulse: sparse.Impulse
    noise: sparse.Noise
    opacity: float
    _done: dict[TileKey, tuple[tuple[object, ...], np.ndarray]] = field(default_factory=dict, repr=False)

    @property
    def reach(self) -> int:
        """Tells how far beyond the stroke, and from a change of its coverage, pixels may change."""
        around = sparse.reach(self.impulse, Rect(0, 0, TILE, TILE))
        return max(-around.x0, -around.y0, around.x1 - TILE, around.y1 - TILE)

    def over(self, coverage: Coverage) -> Coverage:
        """Returns the coverage with edges of whole windows; its tiles are made when they are asked for."""
        rect = coverage.rect.grown(self.reach)
        keys = {
            near for key in coverage.tiles for near in key.rect.grown(self.reach).intersect(rect).tiles(coverage.level)
        }
        return replace(coverage, tiles=_Extended(self, coverage.tiles, frozenset(keys)), rect=rect)

    def tile(self, tiles: Tiles, key: TileKey) -> np.ndarray:
        """Returns one tile's coverage: float32 (128, 128)."""
        around = sparse.reach(self.impulse, key.rect)
        near = list(around.tiles(key.level))
        sources = tuple(tiles.get(part, 0.0) for part in near)
        known = self._done.get(key)
        if known is not None and all(a is b for a, b in zip(known[0], sources, strict=True)):
            return known[1]
        seen = np.zeros((around.height, around.width), np.float32)
        for part, source in zip(near, sources, strict=True):
            place = part.rect.intersect(around)
            seen[place.slices(around)] = source[place.slices(part.rect)] if isinstance(source, np.ndarray) else source
        made = self._made(seen, key.rect)
        self._done[key] = sources, made
        return made

    def _made(self, seen: np.ndarray, rect: Rect) -> np.ndarray:
        out = np.zeros((rect.height, rect.width), np.float32)
        area = self.impulse.size[0] * self.impulse.size[1]
        window = float(self.impulse.phases[0, 0].sum(dtype=np.float64)) * 4.0**self.impulse.coarser
        gain = np.float32(area / (FULL * self.noise.density * window))
        before = None
        for step in range(STEPS):
            within = (seen > self.opacity * (step + 0.5) / STEPS).astype(np.uint8)
            if not within.any():
                break
            if before is None or not np.array_equal(before[0], within):
                total = sparse.field(self.impulse, self.noise, rect, within)[0]
                before = within, np.minimum(total * gain, np.float32(1.0))
            out += before[1] * np.float32(self.opacity / STEPS)
        return out


class _Extended(Mapping[TileKey, "np.ndarray | float"]):
    """The tiles of a coverage and those around it, made when they are asked for."""

    def __init__(self, extent: Extent, tiles: Tiles, keys: frozenset[TileKey]) -> None:
        self._extent, self._tiles, self._keys = extent, tiles, keys

    def __getitem__(self, key: TileKey) -> np.ndarray:
        if key not in self._keys:
            raise KeyError(key)
        return self._extent.tile(self._tiles, key)

    def __iter__(self) -> Iterator[TileKey]:
        return iter(self._keys)

    def __len__(self) -> int:
        return len(self._keys)


def resolve(
    brush: Brush, textures: Mapping[str, Texture | ImageSource], level: int, seed: int, where: str = "brush"
) -> Extent | None:
    """Returns the extent of a brush's strokes at `level`: by the first scattered texture of its ink, or else of its
    density.

    None if it asks for none, or has no such texture, or one of windows wider than 512 px.
    """
    if not brush.extent:
        return None
    parts = [(part, f"{where}.ink[{i}]") for i, part in enumerate(brush.ink)]
    found = [named(part, textures, level, seed, place) for part, place in parts]
    if brush.density is not None:
        found.append(named(brush.density, textures, level, seed, f"{where}.density"))
    for made in found:
        if isinstance(made, Sparse) and made.source.there and made.period <= WIDEST:
            coarser = max(made.native - level, 0)
            size = made.impulse(made.native).size if made.native >= level else _own_size(made)
            points = made.noise
            window = _window(size, coarser, made.arithmetic)
            return Extent(window, sparse.Noise(points.key, points.density, sparse.ALIKE), brush.opacity)
    return None


def _own_size(made: Sparse) -> tuple[int, int]:
    """Of a sample that is enlarged: its size at the base level."""
    return max(1, round(made.period * made.source.height / made.source.width)), made.period


@remembered
def _window(size: tuple[int, int], coarser: int, arithmetic: int) -> sparse.Impulse:
    whole = sparse.Impulse.of(radial_window(*size, arithmetic)[None])
    return whole.seen(coarser) if coarser else whole
