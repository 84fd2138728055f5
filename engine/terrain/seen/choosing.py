"""Which tiles of land are drawn, and which are lacking: a quadtree, refined where its texels would be seen."""

from __future__ import annotations

import heapq
import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from fractions import Fraction
from typing import NamedTuple

import numpy as np

from engine.numeric.address import Rect
from engine.terrain.seen.eye import Eye, from_whole
from engine.terrain.seen.land_tiles import FINER, QUADS, UNIT, LandTile, Placed, TileKey

MORPHS = 0.85  # of the way to where a tile ends, at which it begins to become its parent
FINEST = 32  # level of the finest texels: heights above the sea are told no finer
_ROOMY = 2.5  # frames that are seen beyond the frame
_HIGH = 24.0  # times as far as the eye is high, at least
_ACROSS = 4  # of the coarsest tiles from the eye to where the land ends
_COARSE = 12  # the anchor lies on the grid of so many levels coarser than the finest
_LEVEL = 4  # and in height
_LEAST = 3.0  # tiles that a level reaches at least: with fewer, tiles two levels apart would meet
_NO_HEIGHTS = (-math.inf, math.inf)


@dataclass(frozen=True, slots=True)
class LandSight:
    """What is seen: an eye, the picture's size, `clear` pixels of level 0 above the ground below, `texel`: pixels of
    the picture that a texel is allowed, `frame`: of the painting."""

    eye: Eye
    size: tuple[int, int]
    clear: float
    texel: float
    frame: Rect

    def reach(self, level: int) -> float:
        """Returns how far from the eye, in pixels of level 0, tiles of a level end: from there their parents do."""
        return 2.0 * self._near(level)

    def _near(self, level: int) -> float:
        """Returns from where on a level's texels are small enough."""
        side = math.ldexp(1.0, -level)
        return max(side * 2.0**-FINER / (self.texel * self.eye.pixel(self.size[0])), 0.5 * _LEAST * QUADS * side)

    def splits(self, level: int, away: float) -> bool:
        """Tells whether what lies so far away is seen in finer tiles than those of a level."""
        return away < self._near(level) and level + FINER < FINEST

    @property
    def horizon(self) -> float:
        """Returns how far land is seen, in pixels of level 0: there it has become the sky."""
        frame = self.frame
        wide = _ROOMY * max(frame.width, frame.height)
        middle = (
            float(abs(self.eye.x - Fraction(frame.x0 + frame.x1, 2))),
            float(abs(self.eye.y - Fraction(frame.y0 + frame.y1, 2))),
        )
        return max(wide + max(middle), _HIGH * self.clear)

    @property
    def far(self) -> float:
        """Returns how far tiles lie: a power of two, and not nearer."""
        return 2.0 ** math.ceil(math.log2(self.horizon))

    @property
    def coarsest(self) -> int:
        """Returns the level of the coarsest tiles."""
        return -math.floor(math.log2(self.far / (_ACROSS * QUADS)))


@dataclass(slots=True)
class TileChoice:
    """`drawn`: tiles, nearest first; `lacking`: those to be made, most urgent first; `wanted`: all that are looked at;
    `finest`: the level whose pixels are the unit."""

    drawn: list[TileKey] = field(default_factory=list)
    lacking: list[TileKey] = field(default_factory=list)
    wanted: set[TileKey] = field(default_factory=set)
    finest: int = 0


class _Node(NamedTuple):
    """A tile on its way through the tree: how far its nearest corner is, where its first one lies from the eye, and its
    side, in pixels of level 0."""

    away: float
    key: TileKey
    x: float
    y: float
    side: float

    def quarters(self, clear: float) -> list[_Node]:
        """Returns its four quarters."""
        half = self.side / 2
        places = ((self.x, self.y), (self.x + half, self.y), (self.x, self.y + half), (self.x + half, self.y + half))
        return [_node(key, *at, half, clear) for key, at in zip(self.key.children(), places, strict=True)]


def _node(key: TileKey, x: float, y: float, side: float, clear: float) -> _Node:
    return _Node(max(x, -x - side, y, -y - side, clear), key, x, y, side)


def _roots(sight: LandSight) -> list[_Node]:
    begin, span = sight.coarsest, Fraction(sight.far)
    side = Fraction(QUADS) / Fraction(2) ** begin
    columns, rows = (
        range(math.floor((at - span) / side), math.floor((at + span) / side) + 1) for at in (sight.eye.x, sight.eye.y)
    )
    across, down = (
        [-math.ldexp(from_whole(at, begin, n * QUADS), -begin) for n in numbers]
        for at, numbers in ((sight.eye.x, columns), (sight.eye.y, rows))
    )
    return [
        _node(TileKey(begin, i, j), x, y, float(side), sight.clear)
        for j, y in zip(rows, down, strict=True)
        for i, x in zip(columns, across, strict=True)
    ]


