"""Solids with paint on them: strokes in three dimensions over whatever the solid is (Heeger & Bergen 1995, section 6).

A stroke is a row of capsules.  It covers a place as much as the nearest of its dabs does, not more where it crosses
itself, and lies over the strokes before it.  It is worked out for each place that is looked at, so its edge is as sharp
as one looks; like the solid it repeats after one unit along each axis.  Sums, products and quotients alone: the same
bits everywhere.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple, Protocol

import numpy as np

from engine.brush.dynamics import evaluate
from engine.brush.settings import Brush
from engine.numeric.kernel import inlined, kernel
from engine.solids.solid_lookup import Lookup

_CELLS = 32  # of a unit along each axis, by which capsules are found
_LONGEST = 0.1  # units from end to end of a capsule
_THINNEST = 0.75  # of what is seen just so: a stroke is at least so thick
_COARSEST = 1.0 / 96.0  # units: of what is seen, as far as strokes grow thicker by it
_STROKE = 12  # column of a capsule; before it its ends, and at each of these radius, opacity and hardness


class PaintedStroke(Protocol):
    """A stroke on a solid, in voxels."""

    @property
    def points(self) -> Sequence[tuple[float, float, float, float]]:
        """Gives x, y, z and the pen's pressure, of each point."""
        ...

    @property
    def breaks(self) -> Sequence[int]:
        """Gives the points to which no line leads."""
        ...

    @property
    def brush(self) -> Brush:
        """Gives the brush."""
        ...


class Capsules(NamedTuple):
    """`rows`: float64 (S, 13), in units; `colours`: (K, 4) of each stroke, the last whether it takes paint away;
    `starts`, `held`: which capsules reach each cell, in their order."""

    rows: np.ndarray
    colours: np.ndarray
    starts: np.ndarray
    held: np.ndarray


def felt(brush: Brush, points: np.ndarray, voxels: float) -> np.ndarray:
    """Returns the knots of a stroke, float64 (n, 6): where each is and its radius, in units; opacity, hardness."""
    pressure = points[:, 3]
    radius, opacity, hardness = (
        np.clip(getattr(brush, name) * evaluate(brush.dynamics.get(name), pressure), 0.0, high)
        for name, high in (("radius", np.inf), ("opacity", 1.0), ("hardness", 1.0))
    )
    return np.column_stack([points[:, :3] / voxels, radius / voxels, opacity, hardness])


def capsules_of(strokes: Sequence[PaintedStroke], voxels: float) -> Capsules:
    """Returns the capsules of strokes, the first one lowest; `voxels`: of a unit."""
    rows, colours = [], []
    for number, stroke in enumerate(strokes):
        knots = felt(stroke.brush, np.array(stroke.points, np.float64).reshape(-1, 4), voxels)
        rows += [_between_knots(part, number) for part in np.split(knots, list(stroke.breaks))]
        red, green, blue = (int(stroke.brush.colour[i : i + 2], 16) / 255.0 for i in (1, 3, 5))
        colours.append((red, green, blue, float(stroke.brush.row.takes_away)))
    every = np.concatenate(rows)
    starts = np.zeros(_CELLS**3 + 1, np.int64)
    _cells_reached(every, starts, np.empty(0, np.int32))
    starts = np.concatenate([[0], np.cumsum(starts[:-1])])
    held = np.empty(int(starts[-1]), np.int32)
    _cells_reached(every, starts[:-1].copy(), held)
    return Capsules(every, np.array(colours), starts, held)


def _between_knots(knots: np.ndarray, number: int) -> np.ndarray:
    """The capsules from knot to knot, long ones in parts; of a single knot a ball."""
    if len(knots) == 1:
        knots = np.concatenate([knots, knots])
    gone = np.sqrt(((knots[1:, :3] - knots[:-1, :3]) ** 2).sum(axis=1))
    parts = np.maximum(np.ceil(gone / _LONGEST).astype(np.int64), 1)
    which = np.repeat(np.arange(len(parts)), parts)
    part = np.arange(len(which)) - np.repeat(np.cumsum(parts) - parts, parts)
    first, last = (((part + step) / parts[which])[:, None] for step in (0, 1))
    way = knots[1:] - knots[:-1]
    a, b = knots[which] + first * way[which], knots[which] + last * way[which]
    mixed = [np.stack([a[:, k], b[:, k]], axis=1) for k in (3, 4, 5)]
    return np.concatenate([a[:, :3], b[:, :3], *mixed, np.full((len(a), 1), float(number))], axis=1)


