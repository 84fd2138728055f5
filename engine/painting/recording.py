"""Recordings: the commands of a painting as a text file, one JSON object a line (feature L10).

The first line is the header {"inkfall": V, "frame": [X, Y, W, H], "seed": S}; every other line is one command.
V is the oldest version of the format that knows all that the recording tells.
"""

from __future__ import annotations

import os
from abc import abstractmethod
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any, BinaryIO, TypeVar

from immutables import Map

from engine.brush.checks import thawed
from engine.brush.felt import feels
from engine.brush.settings import Brush
from engine.checks.field_error import FieldError
from engine.files.atomic import replacing
from engine.files.fault import FileError
from engine.files.strict_json import BYTES_CAP, Fields, dumps, loads
from engine.numeric.address import Rect
from engine.numeric.arithmetic import COARSE, EVERYWHERE, FINE, LIBRARY
from engine.painting.commands import (
    PLACE_LIMIT,
    SEED_LIMIT,
    Command,
    DefineTexture,
    Fill,
    Redo,
    Select,
    Stroke,
    Undo,
    parse,
    to_json,
)
from engine.painting.guiding.guides import GuideCommand
from engine.painting.layer_commands import LayerCommand
from engine.painting.layer_commands import version as layer_version
from engine.painting.layering.erode_command import Erode
from engine.painting.layering.frame_command import SetFrame
from engine.painting.layering.ground_command import LayGround, in_full
from engine.painting.layering.paper_command import SetPaper, read_colour
from engine.painting.layering.touch_command import TouchCommand
from engine.painting.places import BookmarkCommand
from engine.painting.points import ALWAYS
from engine.texture.example.parameters import SEAMLESS
from engine.texture.record import LEARNT

VERSION = 2  # that is read; older ones too
VERSION_OF_GRIDS = 2  # from which on the header tells the grid, and the paper
TOTAL_CAP = 2 << 30  # bytes of a recording
COMMANDS_CAP = 4_000_000
BLANK_CAP = 1_000_000  # blank lines
TELL_LINES, TELL_BYTES = 4096, 1 << 20  # from one word about how far it is to the next, at most
SIDE_LIMIT = 1 << 40
DEFAULT_FRAME = Rect(0, 0, 1024, 768)
BytesRead = Callable[[int], object] | None
_OF_VERSION_2 = SetFrame | SetPaper | Erode | LayGround | BookmarkCommand | Fill | Select | GuideCommand | TouchCommand
_BOM = b"\xef\xbb\xbf"
T = TypeVar("T")


@dataclass(frozen=True, slots=True)
class Header:
    """`frame`: level-0 pixels; `seed`: of every texture that is not given its own; `arithmetic`: in which pixels are
    worked out, `grid`: on which their values lie, both for as long as the painting lives; `paper`: the colour of the
    ground under all layers, None where there is none."""

    frame: Rect = DEFAULT_FRAME
    seed: int = 0
    extra: Map[str, Any] = field(default_factory=Map)
    arithmetic: int = LIBRARY
    grid: int = FINE
    paper: str | None = None

    def to_json(self, version: int = 1) -> dict[str, Any]:
        """Tells the header as the first line of a recording of `version` or later does; `parse_header` is the inverse.

        The arithmetic is that of the version, unless it says another one.  The grid is told where it is not the usual
        one, and where a member of that name, which says nothing in version 1, would be taken for it.
        """
        frame = [self.frame.x0, self.frame.y0, self.frame.width, self.frame.height]
        version = max(version, self.arithmetic, VERSION_OF_GRIDS if self.grid != FINE or self.paper is not None else 1)
        other: dict[str, object] = {"arithmetic": self.arithmetic} if self.arithmetic < version else {}
        if self.grid != FINE or (version >= VERSION_OF_GRIDS and "grid" in self.extra):
            other["grid"] = self.grid
        if self.paper is not None or (version >= VERSION_OF_GRIDS and "paper" in self.extra):
            other["paper"] = self.paper
        return {"inkfall": version, "frame": frame, "seed": self.seed, **thawed(self.extra), **other}


class ToldCommands(Sequence[Command]):
    """Commands of which some are kept as the lines of a recording that tell them.  `version`: of the format, the newest
    that one needs; 1 where there is none."""

    __slots__ = ()

    @property
    @abstractmethod
    def version(self) -> int:
        """Tells it."""

    @abstractmethod
    def lines(self) -> Iterator[str]:
        """Yields the lines, without their ends."""


