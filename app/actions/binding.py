"""Keys as the artist has them: the table of actions as it comes, less and more what is bound otherwise."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from app.actions.action import Action, idle
from app.actions.actions import ACTIONS, keys_mean
from app.desk.desk import Desk, FileWork
from app.desk.holding.taking import take_preset
from app.desk.keys.kept_keys import KeepKeys, read_keys
from app.desk.keys.key_state import Bound, brush_of

_USUAL = {name: action.keys for name, action in ACTIONS.items()}


def usual_keys(row: str) -> tuple[str, ...]:
    """Returns the keys with which a row comes; brushes have none."""
    return _USUAL.get(row, ())


def keys_with(bound: Bound) -> dict[str, tuple[str, ...]]:
    """Returns the keys of every row: what is bound has its keys, whatever they were; all else those that are left of
    its own."""
    taken = {key for row, keys in bound.items() if row in _USUAL or brush_of(row) for key in keys}
    left = {row: tuple(key for key in keys if key not in taken) for row, keys in _USUAL.items() if row not in bound}
    return {**left, **{row: keys for row, keys in bound.items() if row in _USUAL or brush_of(row)}}


def lay_keys(bound: Bound) -> None:
    """From now on keys mean this: in menus, tooltips and presses."""
    keys = keys_with(bound)
    for name, action in ACTIONS.items():
        ACTIONS[name] = action._replace(keys=keys.get(name, ()))
    keys_mean({key: row_action(row) for row, held in keys.items() for key in held})


def row_action(row: str) -> Action:
    """Returns what a row of a map of keys does."""
    brush = brush_of(row)
    if not brush:
        return ACTIONS[row]
    return Action(brush, "", (), f"Paint with {brush}", lambda desk: _take(desk, brush), idle)


def _take(desk: Desk, name: str) -> None:
    found = next((preset for preset in desk.known.presets if preset.name == name), None)
    if found is None:
        desk.say(f"The brush {name} is not there any more", bad=True)
        return
    take_preset(desk, found)
    desk.say(f"Brush: {found.name}")


def owner_of(bound: Bound, key: str) -> str:
    """Returns the row that has a key; "" where none has."""
    return next((row for row, keys in keys_with(bound).items() if key in keys), "")


def bound_with(bound: Bound, row: str, keys: tuple[str, ...]) -> Bound:
    """Returns the map in which a row has these keys, which no other has any more, nor one that this program has not."""
    out = {one: tuple(key for key in held if key not in keys) for one, held in bound.items()}
    for key in keys:
        owner = owner_of(out, key)
        if owner and owner != row:
            out[owner] = tuple(one for one in keys_with(out)[owner] if one != key)
    out[row] = tuple(dict.fromkeys(keys))
    return {one: held for one, held in out.items() if held != usual_keys(one)}


def change_keys(desk: Desk, bound: Mapping[str, tuple[str, ...]]) -> None:
    """Binds keys, and keeps that."""
    if bound != desk.keys.bound:
        desk.keys.bound = bound
        lay_keys(bound)
        desk.work(KeepKeys(bound))


@dataclass(frozen=True, slots=True)
class BringKeys(FileWork):
    """Takes over a map of keys from a file, all or nothing."""

    path: Path

    def carry_out(self) -> tuple[Bound, str]:
        """Returns them, and what is wrong with the file."""
        if not self.path.is_file():
            return {}, f"{self.path.name}: there is no such file"
        return read_keys(self.path)

    def arrive(self, desk: Desk, found: tuple[Bound, str]) -> None:
        """Binds them, or tells in a line why not, in the list."""
        bound, fault = found
        strange = sum(row not in _USUAL and not brush_of(row) for row in bound)
        if not fault:
            change_keys(desk, bound)
        desk.keys.told = fault or f"Brought in {self.path.name}{f', {strange} of what there is not' if strange else ''}"
        desk.asked.show("keys")
