"""What a journal tells: the commands that were carried out, and what was asked for that nobody answered.

Whatever is torn, damaged or not understood ends the story there; what came before it is whole.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from itertools import pairwise
from pathlib import Path
from typing import NamedTuple

import numpy as np

from engine.brush.checks import frozen
from engine.brush.settings import Brush
from engine.checks.field_error import FieldError
from engine.files.strict_json import Fields
from engine.journal import records
from engine.journal.frames import Frame, frames_in
from engine.journal.records import ASKED, NUMBER, Kind, Members, Touch
from engine.painting.commands import COUNT_LIMIT, SEED_LIMIT, Command, Stroke
from engine.painting.pen_points import fitted
from engine.painting.points import ALWAYS, POINT_COLUMNS, like_first, rounded

JOURNAL = "journal-"
_NAMED = re.compile(JOURNAL + "[0-9]{1,9}")
STROKE, COMMAND = b"s", b"c"  # how DONE goes on: of a stroke's own points, or with a command
_MARK = records.LENGTH.size
_OFTEN = 256  # frames from one check to the next
_NO_POINTS = np.empty((0, 6))


class Checkpoint(NamedTuple):
    """The painting after `commands` commands lies in `checkpoint-{0,1}.ora`, by the parity of `generation`; `size` and
    `crc` (CRC-32) are its file's.  `copied`: the layer in it that holds what was copied last, None for none."""

    generation: int
    commands: int
    size: int
    crc: int
    copied: str | None = None


@dataclass(eq=False, slots=True)
class Unanswered:
    """A stroke or a command that was asked for.  `points`: of the stroke, as the pen told them, float64 (n, 6) each;
    `taken`: how many of them, once they are fitted, are strokes already."""

    number: int
    clock: float
    touch: Touch | None = None
    command: Command | None = None
    points: list[np.ndarray] = field(default_factory=list)
    taken: int = 0
    finished: bool = False

    def fitted(self) -> np.ndarray:
        """Returns the points as the engine takes them, float64 (n, 6)."""
        return fitted(rounded(like_first(self.points)))[0] if self.points else _NO_POINTS


@dataclass(eq=False, slots=True)
class Story:
    """`head`: what the painting began with; `base`: what was kept of the file it was opened from; `commands`: carried
    out, in order; `asked`: unanswered, by their numbers, in order; `saved`: how many commands its file holds;
    `faults`: what is missing, a line each; `last`: number of the last whole frame; `files`: how many there are."""

    head: Members = field(default_factory=dict)
    base: Members | None = None
    commands: list[Command] = field(default_factory=list)
    asked: dict[int, Unanswered] = field(default_factory=dict)
    checkpoints: list[Checkpoint] = field(default_factory=list)
    saved: Members | None = None
    faults: list[str] = field(default_factory=list)
    last: int = -1
    files: int = 0