@dataclass(frozen=True, slots=True)
class Recording:
    """Header and commands.  `places`: the line of each command in the file it came from, if it came from one;
    `folder`: what paths in it are relative to."""

    header: Header = field(default_factory=Header)
    commands: Sequence[Command] = ()
    places: tuple[int, ...] = ()
    folder: Path | None = None
    name: str = "recording"

    def fault(self, index: int, message: str) -> FileError:
        """Returns an error of command `index`, with the file and the line."""
        line = self.places[index] if index < len(self.places) else index + 2
        return FileError(self.name, f"line {line}: {message}")

    def until(self, count: int) -> Recording:
        """Returns the first `count` commands."""
        return replace(self, commands=self.commands[:count], places=self.places[:count])

    def lines(self) -> Iterator[str]:
        """Yields the file's lines, without their ends."""
        told = self.commands
        if isinstance(told, ToldCommands):
            version, lines = told.version, told.lines()
        else:
            version, lines = max(map(version_of, told), default=1), (dumps(to_json(command)) for command in told)
        yield dumps(self.header.to_json(version))
        yield from lines


_MAKERS_OF_2 = ("gradient", "expression", "learn")


def version_of(command: Command) -> int:
    """Returns the oldest version of the format that knows all members of a command."""
    steps = isinstance(command, DefineTexture) and any(
        name in command.arguments for name in ("region", "controls", "maps")
    )
    region = steps or (isinstance(command, DefineTexture) and command.maker in _MAKERS_OF_2)
    if isinstance(command, LayerCommand):
        return layer_version(command)
    newer = isinstance(command, Stroke) and (bool(command.copies) or bool(command.onto) or _lasts(command.brush))
    newer |= isinstance(command, Stroke) and command.seen is not None
    newer |= isinstance(command, Stroke) and (command.brush.height is not None or command.brush.impasto != 0.0)
    newer |= isinstance(command, Stroke) and (bool(command.brush.control) or command.brush.row.places)
    newer |= isinstance(command, Stroke) and (feels(command.brush) or command.points.shape[1] > ALWAYS)
    newer |= isinstance(command, DefineTexture) and _newer(command.arguments)
    return 2 if region or newer or isinstance(command, _OF_VERSION_2) else 1


def _lasts(brush: Brush) -> bool:
    """Tells whether any texture of a brush is one of version 2."""
    parts = (*brush.ink, brush.density, brush.grain, brush.tip)
    return any(part is not None and _newer(part.parameters) for part in parts)


def _newer(parameters: Mapping[str, object]) -> bool:
    """Tells whether parameters of a texture are of version 2."""
    found = parameters.get("renew") is False, parameters.get("turn"), parameters.get("profile")
    return any(found) or parameters.get("detail") == LEARNT or parameters.get("method") == SEAMLESS


def read(path: str | os.PathLike[str], most: int = COMMANDS_CAP) -> Recording:
    """Returns the recording in a file, of which only the first `most` commands are read; FileError names the line, the
    member, what was found and what was expected."""
    found, fault = read_torn(path, most)
    if fault is not None:
        raise fault
    return found


def read_torn(
    path: str | os.PathLike[str], most: int = COMMANDS_CAP, tell: BytesRead = None
) -> tuple[Recording, FileError | None]:
    """Returns a recording up to its last whole line, and what is wrong with the next; FileError if the first line is
    none, or the file cannot be read.

    `tell` hears now and then how many bytes are read; what it raises ends the reading.
    """
    try:
        with open(path, "rb") as file:
            return torn_from(file, os.fspath(path), Path(path).parent, most, tell)
    except OSError as error:
        raise FileError(path, f"cannot be read: {error.strerror or error}") from None


def read_from(file: BinaryIO, name: str, folder: Path | None = None) -> Recording:
    """As `read`, from an open binary file.  Lines end with a newline; blank ones and a byte order mark are ignored."""
    found, fault = torn_from(file, name, folder)
    if fault is not None:
        raise fault
    return found


def torn_from(
    file: BinaryIO, name: str, folder: Path | None = None, most: int = COMMANDS_CAP, tell: BytesRead = None
) -> tuple[Recording, FileError | None]:
    """As `read_torn`, from an open binary file."""
    header: Header | None = None
    commands: list[Command] = []
    places: list[int] = []
    fault: FileError | None = None
    try:
        for number, line in _lines(file, name, tell):
            if header is None:
                header = _told(parse_header, line, name, number)
            elif len(commands) == COMMANDS_CAP:
                raise FileError(name, f"line {number}: found more than {COMMANDS_CAP} commands, expected fewer")
            elif len(commands) == most:
                break
            else:
                found = _told(_parsed, line, name, number)[: most - len(commands)]
                commands += found
                places += [number] * len(found)
    except FileError as error:
        fault = error
    if header is None:
        expected = 'the header {"inkfall": 1, "frame": [X, Y, W, H], "seed": S}'
        raise fault or FileError(name, f"found no line, expected {expected}")
    return Recording(header, tuple(commands), tuple(places), folder, name), fault


