"""The actions of the Edit menu."""

from __future__ import annotations

from app.actions.action import Action as A
from app.actions.action import asks, chosen, paint_chosen, ready, to_now
from app.desk.desk import Desk
from app.desk.guides import symmetry
from app.desk.hand import BLACK, WHITE
from app.desk.outside import clipboard, copied_parts
from engine.painting import commands as c
from engine.studio.requests import Do


def _can_undo(desk: Desk) -> bool:
    scene = desk.known.scene
    return ready(desk) and scene is not None and (scene.can_undo or desk.behind())  # a stroke may still be laid


def _undo(desk: Desk) -> None:
    desk.notices.settle("fill")  # what was asked about it is past
    _go(desk, c.Undo())


def _redo(desk: Desk) -> None:
    _go(desk, c.Redo())


def _go(desk: Desk, command: c.Undo | c.Redo) -> None:
    """The symmetry is the hand's: it stays as it is."""
    symmetry.keep(desk)
    desk.post(Do(command, over_symmetry=True))


def _can_redo(desk: Desk) -> bool:
    return ready(desk) and desk.known.scene is not None and desk.known.scene.can_redo


def _can_copy(desk: Desk) -> bool:
    row = desk.known.active
    return chosen(desk) and row is not None and not row.group


def _can_cut(desk: Desk) -> bool:
    row = desk.known.active
    return paint_chosen(desk) and row is not None and not row.locked


def _swap(desk: Desk) -> None:
    desk.hand.swap()


def _default_colours(desk: Desk) -> None:
    desk.hand.colour, desk.hand.other_colour = BLACK, WHITE


def _asks_here(desk: Desk) -> None:
    desk.strip, desk.panels = "history", True
    desk.past.listing, desk.past.asking = "here", True


def _looking_back(desk: Desk) -> bool:
    return desk.past.looking is not None


EDIT_ACTIONS: dict[str, A] = {
    "undo": A("Undo", "Edit", ("Ctrl+Z",), "Take back the last step", _undo, _can_undo),
    "redo": A("Redo", "Edit", ("Ctrl+Shift+Z", "Ctrl+Y"), "Do again what was taken back", _redo, _can_redo),
    "here": A("What was painted here?", "Edit", ("W",), "The strokes that show at a place", _asks_here, ready),
    "now": A("Back to now", "Edit", (), "See the painting as it is, after looking back", to_now, _looking_back),
    "copy_picture": A(
        "Copy picture", "Edit", ("Ctrl+Shift+C",), "Copy the whole frame, for other programs", clipboard.ask_copy, ready
    ),
    "cut": A("Cut", "Edit", ("Ctrl+X",), "Take what is selected off, to paste it", copied_parts.cut_part, _can_cut),
    "copy": A("Copy", "Edit", ("Ctrl+C",), "Copy what is selected, to paste it", copied_parts.copy_part, _can_copy),
    "paste": A("Paste", "Edit", ("Ctrl+V",), "Lay what was copied last on a layer of its own", clipboard.paste, ready),
    "swap": A("Swap colours", "Edit", ("X",), "Swap the two colours", _swap),
    "default": A("Black and white", "Edit", ("D",), "Set the colours to black and white", _default_colours),
    "preferences": A("Preferences…", "Edit", ("Ctrl+,",), "Pen, display, memory and files", asks("preferences")),
}  # fmt: skip
