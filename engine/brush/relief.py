"""What thins a stroke's coverage: the density of a dry brush, the grain of the surface painted on, the stroke's rim.

Lewis 1984, section 6.1: a second texture modulates the density of the first (dry brush), and a texture bound to the
canvas is felt by every brush (virtual surface).  All of it is a function of the stroke's coverage M and of the place
alone, so a stroke in progress looks as it will once it is done.  In order:

* **Extent**: edges of whole windows (module `extent`).
* **Rim**: times a curve of the distance to the stroke's rim (module `rim`).
* **Grain**: heights g, 0..1, of a surface that lies still under all strokes.  With amount a, the brush touches
  where (M (1 + s)/a - (1 - g))/s, clipped to 0..1, is above zero, s = 0.35: a light touch meets only the peaks, M = a
  fills the hollows too, and M = 1 whatever the amount.  What it touches it covers a little more: M + a M (1 - M).
* **Density**: times 1 - a + a s, s being the texture's value.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from engine.brush import extent
from engine.brush.extent import Extent
from engine.brush.ink import Texture, named
from engine.brush.located import Patches, located
from engine.brush.mask import Coverage
from engine.brush.parts import Surface
from engine.brush.rim import Rim, Tiles
from engine.brush.settings import Brush
from engine.brush.thinning import LazyTiles
from engine.numeric.address import TILE, Rect, TileKey
from engine.numeric.elementary import log2
from engine.numeric.kernel import kernel
from engine.numeric.pyramid import reduce
from engine.numeric.shaping import look_up, table
from engine.texture.grey import grey
from engine.texture.image import ImageSource
from engine.texture.record import Instance

SOFTNESS = 0.35  # of the line between what a brush touches and what it does not, in heights
Places = Mapping[TileKey, np.ndarray] | None
_MEMO = 192  # tiles of heights kept: 12 MB
_AVERAGED = 3  # levels coarser than the grain's coarsest at which it is averaged; beyond, it is level

_ZERO = np.float32(0.0)
_ONE = np.float32(1.0)


@dataclass(frozen=True, eq=False)
class Heights:
    """A texture's values s after its curve, tile by tile, at any level.

    `base`: the level the texture is bound to; coarser than that it is averaged, and then level.
    """

    made: Instance
    curve: np.ndarray
    _memo: dict[TileKey, np.ndarray] = field(default_factory=dict, repr=False)
    _patches: Patches | None = None  # of the one level of a stroke

    def plane(self, key: TileKey) -> np.ndarray:
        """float32 (128, 128), 0..1, not to be written to."""
        known = self._memo.get(key)
        if known is None:
            known = np.ascontiguousarray(self._values(key.level, key.rect))
            look_up(known.reshape(-1), self.curve, _ONE, _ZERO)
            while len(self._memo) >= _MEMO:
                self._memo.pop(next(iter(self._memo)), None)
            self._memo[key] = known
        return known

    def at(self, places: np.ndarray, covered: np.ndarray, level: int) -> np.ndarray:
        """As `plane`, where the pixels lie in the texture, float32 (2, 128, 128), and anything is `covered`."""
        if self._patches is None:
            object.__setattr__(self, "_patches", Patches(lambda rect: grey(self.made, level, rect)[None]))
        assert self._patches is not None
        found = np.ascontiguousarray(located(places, covered, self._patches)[0])
        look_up(found.reshape(-1), self.curve, _ONE, _ZERO)
        return found

    def _values(self, level: int, rect: Rect) -> np.ndarray:
        above = self.made.base - level
        if above <= 0:
            return grey(self.made, level, rect)
        if above > _AVERAGED:
            return np.full((rect.height, rect.width), self._mean, np.float32)
        values = grey(self.made, self.made.base, rect.zoomed(above))[None]
        for _ in range(above):
            values = reduce(values)
        out: np.ndarray = values[0]
        return out

    @cached_property
    def _mean(self) -> float:
        return float(grey(self.made, self.made.base, Rect(0, 0, 2 * TILE, 2 * TILE)).mean(dtype=np.float64))


def _heights(
    part: Surface | None, textures: Mapping[str, Texture | ImageSource], level: int, seed: int, where: str
) -> Heights | None:
    if part is None or part.amount == 0.0:
        return None
    return Heights(named(part, textures, level, seed, where), table(part.shaping or "identity"))


def _ground(
    part: Surface | None, textures: Mapping[str, Texture | ImageSource], seed: int, where: str
) -> Heights | None:
    """Returns the grain, bound to the coarsest level at which its period still has four pixels, so that all levels,
    finer and coarser than its own, see one and the same surface."""
    found = _heights(part, textures, part.level if part else 0, seed, where)
    if part is None or found is None:
        return None
    period = getattr(found.made, "period", None)
    if period is None:
        return found
    above = max(0, math.floor(log2(period / 4.0)))
    if isinstance(period, int):  # pictures come in whole pixels
        above = min(above, (period & -period).bit_length() - 1)
    if above == 0:
        return found
    smaller = period >> above if isinstance(period, int) else period / (1 << above)
    bound = Surface(part.texture, parameters=part.parameters.set("period", smaller))
    return Heights(named(bound, textures, part.level - above, seed, where), found.curve)


@dataclass(frozen=True, eq=False, slots=True)
class _Made:
    """A thinned tile, the coverage it was made of, and how deep inside the rim its pixels lie."""

    sources: tuple[np.ndarray | float, ...]
    tile: np.ndarray | float
    depths: np.ndarray | None


@dataclass(frozen=True, eq=False)
class Relief:
    """What thins the coverage of a brush's strokes at one level; nothing if every part is None."""

    density: Heights | None = None
    grain: Heights | None = None
    rim: Rim | None = None
    amounts: tuple[float, float] = (1.0, 1.0)  # of density and grain
    extent: Extent | None = None
    _done: dict[TileKey, _Made] = field(default_factory=dict, repr=False)

    @property
    def reach(self) -> int:
        """Tells how far from a pixel whose coverage changes others may change too, in px."""
        return (self.rim.reach if self.rim else 0) + self.spread

    @property
    def spread(self) -> int:
        """Tells how far beyond its own coverage the stroke goes, in px."""
        return self.extent.reach if self.extent else 0

    def over(self, coverage: Coverage) -> Coverage:
        """Returns the coverage as this relief thins it; its tiles are made when they are asked for."""
        if self.extent is not None:
            coverage = self.extent.over(coverage)
        if self.density is None and self.grain is None and self.rim is None:
            return coverage
        stain = None
        if self.rim is not None and self.rim.colour is not None:
            stain = _Stain(self, coverage.tiles, self.rim, self.rim.colour, coverage.places)
        tiles, places = coverage.tiles, coverage.places
        return replace(coverage, tiles=LazyTiles(tiles, lambda key: self.made(tiles, key, places).tile), stain=stain)

    def made(self, tiles: Tiles, key: TileKey, places: Places = None) -> _Made:
        """Returns one tile of a coverage, thinned; `places`: as of a Coverage."""
        covered = tiles[key]
        sources = self.rim.around(tiles, key) if self.rim else (covered,)
        known = self._done.get(key)
        # Tiles that a Coverage holds are never written to: the same array holds the same values.
        if known is not None and all(a is b for a, b in zip(known.sources, sources, strict=True)):
            return known
        depths = self.rim.depths(sources) if self.rim else None
        made = self._done[key] = _Made(sources, self._tile(covered, key, depths, (places or {}).get(key)), depths)
        return made

    def _tile(
        self, covered: np.ndarray | float, key: TileKey, depths: np.ndarray | None, places: np.ndarray | None
    ) -> np.ndarray | float:
        if not isinstance(covered, np.ndarray):
            if covered == 0.0:
                return covered
            if self.grain is None and self.density is None and depths is None:
                return covered * self.rim.within if self.rim else covered
            covered = np.full((TILE, TILE), covered, np.float32)
        out = covered.copy()
        if self.rim is not None:
            out *= np.float32(self.rim.within) if depths is None else self.rim.factors(depths)
        if self.grain is not None:
            _dig(out, self.grain.plane(key), np.float32(self.amounts[1]), out)
        if self.density is not None:
            values = self.density.plane(key) if places is None else self.density.at(places, out, key.level)
            _thin(out, values, np.float32(self.amounts[0]))
        return out


