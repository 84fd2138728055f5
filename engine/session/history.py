"""Undo and redo: paintings as they were, without a limit of steps, bounded by the bytes that only they hold.

A step keeps two paintings, before and after, which share all tiles that it did not change.  What the one before holds
alone counts while the step is done (undo would bring it back), what the one after holds alone while it is undone.
Of steps far from the present it is coded: what differs from the next painting towards the present, compressed; and
where all take too much, put away on disk.  Their paintings stay what they are, values whose data are made when somebody
looks at them: so going to any of them takes no longer than going to the next, and what is coded there by other steps is
made plain while nothing else is to be done.
"""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Iterable
from dataclasses import replace
from functools import partial
from typing import NamedTuple

import numpy as np

from engine.canvas import growth as growths
from engine.canvas import layers
from engine.canvas.layers import Group
from engine.canvas.store import Record
from engine.checks.owned import Owned
from engine.keeping import memory
from engine.numeric.address import TileKey
from engine.painting.value import Painting
from engine.session.coding.coded_records import CodedData, Ways, decode
from engine.session.coding.coded_tiles import decode_tile
from engine.session.coding.laid_records import pack_laid, stays_packed
from engine.session.coding.spanned import lessen
from engine.session.differing import apart_records, apart_tiles, difference, lost_records
from engine.session.held_pyramids import pyramids
from engine.session.line import StepLine, Undoable, counted, is_thickset, make_thin
from engine.session.old_commits import OldCommits
from engine.texture.example.tiles import TilePlanes

_AT_HAND = 16  # steps nearest to the present that are not coded while there is room
_AT_ONCE = 256 << 10  # bytes of data that are coded in one piece of work
_SHARE = 2  # so many bytes are coded for each that a step brings, where nobody rested; but no fewer than `_AT_ONCE`
_TIGHT_PART = 4  # of the limit: what steps may hold while memory is tight
_TIGHT_AT_ONCE = 1 << 20  # bytes of data that a step has coded then, beside its share
_LOOKED_AT = 256  # records that wait to be made plain, at each step
_TIGHT_STEPS = 8  # that are put away on disk with it;
_MADE_THIN = 2  # and that are made thin: together with all else a stroke must not be felt
_NOTHING = Painting()


class HeldSteps(NamedTuple):
    """The steps done, the oldest first, and those undone, the last to be done again first; for another thread."""

    done: tuple[Undoable, ...] = ()
    undone: tuple[Undoable, ...] = ()


