"""Writing the user's preferences: the lines of the file that say something else now, and no other."""

from __future__ import annotations

import json
import os
import re
from pathlib import Path

from engine.files.atomic import replacing
from engine.keeping.preferences import SETTINGS, Preferences, read_preferences

_TABLE = re.compile(r"\s*\[\s*(\w+)\s*\]")
_LINE = re.compile(r'(\s*(\w+)\s*=\s*)("(?:[^"\\\n]|\\.)*"|[^#\n]*?)(\s*(?:#.*)?)')


def write_preferences(path: Path, told: Preferences) -> None:
    """Writes them where they are others than the file says, comments and all else stay; a file that cannot be
    understood is put aside before.  OSError where that cannot be."""
    path.parent.mkdir(parents=True, exist_ok=True)
    faults = read_preferences(path)[1]
    text = edited(path.read_text("utf-8"), told) if path.exists() and not faults else ""
    if path.exists() and faults:
        os.replace(path, path.with_name("preferences.damaged.toml"))
    _write(path, text or edited("", told))
    if read_preferences(path) != (told, ()):  # lines such as no program writes: better none than wrong ones
        os.replace(path, path.with_name("preferences.damaged.toml"))
        _write(path, edited("", told))


def edited(text: str, told: Preferences) -> str:
    """Returns the text of a file with what is told; what is as it comes is not told, unless it was."""
    wanted = {place: _value(told, place[1]) for place in SETTINGS}
    usual = {place: _value(Preferences(), place[1]) for place in SETTINGS}
    out: list[str] = []
    ends: dict[str, int] = {}  # by tables, after which line more of it may stand
    table, said = "", set()
    for line in text.splitlines():
        head, match = _TABLE.match(line), _LINE.fullmatch(line)
        if head is not None:
            table = head[1]
        elif match is not None and (table, match[2]) in wanted:
            said.add((table, match[2]))
            line = f"{match[1]}{wanted[table, match[2]]}{match[4]}"
        out.append(line)
        if line.strip():
            ends[table] = len(out)
    for place in sorted(wanted.keys() - said, key=lambda place: (-ends.get(place[0], len(out)), place)):
        if wanted[place] == usual[place]:
            continue
        line = f"{place[1]} = {wanted[place]}"
        if place[0] in ends:
            out.insert(ends[place[0]], line)
        else:
            out += [*([""] if out else []), f"[{place[0]}]", line]
            ends[place[0]] = len(out)
    return "".join(f"{line}\n" for line in out)


def _value(told: Preferences, key: str) -> str:
    """Returns a value as TOML has it."""
    value = getattr(told, key)
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False)
    if isinstance(value, tuple):
        return "[" + ", ".join(f"[{a!r}, {b!r}]" for a, b in value) + "]" if value else "[[0.0, 0.0], [1.0, 1.0]]"
    return f"{value:g}" if isinstance(value, float) and float(f"{value:g}") == value else repr(value)


def _write(path: Path, text: str) -> None:
    with replacing(path) as file:
        file.write(text.encode("utf-8"))