class _Reader:
    """Goes through the frames of a journal once."""

    def __init__(self) -> None:
        self.story = Story()
        self._brushes: dict[bytes, Brush] = {}
        self._answered: dict[int, Unanswered] = {}  # strokes that are in parts
        self.take = {
            Kind.HEAD: self._head,
            Kind.BEGIN: self._begin,
            Kind.POINTS: self._points,
            Kind.TURNED: lambda payload: self._points(payload, len(POINT_COLUMNS)),
            Kind.FINISH: self._finish,
            Kind.ABANDON: self._settle,
            Kind.ASK: self._ask,
            Kind.DONE: self._done,
            Kind.REFUSED: self._settle,
            Kind.DID: lambda payload: self.story.commands.append(records.read_command(payload)),
            Kind.CHECKPOINT: self._checkpoint,
            Kind.SAVED: self._saved,
            Kind.BASE: self._base,
        }

    def _head(self, payload: bytes) -> None:
        if not self.story.head:
            self.story.head = records.read_object(payload)

    def _begin(self, payload: bytes) -> None:
        number, clock = ASKED.unpack_from(payload)
        touch = records.read_touch(payload[ASKED.size :], self._brushes)
        self.story.asked[number] = Unanswered(number, clock, touch)

    def _points(self, payload: bytes, columns: int = ALWAYS) -> None:
        asked = self.story.asked.get(NUMBER.unpack_from(payload)[0])
        if asked is not None:
            asked.points.append(records.read_points(payload[NUMBER.size :], columns))

    def _finish(self, payload: bytes) -> None:
        asked = self.story.asked.get(NUMBER.unpack_from(payload)[0])
        if asked is not None:
            asked.finished = True

    def _settle(self, payload: bytes) -> None:
        self.story.asked.pop(NUMBER.unpack_from(payload)[0], None)

    def _ask(self, payload: bytes) -> None:
        number, clock = ASKED.unpack_from(payload)
        self.story.asked[number] = Unanswered(number, clock, command=records.read_command(payload[ASKED.size :]))

    def _done(self, payload: bytes) -> None:
        number, how = NUMBER.unpack_from(payload)[0], payload[NUMBER.size : NUMBER.size + 1]
        rest = payload[NUMBER.size + 1 :]
        if how == COMMAND:
            self.story.commands.append(records.read_command(rest))
            self.story.asked.pop(number, None)
            return
        asked = self.story.asked.get(number)
        if asked is None or asked.touch is None:
            raise FieldError("record", f"stroke {number} done", "one that was asked for")
        members = Fields(records.read_object(rest), "stroke")
        count, last = members.integer("count", lo=1, hi=COUNT_LIMIT), members.flag("last")
        points = asked.fitted()[asked.taken : asked.taken + count]
        if len(points) != count:
            raise FieldError("record", f"stroke {number} with {len(points)} points", f"{count}")
        layer = None if members.take("layer", None) is None else members.text("layer")
        seed = None if members.take("seed", None) is None else members.integer("seed", lo=-SEED_LIMIT, hi=SEED_LIMIT)
        touch, extra = asked.touch, frozen(members.take("extra", {}))
        points.flags.writeable = False
        self.story.commands.append(
            Stroke(
                touch.level, touch.origin, points, touch.brush, layer, seed, extra, touch.copies, touch.onto, touch.seen
            )
        )
        asked.taken += count
        if last:
            self.story.asked.pop(number)

    def _checkpoint(self, payload: bytes) -> None:
        members = Fields(records.read_object(payload), "checkpoint")
        names = ("generation", "commands", "size", "crc")
        generation, commands, size, crc = (members.integer(name, lo=0, hi=1 << 60) for name in names)
        copied = members.text("copied", None)
        self.story.checkpoints.append(Checkpoint(generation, commands, size, crc, copied))

    def _saved(self, payload: bytes) -> None:
        self.story.saved = records.read_object(payload)

    def _base(self, payload: bytes) -> None:
        self.story.base = records.read_object(payload)


def read_story(folder: Path, check: Callable[[], object] = lambda: None) -> Story:
    """Returns what the journal in an entry's folder tells, as far as it is whole.  It never fails, but for what `check`
    raises, which is called now and then."""
    reader = _Reader()
    story = reader.story
    for frame in _frames(folder, story):
        if not frame.sequence % _OFTEN:
            check()
        try:
            reader.take[Kind(frame.kind)](frame.payload)
        except Exception as error:  # its check sum is right: another version wrote it
            story.faults.append(f"a record that cannot be read ({error}), and all after it")
            break
        story.last = frame.sequence
    return story


def _frames(folder: Path, story: Story) -> Iterator[Frame]:
    """Yields the frames of all files of a journal in order, and tells in the story what is missing."""
    held: list[Frame] = []
    for path in journal_files(folder):
        story.files += 1
        try:
            data = path.read_bytes()
        except OSError as error:
            story.faults.append(f"{path.name}: {error.strerror or error}")
            break
        frames, good = frames_in(data)
        if not frames or frames[0].kind != Kind.HEAD:
            story.faults.append(f"{path.name}: its beginning is damaged")
            continue
        after = _after(frames[0])
        if (held[-1].sequence if held else -1) < after:
            story.faults.append(f"what was done before {path.name}, and all after it")
            break
        held = [frame for frame in held if frame.sequence <= after]
        story.faults.clear()  # what is damaged behind it was written again
        held += frames
        if good < len(data):
            story.faults.append(f"{path.name}: the last {len(data) - good} bytes, which are damaged or incomplete")
    yield from held


