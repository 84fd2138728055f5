"""What commits made of levels, kept for a while: tiles evaluated before them are brought up to date with it.

A commit works out the new values of all coarser levels where they change.  Evaluating them anew goes through all levels
above.
"""

from __future__ import annotations

import threading
from collections import OrderedDict
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from engine.canvas.rising import lifting, span_values
from engine.canvas.store import Change, Pyramid
from engine.numeric.address import TILE, Rect, TileKey
from engine.texture.planes import COLOURS, Planes, merged, plane_map, widened
from engine.texture.record import Instance

MOST = 256  # commits that are looked through: a tile is sooner made again than after more
_OVERHEAD = 2000  # bytes of a commit's own objects, roughly


class PaintedTile(Protocol):
    """What a commit made of a tile of its own level: `engine.canvas.front.Patch`."""

    @property
    def key(self) -> TileKey:
        """Gives the tile."""
        ...

    @property
    def dirty(self) -> Rect:
        """Gives the rectangle that holds all that changed."""
        ...


class OfLevel(Protocol):
    """What lies in a rectangle of a level."""

    @property
    def level(self) -> int:
        """Gives the level."""
        ...

    @property
    def rect(self) -> Rect:
        """Gives the rectangle that the values cover."""
        ...


class RisenLevel(OfLevel, Protocol):
    """What a commit made of a coarser level: `engine.canvas.rising.risen.Risen`."""

    @property
    def planes(self) -> Planes:
        """Gives the new values."""
        ...

    @property
    def by_tiles(self) -> np.ndarray:
        """Gives the columns of each row in which they changed, by tile: int32 (h, T, 2)."""
        ...


class AroundChange(OfLevel, Protocol):
    """Values of a level around a change: `engine.canvas.front.Around`."""

    @property
    def planes(self) -> Planes | None:
        """Gives the values; None where nothing lies."""
        ...


class Front:
    """The values of the levels around the newest commit, for the next one, which most often lies there, too; bounded by
    bytes.  Safe for several threads."""

    def __init__(self, most: int) -> None:
        self._most, self._lock, self.held = most, threading.Lock(), 0
        self._state: tuple[int, Change | None] | None = None
        self._around: Sequence[AroundChange] = ()

    def keep(self, pyramid: Pyramid, around: Sequence[AroundChange]) -> None:
        """Keeps the values as they are in the state that a commit led to, in place of others; the next commit writes to
        them."""
        size = sum(level.planes.data.nbytes for level in around if level.planes is not None)
        state = (pyramid.uid, pyramid.last), around, size
        with self._lock:
            self._state, self._around, self.held = state if size <= self._most else (None, (), 0)

    def taken(self, pyramid: Pyramid) -> Sequence[AroundChange]:
        """Gives them away, where the commit led to this state: none else."""
        with self._lock:
            state = self._state
            if state is None or state[0] != pyramid.uid or state[1] is not pyramid.last:
                return ()
            found, self._state, self._around, self.held = self._around, None, (), 0
            return found

    def clear(self) -> None:
        """Forgets them."""
        with self._lock:
            self._state, self._around, self.held = None, (), 0


