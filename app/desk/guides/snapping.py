"""Strokes that are drawn onto guides: the first few pixels choose the line, and the stroke stays on it.

Points are moved before they are recorded: what is stored is a stroke like any other.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from app.desk.desk import Desk
from app.desk.guides.present import assistants
from app.desk.guides.snap_curves import CURVES, Edge, Line, Pair, exact, near
from engine.painting.guiding.guides import Guide

BEGINNING, BEGINNING_STRAIGHT = 10.0, 12.0  # points of the screen that a stroke goes before its line is chosen
RULER_REACH = 32.0  # points of the screen from a ruler within which strokes are drawn onto it
_ACROSS = math.radians(60.0)  # more than so far from a line's direction, a stroke is not on its way
_ALONG_GRID = math.radians(20.0)  # the same for grids, in which oblique strokes are free
_EDGE = math.radians(20.0)  # by which a ruler that is near is taken before lines that are everywhere
_TURNS = 24  # directions of a straight line, of a full turn
_AT_ONCE = 256  # pieces of one part of a stroke
_EDGES = ("ruler", "ellipse", "grid")  # kinds that lie somewhere


class Way(NamedTuple):
    """A curve that a stroke may be drawn onto, and how much, 0..1; `edge`: it lies somewhere, others begin anywhere;
    `across`: by how much a stroke may run aside of it, radians."""

    curve: Edge
    strength: float
    edge: bool
    across: float = _ACROSS


def ways_at(guides: Sequence[Guide], level: int, origin: tuple[int, int], at: Pair, reach: float) -> list[Way]:
    """Returns what a stroke from a place may be drawn onto, in pixels of a level; rulers that are farther are not."""
    out: list[Way] = []
    for guide in guides:
        if not guide.snap or not _within(guide, level, origin, at, reach):
            continue
        edge, across = guide.kind in _EDGES, _ALONG_GRID if guide.kind == "grid" else _ACROSS
        found = (Way(curve, guide.snap, edge, across) for curve in CURVES[guide.kind](guide, level, origin, at))
        out += [way for way in found if math.dist(way.curve.nearest(*at), at) <= reach]
    return out


def _within(guide: Guide, level: int, origin: tuple[int, int], at: Pair, reach: float) -> bool:
    """Tells whether a place is beside a ruler, not beyond its ends; of others, whether they are so large that they can
    be seen."""
    if guide.kind not in _EDGES:
        return True
    ends = [near(exact(guide, n, level, origin)) for n in range(len(guide.points))]
    if max(math.dist(ends[0], end) for end in ends[1:]) < 2.0:
        return False
    if guide.kind != "ruler":
        return True
    (x0, y0), (x1, y1) = ends
    length = math.dist(*ends)
    along = ((at[0] - x0) * (x1 - x0) + (at[1] - y0) * (y1 - y0)) / length
    return -reach <= along <= length + reach


def best_way(ways: Sequence[Way], start: Pair, there: Pair, reach: float) -> Way | None:
    """Returns the way that a stroke from `start` to `there` is nearest to in direction, and to an edge in place."""
    best, found = math.inf, None
    length = math.dist(start, there)
    for way in ways:
        foot = way.curve.nearest(*start)
        dx, dy = way.curve.direction(*foot)
        even = abs(dx * (there[0] - start[0]) + dy * (there[1] - start[1])) / length
        angle = math.acos(min(1.0, even))
        cost = angle + _EDGE * (math.dist(foot, start) / reach - 1.0) * way.edge
        if angle <= way.across and cost < best:
            best, found = cost, way
    return found


def straight_ways(at: Pair) -> list[Way]:
    """Returns the straight lines from a place, at multiples of 15°."""
    turns = (math.tau * k / _TURNS for k in range(_TURNS // 2))
    return [Way(Line(*at, math.cos(turn), math.sin(turn)), 1.0, False) for turn in turns]


class Snapper:
    """Points of one stroke in, the points that are recorded out.

    `straight`: drawn onto a straight line, whatever guides there are.  Until its way is chosen, a stroke is held back;
    one that has none to choose from is not.
    """

    def __init__(self, desk: Desk, level: int, origin: tuple[int, int], straight: bool = False) -> None:
        self._place, self._straight = (level, origin), straight
        self._guides = assistants(desk) if desk.guides.snaps and not straight else ()
        pixel = desk.scale / desk.view.scale(level)
        self._reach, self._first = RULER_REACH * pixel, (BEGINNING_STRAIGHT if straight else BEGINNING) * pixel
        self._ways: list[Way] | None = None
        self._held = np.empty((0, 6))
        self._before: np.ndarray | None = None  # the last point, as it came
        self.way: Way | None = None

    @property
    def waits(self) -> bool:
        """Tells whether the stroke is held back, having gone nowhere yet."""
        return len(self._held) > 0

    def add(self, points: np.ndarray) -> np.ndarray:
        """Returns what points, float64 (n, 6), give to record: float64 (m, 6)."""
        if not len(points):
            return points
        if self._ways is None:
            x, y = points[0, :2].tolist()
            level, origin = self._place
            self._ways = (
                straight_ways((x, y)) if self._straight else ways_at(self._guides, level, origin, (x, y), self._reach)
            )
            self._held = points[:0]
        if not self._ways:
            return points if self.way is None else self._drawn(points)
        self._held = np.concatenate([self._held, points])
        start, there = self._held[0, :2].tolist(), self._held[-1, :2].tolist()
        if math.dist(start, there) < self._first:
            return points[:0]
        self.way = best_way(self._ways, (start[0], start[1]), (there[0], there[1]), self._reach)
        self._ways = []
        held, self._held = self._held, self._held[:0]
        return held if self.way is None else self._drawn(held)

    def finish(self) -> np.ndarray:
        """Returns what was held back of a stroke that went nowhere."""
        held, self._held = self._held, self._held[:0]
        return held

    def _drawn(self, points: np.ndarray) -> np.ndarray:
        """Returns points drawn onto the way, with more between them where that is a curve."""
        assert self.way is not None
        before = points[:1] if self._before is None else self._before
        self._before = points[-1:]
        out = _cut(np.concatenate([before, points]), self.way.curve.step)
        for row in out:
            x, y = self.way.curve.nearest(float(row[0]), float(row[1]))
            row[0] += (x - row[0]) * self.way.strength
            row[1] += (y - row[1]) * self.way.strength
        return out


def _cut(points: np.ndarray, step: float) -> np.ndarray:
    """Returns the path through points, float64 (n, 6), without its first, with no side longer than a step."""
    out = []
    for start, end in pairwise(points):
        far = math.hypot(end[0] - start[0], end[1] - start[1])
        parts = max(1, min(_AT_ONCE, math.ceil(far / step)))
        out += [start + (end - start) * (k / parts) for k in range(1, parts)] + [end]
    return np.array(out).reshape(-1, points.shape[1])
