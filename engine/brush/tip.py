"""Small brushes: dabs in the shape of a texture (Lewis 1984, section 6.1).

Either every dab is a stamp of the texture's own sample, laid out over the dab whatever its size, or every dab is
another window into a field of the texture, chosen by the stroke's seed and the dab's number: a "brushful" of it.
"""

from __future__ import annotations

import math
from collections.abc import Hashable, Mapping
from dataclasses import dataclass, replace
from typing import Any, cast

import numpy as np

from engine.brush.blending import blend_one
from engine.brush.copies import Copies, Copy, Torus
from engine.brush.discs import CEILING, CX, CY, RATE, RIN2, ROUT, SCALE
from engine.brush.ink import Texture, named
from engine.brush.parts import Tip
from engine.brush.print_form import Planes4, TwoInts
from engine.brush.settings import Brush
from engine.numeric.address import TILE, Rect
from engine.numeric.curves import Shape
from engine.numeric.elementary import log2
from engine.numeric.hashing import fold_key, mix64
from engine.numeric.kernel import Array, inlined, kernel
from engine.numeric.memo import remembered
from engine.numeric.pyramid import reduce
from engine.numeric.shaping import look_up, table
from engine.texture.grey import LUMINANCE, grey
from engine.texture.image import ImageSource, stretched
from engine.texture.record import Instance

LARGEST = 512  # pixels along a side of a sample
FIELD = 512  # and of the field that windows are cut from, or twice that for large dabs
_WIDE = 96.0  # px: from this radius on dabs are large
_SMALLEST = 4
_DOMAIN = 0x746970  # "tip"

_ZERO = np.float32(0.0)
_ONE = np.float32(1.0)
_TWO = np.float32(2.0)
_THREE = np.float32(3.0)


@dataclass(frozen=True, eq=False, slots=True)
class Pattern:
    """What dabs are filled with.

    `planes`: square planes of 0..1 one after the other, float32 (sum of their sizes squared,): the sample as wide as
    the brush's dab, half as wide, and so on; or, if `windows`, one field in pixels of the stroke's level.
    `sizes`: int64 (n,), how many pixels each is wide.  `key`: of the windows' places, a uint64.  `ways`: float64
    (1 + copies, 4), from a stroke's own dab and from each copy of it, the matrix row by row by which a place of the dab
    is brought onto the sample; None where all lie as the sample does.
    """

    planes: np.ndarray
    sizes: np.ndarray
    windows: bool
    key: int
    ways: np.ndarray | None = None

    def lay(self, coverage: Array, discs: Array, which: Array, count: TwoInts, corner: TwoInts) -> None:
        """Lays the discs `which` into a tile's coverage, in order, each filled with the pattern.

        `count`: the number of the stroke's dab that is the first of `discs`, and how many of them are copies of one;
        `corner`: left and top of the tile, px.
        """
        if self.windows:
            _lay_windows(coverage, discs, which, *count, np.uint64(self.key), *corner, self.planes, self.sizes[0])
        elif self.ways is None:
            _lay_samples(coverage, discs, which, *corner, self.planes, self.sizes)
        else:
            _lay_copies(coverage, discs, which, *count, self.ways, *corner, self.planes, self.sizes)

    def lay_tinted(self, planes: Planes4, discs: Array, which: Array, count: TwoInts, corner: TwoInts) -> None:
        """As `Print.lay_tinted`."""
        for k in range(len(which)):
            for plane in planes[:2]:
                self.lay(plane, discs, which[k : k + 1], count, corner)
            blend_one(planes, discs[which[k]], *corner)

    def of_copy(self, number: int) -> Pattern:
        """Returns the pattern for the dabs of one copy alone; 0: of the stroke itself."""
        return self if self.ways is None else replace(self, ways=self.ways[number : number + 1])


def resolve(
    brush: Brush, textures: Mapping[str, Texture | ImageSource], level: int, seed: int, where: str = "brush"
) -> Pattern | None:
    """Returns the pattern of a brush's tip for a stroke at `level`; None if its dabs are plain.  BrushError names
    the field."""
    tip = brush.tip
    if tip is None:
        return None
    at = f"{where}.tip"
    if tip.source == "window":
        size = FIELD if brush.radius < _WIDE else 2 * FIELD
        field = named(tip, textures, level, seed, at)
        return Pattern(
            _field(cast(Hashable, field), tip.shaping, size), np.array([size]), True, fold_key(_DOMAIN, seed)
        )
    size = min(max(1 << math.ceil(log2(max(2.0 * brush.radius, 1.0))), 2 * _SMALLEST), LARGEST)
    made = _laid_out(tip, textures, level, seed, size, at)
    return Pattern(*_sample(cast(Hashable, made), tip.shaping, size), False, 0)


