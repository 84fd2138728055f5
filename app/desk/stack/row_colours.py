"""Colours of rows of the panel of layers: kept by paintings, as `rows.json` in the state folder."""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path

from app.desk.colours import RGB
from app.desk.desk import Desk, FileWork
from app.desk.remembering.kept_json import KeptObject, read_kept_object, write_kept_object
from engine.checks.field_error import FieldError
from engine.checks.values import described
from engine.keeping.state_folder import state_folder

ROW_COLOURS: dict[str, RGB] = {
    "red": (0.79, 0.33, 0.30),
    "orange": (0.82, 0.54, 0.27),
    "yellow": (0.80, 0.72, 0.34),
    "green": (0.45, 0.66, 0.38),
    "blue": (0.36, 0.55, 0.80),
    "violet": (0.60, 0.45, 0.76),
    "grey": (0.56, 0.56, 0.56),
}
MOST_PAINTINGS, _MOST_ROWS = 200, 2000

Coloured = dict[str, str]  # by layers' names: rows of ROW_COLOURS


def _file() -> Path:
    return state_folder("recent") / "rows.json"


def rows_of(told: KeptObject) -> dict[str, Coloured]:
    """Returns the colours that an object tells, by the paths of paintings.  ValueError, one line, where one is none."""
    found: dict[str, Coloured] = {}
    for path, rows in list(told.items())[-MOST_PAINTINGS:]:
        if not isinstance(rows, dict) or not all(isinstance(one, str) for one in rows.values()):
            raise FieldError("rows", described(rows), "names of layers, each with a colour's")
        found[path] = {name: one for name, one in list(rows.items())[:_MOST_ROWS] if one in ROW_COLOURS}
    return found


@dataclass(frozen=True, slots=True)
class ReadRows(FileWork):
    """Reads those of one painting."""

    path: str
    serial: int

    def carry_out(self) -> tuple[Coloured, str]:
        """Returns them, and what is wrong with the file."""
        none: dict[str, Coloured] = {}
        found, fault = read_kept_object(_file(), rows_of, none)
        return found.get(self.path, {}), fault

    def arrive(self, desk: Desk, found: tuple[Coloured, str]) -> None:
        """Colours the rows, unless another painting is there by now."""
        if desk.known.scene is not None and desk.known.scene.serial == self.serial:
            desk.stack.colours = {**found[0], **desk.stack.colours}
        if found[1]:
            desk.say(f"{found[1]}; rows of layers have no colours", bad=True)

    def fail(self, desk: Desk, fault: str) -> None:
        """Goes on without."""


@dataclass(frozen=True, slots=True)
class KeepRows(FileWork):
    """Writes those of one painting, the newest last."""

    path: str
    rows: tuple[tuple[str, str], ...]

    def carry_out(self) -> None:
        """Writes the file; one that cannot be read is put aside before."""
        none: dict[str, Coloured] = {}
        before, fault = read_kept_object(_file(), rows_of, none)
        before.pop(self.path, None)
        kept = dict(list(before.items())[1 - MOST_PAINTINGS :]) | ({self.path: dict(self.rows)} if self.rows else {})
        write_kept_object(_file(), dict(kept), bool(fault))

    def arrive(self, desk: Desk, found: None) -> None:
        """Tells nothing."""

    def fail(self, desk: Desk, fault: str) -> None:
        """Tells that they are not kept."""
        desk.say(f"The colours of rows are not kept: {fault}", bad=True)


def colour_rows(desk: Desk, names: list[str], colour: str) -> None:
    """Gives rows a colour, none for an empty name."""
    desk.stack.colours = {name: one for name, one in desk.stack.colours.items() if name not in names}
    desk.stack.colours |= dict.fromkeys(names, colour) if colour else {}
    _keep(desk)


def follow_rows(desk: Desk) -> None:
    """Takes up the colours of another painting, and keeps those of one that has a file now."""
    scene = desk.known.scene
    if scene is None:
        return
    there = None if scene.path is None else os.path.abspath(scene.path)
    of = scene.serial, there
    if desk.stack.coloured == of:
        return
    other, desk.stack.coloured = desk.stack.coloured[0] != scene.serial, of
    if other:
        desk.stack.colours = {}
    if other and there is not None:
        desk.work(ReadRows(there, scene.serial))
    elif desk.stack.colours:
        _keep(desk)


def _keep(desk: Desk) -> None:
    scene = desk.known.scene
    if scene is not None and scene.path is not None:
        desk.work(KeepRows(os.path.abspath(scene.path), tuple(desk.stack.colours.items())))
