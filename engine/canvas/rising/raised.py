"""What commits made of levels, kept for a while: tiles evaluated before them are brought up to date with it.

A commit works out the new values of all coarser levels where they change.  Evaluating them anew goes through all levels
above.
"""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from engine.canvas.rising import lifting
from engine.canvas.rising.spans import Marks
from engine.canvas.store import Change
from engine.numeric.address import Rect, TileKey
from engine.texture.planes import COLOURS, Planes, merged, plane_map, widened

MOST = 256  # commits that are looked through: a tile is sooner made again than after more
_OVERHEAD = 2000  # bytes of a commit's own objects, roughly


class RaisedPatch(Protocol):
    """What a commit made of a tile: `engine.canvas.front.Patch`."""

    @property
    def key(self) -> TileKey:
        """Gives the tile."""
        ...

    @property
    def at(self) -> Rect:
        """Gives the rectangle that the arrays cover."""
        ...

    @property
    def dirty(self) -> Rect:
        """Gives the one that holds all that changed."""
        ...

    @property
    def new(self) -> Planes:
        """Gives the new values."""
        ...

    @property
    def marks(self) -> Marks:
        """Gives where they changed, and the columns of each row."""
        ...


@dataclass(frozen=True, eq=False, slots=True)
class NewValues:
    """New values of pixels: of `at`, in the columns of each row that `spans`, int32 (h, 2), tells."""

    at: Rect
    planes: Planes
    spans: np.ndarray

    @classmethod
    def of(cls, patch: RaisedPatch) -> NewValues:
        """Takes what changed of a patch."""
        rows, columns = patch.dirty.slices(patch.at)
        spans = patch.marks[1][rows] - np.int32(columns.start)
        return cls(patch.dirty, Planes(patch.new.data[:, rows, columns].copy(), patch.new.inks), spans)

    @property
    def nbytes(self) -> int:
        """Counts the bytes of memory that it takes."""
        return self.planes.data.nbytes + self.spans.nbytes

    def put(self, rect: Rect, out: Planes) -> None:
        """Writes the pixels into `out`, which covers `rect` and has room for their inks."""
        part = self.at.intersect(rect)
        if part.empty:
            return
        rows, columns = part.slices(self.at)
        spans = np.minimum(np.maximum(self.spans[rows] - np.int32(columns.start), 0), part.width)
        planes = plane_map(self.planes.inks, out.inks)
        values = np.ascontiguousarray(
            self.planes.data[:, rows, columns]
        )  # whatever is cut: so the kernel is compiled once
        lifting.place_changed(values, planes, spans, out.data, part.y0 - rect.y0, part.x0 - rect.x0)


@dataclass(frozen=True, eq=False, slots=True)
class _Made:
    """What a commit made: `own`, where its own level changed, by tile; of the coarser levels, what was written."""

    own: Mapping[tuple[int, int], Rect]
    coarser: Mapping[int, Sequence[NewValues]]

    @classmethod
    def of(cls, level: int, patches: Sequence[RaisedPatch]) -> _Made:
        coarser: dict[int, list[NewValues]] = {}
        for patch in patches:
            if patch.key.level < level:
                coarser.setdefault(patch.key.level, []).append(NewValues.of(patch))
        return cls({(patch.key.x, patch.key.y): patch.dirty for patch in patches if patch.key.level == level}, coarser)

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

    def note(self, change: Change, patches: Sequence[RaisedPatch]) -> None:
        """Keeps what a commit made: all patches, of its own level and of the coarser ones."""
        if sum(patch.new.data.nbytes for patch in patches if patch.key.level < change.level) > self._most:
            return
        made = self._made[change] = _Made.of(change.level, patches)
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
    inks = merged(planes.inks, *(one.planes.inks for one in written))
    out = widened(planes, inks)
    if np.may_share_memory(out.data, planes.data):
        out = Planes(planes.data.copy(), inks)
    for one in written:
        one.put(rect, out)
    return out
