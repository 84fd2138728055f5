"""The steps on one side of the present, of which those far from it are made smaller, piece by piece."""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field, replace
from itertools import takewhile

from engine.canvas.layers import Group
from engine.canvas.store import Record
from engine.painting.value import Painting
from engine.session.coding.coded_records import CodedData, Ways, decode, leads_to, put_away
from engine.session.coding.coded_tiles import CodedTile, encode_tile
from engine.session.coding.thin_steps import ThinStep, thin_step
from engine.session.differing import apart_records, apart_tiles, difference
from engine.session.held_pyramids import changed_nodes, pyramids_of, related
from engine.texture.example.tiles import TilePlanes

KEPT_WHOLE = 64  # steps that are never made thin: each holds the pages that it changed as they were
_PRESSED = 12  # steps that are coded at once, where the newest asks for room
STEP_OVERHEAD = 6000  # bytes of a step's own objects, roughly: most are nodes of the maps of some ten levels


@dataclass(frozen=True, eq=False, slots=True)
class Undoable:
    """`lost`, `gained`: bytes held only by the painting before, and only by the one after, as counted last."""

    before: Painting
    after: Painting
    lost: int
    gained: int


@dataclass(eq=False, slots=True)
class StepEntry:
    """A step in a line; `held`: bytes that its far end alone takes now; `coded`: whether these are coded; `records`:
    what is coded of it and lies in memory; `thin`: what it is made of again where it is not there as a whole."""

    whole: Undoable | None
    held: int
    coded: bool = False
    records: list[Record | TilePlanes] = field(default_factory=list)
    thin: ThinStep | None = None

    @property
    def step(self) -> Undoable:
        """Gives the step, which is there."""
        assert self.whole is not None
        return self.whole


class StepLine:
    """The steps on one side of the present, the farthest first.  Of each, the far end is the painting that it leads to
    from the present; what that alone holds is coded, and put away on disk, from the farthest step on.  Those far away
    are made thin where there is little room: they are known by what they changed until they are near again.

    `undone`: they are those undone; `ways`: how their records are made of one another.
    """

    def __init__(self, undone: bool, steps: Iterable[Undoable]) -> None:
        self._undone, self.ways = undone, Ways()
        self.entries = deque(StepEntry(step, _alone(step, self._undone)) for step in steps)
        self.held = sum(entry.held for entry in self.entries)
        self._coded = self._away = 0  # of them
        self._thin = 0  # of them, and those that cannot be made thin
        self._begun: Iterator[int] | None = None  # what is still to be coded of the next one

    def __len__(self) -> int:
        return len(self.entries)

    @property
    def steps(self) -> tuple[Undoable, ...]:
        """Gives the steps that are there as a whole, as values: from the nearest to the present on, up to one that is
        not."""
        near = takewhile(lambda step: step is not None, (entry.whole for entry in reversed(self.entries)))
        return tuple(step for step in near if step is not None)[::-1]

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

    def push(self, step: Undoable) -> None:
        """Adds the nearest step, whose bytes were just counted."""
        self.entries.append(StepEntry(step, _alone(step, self._undone)))
        self.held += self.entries[-1].held

    def pop(self) -> Undoable:
        """Takes away the nearest step, as it is; IndexError if there is none."""
        entry = self.entries.pop()
        self.held -= entry.held
        if entry.coded or (self._begun is not None and len(self.entries) == self._coded):
            self._coded -= entry.coded
            self._away = min(self._away, self._coded)
            self._begun = None
            self.ways.forget()
        self._thin = min(self._thin, max(len(self.entries) - 1, 0))
        if self.entries and self.entries[-1].thin is not None:
            _thicken(self, self.entries[-1], _ends(entry.step, self._undone)[0])
        return entry.step

    def forget(self) -> None:
        """Forgets the farthest step."""
        entry = self.entries.popleft()
        self.held -= entry.held
        if not entry.coded:
            self._begun = None
        self._coded -= entry.coded
        self._away -= min(self._away, 1)
        self._thin -= min(self._thin, 1)

    def clear(self) -> None:
        """Forgets all steps."""
        self.entries.clear()
        self._begun = None
        self.ways.forget()
        self.held = self._coded = self._away = self._thin = 0

    def code(self, size: float = math.inf) -> float:
        """Codes the farthest step that is not coded yet: so many bytes of its data, or all that is left of them.
        Returns how many bytes fewer it was, 0 or less for none."""
        entry = self.entries[self._coded]
        if self._begun is None:
            self._begun = self._pieces(entry)
        for done in self._begun:
            size -= done
            if size <= 0.0:
                return size
        self._begun = None
        self._take(entry, counted(entry.step))
        entry.coded = True
        self._coded += 1
        return size

    def put_away(self) -> None:
        """Puts what the farthest coded step in memory holds away on disk, as far as there is room."""
        entry = self.entries[self._away]
        coded = (record.held for record in entry.records)
        saved = sum(put_away(held, spare=True) for held in coded if isinstance(held, CodedData | CodedTile))
        entry.records.clear()
        self._take(entry, _saving(entry.step, saved, self._undone))
        self._away += 1

    def _take(self, entry: StepEntry, step: Undoable) -> None:
        """Has an entry hold its step with what that takes now."""
        held = _alone(step, self._undone)
        self.held += held - entry.held
        entry.whole, entry.held = step, held

    def press(self, size: float, count: int) -> None:
        """Codes so many bytes of the farthest steps, of `_PRESSED` of them at most, as thousands may hold next to
        nothing; and puts so many steps away on disk."""
        for _ in range(min(self.plain, _PRESSED)):
            if size > 0.0:
                size = self.code(size)
        for _ in range(min(count, self.in_memory)):
            self.put_away()

    def _pieces(self, entry: StepEntry) -> Iterator[int]:
        """Codes one record, or tile of an example, of a step's far end after the other; yields the bytes of
        data that were looked at."""
        far, near = _ends(entry.step, self._undone)
        entry.records.clear()
        apart = pyramids_of(changed_nodes(far, near)[0]).values()
        elsewhere = related(near, {pyramid.family for pyramid in apart})
        for key, record, other in apart_records(far, near):
            if not any(pyramid.holds(key, record) for pyramid in elsewhere):  # a copy of a layer shares its records
                size = record.held.nbytes
                saved = self.ways.encode(record, _ready(record, other, self._undone))
                self._take(entry, _saving(entry.step, saved, self._undone))
                entry.records.append(record)
                yield size
        for tile in apart_tiles(far, near):
            size = tile.nbytes
            self._take(entry, _saving(entry.step, encode_tile(tile), self._undone))
            entry.records.append(tile)
            yield size


