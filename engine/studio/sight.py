"""What the window has in sight: the tiles it wants, and which of its copies have become old."""

from __future__ import annotations

from collections import deque

from engine.canvas.placing.cells import SeenAreas
from engine.checks.owned import Owned
from engine.numeric.address import Rect
from engine.studio import requests as q

Key = tuple[int, int, int]
STEPS_KEPT = 64  # changes remembered: a tile older than all of them is made anew


class Sight(Owned):
    """The tiles on the screen by urgency, and the changes since they were made.  It belongs to the engine's thread.

    `revision` counts the changes; a tile that the window holds is as good as the revision it was made at.
    """

    def __init__(self) -> None:
        self.revision = 0
        self.open: deque[Key] = deque()  # tiles to look at
        self._wanted: dict[Key, int] = {}  # tile: revision that the window holds, -1 for none; in order of urgency
        self._begun: set[Key] = set()  # tiles of which a first picture was sent
        self._changes: deque[tuple[int, SeenAreas]] = deque(maxlen=STEPS_KEPT)

    def look(self, request: q.Look) -> None:
        """Takes over what is wanted on the screen."""
        self._wanted = {(level, x, y): held for level, x, y, held in request.tiles}
        self.open = deque(self._wanted)
        self._begun.clear()

    def changed(self, where: SeenAreas) -> None:
        """The picture changed in the areas that `where` gives for a level: all tiles are looked at again."""
        self.grew(where, False)
        self.open = deque(self._wanted)

    def grew(self, where: SeenAreas, more: bool) -> None:
        """A stroke in progress changed the picture; `more`: `where` holds what the change before told as well."""
        if more:
            self._changes.pop()
        self.revision += 1
        self._begun.clear()
        self._changes.append((self.revision, where))

    def forget(self) -> None:
        """Another painting is to be seen: no change of the old one matters."""
        self._changes.clear()
        self._begun.clear()

    def meeting(self, where: SeenAreas) -> list[Key]:
        """Returns the tiles that the window holds and that meet areas of their levels."""
        held = ((key, where(key[0])) for key, held in self._wanted.items() if held >= 0)
        return [key for key, found in held if found is None or any(area.meets(tile_rect(key)) for area in found)]

    @property
    def near(self) -> tuple[int, Rect] | None:
        """Returns the most urgent tile's level, and what is in sight of it."""
        if not self._wanted:
            return None
        level, area = next(iter(self._wanted))[0], Rect(0, 0, 0, 0)
        for key in self._wanted:
            area = area.union(tile_rect(key)) if key[0] == level else area
        return level, area

    def old_part(self, key: Key) -> Rect | None:
        """Returns what of a tile is to be sent anew: empty if the window's copy is good, None if there is nothing to
        tell."""
        held = self._wanted.get(key)
        if held is None or held == self.revision:
            return None
        whole = tile_rect(key)
        part = Rect(0, 0, 0, 0)
        for area in [whole] if held < 0 else self._old_parts(key[0], whole, held):
            part = part.union(area)
        return part

    def sent(self, key: Key) -> None:
        """The window's copy of a tile is good now."""
        self._wanted[key] = self.revision

    def unfinished(self, key: Key) -> int | None:
        """A tile is looked at again: its picture is not all made.  Returns what the window's copy is as good as if it
        is given what there is; None if it has been.  All are begun first, then finished one by one."""
        begun = key in self._begun
        if key not in self.open:
            (self.open.appendleft if begun else self.open.append)(key)
        self._begun.add(key)
        return None if begun else self._wanted[key]

    def _old_parts(self, level: int, whole: Rect, held: int) -> list[Rect]:
        """Returns the parts of a rectangle that changed after revision `held`."""
        if not self._changes or self._changes[0][0] > held + 1:
            return [whole]
        out = []
        for revision, where in self._changes:
            if revision <= held:
                continue
            changed = where(level)
            if changed is None:
                return [whole]
            out += [r for r in (area.intersect(whole) for area in changed) if not r.empty]
        return out


def tile_rect(key: Key) -> Rect:
    """Gives the pixels that a screen tile covers."""
    _, x, y = key
    return Rect.at(x * q.SCREEN_TILE, y * q.SCREEN_TILE, q.SCREEN_TILE, q.SCREEN_TILE)


def grown_parts(before: list[Rect], parts: list[Rect]) -> list[Rect]:
    """Returns parts that grew: one by one where there are as many, else all of them around as one."""
    if len(before) == len(parts):
        return [one.union(other) for one, other in zip(before, parts, strict=True)]
    if not before or not parts:
        return before or parts
    whole = before[0]
    for part in (*before[1:], *parts):
        whole = whole.union(part)
    return [whole]
