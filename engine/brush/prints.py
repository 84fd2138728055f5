"""How the dabs of a stroke are laid where they are more than round: in the shape of a texture, or of an ellipse.

An ellipse has the length of two radii along its own axis and is as broad as its ratio says.  A place p, in px from its
middle, is brought by a matrix W onto the round tip: q = W p.  There the profile is that of module `discs`, whose rim of
one pixel is as wide as W makes a pixel, |W^T q| / |q|, so that narrow tips are as sharp as round ones.  One that is
thinner than a pixel is a pixel thick and fades.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from engine.brush import tip
from engine.brush.blending import blend
from engine.brush.copies import NO_COPIES, Copies, Torus
from engine.brush.discs import CEILING, CX, CY, DISC, RATE, RIN2, ROUT
from engine.brush.felt import is_turned
from engine.brush.ink import Texture
from engine.brush.print_form import Planes4, Print, TwoInts
from engine.brush.settings import Brush
from engine.brush.tip import Pattern, between_pixels, sample_for, ways_of
from engine.numeric.address import TILE
from engine.numeric.hashing import mix64
from engine.numeric.kernel import Array, dividing, inner, inner_uncounted, kernel
from engine.texture.image import ImageSource

_PLAIN, _SAMPLE, _WINDOW = range(3)
_ROOM = 1.5  # px around an ellipse that are looked at
_THINNEST = 0.5  # px: half the breadth

_ZERO = np.float32(0.0)
TwoReals = tuple[float, float]


_UNFILLED = _PLAIN, np.uint64(0), np.ones(4, np.float32), np.array([2])


@dataclass(frozen=True, eq=False, slots=True)
class Oval:
    """Ellipses, each turned and squeezed as its own columns say: cosine and sine of its angle, and its ratio, after
    those of a disc; filled with a `pattern`, if there is one.  `ways`: as of a `Pattern`, one of each copy."""

    pattern: Pattern | None
    ways: np.ndarray

    def lay(self, coverage: Array, discs: Array, which: Array, count: TwoInts, corner: TwoInts) -> None:
        """Lays the discs `which` into a tile's coverage, as `Pattern.lay`."""
        lay_ovals(coverage, discs, which, count, corner, self.ways, self.fill)

    @property
    def fill(self) -> tuple[int, np.uint64, np.ndarray, np.ndarray]:
        """Gives what they are filled with, as `lay_ovals` wants it."""
        if self.pattern is None:
            return _UNFILLED
        kind = _WINDOW if self.pattern.windows else _SAMPLE
        return kind, np.uint64(self.pattern.key), self.pattern.planes, self.pattern.sizes

    def lay_tinted(self, planes: Planes4, discs: Array, which: Array, count: TwoInts, corner: TwoInts) -> None:
        """As `Print.lay_tinted`."""
        _lay_tinted(planes, discs, which, count, corner, (self.ways, self.fill))

    def of_copy(self, number: int) -> Oval:
        """Returns the ellipses of one copy alone."""
        return replace(self, ways=self.ways[number : number + 1])


def resolve(
    brush: Brush, textures: Mapping[str, Texture | ImageSource], level: int, seed: int, where: str = "brush"
) -> Print | None:
    """Returns what the dabs of a brush look like in a stroke at `level`; None if they are round.  BrushError names the
    field."""
    pattern = tip.resolve(brush, textures, level, seed, where)
    return Oval(pattern, ways_of(NO_COPIES)) if is_turned(brush) else pattern


def plain(brush: Brush) -> Print | None:
    """As `resolve`, without what textures make of them."""
    return Oval(None, ways_of(NO_COPIES)) if is_turned(brush) else None


def for_copies(made: Print | None, copies: Copies | Torus) -> Print | None:
    """Returns that with which the dabs of a stroke and of its copies are laid, each turned and mirrored with its
    copy."""
    if isinstance(made, Oval):
        return replace(made, ways=ways_of(copies.copies if isinstance(copies, Torus) else copies))
    return tip.for_copies(made, copies) if isinstance(made, Pattern) else made


@inner
def onto_round(turn: Array, way: Array, ratio: float) -> tuple[float, float, float, float]:
    """The matrix that brings a place of a dab, whose `turn` begins with cosine and sine, onto the round tip: row by
    row."""
    cos, sin, thin = turn[0], turn[1], 1.0 / ratio
    return (
        cos * way[0] + sin * way[2],
        cos * way[1] + sin * way[3],
        (cos * way[2] - sin * way[0]) * thin,
        (cos * way[3] - sin * way[1]) * thin,
    )


@dividing
def _profiles(
    profiles: Array, first: int, cx: float, down: float, onto: tuple[float, float, float, float], size: TwoReals
) -> None:
    """Writes the profiles, 1 within and 0 outside, of the pixels of a row from the `first` on, `down` below the middle;
    `size`: the tip's radius, and how far it is 1 before `onto`.  Without a branch: several pixels at a time."""
    a, b, c, d = onto
    radius, inside = size
    across, along = b * down, d * down
    for i in range(profiles.shape[0]):
        right = (first + i) + 0.5 - cx
        u, v = a * right + across, c * right + along
        square = u * u + v * v
        p, q = a * u + c * v, b * u + d * v
        pixel = 0.5 * math.sqrt((p * p + q * q) / square)
        outer, within = radius + pixel, max(0.0, min(inside, radius - pixel))
        w = 1.0 - max(0.0, min(1.0, (square - within * within) / (outer * outer - within * within)))
        profiles[i] = np.float32(1.0 if square == 0.0 else w * w * (3.0 - 2.0 * w))


