"""Undo and redo: paintings as they were, without a limit of steps, bounded by the bytes that only they hold.

A step keeps two paintings, before and after, which share all tiles that it did not change.  What the one before holds
alone counts while the step is done (undo would bring it back), what the one after holds alone while it is undone.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import NamedTuple

from engine.canvas import growth as growths
from engine.canvas import layers
from engine.canvas.growth import Growth
from engine.canvas.layers import Group
from engine.canvas.store import Pyramid, Record, changed_rects
from engine.checks.owned import Owned
from engine.painting.value import Painting

_AROUND = 4  # pixels around a change whose residuals it also rewrites: those under the expanded parents
STEP_OVERHEAD = 2000  # bytes of a step's own objects, roughly


@dataclass(frozen=True, eq=False, slots=True)
class Undoable:
    """`lost`, `gained`: bytes held only by the painting before, and only by the one after."""

    before: Painting
    after: Painting
    lost: int
    gained: int


class HeldSteps(NamedTuple):
    """The steps done, the oldest first, and those undone, the last to be done again first; for another thread."""

    done: tuple[Undoable, ...] = ()
    undone: tuple[Undoable, ...] = ()


class History(Owned):
    """The steps done and the steps undone.  It belongs to the thread that made it.

    `bytes_cap`: None for no limit; `keep`: steps never forgotten; `steps`: those that are there already.
    """

    def __init__(self, bytes_cap: int | None = None, keep: int = 1, steps: HeldSteps = HeldSteps()) -> None:  # noqa: B008
        self._done: deque[Undoable] = deque(steps.done)
        self._undone: list[Undoable] = list(steps.undone)
        self._bytes_cap, self._keep = bytes_cap, keep
        held = (*(step.lost for step in steps.done), *(step.gained for step in steps.undone))
        self.held = sum(held) + STEP_OVERHEAD * len(held)  # bytes

    @property
    def steps(self) -> HeldSteps:
        """Gives all steps, as values."""
        return HeldSteps(tuple(self._done), tuple(self._undone))

    @property
    def undo_count(self) -> int:
        """Counts the steps that can be taken back."""
        return len(self._done)

    @property
    def redo_count(self) -> int:
        """Counts the steps that can be done again."""
        return len(self._undone)

    def push(self, before: Painting, after: Painting) -> None:
        """A step was done: nothing that was undone can be redone any more."""
        self.held -= sum(step.gained + STEP_OVERHEAD for step in self._undone)
        self._undone.clear()
        step = Undoable(before, after, *difference(before.root, after.root))
        self._done.append(step)
        self.held += step.lost + STEP_OVERHEAD
        self._forget()

    def undo(self) -> Painting:
        """Returns the painting before the last step; IndexError if there is none."""
        step = self._done.pop()
        self._undone.append(step)
        self.held += step.gained - step.lost
        return step.before

    def redo(self) -> Painting:
        """Returns the painting after the step undone last; IndexError if there is none."""
        step = self._undone.pop()
        self._done.append(step)
        self.held += step.lost - step.gained
        return step.after

    def at(self, by: int) -> Painting | None:
        """Returns the painting so many steps on, or back if that is negative; None where that is not held, or is 0."""
        if 0 < -by <= len(self._done):
            return self._done[by].before
        return self._undone[-by].after if 0 < by <= len(self._undone) else None

    def amend(self, root: Group) -> None:
        """The layers as they are now, further refined, are `root`."""
        if self._done:
            step = self._done[-1]
            new = Undoable(step.before, replace(step.after, root=root), *difference(step.before.root, root))
            self._done[-1] = new
            self.held += new.lost - step.lost
        if self._undone:
            step = self._undone[-1]
            new = Undoable(replace(step.before, root=root), step.after, *difference(root, step.after.root))
            self._undone[-1] = new
            self.held += new.gained - step.gained

    def _forget(self) -> None:
        """Drops the oldest steps beyond the limit."""
        while len(self._done) > self._keep and self._bytes_cap is not None and self.held > self._bytes_cap:
            self.held -= self._done.popleft().lost + STEP_OVERHEAD


def difference(old: Group, new: Group) -> tuple[int, int]:
    """Returns bytes that only `old` holds, and bytes that only `new` holds."""
    before = {layer.id: layer for layer in layers.layers(old)}
    after = {layer.id: layer for layer in layers.layers(new)}
    lost = gained = 0
    for number in before.keys() | after.keys():
        one, other = before.get(number), after.get(number)
        fewer, more = _regrown(one.growth if one else (), other.growth if other else ())
        lost, gained = lost + fewer, gained + more
        a, b = one.pyramid if one else None, other.pyramid if other else None
        if a is b:
            continue
        if a is None or b is None or a.uid != b.uid:
            lost += a.nbytes if a is not None else 0
            gained += b.nbytes if b is not None else 0
            continue
        lost += sum(record.nbytes for record in _only(a, b))
        gained += sum(record.nbytes for record in _only(b, a))
        gained += b.last.nbytes if b.last is not None and b.last is not a.last else 0
    return lost, gained


def _regrown(old: Growth, new: Growth) -> tuple[int, int]:
    """Returns the same of what was painted on a layer with examples."""
    if old is new:
        return 0, 0
    before, after = growths.arrays(old), growths.arrays(new)
    return sum(n for k, n in before.items() if k not in after), sum(n for k, n in after.items() if k not in before)


def _only(one: Pyramid, other: Pyramid) -> Iterator[Record]:
    """Yields the records of one state that another of the same line of history does not share."""
    for level, stored in one.levels.items():
        there = other.levels.get(level)
        if there is stored:
            continue
        if one.settled != other.settled:  # folded in between: records changed wherever a stroke had waited
            yield from (r for place, r in stored.items() if there is None or there.get(place) is not r)
            continue
        for rect in changed_rects(other, one, level):
            for key, record in one.records(level, rect.grown(_AROUND)):
                if there is None or there.get((key.x, key.y)) is not record:
                    yield record
