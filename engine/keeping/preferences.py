"""The user's preferences: `preferences.toml` in the configuration folder, read once at the start.

What is not said there, or is not to be understood, is as in `Preferences()`.
"""

from __future__ import annotations

import tomllib
from collections.abc import Callable
from dataclasses import dataclass, replace
from itertools import pairwise
from pathlib import Path
from typing import NamedTuple, TypeGuard

import platformdirs

from engine.files.fault import shown, system_words

LARGEST_FILE = 1 << 20  # bytes


PressureKnots = tuple[tuple[float, float], ...]
MOST_KNOTS = 64
LOOK_NAMES = "dark", "light", "contrast"
PEN_DRIVERS = "ink", "wintab"  # of which a system may have but one
_MOST_LETTERS = 4096
_STRAIGHT: PressureKnots = ((0.0, 0.0), (1.0, 1.0))  # what changes nothing


@dataclass(frozen=True, slots=True)
class Preferences:
    """`versions`: how many earlier versions of each saved file are kept; `gigabytes`, `part_of_free`: those of all
    files and the bin take at most so many together, and at most this part of the free disk; `megabytes` of memory that
    paintings may take, 0 for what fits the machine; `curve`: what pressures of a pen become, knots of 0..1, none where
    they stay; `constant`: the pressure of every pen, 0 where it is felt; `ignore_touch`: fingers do nothing; `scale` of
    all that the window shows beside the canvas, in that of the screen; `font_size` in points; `profile`: a file's, by
    which the screen shows colours, "screen" for what the system has, "none"; `proof`: the file of one that is imitated
    on a key; `language`: that of the window, nothing for the system's; `look`: the window's colours, one of LOOK_NAMES;
    `driver`: which of the system's ways pens are heard by, one of PEN_DRIVERS."""

    versions: int = 3
    gigabytes: float = 5.0
    part_of_free: float = 0.1
    megabytes: int = 0
    curve: PressureKnots = ()
    constant: float = 0.0
    ignore_touch: bool = False
    scale: float = 1.0
    font_size: float = 15.0
    profile: str = "screen"
    proof: str = ""
    language: str = ""
    look: str = "dark"
    driver: str = "ink"


class Row(NamedTuple):
    """What one line of the file sets: a number, `whole` or not, from `low` to `high`."""

    low: float
    high: float
    whole: bool
    put: Callable[[Preferences, float], Preferences]

    def taken(self, found: Preferences, value: object) -> Preferences | None:
        """Returns the preferences with a value, None where that is none."""
        good = _is_number(value, self.whole) and self.low <= value <= self.high
        return self.put(found, value) if good and _is_number(value, self.whole) else None

    @property
    def expected(self) -> str:
        """Says what the value is to be."""
        return f"{'a whole number' if self.whole else 'a number'} from {self.low:g} to {self.high:g}"


class Switch(NamedTuple):
    """What one line of the file turns on or off."""

    put: Callable[[Preferences, bool], Preferences]

    @property
    def expected(self) -> str:
        """Says what the value is to be."""
        return "true or false"

    def taken(self, found: Preferences, value: object) -> Preferences | None:
        """Returns the preferences with a value, None where that is none."""
        return self.put(found, value) if isinstance(value, bool) else None


class Curve(NamedTuple):
    """What one line of the file draws: knots, whose inputs rise."""

    put: Callable[[Preferences, PressureKnots], Preferences]

    @property
    def expected(self) -> str:
        """Says what the value is to be."""
        return f"[[in, out], ...], from 0 to 1, inputs rising, at most {MOST_KNOTS}"

    def taken(self, found: Preferences, value: object) -> Preferences | None:
        """Returns the preferences with a value, None where that is none."""
        if not isinstance(value, list) or not 2 <= len(value) <= MOST_KNOTS:
            return None
        knots = [tuple(pair) for pair in value if isinstance(pair, list) and len(pair) == 2]
        if len(knots) < len(value) or not all(_is_number(v, False) and 0 <= v <= 1 for pair in knots for v in pair):
            return None
        rising = all(one[0] < other[0] for one, other in pairwise(knots))
        return self.put(found, tuple((float(a), float(b)) for a, b in knots)) if rising else None


class Named(NamedTuple):
    """What one line of the file names."""

    put: Callable[[Preferences, str], Preferences]
    expected: str

    def taken(self, found: Preferences, value: object) -> Preferences | None:
        """Returns the preferences with a text, None where that is none."""
        good = isinstance(value, str) and len(value) <= _MOST_LETTERS and value.isprintable()
        return self.put(found, value) if good and isinstance(value, str) else None


class Choice(NamedTuple):
    """What one line of the file chooses of `names`."""

    names: tuple[str, ...]
    put: Callable[[Preferences, str], Preferences]

    @property
    def expected(self) -> str:
        """Says what the value is to be."""
        return f"one of {', '.join(self.names)}"

    def taken(self, found: Preferences, value: object) -> Preferences | None:
        """Returns the preferences with a value, None where that is none."""
        return self.put(found, value) if isinstance(value, str) and value in self.names else None


_A_PROFILE = f"the path of an ICC profile, at most {_MOST_LETTERS} letters"
MEGABYTES = Row(0, 1e6, True, lambda told, number: replace(told, megabytes=int(number)))
SETTINGS: dict[tuple[str, str], Row | Switch | Curve | Named | Choice] = {
    ("kept", "versions"): Row(1, 100, True, lambda told, number: replace(told, versions=int(number))),
    ("kept", "gigabytes"): Row(0.0, 1e6, False, lambda told, number: replace(told, gigabytes=number)),
    ("kept", "part_of_free"): Row(0.0, 1.0, False, lambda told, number: replace(told, part_of_free=number)),
    ("memory", "megabytes"): MEGABYTES,
    ("pen", "curve"): Curve(lambda told, knots: replace(told, curve=() if knots == _STRAIGHT else knots)),
    ("pen", "constant"): Row(0.0, 1.0, False, lambda told, number: replace(told, constant=number)),
    ("pen", "ignore_touch"): Switch(lambda told, on: replace(told, ignore_touch=on)),
    ("display", "scale"): Row(0.75, 3.0, False, lambda told, number: replace(told, scale=number)),
    ("display", "look"): Choice(LOOK_NAMES, lambda told, name: replace(told, look=name)),
    ("pen", "driver"): Choice(PEN_DRIVERS, lambda told, name: replace(told, driver=name)),
    ("display", "font_size"): Row(12.0, 20.0, False, lambda told, number: replace(told, font_size=number)),
    ("display", "profile"): Named(
        lambda told, path: replace(told, profile=path or "none"), f'"screen", "none" or {_A_PROFILE}'
    ),
    ("display", "proof"): Named(lambda told, path: replace(told, proof=path), f'"" or {_A_PROFILE}'),
    ("display", "language"): Named(
        lambda told, code: replace(told, language=code), '"" for that of the system, or such as "de"'
    ),
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
            continue
        taken = row.taken(found, value)
        if taken is None:
            faults.append(f"{path}: [{table}] {key}: found {shown(value)}, expected {row.expected}")
        found = taken or found
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
