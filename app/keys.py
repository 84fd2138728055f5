"""Key presses as the action table writes them: `Ctrl+Shift+Z`, `[`, `PageUp`; wheels and buttons likewise: `Wheel up`,
`Ctrl+Middle button`."""

from __future__ import annotations

from typing import Any

import glfw

from app.input.events import BACK, FORWARD, LEFT, MIDDLE, PAD, RIGHT, PenEvent

_NAMED = {
    glfw.KEY_ESCAPE: "Escape",
    glfw.KEY_TAB: "Tab",
    glfw.KEY_DELETE: "Delete",
    glfw.KEY_INSERT: "Insert",
    glfw.KEY_BACKSPACE: "Backspace",
    glfw.KEY_ENTER: "Enter",
    glfw.KEY_SPACE: "Space",
    glfw.KEY_PAGE_UP: "PageUp",
    glfw.KEY_PAGE_DOWN: "PageDown",
    glfw.KEY_HOME: "Home",
    glfw.KEY_END: "End",
    glfw.KEY_UP: "Up",
    glfw.KEY_DOWN: "Down",
    glfw.KEY_LEFT: "Left",
    glfw.KEY_RIGHT: "Right",
    glfw.KEY_KP_ADD: "+",
    glfw.KEY_KP_SUBTRACT: "-",
    **{glfw.KEY_F1 + i: f"F{i + 1}" for i in range(12)},
    **{glfw.KEY_KP_0 + i: str(i) for i in range(10)},
}
_BUTTONS = {MIDDLE: "Middle button", RIGHT: "Right button", BACK: "Back button", FORWARD: "Forward button"}
_WAYS = ("up", "down", "left", "right")
KEY_NAMES = frozenset(
    [*_NAMED.values(), *_BUTTONS.values(), *(f"F{i}" for i in range(13, 26))]
    + [f"{wheel} {way}" for wheel in ("Wheel", "Ring") for way in _WAYS]
    + [f"Button {i}" for i in range(6, 33)]
    + [f"Pad button {i}" for i in range(1, 33)]
)
FIXED = "Escape", "Space"  # keys that mean the same on every desk
_MODIFIERS = ((glfw.MOD_CONTROL | glfw.MOD_SUPER, "Ctrl"), (glfw.MOD_ALT, "Alt"), (glfw.MOD_SHIFT, "Shift"))


def key_name(key: int, scancode: int) -> str:
    """Returns the key as its label reads on the artist's keyboard; empty for one that means nothing."""
    if key in _NAMED:
        return _NAMED[key]
    label: Any = glfw.get_key_name(key, scancode)
    if not label and 32 < key < 127:
        label = chr(key)
    return str(label).upper() if label else ""


def chord(key: int, scancode: int, mods: int) -> str:
    """Returns the press with its modifiers, as in the action table."""
    name = key_name(key, scancode)
    if not name:
        return ""
    if name == "=" and mods & glfw.MOD_SHIFT:  # what is on that key besides, wherever there is one
        name, mods = "+", mods & ~glfw.MOD_SHIFT
    return "+".join([word for mask, word in _MODIFIERS if mods & mask] + [name])


def pointer_chord(event: PenEvent, mods: int) -> str:
    """Returns a press of a button, or a notch of a wheel, with the modifiers held, likewise; empty for the left one,
    and for what is neither."""
    if event.kind == "wheel":
        way = "up" if event.dy > 0 else "down" if event.dy < 0 else "left" if event.dx > 0 else "right"
        name = f"{'Ring' if event.pad else 'Wheel'} {way}"
    elif event.kind == "down" and event.button != LEFT:
        number = event.button
        name = _BUTTONS.get(number) or (f"Pad button {number - PAD}" if number > PAD else f"Button {number}")
    else:
        return ""
    return "+".join([word for mask, word in _MODIFIERS if mods & mask] + [name])