class _Choice:
    """What is chosen for one picture."""

    def __init__(self, sight: LandSight, held: Mapping[TileKey, LandTile]) -> None:
        self.out, self._sight, self._held = TileChoice(), sight, held
        self._walls: list[tuple[float, float, float]] = [(*wall.tolist(),) for wall in _walls(sight)]
        self._known: dict[TileKey, tuple[float, float]] = {}
        self.lacking: list[tuple[float, TileKey]] = []

    def visit(self, nodes: list[_Node]) -> bool:
        """Notes that tiles are wanted; True if all are held."""
        whole = True
        for node in nodes:
            self.out.wanted.add(node.key)
            if node.key not in self._held:
                whole = False
                self.lacking.append((-node.side / node.away, node.key))
        return whole

    def seen(self, nodes: list[_Node]) -> list[_Node]:
        """Returns those of which any part may be in the picture."""
        return [node for node in nodes if self._in_sight(node)]

    def _heights(self, key: TileKey) -> tuple[float, float]:
        """From which height to which, of level 0, a tile lies: by its own, or what its parent tells."""
        tile = self._held.get(key)
        if tile is None:
            return self._known.get(key.parent, _NO_HEIGHTS)
        by = 2.0 ** -(key.level + UNIT)
        found = self._known[key] = ((tile.base + tile.low) * by, (tile.base + tile.high) * by)
        return found

    def _in_sight(self, node: _Node) -> bool:
        sight, wide = self._sight, node.side
        low, high = self._heights(node.key)
        if not math.isfinite(low):
            ground, reach = sight.eye.z - sight.clear, 0.5 * wide + sight.clear
            low, high = ground - reach, ground + reach
        z0, z1 = low - sight.eye.z, high - sight.eye.z
        x0, y0 = node.x, node.y
        x1, y1 = x0 + wide, y0 + wide
        return all(
            (a * x1 if a > 0 else a * x0) + (b * y1 if b > 0 else b * y0) + (c * z1 if c > 0 else c * z0) >= 0.0
            for a, b, c in self._walls
        )


def choose_tiles(sight: LandSight, held: Mapping[TileKey, LandTile]) -> TileChoice:
    """Returns what is drawn of what is held, and what is lacking.  A tile is drawn as long as one of its quarters that
    is seen is not there."""
    choice = _Choice(sight, held)
    roots = choice.seen(_roots(sight))
    choice.visit(roots)
    waiting = [node for node in roots if node.key in held]
    heapq.heapify(waiting)
    while waiting:
        node = heapq.heappop(waiting)
        if sight.splits(node.key.level, node.away):
            quarters = choice.seen(node.quarters(sight.clear))
            if choice.visit(quarters):
                for quarter in quarters:
                    heapq.heappush(waiting, quarter)
                continue
        choice.out.drawn.append(node.key)
    out = choice.out
    out.lacking = [key for _, key in sorted(choice.lacking)]
    out.finest = max((key.level for key in out.drawn), default=sight.coarsest)
    return out


def _walls(sight: LandSight) -> np.ndarray:
    """Returns the directions that look inwards from the four sides of the picture, (4, 3)."""
    right, up, forward = sight.eye.axes()
    pixel = sight.eye.pixel(sight.size[0])
    wide, high = pixel * sight.size[0] / 2, pixel * sight.size[1] / 2
    return np.stack([forward * wide - right, forward * wide + right, forward * high - up, forward * high + up])


@dataclass(frozen=True, slots=True)
class Anchor:
    """The point from which the card counts: `level`, whose pixels are the unit; (x, y, z) whole numbers of it, on grids
    so coarse that whatever is drawn has exact numbers from here; `eye` from it and `clear`, in the unit."""

    level: int
    x: int
    y: int
    z: int
    eye: tuple[float, float, float]
    clear: float

    def place(self, key: TileKey, base: int, sight: LandSight) -> Placed:
        """Returns where a tile lies."""
        up = self.level - key.level
        corner = float((key.x * QUADS << up) - self.x), float((key.y * QUADS << up) - self.y)
        low = math.ldexp(float((base << up) - (self.z << UNIT)), -UNIT)
        step = math.ldexp(1.0, up)
        ends = math.ldexp(sight.reach(key.level), self.level)
        return Placed((*corner, low), step, step * 2.0**-UNIT, MORPHS * ends, ends)


def anchor(sight: LandSight, finest: int) -> Anchor:
    """Returns a point near the eye to count from."""
    unit, eye = Fraction(2) ** finest, sight.eye
    x, y, z = eye.x * unit, eye.y * unit, Fraction(eye.z) * unit
    at = [math.floor(v) >> bits << bits for v, bits in ((x, _COARSE), (y, _COARSE), (z, _LEVEL))]
    seen = float(x - at[0]), float(y - at[1]), float(z - at[2])
    return Anchor(finest, at[0], at[1], at[2], seen, math.ldexp(sight.clear, finest))
