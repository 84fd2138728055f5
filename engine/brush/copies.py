"""More strokes in the same one: each dab is laid again through similarities of the plane.

A copy shows the point p = x + iy (y downwards) at c m(p) + t, m(x + iy) = -x + iy where it mirrors, else p; a dab's
radius is multiplied by |c|.  The dabs of all copies go into one coverage, dab by dab, so that a stroke is the same in
whatever portions its points come, and its opacity is a ceiling where copies cross.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from engine.brush.checks import BrushError
from engine.brush.settings import SETTINGS
from engine.numeric.address import Rect
from engine.numeric.turns import turned

_AT_ONCE = 1 << 18  # copied dabs at once
_X, _Y, _RADIUS, _OPACITY = range(4)
_AROUND = tuple((i, j) for j in (-1, 0, 1) for i in (-1, 0, 1))  # periods by which dabs on a torus are shifted


class Copy(NamedTuple):
    """c = `re` + i `im`, t = `x` + i `y` in pixels of the stroke's level from its origin; `mirror`: left and right are
    swapped first."""

    re: float
    im: float
    x: float
    y: float
    mirror: bool = False

    def moved(self, x: float, y: float) -> tuple[float, float]:
        """Returns where a point is shown."""
        px = -x if self.mirror else x
        return self.re * px - self.im * y + self.x, self.re * y + self.im * px + self.y

    @property
    def scale(self) -> float:
        """Gives |c|."""
        return float(np.sqrt(self.re * self.re + self.im * self.im))


Copies = tuple[Copy, ...]
NO_COPIES: Copies = ()


class Torus(NamedTuple):
    """A cell that is repeated without end, on which a stroke and its copies are laid: pixels of the stroke's level, the
    corner from its origin.  Each dab lies in the cell, and again where it reaches to `spare` pixels from the rim."""

    copies: Copies
    left: float
    top: float
    width: float
    height: float
    spare: float

    @property
    def each(self) -> int:
        """Gives how many dabs one becomes."""
        return (1 + len(self.copies)) * len(_AROUND)

    def shifted(self, dabs: np.ndarray, across: int, down: int) -> np.ndarray:
        """Returns dabs, float64 (n, 6), as they lie in the cell, shifted by whole periods; those that stay outside
        have no effect, but count, or tips would lie otherwise.  BrushError if one is wider than the cell."""
        out, reach = dabs.copy(), np.maximum(dabs[:, _RADIUS], 0.5) + 1.0 + self.spare
        widest = float(reach.max()) if len(reach) else 0.0
        if widest > min(self.width, self.height):
            most = min(self.width, self.height) - 1.0 - self.spare
            if most < 0.5:
                tile = f"a tile of {self.width:g} x {self.height:g} px at this level"
                raise BrushError("stroke", tile, "at least 3 px each way: zoom in")
            raise BrushError("brush.radius", f"{widest - 1.0 - self.spare:g} px", f"at most {most:g} px on this tile")
        met = np.ones(len(out), np.bool_)
        for column, first, period, by in ((_X, self.left, self.width, across), (_Y, self.top, self.height, down)):
            out[:, column] += (by - np.floor((out[:, column] - first) / period)) * period
            met &= (out[:, column] + reach > first) & (out[:, column] - reach < first + period)
        out[~met, _OPACITY] = 0.0
        return out


def each(copies: Copies | Torus) -> int:
    """Returns how many dabs one becomes."""
    return copies.each if isinstance(copies, Torus) else 1 + len(copies)


def symmetric(centre: tuple[float, float], count: int, axis: tuple[float, float] | None = None) -> Copies:
    """Returns the copies that, with the stroke itself, are turned about `centre` by each part of a full turn, of which
    there are `count`; and all of them mirrored in an axis through the centre in the direction `axis`."""
    turns = [turned(k, count) for k in range(count)]
    out = [_about(centre, *turn, False) for turn in turns[1:]]
    if axis is not None:
        x, y = axis
        square = x * x + y * y
        re, im = (y * y - x * x) / square, -2.0 * x * y / square
        out += [_about(centre, re * a - im * b, re * b + im * a, True) for a, b in turns]
    return tuple(out)


def _about(centre: tuple[float, float], re: float, im: float, mirror: bool) -> Copy:
    """Returns the copy that leaves the centre where it is."""
    x, y = Copy(re, im, 0.0, 0.0, mirror).moved(*centre)
    return Copy(re + 0.0, im + 0.0, centre[0] - x + 0.0, centre[1] - y + 0.0, mirror)


@lru_cache(64)
def _table(copies: Copies) -> np.ndarray:
    """Returns columns re, im, x, y, sign of x, |c|: float64 (n, 6)."""
    return np.array([(c.re, c.im, c.x, c.y, -1.0 if c.mirror else 1.0, c.scale) for c in copies]).reshape(-1, 6)


def copied_places(points: np.ndarray, copies: Copies) -> np.ndarray:
    """Returns where points, float64 (n, 2), lie themselves and in each copy: float64 (n, 1 + copies, 2)."""
    table = _table(copies)
    out = np.empty((len(points), 1 + len(table), 2))
    out[:, 0] = points
    re, im, left, top, sign = table.T[:5]
    x, y = points[:, :1] * sign, points[:, 1:]
    out[:, 1:, _X] = re * x - im * y + left
    out[:, 1:, _Y] = re * y + im * x + top
    return out


def copied(dabs: np.ndarray, copies: Copies | Torus, together: int = 1) -> Iterator[np.ndarray]:
    """Yields the dabs of a stroke, float64 (n, 6), each followed by its copies, a portion at a time; never a part of
    so many `together`."""
    if isinstance(copies, Torus):
        for part in copied(dabs, copies.copies, together):
            around = np.stack([copies.shifted(part, *by) for by in _AROUND], axis=1)
            yield around.reshape(-1, dabs.shape[1])
        return
    if not copies:
        yield dabs
        return
    widest, each = SETTINGS["radius"].hi, 1 + len(copies)
    portion = max(1, _AT_ONCE // each // together) * together
    for start in range(0, len(dabs), portion):
        part = dabs[start : start + portion]
        out = np.repeat(part[:, None], each, axis=1)
        out[:, :, :_RADIUS] = copied_places(part[:, :_RADIUS], copies)
        out[:, 1:, _RADIUS] = np.minimum(part[:, _RADIUS, None] * _table(copies)[:, 5], widest)
        yield out.reshape(-1, dabs.shape[1])


def one_by_one(dabs: np.ndarray, copies: Copies | Torus) -> Iterator[np.ndarray]:
    """Yields the dabs of a stroke, and of each of its copies."""
    if isinstance(copies, Torus):
        for part in one_by_one(dabs, copies.copies):
            yield from (copies.shifted(part, *by) for by in _AROUND)
        return
    yield dabs
    for copy in copies:
        yield np.concatenate([*(part[1::2] for part in copied(dabs, (copy,)))]) if len(dabs) else dabs


def boxes(dabs: np.ndarray, copies: Copies, origin: tuple[int, int], spare: int) -> list[Rect]:
    """Returns, for the stroke and for each copy, pixels outside which its dabs lay nothing, and `spare` more."""
    if not len(dabs):
        return []
    at, table = copied_places(dabs[:, :_RADIUS], copies), _table(copies)
    radius = np.minimum(float(dabs[:, _RADIUS].max()) * np.append(1.0, table[:, 5]), SETTINGS["radius"].hi) + 2.0
    low, high = np.floor(at.min(axis=0) - radius[:, None]), np.ceil(at.max(axis=0) + radius[:, None])
    x, y = origin
    return [
        Rect(x + int(x0), y + int(y0), x + int(x1), y + int(y1)).grown(spare)
        for (x0, y0), (x1, y1) in zip(low, high, strict=True)
    ]
