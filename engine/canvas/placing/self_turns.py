"""A picture that contains itself, turn by turn: each is composed once, and those that matter are found by halving.

Where the frame of a turn lies within that of the one before, all turns whose frame holds a rectangle come first.  Of
these, only the innermost are looked at, at every depth: the ones farther out are behind it, and what lies above the
placement in them shows only the few pixels around the place that all turns share.
"""

from __future__ import annotations

import functools
import threading
from collections.abc import Callable, Sequence

from engine.canvas.evaluate import evaluate_sparse
from engine.canvas.layers import Layer
from engine.canvas.placing.clip import Clip
from engine.canvas.placing.placement import Placement
from engine.canvas.placing.pose import SourcePart
from engine.canvas.placing.through import UNPLACED, Seen
from engine.canvas.selecting.layer_mask import Mask
from engine.canvas.store import Change, Pyramid
from engine.numeric.address import Rect
from engine.numeric.similarity import Dyadic

_CHAINS = 8  # placements whose turns are kept
_AROUND = 3  # pixels around the place that all turns share, where layers are looked at
_EMPTY_FROM = 12  # levels coarser than a layer's finest paint at which it is looked at first
_MOST = 1 << 16  # turns
_States = tuple[tuple[int, Change | None], ...]


class Turns:
    """The turns of a placement that lies in what it shows; itself seen as `outer`.  Safe for several threads."""

    def __init__(self, placement: Placement, outer: Seen) -> None:
        assert placement.part is not None
        self._placement, self._part = placement, placement.part
        self._found = [outer.unclipped.of(placement)]
        self._nested = self._is_nested()
        self._bounds: dict[tuple[int, int], Rect] = {}
        self._starts: dict[tuple[SourcePart, int], int] = {}  # by level of a part, where the last search ended
        self._empty: tuple[_States, SourcePart | None] = (), None
        self._whole: tuple[_States, SourcePart | None] = (), None
        self._lock = threading.Lock()

    def _is_nested(self) -> bool:
        own, part = self._placement.pose.similarity, self._part
        rect = part.rect
        corners = [own(Dyadic.of(x, y, part.level)) for x in (rect.x0, rect.x1) for y in (rect.y0, rect.y1)]
        fine = max(part.level, *(corner.e for corner in corners))
        inner = own.shown(rect, part.level, fine)
        return inner.intersect(rect.zoomed(fine - part.level)) == inner

    def __getitem__(self, turn: int) -> Seen:
        """Gives how a turn is seen; it is cut by its own frame alone, and that by whoever draws it."""
        if turn >= len(self._found):
            with self._lock:
                while turn >= len(self._found):
                    self._found.append(self._found[-1].unclipped.of(self._placement))
        return self._found[turn]

    def frame(self, turn: int, level: int) -> Rect:
        """Returns the pixels of a level that meet the frame of a turn."""
        found = self._bounds.get((turn, level))
        if found is None:
            clip = self[turn].own
            assert clip is not None
            if len(self._bounds) > _MOST:
                self._bounds = {}
            found = self._bounds[turn, level] = clip.bounds(level)
        return found

    def within(self, turn: int, level: int, rect: Rect) -> Rect:
        """Returns the pixels of a rectangle in which a turn is seen; none where it is too small."""
        return Rect(0, 0, 0, 0) if self[turn].vanishes(level) else rect.intersect(self.frame(turn, level))

    def holding(self, level: int, rect: Rect) -> int:
        """Returns how many turns come before the innermost whose frame holds all of a rectangle; 0 where frames do not
        lie in one another."""
        if not self._nested:
            return 0
        return max(0, self._count(self._part, level, rect) - 1)

    def empty(self, above: Sequence[Layer], level: int, rect: Rect) -> int:
        """Returns how many turns, from the outermost on, of which layers show nothing in a rectangle."""
        if not self._nested or any(layer.growth or layer.pyramid.bare is not None for layer in above):
            return 0
        states = tuple((layer.pyramid.uid, layer.pyramid.last) for layer in above)
        held, part = self._empty
        if not _the_same(held, states):
            stored = [layer for layer in above if layer.pyramid.finest is not None]
            finest = max((layer.pyramid.finest or 0 for layer in stored), default=0)
            part = self._around(finest, lambda at, near: not any(_has_paint(layer, at, near) for layer in stored))
            self._empty = states, part
        return 0 if part is None else self._count(part, level, rect)

    def whole(self, mask: Mask, level: int, rect: Rect) -> int:
        """Returns how many turns, from the outermost on, of which a mask around them hides nothing in a rectangle."""
        pyramid = mask.selection.pyramid
        if not self._nested or pyramid.bare is not None:
            return 0
        states = ((pyramid.uid, pyramid.last),)
        held, part = self._whole
        if not _the_same(held, states):
            finest = (pyramid.finest or 0) - mask.moved.levels
            part = self._around(finest, lambda at, near: _hides_nothing(mask, at, near))
            self._whole = states, part
        return 0 if part is None else self._count(part, level, rect.grown(_AROUND))

    def _around(self, finest: int, alike: Callable[[int, Rect], bool]) -> SourcePart | None:
        """Returns a square around the place that all turns share that is `alike`, if there is one."""
        shared = self._shared(finest)
        for level in range(finest - _EMPTY_FROM, finest + 1):
            near = shared.zoomed(level - finest).grown(_AROUND)
            if alike(level, near):
                return SourcePart(level, near)
        return None

    def _shared(self, level: int) -> Rect:
        """Returns the few pixels of a source's level that hold the place that all turns share."""
        seen = UNPLACED.of(self._placement)
        for _ in range(self._most(level)):
            seen = seen.unclipped.of(self._placement)
        return Clip(self._part, seen.similarity).bounds(level)

    def _most(self, level: int) -> int:
        """Returns a number of turns beyond which a frame is less than a pixel of a level."""
        side = max(self._part.rect.width, self._part.rect.height).bit_length() - self._part.level
        first = level + side + self._found[0].similarity.log_scale
        return max(0, int(-first / self._placement.pose.similarity.log_scale)) + 3

    def _count(self, part: SourcePart, level: int, rect: Rect) -> int:
        """Returns how many turns there are in which a part holds all of a rectangle, all others coming later."""

        def holds(turn: int) -> bool:
            return Clip(part, self[turn].similarity).holds(level, rect)

        low, high = 0, self._most(level + part.level - self._part.level) + 1
        near, wide = self._starts.get((part, level), 0), 1
        while low < near < high - 1:  # it is near the one before, as a rule
            if holds(near - 1):
                low, near = near, near + wide
            else:
                high, near = near, near - wide
            wide *= 2
        while low < high - 1:
            half = (low + high) // 2
            low, high = (half, high) if holds(half - 1) else (low, half)
        if len(self._starts) > _MOST:
            self._starts = {}
        self._starts[part, level] = low
        return low


