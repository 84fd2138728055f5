"""The artist's keys as a file: `keys.json` in the configuration folder, or one that goes from desk to desk."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path

import platformdirs

from app.desk.desk import Desk, FileWork
from app.desk.keys.key_state import Bound
from app.desk.remembering.kept_json import KeptObject, read_kept_object, write_kept_object
from app.keys import FIXED, KEY_NAMES
from engine.checks.field_error import FieldError
from engine.checks.values import described

_MOST_ROWS, _MOST_KEYS, _LONGEST = 2000, 8, 200  # rows, keys of each, characters of a row's name
_CHORD = re.compile(r"(Ctrl\+)?(Alt\+)?(Shift\+)?(.+)", re.DOTALL)
_BACK = "escape", "Escape"  # what it is bound to on every desk
NO_KEYS: Bound = {}


def kept_keys_file() -> Path:
    """Returns where they lie, whether there are any or not."""
    return platformdirs.user_config_path("inkfall") / "keys.json"


def bound_of(told: KeptObject) -> Bound:
    """Returns the keys that an object tells, {"keys": {ROW: [KEY, ...]}}; rows of what there is not are kept.
    ValueError, one line, where one is none, or is bound to two things."""
    rows = told.get("keys")
    if not isinstance(rows, dict) or len(rows) > _MOST_ROWS:
        raise FieldError("keys", described(rows), f"an object of at most {_MOST_ROWS} members")
    bound: dict[str, tuple[str, ...]] = {}
    owners: dict[str, str] = {}
    for row, keys in rows.items():
        if not isinstance(keys, list) or len(keys) > _MOST_KEYS or len(row) > _LONGEST:
            raise FieldError(f"keys.{row}", described(keys), f"a list of at most {_MOST_KEYS} keys")
        bound[row] = tuple(_key(key, row) for key in keys)
        for key in bound[row]:
            if owners.setdefault(key, row) != row:
                raise FieldError(f"keys.{row}", f"{key}, which {described(owners[key])} has", "a key of its own")
    return bound


def _key(key: object, row: str) -> str:
    match = _CHORD.fullmatch(key) if isinstance(key, str) else None
    name = match[4] if match is not None else ""
    if name in KEY_NAMES or (len(name) == 1 and name.isprintable() and not name.isspace() and name == name.upper()):
        if name not in FIXED or (row, key) == _BACK:
            return str(key)
        raise FieldError(f"keys.{row}", described(key), f"another key: {name} is always what it is")
    raise FieldError(f"keys.{row}", described(key), "a key such as Ctrl+Shift+Z, F5, Wheel up or Middle button")


def read_keys(path: Path) -> tuple[Bound, str]:
    """Returns the keys of a file, and why that is not what it should tell, one line."""
    return read_kept_object(path, bound_of, NO_KEYS)


def _object(bound: Bound) -> KeptObject:
    return {"keys": {row: list(keys) for row, keys in bound.items()}}


@dataclass(frozen=True, slots=True)
class KeepKeys(FileWork):
    """Writes them; a file that cannot be read is put aside before."""

    bound: Bound

    def carry_out(self) -> None:
        """Writes the file."""
        path = kept_keys_file()
        write_kept_object(path, _object(self.bound), bool(read_keys(path)[1]))

    def arrive(self, desk: Desk, found: None) -> None:
        """Tells nothing: they are seen."""

    def fail(self, desk: Desk, fault: str) -> None:
        """Tells that they are not kept."""
        desk.say(f"Keys are not kept: {fault}", bad=True)


@dataclass(frozen=True, slots=True)
class GiveKeys(FileWork):
    """Writes a map of keys for other desks."""

    bound: Bound
    path: Path

    def carry_out(self) -> None:
        """Writes the file."""
        write_kept_object(self.path, _object(self.bound), damaged=False)

    def arrive(self, desk: Desk, found: None) -> None:
        """Tells where it is."""
        desk.say(f"Wrote {self.path.name}")
