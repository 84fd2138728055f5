"""Maps of keys that come along: as other programs have them, as far as Inkfall does what they do."""

from __future__ import annotations

from typing import NamedTuple

from app.actions.binding import usual_keys
from app.desk.keys.key_state import Bound


class KeyMap(NamedTuple):
    """A row: its `title` and `hint`, and what is bound otherwise than in Inkfall's own."""

    title: str
    hint: str
    bound: Bound


def _map(title: str, rows: dict[str, str]) -> KeyMap:
    """Returns a row of rows with their keys, between which spaces stand."""
    bound = {row: tuple(keys.split()) for row, keys in rows.items()}
    changed = {row: keys for row, keys in bound.items() if keys != usual_keys(row)}
    return KeyMap(title, f"The keys of {title} as it comes, for what both do", changed)


KEY_MAPS = {
    "inkfall": KeyMap("Inkfall", "The keys as they come", {}),
    "krita": _map(
        "Krita",
        {
            "fill": "F", "fit": "2", "pick": "P", "examples": "Shift+P", "move": "T", "match": "Ctrl+Alt+T",
            "rectangle": "Ctrl+R", "merge_down": "Ctrl+E", "export": "Ctrl+Shift+X", "gradient": "G",
            "select_invert": "Ctrl+Shift+I", "add_layer": "Insert", "clip": "Ctrl+Shift+G", "wrap": "W",
            "here": "Alt+W", "fill_selection": "Shift+Backspace Shift+F5", "redo": "Ctrl+Shift+Z",
        },
    ),
    "photoshop": _map(
        "Photoshop",
        {
            "fit": "Ctrl+0", "one": "Ctrl+1 1", "favourite_1": "", "in": "Ctrl++ Ctrl+= + =", "out": "Ctrl+- -",
            "rectangle": "M", "ellipse": "Shift+M", "mirror": "Ctrl+Alt+F", "lasso": "L", "polygon": "Shift+L",
            "lab": "Alt+L", "light": "Ctrl+Shift+L", "wand": "W", "here": "Shift+W", "merge_down": "Ctrl+E",
            "export": "Ctrl+Alt+Shift+W", "select_none": "Ctrl+D", "select_invert": "Ctrl+Shift+I", "adjust": "Ctrl+U",
            "draw_curve": "Alt+U", "raise": "Ctrl+]", "lower": "Ctrl+[", "redo": "Ctrl+Shift+Z", "panels": "Tab F",
        },
    ),
    "mypaint": _map(
        "MyPaint",
        {
            "larger": "F ]", "smaller": "D [", "fit": "2", "default": "Shift+D", "pick": "R", "turn": "Shift+R",
            "undo": "Z Ctrl+Z", "redo": "Y Ctrl+Shift+Z Ctrl+Y", "zoom": "Alt+Z", "symmetry": "Shift+Y",
            "guides": "Alt+Y", "in": ". + =", "out": ", -", "mirror": "I M", "turn_left": "Ctrl+Left",
            "turn_right": "Ctrl+Right", "upright": "F12 5", "pop_up": "V K", "move": "Alt+V",
            "add_layer": "Ctrl+PageUp", "raise": "Ctrl+Shift+PageUp", "lower": "Ctrl+Shift+PageDown",
        },
    ),
}  # fmt: skip