@dataclass(frozen=True, eq=False)
class Touched:
    """A solid with strokes on it, whose points are in `voxels` of a unit."""

    bare: Lookup
    strokes: Sequence[PaintedStroke]
    voxels: float

    @property
    def gloss(self) -> float:
        """As the bare solid."""
        return self.bare.gloss

    def cells(self) -> np.ndarray:
        """Tells which parts of the solid the strokes may reach: bool (n, n, n), z first."""
        starts = self._capsules.starts
        out: np.ndarray = (starts[1:] > starts[:-1]).reshape((_CELLS,) * 3)
        return out

    @cached_property
    def _capsules(self) -> Capsules:
        return capsules_of(self.strokes, self.voxels)

    def colours(self, points: np.ndarray, finest: float) -> np.ndarray:
        """Returns the bare solid's colours under the strokes."""
        return self.over(points, self.bare.colours(points, finest), finest)

    def over(self, points: np.ndarray, bare: np.ndarray, finest: float) -> np.ndarray:
        """Returns colours (N, 3) at points, of which the bare solid's are known."""
        out = np.array(bare, np.float64)
        if len(self.strokes):
            _paint_over(np.ascontiguousarray(points, np.float64), min(finest, _COARSEST), *self._capsules, out)
        return out


@kernel
def _cells_reached(rows: np.ndarray, starts: np.ndarray, held: np.ndarray) -> None:
    """Counts in `starts` the capsules that reach each cell; if there is room in `held`, writes them from `starts` on,
    which goes on to their ends."""
    low, high = np.empty(3, np.int64), np.empty(3, np.int64)
    for s in range(rows.shape[0]):
        reach = max(rows[s, 6], rows[s, 7]) + _COARSEST
        for axis in range(3):
            a, b = rows[s, axis], rows[s, 3 + axis]
            low[axis] = int(np.floor((min(a, b) - reach) * _CELLS))
            high[axis] = min(int(np.floor((max(a, b) + reach) * _CELLS)), low[axis] + _CELLS - 1)
        for z in range(low[2], high[2] + 1):
            for y in range(low[1], high[1] + 1):
                for x in range(low[0], high[0] + 1):
                    cell = ((z % _CELLS) * _CELLS + y % _CELLS) * _CELLS + x % _CELLS
                    if held.size:
                        held[starts[cell]] = s
                    starts[cell] += 1


@inlined
def _towards(colour: float, other: float, share: float) -> float:
    return colour + (other - colour) * share


@kernel
def _covers(row: np.ndarray, place: np.ndarray, finest: float) -> float:
    """How much a capsule covers a place: as a dab of the canvas does, (1 - u)^2 (1 + 2u) of the square of the distance
    beyond the part that is covered in full."""
    way, gone, length, along = 0.0, 0.0, 0.0, 0.0
    for axis in range(3):
        step = row[3 + axis] - row[axis]
        from_middle = place[axis] - 0.5 * (row[axis] + row[3 + axis])
        from_middle -= np.floor(from_middle + 0.5)  # the solid repeats: the nearest of all
        way = from_middle + 0.5 * step
        length += step * step
        along += way * step
        gone += way * way
    t = min(max(along / length, 0.0), 1.0) if length > 0.0 else 0.0
    radius = _towards(row[6], row[7], t)
    outer = max(radius, _THINNEST * finest)
    far = max(gone - 2.0 * t * along + t * t * length, 0.0)
    if radius <= 0.0 or far >= outer * outer:
        return 0.0
    inner = max(min(_towards(row[10], row[11], t) * outer, outer - finest), 0.0)
    u = max(far - inner * inner, 0.0) / (outer * outer - inner * inner)
    return _towards(row[8], row[9], t) * (1.0 - u) * (1.0 - u) * (1.0 + 2.0 * u)


@kernel
def _paint_over(
    points: np.ndarray,
    finest: float,
    rows: np.ndarray,
    colours: np.ndarray,
    starts: np.ndarray,
    held: np.ndarray,
    out: np.ndarray,
) -> None:
    """Lays strokes over colours (N, 3), stroke by stroke."""
    place = np.empty(3)
    bare = np.empty(3)
    for n in range(points.shape[0]):
        cell = 0
        for axis in range(2, -1, -1):
            place[axis] = points[n, axis] - np.floor(points[n, axis])
            cell = cell * _CELLS + min(int(place[axis] * _CELLS), _CELLS - 1)
        if starts[cell] == starts[cell + 1]:
            continue
        bare[0], bare[1], bare[2] = out[n, 0], out[n, 1], out[n, 2]
        stroke, cover = -1, 0.0
        for at in range(starts[cell], starts[cell + 1] + 1):
            ended = at == starts[cell + 1]
            following = -1 if ended else int(rows[held[at], _STROKE])
            if following != stroke and stroke >= 0 and cover > 0.0:
                takes = colours[stroke, 3]
                for channel in range(3):
                    to = bare[channel] if takes > 0.0 else colours[stroke, channel]
                    out[n, channel] = _towards(out[n, channel], to, cover)
            if ended:
                break
            if following != stroke:
                stroke, cover = following, 0.0
            cover = max(cover, _covers(rows[held[at]], place, finest))