class History(Owned):
    """The steps done and the steps undone.  It belongs to the thread that made it.

    `bytes_cap`: None for no limit, 0 for no step beside those of `keep`, which are never forgotten; `steps`: those that
    are there already.  Steps beyond the newest are coded while nothing else is to be done (`pending`, `step`), and from
    half of the limit on each step has some of the others coded, too.  Near the limit they go to disk, and are forgotten
    only where that has no room.  `forgotten`: steps that were done and are not there any more;
    `tight`: whether all are to be coded and put away on disk; `lessens`: whether a new step keeps only what it
    changed, where that is known.
    """

    def __init__(self, bytes_cap: int | None = None, keep: int = 1, steps: HeldSteps = HeldSteps()) -> None:  # noqa: B008
        self._done, self._undone = StepLine(False, steps.done), StepLine(True, steps.undone)
        self._lines = self._done, self._undone
        self._bytes_cap, self._keep = bytes_cap, keep
        # Those that a replay keeps, because it takes them back, may take as much as any.
        self._limit = math.inf if bytes_cap is None else bytes_cap or memory.history_share()
        self._mixed: deque[tuple[TileKey, Record]] = deque()  # of the present or another state, of which some are coded
        self._grown: deque[TilePlanes] = deque()  # tiles of the present that are coded, or were
        self._old = OldCommits()
        self._root: Group | None = None  # the present, where it was another before
        self.forgotten, self.tight = 0, False
        self.lessens = bytes_cap != 0  # nobody goes back to a replay's steps

    @property
    def held(self) -> int:
        """Returns bytes that only steps hold."""
        return self._done.held + self._undone.held

    @property
    def steps(self) -> HeldSteps:
        """Gives the steps, as values, but for those far away that are not there as a whole."""
        return HeldSteps(self._done.steps, self._undone.steps)

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
        self._undone.clear()
        if self._mixed:  # what is coded by records that are forgotten now would keep them
            for record in lost_records(before.root, after.root):
                decode(record)
        self._root = after.root
        _let_go(self._mixed, self._root, self.tight)
        smaller = partial(_smaller, self._done.ways if self.lessens else None)
        self._done.push(Undoable(_stepped(before), _stepped(after), *difference(before.root, after.root, smaller)))
        self._forget()
        entries = self._done.entries  # none in a replay that keeps no step
        oldest = entries[0].whole if entries else None
        if oldest is not None or not entries:
            self._old.step((after if oldest is None else oldest.before).root)

    def undo(self) -> Painting:
        """Returns the painting before the last step; IndexError if there is none."""
        return self._cross(self._done, self._undone).before

    def redo(self) -> Painting:
        """Returns the painting after the step undone last; IndexError if there is none."""
        return self._cross(self._undone, self._done).after

    def _cross(self, one: StepLine, other: StepLine) -> Undoable:
        """Takes the nearest step from one side of the present to the other."""
        step = counted(one.pop())  # some of its records may be coded, and those of both ends were since it was pushed
        other.push(step)
        if self.tight:
            _make_thin(self._lines, 1)
        left, self._root = step.after.root, step.before.root
        if other is self._done:
            left, self._root = self._root, left
        # What else the present holds it held before.
        self._mixed.extend((key, record) for key, record, _ in apart_records(self._root, left))
        self._grown.extend(tile for tile in apart_tiles(self._root, left) if not isinstance(tile.held, np.ndarray))
        return step

    def at(self, by: int) -> Painting | None:
        """Returns the painting so many steps on, or back if that is negative; None where that is not held, or is 0."""
        if 0 < -by <= len(self._done):
            step = self._done.entries[by].whole
            return None if step is None else step.before
        step = self._undone.entries[-by].whole if 0 < by <= len(self._undone) else None
        return None if step is None else step.after

    def amend(self, root: Group) -> None:
        """The layers as they are now, further refined, are `root`."""
        self._root = root
        if self._done:
            step = self._done.pop()
            after = replace(step.after, root=root)
            self._done.push(Undoable(step.before, after, *difference(step.before.root, root)))
        if self._undone:
            step = self._undone.pop()
            before = replace(step.before, root=root)
            self._undone.push(Undoable(before, step.after, *difference(root, step.after.root)))

    @property
    def pending(self) -> int:
        """Counts the steps to be coded, or put away on disk, and whether the present is to be looked through, while
        nothing else is to be done."""
        coding = sum(max(0, line.plain - self._at_hand) for line in self._lines)
        full = self.tight or sum(line.beyond for line in self._lines) > 0.75 * self._limit
        crowded = full and any(line.in_memory or is_thickset(line) for line in self._lines)
        return coding + int(len(self._mixed) + len(self._grown) > 0) + int(crowded)

    @property
    def _at_hand(self) -> int:
        """Counts the steps nearest to the present that are not to be coded."""
        return _AT_HAND if self.held <= self._limit / 4 and not self.tight else 0

    def step(self) -> None:
        """Makes a record of the present that is made of others plain, or codes some records of a step, or puts a step
        away on disk: a piece of work of some milliseconds."""
        while self._mixed:
            key, record = self._mixed.popleft()
            if _in_the_way(record, self.tight) and _has(self._root, key, record):
                decode(record)
                return
        while self._grown:
            tile = self._grown.popleft()
            if not self.tight and _shows(self._root, tile):
                decode_tile(tile)
                return
        if self.tight and any(map(is_thickset, self._lines)):
            _make_thin(self._lines, 1)
            return
        line = max(self._lines, key=lambda line: line.plain)
        coded = max(self._lines, key=lambda line: line.in_memory)
        if line.plain > self._at_hand:
            line.code(_AT_ONCE)
        elif coded.in_memory:
            coded.put_away()
        else:
            _make_thin(self._lines, 1)

    def _forget(self) -> None:
        """Codes as much again as the newest step brought where nobody rested for long, so that each costs the same, and
        all that is needed beyond the limit; then puts the oldest steps away on disk, or drops them, never for the sake
        of the newest alone.  Steps that were crossed since are many, and wait for their turn."""
        done, cap, limit = self._done, self._bytes_cap, self._limit
        while cap == 0 and len(done) > self._keep:  # a replay's: nobody goes back to them, so nobody codes them
            done.forget()
            self.forgotten += 1
        if self.tight and self.held > limit / _TIGHT_PART:
            done.press(_SHARE * done.entries[-1].held + _TIGHT_AT_ONCE, _TIGHT_STEPS)
        elif done.plain and self.held > limit / 2:
            done.code(max(_SHARE * done.entries[-1].held, _AT_ONCE))
        if self.tight:
            _make_thin(self._lines, _MADE_THIN)
        while done.plain and self.held > limit:
            done.code()
        while cap and done.in_memory and done.beyond > cap:
            done.put_away()
        while cap and is_thickset(done) and done.beyond > cap:
            make_thin(done)
        while cap and len(done) > self._keep and done.beyond > cap:
            done.forget()
            self.forgotten += 1


def _make_thin(lines: Iterable[StepLine], count: int) -> None:
    """Makes so many steps of each line thin, as far as there are any."""
    for line in lines:
        for _ in range(count):
            if is_thickset(line):
                make_thin(line)


def _stepped(painting: Painting) -> Painting:
    """Returns what a step keeps of a painting: nothing beside the steps, or the pictures of textures would be held for
    as long as it is."""
    return painting.beside(_NOTHING)


def _smaller(ways: Ways | None, record: Record | None, other: Record) -> None:
    """Makes a record that was just stored smaller, where a generator laid something there; and the one whose place it
    took by it, where there are `ways`."""
    pack_laid(other, record)
    if ways is not None and record is not None:
        lessen(ways, record, other)


def _has(root: Group | None, key: TileKey, record: Record) -> bool:
    """Tells whether a state of the layers has a record."""
    return root is not None and any(pyramid.holds(key, record) for pyramid in pyramids(root).values())


def _shows(root: Group | None, tile: TilePlanes) -> bool:
    """Tells whether what was painted with examples in a state of the layers has a tile."""
    return root is not None and any(tile in growths.tiles_of(layer.growth) for layer in layers.layers(root))


def _let_go(mixed: deque[tuple[TileKey, Record]], root: Group | None, tight: bool) -> None:
    """Takes out some of the records that wait to be made plain and left the layers `root` meanwhile: where nobody
    rests, they would stay for ever."""
    for _ in range(min(len(mixed), _LOOKED_AT)):
        key, record = mixed.popleft()
        if _in_the_way(record, tight) and _has(root, key, record):
            mixed.append((key, record))


def _in_the_way(record: Record, tight: bool) -> bool:
    """Tells whether a record of the present is to be made plain: what is coded by itself only where there is room."""
    alone = isinstance(record.held, CodedData) and record.held.other is None
    return not (tight or stays_packed(record)) if alone else isinstance(record.held, CodedData)