def for_copies(pattern: Pattern | None, copies: Copies | Torus) -> Pattern | None:
    """Returns the pattern with which the dabs of a stroke and of its copies are laid: each sample is turned and
    mirrored with its copy.  Windows into a field lie as the field does."""
    told = copies.copies if isinstance(copies, Torus) else copies
    if pattern is None or pattern.windows:
        return pattern
    ways = ways_of(told)
    return replace(pattern, ways=ways) if (ways != ways[0]).any() else pattern


def ways_of(copies: Copies) -> np.ndarray:
    """Returns the ways of a stroke itself and of its copies, float64 (1 + copies, 4), as a Pattern has them."""
    return np.array([(1.0, 0.0, 0.0, 1.0), *map(_way, copies)])


def _way(copy: Copy) -> tuple[float, float, float, float]:
    """Returns the inverse of how a copy is turned and mirrored."""
    re, im, sign = copy.re / copy.scale, copy.im / copy.scale, -1.0 if copy.mirror else 1.0
    return sign * re, sign * im + 0.0, 0.0 - im, re


def _laid_out(
    tip: Tip, textures: Mapping[str, Texture | ImageSource], level: int, seed: int, size: int, where: str
) -> Instance | ImageSource:
    """Returns the texture of a tip whose sample is `size` pixels wide, or the picture that is its sample."""
    made = named(tip, textures, level, seed, where)
    if "period" in tip.parameters or not hasattr(made, "period"):
        return made
    source = getattr(made, "source", None)
    if isinstance(source, ImageSource) and source.there:
        return source
    return named(replace(tip, parameters=tip.parameters.set("period", size)), textures, level, seed, where)


@remembered
def _field(made: Any, curve: Shape | None, size: int) -> np.ndarray:
    return _curved(grey(made, made.base, Rect(0, 0, size, size)), curve).ravel()


@remembered
def _sample(made: Any, curve: Shape | None, size: int) -> tuple[np.ndarray, np.ndarray]:
    """Returns the sample, of an Instance or an ImageSource, at its size, half of it, and so on, after its curve:
    `planes` and `sizes` of a Pattern."""
    values = _picture(made, size) if isinstance(made, ImageSource) else grey(made, made.base, Rect(0, 0, size, size))
    levels = [_curved(values, curve)]
    while len(levels[-1]) > _SMALLEST:
        levels.append(reduce(levels[-1][None])[0])
    return np.concatenate([plane.ravel() for plane in levels]), np.array([len(plane) for plane in levels])


def _picture(source: ImageSource, size: int) -> np.ndarray:
    """Returns a picture's luminance, fitted into a square: float32 (size, size), 0 beside it."""
    longest = max(source.width, source.height)
    height, width = (max(1, round(side * size / longest)) for side in (source.height, source.width))
    seen = stretched(source, (height, width), np.arange(height), np.arange(width))
    out = np.zeros((size, size), np.float32)
    top, left = (size - height) // 2, (size - width) // 2
    out[top : top + height, left : left + width] = np.einsum("chw,c->hw", seen[:3], LUMINANCE)
    return out


def _curved(values: np.ndarray, curve: Shape | None) -> np.ndarray:
    out = np.ascontiguousarray(values)
    look_up(out.reshape(-1), table(curve or "identity"), _ONE, _ZERO)
    return out


@inlined
def _profile(dx2: np.float32, dy2: np.float32, inner: np.float32, scale: np.float32) -> np.float32:
    """d(r) of a disc (module `discs`)."""
    v = _ONE - max(_ZERO, min(_ONE, np.float32((dx2 + dy2 - inner) * scale)))
    return v * v * (_THREE - _TWO * v)


@inlined
def sample_for(radius: float, sizes: Array) -> tuple[int, int]:
    """Returns where the level begins that is about as wide as a disc, and how many pixels wide it is."""
    start, level = 0, 0
    while level + 1 < sizes.size and sizes[level] > 2.5 * radius:
        start += sizes[level] * sizes[level]
        level += 1
    return start, sizes[level]


@inlined
def _span(centre: float, outer: float) -> tuple[int, int]:
    """Returns the pixels of a tile that a disc may meet along one side."""
    return max(0, math.floor(centre - outer)), min(TILE, math.ceil(centre + outer))


@inlined
def between_pixels(plane: Array, x: float, y: float, step: float) -> np.float32:
    """Returns what a square plane has at a place, with straight lines between its pixels."""
    n = plane.shape[0]
    u, v = min(max(x * step - 0.5, 0.0), n - 1.001), min(max(y * step - 0.5, 0.0), n - 1.001)
    i, j = int(u), int(v)
    a, b = np.float32(u - i), np.float32(v - j)
    high = plane[j, i] + (plane[j, i + 1] - plane[j, i]) * a
    low = plane[j + 1, i] + (plane[j + 1, i + 1] - plane[j + 1, i]) * a
    found: np.float32 = high + (low - high) * b
    return found