@dataclass(frozen=True, eq=False, slots=True)
class NewValues:
    """New values of pixels: of `at`, in the columns of each row that `spans`, int32 (h, 2), tells, where `values` has
    them one after another (`span_values.gather`): float32 (4 + 3n, k)."""

    at: Rect
    values: np.ndarray
    inks: tuple[Instance, ...]
    spans: np.ndarray

    @classmethod
    def of(cls, risen: RisenLevel) -> list[NewValues]:
        """Takes what changed of a level, by columns of tiles."""
        found, planes, (left, top, right, _) = [], risen.planes, risen.rect
        whole = planes.data.view(np.int32)  # as records are: so the kernel is compiled once
        for t, x in enumerate(range(left // TILE * TILE, right, TILE)):
            rows = np.flatnonzero(risen.by_tiles[:, t, 0] < risen.by_tiles[:, t, 1])
            if not len(rows):
                continue
            first, last, x0 = int(rows[0]), int(rows[-1]) + 1, max(x, left)
            spans = np.ascontiguousarray(risen.by_tiles[first:last, t])
            values = np.empty((len(whole), _count(spans)), np.int32)
            span_values.gather(whole, first, spans, values.reshape(-1))
            at = Rect(x0, top + first, min(x + TILE, right), top + last)
            spans -= np.int32(x0 - left)
            spans[spans[:, 0] >= spans[:, 1]] = 0
            found.append(cls(at, values.view(np.float32), planes.inks, spans))
        return found

    @property
    def nbytes(self) -> int:
        """Counts the bytes of memory that it takes."""
        return self.values.nbytes + self.spans.nbytes

    def put(self, rect: Rect, out: Planes) -> None:
        """Writes the pixels into `out`, which covers `rect` and has room for their inks."""
        part = self.at.intersect(rect)
        if part.empty:
            return
        rows, columns = part.slices(self.at)
        told, before = self.spans[rows], _count(self.spans[: rows.start])
        values = np.ascontiguousarray(self.values[:, before : before + _count(told)]).view(np.int32)
        there = np.empty((len(values), part.height, self.at.width), np.int32)
        span_values.scatter(values.reshape(-1), told, there, 0)
        spans = np.minimum(np.maximum(told - np.int32(columns.start), 0), part.width)
        planes = plane_map(self.inks, out.inks)
        cut = np.ascontiguousarray(there[:, :, columns]).view(np.float32)
        lifting.place_changed(cut, planes, spans, out.data, part.y0 - rect.y0, part.x0 - rect.x0)


def _count(spans: np.ndarray) -> int:
    """Counts the columns of rows."""
    return int(np.maximum(spans[..., 1] - spans[..., 0], 0).sum())


@dataclass(frozen=True, eq=False, slots=True)
class _Made:
    """What a commit made: `own`, where its own level changed, by tile; of the coarser levels, what was written."""

    own: Mapping[tuple[int, int], Rect]
    coarser: Mapping[int, Sequence[NewValues]]

    @classmethod
    def of(cls, painted: Sequence[PaintedTile], risen: Sequence[RisenLevel]) -> _Made:
        own = {(patch.key.x, patch.key.y): patch.dirty for patch in painted}
        return cls(own, {level.level: NewValues.of(level) for level in risen})

    def meets(self, rect: Rect) -> bool:
        """Tells whether its own level changed in a rectangle."""
        x0, y0, x1, y1 = rect.within_tiles()
        near = [self.own.get((x, y)) for y in range(y0, y1) for x in range(x0, x1)]
        return any(own is not None and own.meets(rect) for own in near)

    @property
    def nbytes(self) -> int:
        return _OVERHEAD + sum(written.nbytes for level in self.coarser.values() for written in level)


class Raised:
    """What the newest commits made of the levels coarser than their own, bounded by bytes."""

    def __init__(self, most: int) -> None:
        self._most, self.held = most, 0
        self._made: OrderedDict[Change, _Made] = OrderedDict()

    def note(self, change: Change, painted: Sequence[PaintedTile], risen: Sequence[RisenLevel]) -> None:
        """Keeps what a commit made of the tiles of its own level and of the coarser ones."""
        if sum(4 * len(level.planes.data) * _count(level.by_tiles) for level in risen) > self._most:
            return
        made = self._made[change] = _Made.of(painted, risen)
        self.held += made.nbytes
        while self.held > self._most:
            self.held -= self._made.popitem(last=False)[1].nbytes

    def clear(self) -> None:
        """Forgets all."""
        self._made.clear()
        self.held = 0

    def since(self, before: Change | None, last: Change | None, level: int, rect: Rect) -> list[NewValues] | None:
        """Returns what was written of a rectangle after a commit, the first one first; None where that is not known, or
        `last` does not follow on it."""
        found: list[NewValues] = []
        change, least = last, before.depth if before is not None else 0
        for _ in range(MOST):
            if change is before:
                return found[::-1]
            if change is None or change.depth <= least:
                return None
            if change.reach(level).meets(rect):
                made = self._made.get(change)
                if made is None or level > change.level:
                    return None
                if level == change.level and made.meets(rect):
                    return None
                found += [written for written in made.coarser.get(level, ()) if written.at.meets(rect)]
            change = change.before
        return None


def brought_up(planes: Planes | None, rect: Rect, written: Sequence[NewValues]) -> Planes | None:
    """Returns the values of a rectangle after some were written, the same object where none were."""
    if not written:
        return planes
    if planes is None:
        planes = Planes(np.zeros((COLOURS, rect.height, rect.width), np.float32))
    inks = merged(planes.inks, *(one.inks for one in written))
    out = widened(planes, inks)
    if np.may_share_memory(out.data, planes.data):
        out = Planes(planes.data.copy(), inks)
    for one in written:
        one.put(rect, out)
    return out
