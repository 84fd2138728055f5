"""Brush presets: one JSON file each, {"name": ..., "group": ..., "brush": {...}}, in a folder."""

from __future__ import annotations

import json
import math
import os
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from immutables import Map

from engine.brush import checks, settings
from engine.brush.checks import BrushError
from engine.brush.settings import Brush

BYTES_CAP = 1 << 18
FILES_CAP = 2000
GROUP = "My brushes"


@dataclass(frozen=True, slots=True)
class Preset:
    """A brush under a name, shown among those of its group.  `extra`: members this version does not know."""

    name: str
    brush: Brush
    group: str = GROUP
    extra: Map[str, Any] = field(default_factory=Map)


def load(path: str | os.PathLike[str]) -> Preset:
    """The preset of a file.  BrushError, one line that starts with the file's name, if it is no preset; OSError if it
    cannot be read."""
    try:
        with open(path, "rb") as file:
            data = file.read(BYTES_CAP + 1)
        return from_json(_decoded(data))
    except BrushError as error:
        raise BrushError(f"{os.fspath(path)}: {error.place}", error.found, error.expected) from None


def save(path: str | os.PathLike[str], preset: Preset) -> None:
    """Writes a preset's file beside and then in place of the old one: it is whole at any moment."""
    path = Path(path)
    beside = path.with_name(f".{path.name}.{os.getpid()}.part")
    text = json.dumps(to_json(preset), ensure_ascii=False, allow_nan=False, indent=1) + "\n"
    try:
        with open(beside, "w", encoding="utf-8", newline="\n") as file:
            file.write(text)
            file.flush()
            os.fsync(file.fileno())
        os.replace(beside, path)
    finally:
        beside.unlink(missing_ok=True)


def load_folder(folder: str | os.PathLike[str]) -> tuple[list[Preset], list[str]]:
    """The presets of a folder's *.json files, by group and name, and one line for each file that is none.

    A folder that is missing holds none.
    """
    found: list[Preset] = []
    faults: list[str] = []
    for path in sorted(Path(folder).glob("*.json"))[:FILES_CAP]:
        try:
            found.append(load(path))
        except BrushError as error:
            faults.append(str(error))
        except OSError as error:
            faults.append(f"{path}: {error.strerror or error}")
    return sorted(found, key=lambda preset: (preset.group, preset.name)), faults


def from_json(data: Any) -> Preset:
    """The preset that a JSON object describes; BrushError names the field."""
    if not isinstance(data, dict):
        raise BrushError("preset", checks.shown(data), 'an object {"name": ..., "group": ..., "brush": {...}}')
    return Preset(
        checks.text(data.get("name"), "name"),
        settings.from_json(data.get("brush"), "brush"),
        checks.text(data.get("group", GROUP), "group"),
        checks.frozen({k: v for k, v in data.items() if k not in ("name", "group", "brush")}),
    )


def to_json(preset: Preset) -> dict[str, Any]:
    own = {"name": preset.name, "group": preset.group, "brush": settings.to_json(preset.brush)}
    return own | checks.thawed(preset.extra)


def _decoded(data: bytes) -> Any:
    if len(data) > BYTES_CAP:
        raise BrushError("preset", f"more than {BYTES_CAP >> 10} KiB", "less")
    try:
        return json.loads(
            data.decode("utf-8-sig"), parse_constant=_no_constant, parse_float=_finite, object_pairs_hook=_members
        )
    except UnicodeDecodeError as error:
        raise BrushError(f"byte {error.start + 1}", "bytes that are not UTF-8", "UTF-8 text") from None
    except json.JSONDecodeError as error:
        raise BrushError(
            f"line {error.lineno}, column {error.colno}", "something else", f"JSON ({error.msg})"
        ) from None
    except RecursionError:
        raise BrushError("preset", "brackets nested too deeply", "a few levels") from None
    except BrushError:
        raise
    except ValueError:
        raise BrushError("preset", "a number of thousands of digits", "a shorter number") from None


def _no_constant(name: str) -> float:
    raise BrushError("preset", name, "a finite number")


def _finite(digits: str) -> float:
    value = float(digits)
    if not math.isfinite(value):
        raise BrushError("preset", ascii(digits[:40]), "a number within the range of a 64-bit float")
    return value


def _members(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    members = dict(pairs)
    if len(members) < len(pairs):
        names = [name for name, _ in pairs]
        twice = next(name for i, name in enumerate(names) if name in names[:i])
        raise BrushError("preset", f"{twice[:40]!a} given twice", "each name once")
    return members
