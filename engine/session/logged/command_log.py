"""Commands in their order, of which those done long ago lie on disk, as the lines of a recording tell them.

A stroke of a few points takes 700 bytes as an object, and a long session has a million of them; nobody asks for one
that was done long ago but who saves, or plays all anew.
"""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import Self, overload

import numpy as np
from isal import isal_zlib

from engine.files.strict_json import dumps, loads
from engine.keeping.spill import Spilled, spill
from engine.numeric.recent import Recent
from engine.painting.commands import Command, parse, to_json
from engine.painting.recording import ToldCommands, version_of

NEWEST = 256  # of the newest commands: so many stay as they are
_AS_THEY_ARE = 8 << 20  # bytes of others that do
_OVERHEAD = 300  # bytes of a command's own objects, roughly
_EACH, _BYTES = 256, 1 << 20  # commands in a piece, and bytes of its lines, about
_AT_ONCE = 2  # commands that are told as lines when one is added
_READ = 8 << 20  # bytes of commands kept that were asked for


class _Piece:
    """Commands on disk from a place of the log on, up to the place `stop`; `version`: the newest that one needs;
    `held`: bytes that they took as they were."""

    __slots__ = ("_lines", "held", "start", "stop", "version")

    def __init__(self, start: int, lines: Sequence[bytes], version: int, held: int) -> None:
        self.start, self.stop, self.version, self.held = start, start + len(lines), version, held
        packed = isal_zlib.compress(b"\n".join(lines), 1)
        self._lines: Spilled | bytes = spill().put(packed) or packed

    def lines(self) -> list[bytes]:
        """Returns the lines.  OSError if they cannot be read."""
        packed = self._lines if isinstance(self._lines, bytes) else self._lines.read()
        return isal_zlib.decompress(packed).split(b"\n")

    def commands(self) -> Sequence[Command]:
        """Returns the commands, which are made if they were not of late."""
        known = _COMMANDS_READ.get(self)
        if known is None:
            known = tuple(parse(loads(line)) for line in self.lines())
            _COMMANDS_READ.keep(self, known, self.held)
        return known


_COMMANDS_READ: Recent[Sequence[Command]] = Recent(lambda: _READ)


class Commands(ToldCommands):
    """Commands in their order: those in pieces, and then the newest.  A value, for any thread."""

    __slots__ = ("_parts",)
    _some: Callable[[Iterable[Command]], Sequence[Command]] = tuple

    def __init__(self, pieces: Sequence[_Piece], newest: Sequence[Command]) -> None:
        self._parts = pieces, newest

    def __len__(self) -> int:
        pieces, newest = self._parts
        return _stop(pieces) + len(newest)

    @overload
    def __getitem__(self, at: int) -> Command: ...

    @overload
    def __getitem__(self, at: slice) -> Sequence[Command]: ...

    def __getitem__(self, at: int | slice) -> Command | Sequence[Command]:
        if isinstance(at, slice):
            return self._some(self[n] for n in range(*at.indices(len(self))))
        pieces, newest = self._parts
        before = _stop(pieces)
        number = at + before + len(newest) if at < 0 else at
        if number >= before:
            return newest[number - before]
        if number < 0:
            raise IndexError(at)
        piece = pieces[bisect_right(pieces, number, key=lambda piece: piece.stop)]
        return piece.commands()[number - piece.start]

    def __iter__(self) -> Iterator[Command]:
        pieces, newest = self._parts
        for piece in pieces:
            yield from piece.commands()
        yield from newest

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Sequence):
            return NotImplemented
        return len(self) == len(other) and all(a == b for a, b in zip(self, other, strict=True))

    def __hash__(self) -> int:
        return hash(len(self))

    def __repr__(self) -> str:
        return f"Commands({list(self)})"

    @property
    def held(self) -> int:
        """Counts the bytes of the points of those that are in memory, as they were drawn."""
        return sum(_size(command) - _OVERHEAD for command in self._parts[1])

    def lines(self) -> Iterator[str]:
        """Yields the lines of a recording that tell them, without their ends."""
        pieces, newest = self._parts
        for piece in pieces:
            yield from (line.decode() for line in piece.lines())
        yield from map(_line, newest)

    @property
    def version(self) -> int:
        """Tells the newest version of the format that a command needs; 1 where there is none."""
        pieces, newest = self._parts
        return max((1, *(piece.version for piece in pieces), *map(version_of, newest)))


class CommandLog(Commands):
    """Commands to which others are added.  It belongs to one thread, which hands out values of it (`now`); others may
    read meanwhile what is there already."""

    __slots__ = ("_held", "_told", "_version")
    _parts: tuple[Sequence[_Piece], list[Command]]
    _some = list

    def __init__(self, commands: Iterable[Command] = ()) -> None:
        pieces, newest = commands._parts if isinstance(commands, Commands) else ((), commands)
        super().__init__(pieces, [])
        self._version = 1
        self._told: list[bytes] = []  # lines of the first of the newest commands
        self._held = 0  # bytes of those that are not told yet
        self += newest

    def __iadd__(self, commands: Iterable[Command]) -> Self:
        for command in commands:
            self.append(command)
        return self

    def append(self, command: Command) -> None:
        """Adds a command."""
        newest = self._parts[1]
        newest.append(command)
        self._held += _size(command)
        for _ in range(_AT_ONCE):
            if self._held > _AS_THEY_ARE and len(newest) - len(self._told) > NEWEST:
                self._tell()

    def pop(self) -> Command:
        """Takes the newest command away, which is told in no line; IndexError if there is none."""
        command = self._parts[1].pop()
        self._held -= _size(command)
        return command

    def now(self) -> Sequence[Command]:
        """Returns the commands that there are now."""
        pieces, newest = self._parts
        return Commands(pieces, tuple(newest)) if pieces else tuple(newest)

    def _tell(self) -> None:
        """Tells the next command as a line, and puts those away that are told where they are many."""
        (pieces, newest), lines = self._parts, self._told
        command = newest[len(lines)]
        self._held -= _size(command)
        lines.append(_line(command).encode())
        self._version = max(self._version, version_of(command))
        if len(lines) < _EACH and sum(map(len, lines)) < _BYTES:
            return
        count = len(lines)
        piece = _Piece(_stop(pieces), lines, self._version, sum(map(_size, newest[:count])))
        self._parts = (*pieces, piece), newest[count:]
        self._told, self._version = [], 1


def _stop(pieces: Sequence[_Piece]) -> int:
    """Counts the commands in pieces."""
    return pieces[-1].stop if pieces else 0


def _line(command: Command) -> str:
    return dumps(to_json(command))


def _size(command: Command) -> int:
    """Returns the bytes of memory that a command takes, roughly."""
    points = getattr(command, "points", None)
    return _OVERHEAD + (points.nbytes if isinstance(points, np.ndarray) else 0)