@inner_uncounted
def _lay_row(row: Array, profiles: Array, ceiling: np.float32, rate: np.float32) -> None:
    for i in range(row.shape[0]):
        row[i] += max(_ZERO, ceiling - row[i]) * (rate * profiles[i])


@inner
def _span_at(down: float, onto: tuple[float, float, float, float], reach: float) -> tuple[float, float]:
    """Where the row `down` px below the middle lies within `reach` of the round tip: its middle, and how far to each
    side; below 0 for nowhere."""
    a, b, c, d = onto
    square, mixed_ = a * a + c * c, (a * b + c * d) * down
    rest = mixed_ * mixed_ - square * ((b * b + d * d) * down * down - reach * reach)
    return -mixed_ / square, math.sqrt(rest) / square if rest >= 0.0 else -1.0


@inner
def _height_of(onto: tuple[float, float, float, float], reach: float) -> float:
    """How far below the middle anything may lie within `reach` of the round tip."""
    a, b, c, d = onto
    return min(reach, reach * math.sqrt(a * a + c * c) / abs(a * d - b * c) + 0.01)


@inner
def _sampled(x: float, y: float, radius: float, planes: Array, sizes: Array) -> np.float32:
    """What a sample laid out over the round tip has at a place of it."""
    start, n = sample_for(radius, sizes)
    plane = planes[start : start + n * n].reshape(n, n)
    return between_pixels(plane, x + radius, y + radius, n / (2.0 * radius))


@kernel
def lay_ovals(
    coverage: Array,
    discs: Array,
    which: Array,
    count: tuple[int, int],
    corner: tuple[int, int],
    ways: Array,
    fill: tuple[int, np.uint64, Array, Array],
) -> None:
    """M' = M + max(0, ceiling - M) rate d, for each disc in turn, d being its profile, times what fills it."""
    number, each = count
    profiles = np.empty(TILE, np.float32)
    for index in which:
        disc = discs[index]
        radius = disc[ROUT] - 0.5
        ratio = max(disc[DISC + 2], min(1.0, _THINNEST / radius))
        fade = min(1.0, disc[DISC + 2] * radius / _THINNEST)
        way = ways[(number + index) % each * ways.shape[0] // each]
        onto = onto_round(disc[DISC:], way, ratio)
        wide = (radius * ratio + _ROOM) / (radius + _ROOM)
        around = onto_round(disc[DISC:], way, wide)
        cx, cy = disc[CX] - corner[0], disc[CY] - corner[1]
        windowed = _window(disc, cx, cy, (number + index) // each, fill)
        ceiling, rate, inside = np.float32(disc[CEILING] * fade), np.float32(disc[RATE]), math.sqrt(disc[RIN2])
        reach = radius + _ROOM
        tall = _height_of(around, reach)
        for y in range(max(0, math.floor(cy - tall)), min(TILE, math.ceil(cy + tall))):
            down = y + 0.5 - cy
            middle, half = _span_at(down, around, reach)
            if half < 0.0:
                continue
            first, last = max(0, math.ceil(cx + middle - half - 0.5)), min(TILE, math.floor(cx + middle + half + 0.5))
            if first >= last:
                continue
            seen = profiles[: last - first]
            _profiles(seen, first, cx, down, onto, (radius, inside))
            if fill[0] == _SAMPLE:
                for x in range(first, last):
                    right = x + 0.5 - cx
                    u, v = onto[0] * right + onto[1] * down, onto[2] * right + onto[3] * down
                    seen[x - first] *= _sampled(u, v, radius, fill[2], fill[3])
            if fill[0] == _WINDOW:
                n = fill[3][0]
                for x in range(first, last):
                    seen[x - first] *= fill[2][(y - windowed[1]) % n * n + (x - windowed[0]) % n]
            _lay_row(coverage[y, first:last], seen, ceiling, rate)


@inner
def _window(
    disc: Array, cx: float, cy: float, number: int, fill: tuple[int, np.uint64, Array, Array]
) -> tuple[int, int]:
    """Where the window of a dab begins in its field, in pixels of the tile, as `Pattern` has it."""
    h = mix64(fill[1] ^ mix64(np.uint64(number)))
    room = np.uint64(max(1, fill[3][0] - 2 * int(disc[ROUT]) - 3))
    x = math.floor(cx - disc[ROUT]) - np.int64((h & np.uint64(0xFFFFFFFF)) % room)
    return x, math.floor(cy - disc[ROUT]) - np.int64((h >> np.uint64(32)) % room)


@kernel
def _lay_tinted(
    planes: tuple[Array, Array, Array, Array],
    discs: Array,
    which: Array,
    count: tuple[int, int],
    corner: tuple[int, int],
    how: tuple[Array, tuple[int, np.uint64, Array, Array]],
) -> None:
    """Lays ellipses and their tints, one after the other."""
    for k in range(which.shape[0]):
        one = which[k : k + 1]
        lay_ovals(planes[0], discs, one, count, corner, how[0], how[1])
        lay_ovals(planes[1], discs, one, count, corner, how[0], how[1])
        blend(planes, discs[which[k]], corner[0], corner[1])