@kernel
def _lay_windows(
    coverage: Array,
    discs: Array,
    which: Array,
    number: int,
    each: int,
    key: np.uint64,
    left: int,
    top: int,
    field: Array,
    n: int,
) -> None:
    """M' = M + max(0, ceiling - M) rate d(r) t, t being a window of `field`, float32 (n n,), in whole pixels."""
    for index in which:
        disc = discs[index]
        cx, cy, outer = disc[CX] - left, disc[CY] - top, disc[ROUT]
        ceiling, rate = np.float32(disc[CEILING]), np.float32(disc[RATE])
        h = mix64(key ^ mix64(np.uint64((number + index) // each)))
        room = np.uint64(max(1, n - 2 * int(outer) - 3))
        x0 = math.floor(cx - outer) - np.int64((h & np.uint64(0xFFFFFFFF)) % room)
        y0 = math.floor(cy - outer) - np.int64((h >> np.uint64(32)) % room)
        for y in range(max(0, math.floor(cy - outer)), min(TILE, math.ceil(cy + outer))):
            dy2 = (y + 0.5 - cy) * (y + 0.5 - cy)
            row, seen = coverage[y], field[(y - y0) % n * n :]
            for x in range(max(0, math.floor(cx - outer)), min(TILE, math.ceil(cx + outer))):
                d = _profile((x + 0.5 - cx) * (x + 0.5 - cx), dy2, disc[RIN2], disc[SCALE])
                row[x] += max(_ZERO, ceiling - row[x]) * (rate * d * seen[(x - x0) % n])


@kernel
def _lay_samples(coverage: Array, discs: Array, which: Array, left: int, top: int, packed: Array, sizes: Array) -> None:
    """As `_lay_windows`, t being the sample laid out over the disc's square, of the level that is about as wide as
    the disc, with straight lines between its pixels."""
    for index in which:
        disc = discs[index]
        cx, cy, outer = disc[CX] - left, disc[CY] - top, disc[ROUT]
        ceiling, rate = np.float32(disc[CEILING]), np.float32(disc[RATE])
        radius = outer - 0.5
        start, n = sample_for(radius, sizes)
        plane = packed[start : start + n * n].reshape(n, n)
        step = n / (2.0 * radius)
        for y in range(max(0, math.floor(cy - outer)), min(TILE, math.ceil(cy + outer))):
            dy2 = (y + 0.5 - cy) * (y + 0.5 - cy)
            v = min(max((y + 0.5 - cy + radius) * step - 0.5, 0.0), n - 1.001)
            j = int(v)
            b = np.float32(v - j)
            row, upper, lower = coverage[y], plane[j], plane[j + 1]
            for x in range(max(0, math.floor(cx - outer)), min(TILE, math.ceil(cx + outer))):
                u = min(max((x + 0.5 - cx + radius) * step - 0.5, 0.0), n - 1.001)
                i = int(u)
                a = np.float32(u - i)
                high = upper[i] + (upper[i + 1] - upper[i]) * a
                low = lower[i] + (lower[i + 1] - lower[i]) * a
                d = _profile((x + 0.5 - cx) * (x + 0.5 - cx), dy2, disc[RIN2], disc[SCALE])
                row[x] += max(_ZERO, ceiling - row[x]) * (rate * d * (high + (low - high) * b))


@kernel
def _lay_copies(
    coverage: Array,
    discs: Array,
    which: Array,
    number: int,
    each: int,
    ways: Array,
    left: int,
    top: int,
    packed: Array,
    sizes: Array,
) -> None:
    """As `_lay_samples`, each disc's sample brought onto it by the way of its copy."""
    for index in which:
        disc = discs[index]
        way = ways[(number + index) % each * ways.shape[0] // each]
        cx, cy, outer = disc[CX] - left, disc[CY] - top, disc[ROUT]
        start, n = sample_for(outer - 0.5, sizes)
        plane = packed[start : start + n * n].reshape(n, n)
        first, last = _span(cx, outer)
        for y in range(*_span(cy, outer)):
            down = y + 0.5 - cy
            for x in range(first, last):
                right = x + 0.5 - cx
                at = way[0] * right + way[1] * down, way[2] * right + way[3] * down
                seen = between_pixels(plane, at[0] + (outer - 0.5), at[1] + (outer - 0.5), n / (2.0 * (outer - 0.5)))
                d = _profile(right * right, down * down, disc[RIN2], disc[SCALE])
                room = max(_ZERO, np.float32(disc[CEILING]) - coverage[y, x])
                coverage[y, x] += room * (np.float32(disc[RATE]) * d * seen)