@functools.lru_cache(_CHAINS)
def turns_of(placement: Placement, outer: Seen) -> Turns:
    """Returns the turns of a placement that lies in what it shows."""
    return Turns(placement, outer)


def _the_same(held: _States, states: _States) -> bool:
    return len(held) == len(states) and all(a[0] == b[0] and a[1] is b[1] for a, b in zip(held, states, strict=True))


def _has_paint(layer: Layer, level: int, rect: Rect) -> bool:
    """Tells whether something lies in a rectangle of a level, or is stored below it."""
    return _has_finer(layer.pyramid, level, rect) or (
        evaluate_sparse(layer.pyramid, level, rect.grown(_AROUND), None) is not None
    )


def _hides_nothing(mask: Mask, level: int, rect: Rect) -> bool:
    """Tells whether a mask hides nothing in a rectangle of a level, and of those below it."""
    at = level + mask.moved.levels
    near = mask.moved.similarity.box(rect, level, at, _AROUND)
    share = mask.selection.part(at, near)
    return isinstance(share, float) and share == 1.0 and not _has_finer(mask.selection.pyramid, at, near)


def _has_finer(pyramid: Pyramid, level: int, rect: Rect) -> bool:
    """Tells whether something is stored below a rectangle of a level."""
    return any(pyramid.has_records(k, rect.zoomed(k - level)) for k in pyramid.levels if k > level)
