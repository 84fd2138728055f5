"""The user's preferences: `preferences.toml` in the configuration folder, read once at the start.

What is not said there, or is not to be understood, is as in `Preferences()`.
"""

from __future__ import annotations

import tomllib
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import NamedTuple, TypeGuard

import platformdirs

from engine.files.fault import shown, system_words

LARGEST_FILE = 1 << 20  # bytes


@dataclass(frozen=True, slots=True)
class Preferences:
    """`versions`: how many earlier versions of each saved file are kept; `gigabytes`, `part_of_free`: those of all
    files and the bin take at most so many together, and at most this part of the free disk; `megabytes` of memory that
    paintings may take, 0 for what fits the machine."""

    versions: int = 3
    gigabytes: float = 5.0
    part_of_free: float = 0.1
    megabytes: int = 0


class Row(NamedTuple):
    """What one line of the file sets: a number, `whole` or not, from `low` to `high`."""

    low: float
    high: float
    whole: bool
    put: Callable[[Preferences, float], Preferences]


SETTINGS = {
    ("kept", "versions"): Row(1, 100, True, lambda told, number: replace(told, versions=int(number))),
    ("kept", "gigabytes"): Row(0.0, 1e6, False, lambda told, number: replace(told, gigabytes=number)),
    ("kept", "part_of_free"): Row(0.0, 1.0, False, lambda told, number: replace(told, part_of_free=number)),
    ("memory", "megabytes"): Row(0, 1e6, True, lambda told, number: replace(told, megabytes=int(number))),
}


def preferences_file() -> Path:
    """Returns where the preferences lie, whether there are any or not."""
    return platformdirs.user_config_path("inkfall") / "preferences.toml"


def read_preferences(path: Path) -> tuple[Preferences, tuple[str, ...]]:
    """Returns the preferences in a file, and a line for each that is not taken over."""
    try:
        told = _loaded(path)
    except FileNotFoundError:
        return Preferences(), ()
    except OSError as error:
        return Preferences(), (f"{system_words(error)}; the preferences are as they come",)
    except (ValueError, RecursionError) as error:
        reason = " ".join(str(error).split()) or "nested too deep"
        return Preferences(), (f"{path}: {reason}; the preferences are as they come",)
    found, faults = Preferences(), []
    for (table, key), value in told.items():
        row = SETTINGS.get((table, key))
        if row is None:
            faults.append(f"{path}: [{table}] found {shown(key)}, expected one of {_names(table)}")
        elif not _is_number(value, row.whole) or not row.low <= value <= row.high:
            kind = "a whole number" if row.whole else "a number"
            wanted = f"expected {kind} from {row.low:g} to {row.high:g}"
            faults.append(f"{path}: [{table}] {key}: found {shown(value)}, {wanted}")
        else:
            found = row.put(found, value)
    return found, tuple(faults)


def _loaded(path: Path) -> dict[tuple[str, str], object]:
    """Returns what each table and key of the file is set to."""
    with path.open("rb") as file:
        data = file.read(LARGEST_FILE + 1)
    if len(data) > LARGEST_FILE:
        raise ValueError(f"found more than {LARGEST_FILE} bytes, expected preferences")
    tables: dict[str, object] = tomllib.loads(data.decode("utf-8"))
    names = {table for table, _ in SETTINGS}
    for name, members in tables.items():
        if name not in names or not isinstance(members, dict):
            raise ValueError(f"found {shown(name)}, expected a table, one of {', '.join(sorted(names))}")
    return {
        (name, key): value for name, rows in tables.items() if isinstance(rows, dict) for key, value in rows.items()
    }


def _names(table: str) -> str:
    return ", ".join(key for name, key in SETTINGS if name == table)


def _is_number(value: object, whole: bool) -> TypeGuard[float]:
    return isinstance(value, int if whole else int | float) and not isinstance(value, bool)