def _parsed(value: object) -> list[Command]:
    """Returns the command that a line tells, or the two that it tells in short."""
    return [parse(one) for one in in_full(value)]


def _told(parsed: Callable[[object], T], line: bytes, name: str, number: int) -> T:
    """Returns what a line tells; FileError names it."""
    try:
        return parsed(loads(line))
    except FieldError as error:
        raise FileError(name, f"line {number}: {error}") from None


def _lines(file: BinaryIO, name: str, tell: BytesRead) -> Iterator[tuple[int, bytes]]:
    total = number = blank = told = 0
    while line := file.readline(BYTES_CAP + 1):
        number += 1
        total += len(line)
        if len(line) > BYTES_CAP:
            raise FileError(name, f"line {number}: found more than {BYTES_CAP >> 20} MiB, expected shorter lines")
        if total > TOTAL_CAP:
            raise FileError(name, f"line {number}: found more than {TOTAL_CAP >> 30} GiB, expected a smaller file")
        if number == 1:
            line = line.removeprefix(_BOM)
        if tell is not None and (number % TELL_LINES == 0 or total - told > TELL_BYTES):
            told = total
            tell(told)
        if line.strip():
            yield number, line
            continue
        blank += 1
        if blank > BLANK_CAP:
            raise FileError(name, f"line {number}: found more than {BLANK_CAP} blank lines, expected fewer")


def parse_header(value: Any) -> Header:
    """Reads the first line of a recording.  FieldError names the member that is wrong."""
    members = Fields(value, "header")
    if "inkfall" not in members:
        raise FieldError("header", "no member inkfall", '{"inkfall": 1, "frame": [X, Y, W, H], "seed": S}')
    version = members.integer("inkfall", lo=1, hi=COMMANDS_CAP)
    if version > VERSION:
        raise FieldError("header.inkfall", f"{version} (a newer Inkfall wrote this)", f"a version up to {VERSION}")
    x, y, width, height = members.integers("frame", 4, (0, 0, 1024, 768), limit=PLACE_LIMIT)
    if not (1 <= width <= SIDE_LIMIT and 1 <= height <= SIDE_LIMIT):
        raise members.fault("frame", "a width and height from 1 to 2^40")
    seed = members.integer("seed", 0, lo=-SEED_LIMIT, hi=SEED_LIMIT)
    arithmetic = members.integer("arithmetic", EVERYWHERE, lo=LIBRARY, hi=EVERYWHERE) if version > 1 else LIBRARY
    grid = read_grid(members) if version >= VERSION_OF_GRIDS else FINE
    paper = read_paper(members) if version >= VERSION_OF_GRIDS else None
    return Header(Rect.at(x, y, width, height), seed, members.rest(), arithmetic, grid, paper)


def read_grid(members: Fields) -> int:
    """Returns the member `grid` of a header or a manifest."""
    grid: object = members.take("grid", FINE)
    if type(grid) is not int or grid not in (COARSE, FINE):
        raise members.fault("grid", f"{FINE} or {COARSE}")
    return grid


def read_paper(members: Fields) -> str | None:
    """Returns the member `paper` of a header or a manifest, a colour in small letters; None where there is none."""
    return read_colour(members, "paper")


def write(recording: Recording, path: str | os.PathLike[str]) -> None:
    """Writes the recording as a file, put in place whole or not at all."""
    with replacing(path) as file:
        for line in recording.lines():
            file.write(line.encode() + b"\n")


def undo_reach(commands: Iterable[Command], is_step: frozenset[type]) -> int:
    """Tells how many steps back undo ever goes in these commands: what a replay has to remember."""
    behind = ahead = furthest = reach = 0
    for command in commands:
        if isinstance(command, Undo):
            back = min(command.count, behind)
            behind, ahead = behind - back, ahead + back
            reach = max(reach, furthest - behind)
        elif isinstance(command, Redo):
            forth = min(command.count, ahead)
            behind, ahead = behind + forth, ahead - forth
        elif type(command) in is_step:
            behind, ahead = behind + 1, 0
            furthest = max(furthest, behind)  # what was forgotten then stays forgotten, however many are undone since
    return reach