@dataclass(frozen=True, eq=False, slots=True)
class _Stain:
    """The rim's colour in the paint (`mask.Stain`)."""

    relief: Relief
    tiles: Tiles
    rim: Rim
    colour: np.ndarray
    places: Places

    def part(self, key: TileKey) -> np.ndarray | None:
        depths = self.relief.made(self.tiles, key, self.places).depths
        return None if depths is None else self.rim.stain(depths)


def resolve(
    brush: Brush,
    textures: Mapping[str, Texture | ImageSource],
    level: int,
    seeds: tuple[int, int],
    where: str = "brush",
) -> Relief:
    """Returns what thins the strokes of a brush at `level`.

    `seeds`: of the stroke's textures, and of the painting, to which the grain belongs.  BrushError names the field.
    """
    density, grain = brush.density, brush.grain
    return Relief(
        _heights(density, textures, level, seeds[0], f"{where}.density"),
        _ground(grain, textures, seeds[1], f"{where}.grain"),
        Rim.of(brush),
        (density.amount if density else 0.0, grain.amount if grain else 0.0),
        extent.resolve(brush, textures, level, seeds[0], where),
    )


@kernel
def _dig(coverage: np.ndarray, heights: np.ndarray, amount: np.float32, out: np.ndarray) -> None:
    """Writes what of M touches the heights g: see the module's text.  All float32 (h, w), amount above 0."""
    soft = np.float32(SOFTNESS)
    gain = (_ONE + soft) / (soft * amount)
    slope = _ONE / soft
    for y in range(coverage.shape[0]):
        row, g, o = coverage[y], heights[y], out[y]
        for x in range(row.size):
            m = row[x]
            touch = min(max(m * gain - (_ONE - g[x]) * slope, _ZERO), _ONE)
            o[x] = touch * (m + amount * m * (_ONE - m))


@kernel
def _thin(coverage: np.ndarray, values: np.ndarray, amount: np.float32) -> None:
    """coverage (h, w) times 1 - amount + amount s, in place."""
    for y in range(coverage.shape[0]):
        m, s = coverage[y], values[y]
        for x in range(m.size):
            m[x] *= _ONE - amount + amount * s[x]
