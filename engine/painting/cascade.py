"""Values of many rectangles of a pyramid: what they have in common, the coarser levels, is evaluated once."""

from __future__ import annotations

import threading
from collections.abc import Mapping

from engine.canvas.evaluate import step
from engine.canvas.store import Pyramid
from engine.numeric.address import Rect
from engine.texture.planes import COLOURS, Planes
from engine.texture.record import Instance

SMALL = 1 << 21  # pixels of a level up to which it is held as a whole
PIXEL = 64  # bytes that each is counted for
_PLANES = PIXEL // 4  # for each of these pixels: where more ink lies, there are fewer pixels
_KEPT = 16  # levels held at a time: between them and the coarsest there may be many

Held = tuple[Rect, Planes | None]


class Cascade:
    """`needed`: the even rectangle of each level within which values will be asked for.  Safe for several threads.
    `inked`: whether any ink lies in the pyramid.  `held`: pixels of a level up to which it is held as a whole, fewer
    if there are more inks than four.
    `shown`: the one level whose colours are asked for; ink that adds no texture down to it is left out.

    A level is evaluated when a finer one is, at the latest, and must not change after that.
    """

    def __init__(
        self, pyramid: Pyramid, needed: Mapping[int, Rect], held: int = SMALL, shown: int | None = None
    ) -> None:
        self.pyramid = pyramid
        self._most, self._shown = held, shown
        self._inks = _inks_down_to(pyramid, shown)
        self.inked = any(self._inks.values())
        self._coarsest = pyramid.coarsest if pyramid.coarsest is not None else 0
        self._rects = dict(needed)
        finest = max(needed, default=self._coarsest)
        for level in range(finest, self._coarsest, -1):
            above = self._rects.get(level - 1, Rect(0, 0, 0, 0))
            self._rects[level - 1] = above.union(self._rects[level].parents().evened())
        self._held: dict[int, Held] = {}
        self._next = self._coarsest
        self._lock, self._parts = threading.Lock(), threading.Lock()

    def at(self, level: int, rect: Rect) -> Planes | None:
        """Returns what the even `rect` of `level` shows, None where nothing lies."""
        self.hold(level - 1)
        return self._at(level, rect)

    def hold(self, level: int) -> None:
        """Evaluates all levels down to this one of which little enough is needed to hold it as a whole."""
        with self._lock:
            for k in range(self._next, level + 1):
                rect = self._rects.get(k)
                if rect is not None and self._planes(k) * rect.area <= _PLANES * self._most:
                    self._held[k] = rect, self._at(k, rect)
                self._held.pop(k - _KEPT, None)
            self._next = max(self._next, level + 1)

    def hold_part(self, level: int, rect: Rect) -> None:
        """Evaluates a part of a level that is too large to be held as a whole, and holds it in place of another one;
        for what is asked for next; unless it takes more room than a whole level may."""
        if level <= self._coarsest or self._planes(level) * rect.area > _PLANES * self._most:
            return
        with self._parts:
            held = self._held.get(level)
            if held is None or held[0].union(rect) != held[0]:
                self._held[level] = rect, self.at(level, rect)

    def _planes(self, level: int) -> int:
        """Returns the planes that a pixel of a level is counted for: of all inks down to it, at least `_PLANES`."""
        inks = max((count for k, count in self._inks.items() if k <= level), default=0)
        return max(_PLANES, COLOURS + 3 * inks)

    def _at(self, level: int, rect: Rect) -> Planes | None:
        rects, above = [rect], None
        for k in range(level - 1, self._coarsest - 1, -1):
            parents = rects[-1].parents().evened()
            above = self._held.get(k)
            if above is not None and above[0].union(parents) == above[0]:
                break
            rects.append(parents)
            above = None
        at, value = above if above is not None else (rects[-1].parents(), None)
        for k, inner in zip(range(level - len(rects) + 1, level + 1), reversed(rects), strict=True):
            value = step(self.pyramid, value, at, k, inner, self._shown)
            at = inner
        return value


def _inks_down_to(pyramid: Pyramid, shown: int | None) -> dict[int, int]:
    """Counts, for each level that has records, the inks of that level and of coarser ones; of those that are seen at
    the level `shown`, if it is given."""
    at: dict[int, set[Instance]] = {}
    for level in pyramid.levels:
        at[level] = set().union(*pyramid.stacks(level))
    found: set[Instance] = set()
    counts = {}
    for level in sorted(at):
        found |= {ink for ink in at[level] if shown is None or ink.base < shown}
        counts[level] = len(found)
    return counts