def _after(head: Frame) -> int:
    """Returns the number of the frame that a file goes on after."""
    try:
        found = records.read_object(head.payload).get("after")
    except FieldError:
        found = None
    return found if type(found) is int else 1 << 62


def journal_files(folder: Path) -> list[Path]:
    """Returns the files of a journal in order; none if the folder cannot be read."""
    try:
        names = [path for path in folder.iterdir() if _NAMED.fullmatch(path.name)]
    except OSError:
        return []
    return sorted(names, key=lambda path: int(path.name.rpartition("-")[2]))


class Glance(NamedTuple):
    """What a list tells of a journal, found without reading its commands.  `first`, `last`: when, by the clock (0:
    unknown); `seconds`: that were spent painting; `holds`: whether there is anything that its own file does not
    hold."""

    head: Members
    strokes: int = 0
    seconds: float = 0.0
    last: float = 0.0
    holds: bool = False
    faults: tuple[str, ...] = ()


PAUSE = 60.0  # seconds between two strokes after which the artist was away
_VIEW, _STROKE = b'{"do":"view"', b'{"do":"stroke"'


def glance(folder: Path) -> Glance:
    """Returns what a list tells of the journal in an entry's folder.  It never fails."""
    story, clocks, asked = Story(), list[float](), dict[int, bytes]()
    strokes = done = held = 0
    for frame in _frames(folder, story):
        payload = frame.payload
        try:
            match frame.kind:
                case Kind.HEAD if not story.head:
                    story.head = records.read_object(payload)
                    clock = story.head.get("clock")
                    clocks += [float(clock)] if isinstance(clock, int | float) else []
                case Kind.BEGIN | Kind.ASK:
                    number, clock = ASKED.unpack_from(payload)
                    clocks.append(clock)
                    asked[number] = _STROKE if frame.kind == Kind.BEGIN else payload[ASKED.size + _MARK :][:16]
                case Kind.ABANDON | Kind.REFUSED:
                    asked.pop(NUMBER.unpack_from(payload)[0], None)
                case Kind.DONE | Kind.DID:
                    what = _what(frame)
                    done, strokes = done + 1, strokes + what.startswith(_STROKE)
                    held = held if what.startswith(_VIEW) else done
                    if frame.kind == Kind.DONE and not what.endswith(b"more"):
                        asked.pop(NUMBER.unpack_from(payload)[0], None)
                case Kind.SAVED:
                    story.saved = records.read_object(payload)
        except Exception as error:
            story.faults.append(f"a record that cannot be read ({error}), and all after it")
            break
    stays = [what for what in asked.values() if not what.startswith(_VIEW)]
    saved = story.saved.get("commands", 0) if story.saved is not None else -1 if story.head.get("unsaved") else 0
    return Glance(
        story.head,
        strokes + sum(what.startswith(_STROKE) for what in stays),
        spent(clocks) + (float(before) if isinstance(before := story.head.get("seconds"), int | float) else 0.0),
        max(clocks, default=0.0),
        bool(stays) or (type(saved) is int and held > saved),
        tuple(story.faults),
    )


def spent(clocks: Sequence[float]) -> float:
    """Returns the seconds that were spent painting, by when things were asked for."""
    return sum(min(max(b - a, 0.0), PAUSE) for a, b in pairwise(clocks))


def _what(frame: Frame) -> bytes:
    """Returns the beginning of the command that a record tells of, which ends with "more" where the stroke goes on."""
    if frame.kind == Kind.DID:
        return frame.payload[_MARK:][:16]
    if frame.payload[NUMBER.size : NUMBER.size + 1] == COMMAND:
        return frame.payload[NUMBER.size + 1 + _MARK :][:16]
    members = records.read_object(frame.payload[NUMBER.size + 1 :])
    return _STROKE if members.get("last") else _STROKE + b"more"
