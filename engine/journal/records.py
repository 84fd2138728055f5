"""The records of a journal: what each kind of frame tells.

What is asked for has a number, by which what became of it is told.  Commands are told as in a recording, but for the
points of strokes, which follow as they are: six float64 each, or seven of a pen that tells its rotation.
"""

from __future__ import annotations

import struct
from collections.abc import Mapping
from dataclasses import dataclass, replace
from enum import IntEnum

import numpy as np

from engine.brush import settings
from engine.brush.copies import NO_COPIES, Copies
from engine.brush.settings import Brush
from engine.canvas.placing.pose import Pose
from engine.checks.field_error import FieldError
from engine.files.strict_json import Fields, dumps, loads
from engine.painting.commands import LEVEL_LIMIT, PLACE_LIMIT, Command, Stroke, parse, to_json
from engine.painting.layering.onto_member import ONTO_PAINT, read_onto
from engine.painting.layering.seen_member import read_seen, write_seen
from engine.painting.points import ALWAYS, POINT_COLUMNS
from engine.painting.select_commands import JOIN_OPS
from engine.painting.stroke_copies import read_copies, write_copies

LENGTH = struct.Struct("<I")
NUMBER = struct.Struct("<Q")
ASKED = struct.Struct("<Qd")  # its number, and when by the clock (seconds since 1970)
Members = dict[str, object]  # of a JSON object
_NO_POINTS = np.empty((0, ALWAYS))
_COLUMNS = "columns"  # of a stroke's points, told where they are more
_ANY_POINT = [[0, 0]]
_TEXT_CAP = 1 << 26  # bytes


class Kind(IntEnum):
    """What a frame tells."""

    HEAD = 1  # what the painting began with: the first frame of each file
    BEGIN = 2  # asked for: the pen touches down
    POINTS = 3  # asked for: more of that stroke
    FINISH = 4  # asked for: the pen lifts
    ABANDON = 5  # asked for: the stroke is dropped
    ASK = 6  # asked for: a command
    DONE = 7  # carried out: a stroke or a command that was asked for
    REFUSED = 8  # not carried out, or there was nothing to do
    DID = 9  # carried out: a command that nobody asked for
    CHECKPOINT = 10  # written: the painting as it was after so many commands
    SAVED = 11  # written: the painting's own file
    TURNED = 13  # asked for: as POINTS, each with its rotation
    BASE = 12  # kept: the bytes of the file that was opened


@dataclass(frozen=True, slots=True)
class Touch:
    """How a stroke begins: where, with what brush, and when, where the window tells (seconds since 1970); `layer`: None
    for the active one; `onto`: its paint or its mask; `selects`: what it does to what is selected in place of either,
    an op of `select`, "" for nothing; `seen`: as of a stroke."""

    level: int
    origin: tuple[int, int]
    brush: Brush
    time: float | None = None
    copies: Copies = NO_COPIES
    layer: str | None = None
    onto: str = ONTO_PAINT
    selects: str = ""
    seen: Pose | None = None


def told_object(value: Mapping[str, object]) -> bytes:
    """Returns a JSON object as bytes."""
    return dumps(value).encode()


def read_object(payload: bytes) -> Members:
    """Returns the object again; FieldError if it is none."""
    value = loads(payload, cap=_TEXT_CAP)
    if not isinstance(value, dict):
        raise FieldError("record", type(value).__name__, "an object")
    return value


def told_command(command: Command) -> bytes:
    """Returns a command as bytes.  ValueError if it holds what JSON cannot."""
    points, about = b"", {}
    if isinstance(command, Stroke):
        points = told_points(command.points)
        columns = command.points.shape[1]
        about = {_COLUMNS: columns} if columns > ALWAYS else {}
        command = replace(command, points=_NO_POINTS)
    text = told_object(to_json(command) | about)
    return LENGTH.pack(len(text)) + text + points


def read_command(payload: bytes) -> Command:
    """Returns the command again; FieldError names what is wrong with it."""
    if len(payload) < LENGTH.size:
        raise FieldError("record", f"{len(payload)} bytes", "a command")
    end = LENGTH.size + LENGTH.unpack_from(payload)[0]
    value = read_object(payload[LENGTH.size : end])
    if value.get("do") != "stroke":
        return parse(value)
    columns = value.pop(_COLUMNS, ALWAYS)
    stroke = parse({**value, "points": _ANY_POINT})
    assert isinstance(stroke, Stroke)
    return replace(stroke, points=read_points(payload[end:], len(POINT_COLUMNS) if columns != ALWAYS else ALWAYS))


def told_points(points: np.ndarray) -> bytes:
    """Returns the bytes of points, float64 (n, 6..7)."""
    return np.ascontiguousarray(points, "<f8").tobytes()


def read_points(payload: bytes, columns: int = ALWAYS) -> np.ndarray:
    """Returns the same points, read-only; FieldError if these are no whole ones."""
    if len(payload) % (8 * columns):
        raise FieldError("record", f"{len(payload)} bytes", "whole points")
    return np.frombuffer(payload, "<f8").reshape(-1, columns)


def told_brush(brush: Brush) -> str:
    """Returns a brush as text."""
    return dumps(settings.to_json(brush))


def told_touch(touch: Touch, brush: str) -> bytes:
    """Returns how a stroke begins as bytes; `brush`: the text of its brush."""
    about: Members = {"level": touch.level, "origin": list(touch.origin)}
    if touch.time is not None:
        about["time"] = touch.time
    if touch.copies:
        about["copies"] = write_copies(touch.copies)
    if touch.layer is not None:
        about["layer"] = touch.layer
    if touch.onto:
        about["onto"] = touch.onto
    if touch.seen is not None:
        about["seen"] = write_seen(touch.seen)
    if touch.selects:
        about["selects"] = touch.selects
    text = told_object(about)
    return LENGTH.pack(len(text)) + text + brush.encode()


def read_touch(payload: bytes, brushes: dict[bytes, Brush]) -> Touch:
    """Returns the beginning again; `brushes`: those read before, by their text.  FieldError names what is wrong."""
    if len(payload) < LENGTH.size:
        raise FieldError("record", f"{len(payload)} bytes", "how a stroke begins")
    end = LENGTH.size + LENGTH.unpack_from(payload)[0]
    text = payload[end:]
    if text not in brushes:
        brushes[text] = settings.from_json(read_object(text))
    members = Fields(read_object(payload[LENGTH.size : end]), "touch")
    level = members.integer("level", lo=-LEVEL_LIMIT, hi=LEVEL_LIMIT)
    origin = members.integers("origin", 2, limit=PLACE_LIMIT)
    layer = None if members.take("layer", None) is None else members.text("layer")
    selects = members.text("selects", "")
    if selects not in ("", *JOIN_OPS):
        raise members.fault("selects", ", ".join(f'"{known}"' for known in JOIN_OPS))
    about = brushes[text], members.take("time", None), read_copies(members), layer, read_onto(members), selects
    return Touch(level, (origin[0], origin[1]), *about, read_seen(members))
