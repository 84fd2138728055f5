"""Undo and redo: paintings as they were, without a limit of steps, bounded by the bytes that only they hold.

A step keeps two paintings, before and after, which share all tiles that it did not change.  What the one before holds
alone counts while the step is done (undo would bring it back), what the one after holds alone while it is undone.
Of steps far from the present it is coded: what differs from the next painting towards the present, compressed; and
where all take too much, put away on disk.  Their paintings stay what they are, values whose data are made when somebody
looks at them: so going to any of them takes no longer than going to the next, and what is coded there by other steps is
made plain while nothing else is to be done.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from typing import NamedTuple

from engine.canvas import growth as growths
from engine.canvas import layers
from engine.canvas.growth import Growth
from engine.canvas.layers import Group
from engine.canvas.store import RECORD_OVERHEAD, Pyramid, Record, changed_rects
from engine.checks.owned import Owned
from engine.numeric.address import TileKey
from engine.painting.value import Painting
from engine.session.coded_records import CodedData, Ways, decode, leads_to, put_away
from engine.texture.sparse_planes import SparsePlanes

_AROUND = 4  # pixels around a change whose residuals it also rewrites: those under the expanded parents
STEP_OVERHEAD = 2000  # bytes of a step's own objects, roughly
_AT_HAND = 16  # steps nearest to the present that are not coded while there is room
_IN_PASSING = 4  # steps coded at a time while they take much
_Only = tuple[TileKey, Record, Record | None]  # a record of one state, and what another has in its place


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


@dataclass(eq=False, slots=True)
class _Entry:
    """A step in a line; `held`: bytes that its far end alone takes now; `coded`: whether these are coded."""

    step: Undoable
    held: int
    coded: bool = False


class _Line:
    """The steps on one side of the present, the farthest first.  Of each, the far end is the painting that it leads to
    from the present; what that alone holds is coded, and put away on disk, from the farthest step on.

    `undone`: they are those undone.
    """

    def __init__(self, undone: bool, steps: Iterable[Undoable]) -> None:
        self._undone, self._ways = undone, Ways()
        self.entries = deque(_Entry(step, self._alone(step)) for step in steps)
        self.held = sum(entry.held for entry in self.entries)
        self._coded = self._away = 0  # of them

    def __len__(self) -> int:
        return len(self.entries)

    @property
    def steps(self) -> tuple[Undoable, ...]:
        """Gives the steps, as values."""
        return tuple(entry.step for entry in self.entries)

    @property
    def plain(self) -> int:
        """Counts the steps that could still be coded: never the nearest to the present, beside which it is made."""
        return max(0, len(self.entries) - 1 - self._coded)

    @property
    def in_memory(self) -> int:
        """Counts the coded steps that could still be put away on disk."""
        return self._coded - self._away

    @property
    def beyond(self) -> int:
        """Returns the bytes that the steps beyond the nearest hold."""
        return self.held - self.entries[-1].held if self.entries else 0

    def push(self, step: Undoable, part: float = 1.0) -> None:
        """Adds the nearest step; `part`: of its bytes, that it takes, as far as that is known before it is coded."""
        self.entries.append(_Entry(step, STEP_OVERHEAD + int(part * (self._alone(step) - STEP_OVERHEAD))))
        self.held += self.entries[-1].held

    def pop(self) -> tuple[Undoable, float]:
        """Takes away the nearest step, as it is, and tells which part of its bytes it takes; IndexError if there is
        none."""
        entry = self.entries.pop()
        self.held -= entry.held
        if not entry.coded:
            return entry.step, 1.0
        self._coded -= 1
        self._away = min(self._away, self._coded)
        self._ways.forget()
        return entry.step, (entry.held - STEP_OVERHEAD) / max(self._alone(entry.step) - STEP_OVERHEAD, 1)

    def forget(self) -> None:
        """Forgets the farthest step."""
        entry = self.entries.popleft()
        self.held -= entry.held
        self._coded -= entry.coded
        self._away -= min(self._away, 1)

    def clear(self) -> None:
        """Forgets all steps."""
        self.entries.clear()
        self._ways.forget()
        self.held = self._coded = self._away = 0

    def code(self) -> None:
        """Codes the farthest step that is not coded yet."""
        entry = self.entries[self._coded]
        far, near = self._ends(entry.step)
        elsewhere = [layer.pyramid for layer in layers.layers(near)]
        for key, record, other in _changed(far, near):
            if not any(_holds(pyramid, key, record) for pyramid in elsewhere):  # a copy of a layer shares its records
                self._code(record, other)
        lost, gained = difference(entry.step.before.root, entry.step.after.root)
        held = (gained if self._undone else lost) + STEP_OVERHEAD
        self.held += held - entry.held
        entry.held, entry.coded = held, True
        self._coded += 1

    def put_away(self) -> None:
        """Puts what the farthest coded step in memory holds away on disk, as far as there is room."""
        entry = self.entries[self._away]
        coded = (record.held for _, record, _ in _changed(*self._ends(entry.step)))
        saved = sum(put_away(held) for held in coded if isinstance(held, CodedData))
        entry.held -= saved
        self.held -= saved
        self._away += 1

    def _code(self, record: Record, other: Record | None) -> None:
        """Codes a record of a far end by the one in its place; of the steps that are done, which are forgotten one by
        one, never by one that is farther."""
        if not self._undone and other is not None:
            if isinstance(record.held, CodedData) and record.held.other not in (None, other):
                decode(record)
            if leads_to(other, record):
                decode(other)
        self._ways.encode(record, other)

    def _ends(self, step: Undoable) -> tuple[Group, Group]:
        """Returns the layers at the far end, and at the near one."""
        ends = step.before.root, step.after.root
        return ends[::-1] if self._undone else ends

    def _alone(self, step: Undoable) -> int:
        return (step.gained if self._undone else step.lost) + STEP_OVERHEAD


class History(Owned):
    """The steps done and the steps undone.  It belongs to the thread that made it.

    `bytes_cap`: None for no limit, 0 for no step beside those of `keep`, which are never forgotten; `steps`: those that
    are there already.  Steps beyond the newest are coded while nothing else is to be done (`pending`, `step`), and at
    once where they take a quarter of the limit; beyond it they go to disk, and are forgotten only where that has no
    room.  `forgotten`: steps that were done and are not there any more.
    """

    def __init__(self, bytes_cap: int | None = None, keep: int = 1, steps: HeldSteps = HeldSteps()) -> None:  # noqa: B008
        self._done, self._undone = _Line(False, steps.done), _Line(True, steps.undone)
        self._bytes_cap, self._keep = bytes_cap, keep
        self._mixed: Iterator[Record] | None = None  # records of the present of which some are coded
        self.forgotten = 0

    @property
    def held(self) -> int:
        """Returns bytes that only steps hold."""
        return self._done.held + self._undone.held

    @property
    def steps(self) -> HeldSteps:
        """Gives all steps, as values."""
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
        if self._mixed is not None:  # what is coded by records that are forgotten now would keep them
            for record in _lost(before.root, after.root):
                decode(record)
        self._done.push(Undoable(before, after, *difference(before.root, after.root)))
        self._forget()

    def undo(self) -> Painting:
        """Returns the painting before the last step; IndexError if there is none."""
        return self._cross(self._done, self._undone).before

    def redo(self) -> Painting:
        """Returns the painting after the step undone last; IndexError if there is none."""
        return self._cross(self._undone, self._done).after

    def _cross(self, one: _Line, other: _Line) -> Undoable:
        """Takes the nearest step from one side of the present to the other."""
        step, part = one.pop()
        other.push(step, part)
        self._mixed = _records((step.before if other is self._undone else step.after).root)
        return step

    def at(self, by: int) -> Painting | None:
        """Returns the painting so many steps on, or back if that is negative; None where that is not held, or is 0."""
        if 0 < -by <= len(self._done):
            return self._done.entries[by].step.before
        return self._undone.entries[-by].step.after if 0 < by <= len(self._undone) else None

    def amend(self, root: Group) -> None:
        """The layers as they are now, further refined, are `root`."""
        if self._done:
            step, _ = self._done.pop()
            after = replace(step.after, root=root)
            self._done.push(Undoable(step.before, after, *difference(step.before.root, root)))
        if self._undone:
            step, _ = self._undone.pop()
            before = replace(step.before, root=root)
            self._undone.push(Undoable(before, step.after, *difference(root, step.after.root)))

    @property
    def pending(self) -> int:
        """Counts the steps to be coded, and whether the present is to be looked through, while nothing else is to be
        done."""
        coding = sum(max(0, line.plain - _AT_HAND) for line in (self._done, self._undone))
        return coding + int(self._mixed is not None)

    def step(self) -> None:
        """Makes a record of the present that is made of others plain, or codes a step."""
        if self._mixed is None:
            max(self._done, self._undone, key=lambda line: line.plain).code()
            return
        # What is coded by itself may be so because there is no room for more (`Paging`), and holds nothing else.
        record = next((record for record in self._mixed if _made_of_others(record)), None)
        if record is None:
            self._mixed = None
        else:
            decode(record)

    def _make_room(self) -> None:
        """Codes steps while all take too much; those that were crossed since are many, and wait for their turn."""
        if self._bytes_cap is not None:
            for line in (self._done, self._undone):
                coded = 0
                while line.plain and self.held > self._bytes_cap // (4 if coded < _IN_PASSING else 1):
                    line.code()
                    coded += 1

    def _forget(self) -> None:
        """Puts the oldest steps beyond the limit away on disk, or drops them; never for the sake of the newest alone,
        which is not coded yet."""
        done, cap = self._done, self._bytes_cap
        while cap == 0 and len(done) > self._keep:  # a replay's: nobody goes back to them, so nobody codes them
            done.forget()
            self.forgotten += 1
        self._make_room()
        while cap and done.in_memory and done.beyond > cap:
            done.put_away()
        while cap and len(done) > self._keep and done.beyond > cap:
            done.forget()
            self.forgotten += 1


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
        lost += sum(_alone(record, beside) for _, record, beside in _only(a, b))
        gained += sum(_alone(record, beside) for _, record, beside in _only(b, a))
        lost, gained = lost + _waiting(a, b), gained + _waiting(b, a)
    return lost, gained


def _alone(record: Record, beside: Record | None) -> int:
    """Returns the bytes that a record does not share with the one in its place."""
    if beside is not None and isinstance(record.held, SparsePlanes) and isinstance(beside.held, SparsePlanes):
        return record.held.alone(beside.held) + RECORD_OVERHEAD
    return record.nbytes


def _waiting(one: Pyramid, other: Pyramid) -> int:
    """Returns the bytes of attenuations that wait in one state and not in another."""
    there = {id(waits) for waits in other.waiting()}
    return sum(waits.nbytes for waits in one.waiting() if id(waits) not in there)


def _regrown(old: Growth, new: Growth) -> tuple[int, int]:
    """Returns the same of what was painted on a layer with examples."""
    if old is new:
        return 0, 0
    before, after = growths.arrays(old), growths.arrays(new)
    return sum(n for k, n in before.items() if k not in after), sum(n for k, n in after.items() if k not in before)


def _changed(far: Group, near: Group) -> Iterator[_Only]:
    """Yields the records that one of two states of the layers has and the other has not, of layers that both have."""
    there = {layer.id: layer.pyramid for layer in layers.layers(near)}
    for layer in layers.layers(far):
        other = there.get(layer.id)
        if other is not None and other is not layer.pyramid and other.uid == layer.pyramid.uid:
            yield from _only(layer.pyramid, other)


def _lost(old: Group, new: Group) -> Iterator[Record]:
    """Yields the records that one state of the layers has and a later one has not."""
    there = {layer.id for layer in layers.layers(new)}
    for layer in layers.layers(old):
        if layer.id not in there:
            yield from (record for _, record in layer.pyramid.all_records())
    yield from (record for _, record, _ in _changed(old, new))


def _records(root: Group) -> Iterator[Record]:
    """Yields all records of a state of the layers."""
    for layer in layers.layers(root):
        for stored in layer.pyramid.levels.values():
            yield from stored.values()


def _made_of_others(record: Record) -> bool:
    return isinstance(record.held, CodedData) and record.held.other is not None


def _holds(pyramid: Pyramid, key: TileKey, record: Record) -> bool:
    stored = pyramid.levels.get(key.level)
    return stored is not None and stored.get((key.x, key.y)) is record


def _only(one: Pyramid, other: Pyramid) -> Iterator[_Only]:
    """Yields the records of one state that another of the same line of history does not share, and what that has in
    their places."""
    for level, stored in one.levels.items():
        there = other.levels.get(level)
        if there is stored:
            continue
        # Folded in between, records changed wherever a stroke had waited; and several commits met the same tiles.
        if one.settled != other.settled or len(rects := changed_rects(other, one, level)) > 1:
            places = ((TileKey(level, *place), record) for place, record in stored.items())
        else:
            places = (found for rect in rects for found in one.records(level, rect.grown(_AROUND)))
        for key, record in places:
            beside = there.get((key.x, key.y)) if there is not None else None
            if beside is not record:
                yield key, record, beside