def is_thickset(line: StepLine) -> bool:
    """Tells whether a step could still be made thin: it is far from the present."""
    return len(line.entries) - line._thin > KEPT_WHOLE


def make_thin(line: StepLine) -> None:
    """Makes the farthest step thin that could be, if it changed the paint of one layer alone; else it is coded, and put
    away on disk."""
    number = line._thin
    if number == line._coded and not line._undone:
        line.code()  # by what is nearer, as far as may be; of undone steps what is nearer is made of what is farther
    entry, nearer = line.entries[number], line.entries[number + 1]
    (far, near), reached = _paintings(entry.step, line._undone), _ends(nearer.step, line._undone)[0]
    made = thin_step(far, near) if reached is near.root else None
    if number == line._coded:
        if made is None:
            line.code()
        else:
            line._begun, line._coded, entry.coded = None, number + 1, True
    line._thin += 1
    if made is None:
        if number == line._away:
            line.put_away()
        return
    line._away = max(line._away, number + 1)
    line.held += made.nbytes - entry.held
    entry.whole, entry.thin, entry.held = None, made, made.nbytes
    entry.records.clear()


def _thicken(line: StepLine, entry: StepEntry, root: Group) -> None:
    """Makes a thin step whole again, `root` the layers at its near end.  OSError if it cannot be read."""
    assert entry.thin is not None
    ends = entry.thin.ends(root)
    step = counted(Undoable(*(ends[::-1] if line._undone else ends), 0, 0))
    entry.thin = None
    line._take(entry, step)


def _ready(record: Record, other: Record | None, undone: bool) -> Record | None:
    """Returns the record by which one of a far end is coded, the one in its place; of the steps that are done, which
    are forgotten one by one, never one that is made of what is farther: that is made plain."""
    if not undone and other is not None:
        if isinstance(record.held, CodedData) and record.held.other not in (None, other):
            decode(record)
        if leads_to(other, record):
            decode(other)
    return other


def _ends(step: Undoable, undone: bool) -> tuple[Group, Group]:
    """Returns the layers at the far end of a step, and at the near one."""
    far, near = _paintings(step, undone)
    return far.root, near.root


def _paintings(step: Undoable, undone: bool) -> tuple[Painting, Painting]:
    """Returns the far end of a step, and the near one."""
    return (step.after, step.before) if undone else (step.before, step.after)


def _alone(step: Undoable, undone: bool) -> int:
    """Returns the bytes that the far end of a step alone takes, as counted last."""
    return (step.gained if undone else step.lost) + STEP_OVERHEAD


def counted(step: Undoable) -> Undoable:
    """Returns a step with the bytes that its ends take now."""
    lost, gained = difference(step.before.root, step.after.root)
    return replace(step, lost=lost, gained=gained)


def _saving(step: Undoable, saved: int, undone: bool) -> Undoable:
    """Returns a step whose far end takes so many bytes less."""
    return replace(step, gained=step.gained - saved) if undone else replace(step, lost=step.lost - saved)
