"""Whose event is it: the panels', or the canvas's?  Decided once, at the press; then gestures get the rest."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import replace

import glfw
from imgui_bundle import imgui

from app.actions.action import Action
from app.actions.actions import ACTIONS, by_key, perform
from app.desk.desk import Desk
from app.desk.preferring.feeling import felt
from app.input.events import LEFT, MIDDLE, RIGHT, PenEvent
from app.keys import chord, pointer_chord
from app.panels.controls.fields_in_sight import field_in_sight
from app.panels.layout import Layout
from app.tools.asking_gestures import ask_here, mark, pick, pick_or_pop_up, swap
from app.tools.gesture import Gesture
from app.tools.land_gestures import look_around, on_the_land, orbit
from app.tools.size_gestures import drag_size
from app.tools.tools import TOOLS
from app.tools.view_gestures import pan, turn, zoom

NOTCH = 0.25  # levels a notch of the wheel zooms
_IMGUI_BUTTON = {LEFT: 0, RIGHT: 1, MIDDLE: 2}
_MODIFIER_KEYS = (
    (glfw.MOD_CONTROL, {glfw.KEY_LEFT_CONTROL, glfw.KEY_RIGHT_CONTROL}),
    (glfw.MOD_ALT, {glfw.KEY_LEFT_ALT, glfw.KEY_RIGHT_ALT}),
    (glfw.MOD_SHIFT, {glfw.KEY_LEFT_SHIFT, glfw.KEY_RIGHT_SHIFT}),
)
_AWAY = -3.4e38  # where imgui looks for a pointer that is not there
FOCUSING = 0.5  # seconds after a press on a panel in which a text field there may get the focus
TAKEN_IN = 6  # frames that this takes, at least
_TOLD = {"Enter": "done", "Backspace": "back"}  # keys that a gesture is told of
_NUMBERS = tuple("0123456789.,-+=")  # keys that one types into fields
_ANYWHERE = "save", "quit", "keys"  # actions that go on while a field has the focus, by keys that write nothing


class Router:
    """Feeds imgui and the gesture in progress."""

    def __init__(self, desk: Desk, layout: Layout) -> None:
        self.desk, self.layout = desk, layout
        self.gesture: Gesture | None = None
        self._button = 0
        self._last = PenEvent("lost", 0.0, 0.0)  # what the gesture was told last
        self._panel_buttons: set[int] = set()
        self._keys: set[int] = set()
        self._field_until, self._field_frames = 0.0, 0

    def pointer(self, event: PenEvent) -> None:
        """Takes one pointer event, as the artist prefers it to be felt."""
        desk, told = self.desk, felt(event, self.desk.preferred.now)
        if told is None:
            return
        desk.trial.take(event, told)
        desk.pointer.pressed, event = event.pressure, told
        desk.pointer.pressure = event.pressure
        desk.pointer.x, desk.pointer.y, desk.pointer.pen = event.x, event.y, event.pen
        desk.pointer.eraser = event.eraser
        if self.gesture is not None:
            if event.kind == "lost":
                self.lift()
            elif event.kind in ("move", "wheel") or event.button == self._button:
                self._send(event)
            return
        over_panels = bool(self._panel_buttons) or self.layout.covers(event.x, event.y)
        name = pointer_chord(event, _modifiers(self._keys))
        if event.kind == "lost" or _bound(desk, event, name, over_panels, _busy(desk, self.layout)):
            return
        if event.kind == "down" and event.button in self._panel_buttons:
            self._forget(event.button)
        covered = bool(self._panel_buttons) or self.layout.covers(event.x, event.y)
        desk.pointer.over_canvas = not covered
        io = imgui.get_io()
        io.add_mouse_pos_event(event.x, event.y)
        if event.kind == "wheel":
            self._wheel(event, covered)
        elif event.kind == "down":
            self._press(event, covered)
        elif event.kind == "up" and event.button in self._panel_buttons:
            self._panel_buttons.discard(event.button)
            io.add_mouse_button_event(_IMGUI_BUTTON[event.button], False)

    def _forget(self, button: int) -> None:
        """Lets a button go that is pressed again: nobody told that it was released.  What it was on is not pressed."""
        self._panel_buttons.discard(button)
        io = imgui.get_io()
        io.add_mouse_pos_event(_AWAY, _AWAY)
        io.add_mouse_button_event(_IMGUI_BUTTON[button], False)

    def _wheel(self, event: PenEvent, covered: bool) -> None:
        if covered:
            imgui.get_io().add_mouse_wheel_event(event.dx, event.dy)
        elif event.dy and self.desk.land.on:
            self.desk.land.fly(event.x, event.y, event.dy)
        elif event.dy:
            self.desk.glide.zoom(self.desk.view, event.dy * NOTCH, event.x, event.y)

    def _press(self, event: PenEvent, covered: bool) -> None:
        stroke = self.layout.stroke(self.desk, event.x, event.y) if covered and event.button == LEFT else None
        if stroke is not None:
            self._button = event.button
            self.gesture, self._last = stroke(self.desk, event), event
            self._send(None)
            return
        if covered:
            self._panel_buttons.add(event.button)
            self._field_until, self._field_frames = time.monotonic() + FOCUSING, TAKEN_IN
            imgui.get_io().add_mouse_button_event(_IMGUI_BUTTON[event.button], True)
            return
        self.desk.keys.panel = None
        if not self.layout.dialogs.open:
            imgui.set_window_focus(None)
            self.desk.start.leave()
        self.desk.glide.land()
        self._button = event.button
        self.gesture, self._last = self._chosen(event), event
        imgui.get_io().add_mouse_pos_event(_AWAY, _AWAY)
        self._send(None)

    def _chosen(self, event: PenEvent) -> Gesture:
        """Returns the gesture that this press begins."""
        held = self._keys
        ctrl = bool({glfw.KEY_LEFT_CONTROL, glfw.KEY_RIGHT_CONTROL} & held)
        if self.desk.land.on:
            begin: Callable[[Desk, PenEvent], Gesture] = _on_land(
                self.desk, event, ctrl, glfw.KEY_SPACE in held or self.layout.dialogs.open
            )
        elif glfw.KEY_SPACE in held or event.button == MIDDLE:
            begin = zoom if ctrl else turn if self.desk.pointer.shift else pan
        elif self.layout.dialogs.open:  # one that lies aside: the view moves under it, and nothing else
            begin = zoom if ctrl else pan
        elif event.button == RIGHT:
            begin = pick_or_pop_up
        elif ctrl:
            begin = pick
        elif self.desk.match.marking is not None and self.desk.strip == "match":
            begin = mark
        elif self.desk.examples.swapping:
            begin = swap
        elif self.desk.past.asking:
            begin = ask_here
        elif self.desk.pointer.alt and self.desk.hand.tool == "brush":
            begin = drag_size
        else:
            begin = TOOLS[self.desk.hand.tool].gesture
        return begin(self.desk, event)

    def _send(self, event: PenEvent | None) -> None:
        assert self.gesture is not None
        try:
            if event is None:
                next(self.gesture)
            else:
                self._last = event
                self.gesture.send(event)
        except StopIteration:
            self.gesture = None
        except Exception:
            self.gesture = None  # a fault has ended it
            raise

    def cancel(self) -> None:
        """Ends the gesture in progress as if it had not been."""
        if self.gesture is not None:
            self.gesture.close()
            self.gesture = None

    def lift(self) -> None:
        """Ends a stroke in progress where it is, which stays; every other gesture as if it had not been."""
        if self.gesture is not None:
            self._send(replace(self._last, kind="lost"))
        self.cancel()

    def key(self, key: int, scancode: int, action: int, mods: int) -> None:
        """Takes one key event; those that a text field or a dialog wants are left to it."""
        self.desk.keys.stir()
        if action == glfw.RELEASE:
            self._keys.discard(key)
            _tell_held(self.desk, self._keys)
            return
        self._keys.add(key)
        _tell_held(self.desk, self._keys)
        keys = chord(key, scancode, mods)
        if self.desk.keys.listening:
            self.desk.keys.pressed, self.desk.keys.listening = keys.removeprefix("Escape"), keys != "Escape"
            return
        if keys == "Escape" and self.gesture is not None:
            self.cancel()
            return
        if keys in _TOLD and self.gesture is not None:
            self._send(replace(self._last, kind=_TOLD[keys]))
            return
        dialog = _dialog(self.desk, self.layout)
        if keys == "Escape" and self.layout.popup and not dialog:
            self.layout.dismiss()
            return
        if keys == "Escape" and self.desk.start.shown and not dialog:
            self.desk.start.leave()
            return
        if keys == "Escape" and self.desk.keys.panel is not None and not dialog:
            self.desk.keys.panel = None if not imgui.get_io().want_text_input else self.desk.keys.panel
            return
        busy = _busy(self.desk, self.layout)
        found = by_key(keys)
        if self.desk.keys.panel is not None and found is not ACTIONS["panel_keys"]:
            busy = True  # keys are the panel's
        if not busy and found is not None and self.layout.strip.takes(self.desk, found):
            return
        if found is not None and keys in _NUMBERS and not busy and field_in_sight():
            self.desk.say("Nothing takes what is typed: click a field first, or a slider with Ctrl held")
            return
        if found is not None and (not busy or (_anywhere(keys, found) and not dialog)):
            perform(self.desk, found)

    def lost_focus(self) -> None:
        """Another window is in front: keys are no longer known to be down, nor is what a gesture began with."""
        self._keys.clear()
        _tell_held(self.desk, self._keys)
        self.lift()

    def hover(self) -> None:
        """Finds what the pointer is over, now that the panels are drawn: a dialog may have opened under it."""
        self._field_frames -= 1
        at = self.desk.pointer
        if at.over_canvas and self.gesture is None and self.layout.covers(at.x, at.y):
            at.over_canvas = False

    def left(self) -> None:
        """The pointer is no longer over the window."""
        if self.gesture is None and not self._panel_buttons:
            self.desk.pointer.over_canvas = False
            imgui.get_io().add_mouse_pos_event(_AWAY, _AWAY)

    @property
    def typing(self) -> bool:
        """Tells whether what is typed may be for a text field."""
        field = imgui.get_io().want_text_input or self.layout.dialogs.open or self.layout.popup
        return field or self._field_frames > 0 or time.monotonic() < self._field_until

    @property
    def panning_key(self) -> bool:
        """Tells whether the key is down that makes every press pan."""
        return glfw.KEY_SPACE in self._keys


def _bound(desk: Desk, event: PenEvent, name: str, over_panels: bool, busy: bool) -> bool:
    """Takes a press or a notch of the wheel, `name`, that the list of keys waits for, or that is bound: buttons that
    panels know are theirs over them.  False where it is for others."""
    if desk.keys.listening and name:
        desk.keys.pressed = name
        return True
    strange = event.button not in (0, LEFT, MIDDLE, RIGHT)
    found = by_key(name) if name and not busy and (strange or not over_panels) else None
    if found is not None:
        perform(desk, found)
    return strange or found is not None


def _modifiers(held: set[int]) -> int:
    """Returns which of the keys held are modifiers, as GLFW tells them with keys."""
    return sum(mask for mask, keys in _MODIFIER_KEYS if keys & held)


def _anywhere(keys: str, found: Action) -> bool:
    return found in [ACTIONS[name] for name in _ANYWHERE] and (keys.startswith("Ctrl+") or keys[1:].isdecimal())


def _on_land(desk: Desk, event: PenEvent, ctrl: bool, moves: bool) -> Callable[[Desk, PenEvent], Gesture]:
    """Returns what a press in the picture of the land begins; `moves`: the eye, whatever the button."""
    if moves or event.button == MIDDLE:
        return look_around if desk.pointer.shift else orbit
    if event.button == RIGHT:
        return look_around
    return on_the_land(pick if ctrl else TOOLS[desk.hand.tool].gesture)


def _tell_held(desk: Desk, keys: set[int]) -> None:
    """Tells the desk which of the keys are down that gestures ask for."""
    desk.pointer.shift = bool({glfw.KEY_LEFT_SHIFT, glfw.KEY_RIGHT_SHIFT} & keys)
    desk.pointer.alt = bool({glfw.KEY_LEFT_ALT, glfw.KEY_RIGHT_ALT} & keys)


def _dialog(desk: Desk, layout: Layout) -> bool:
    return layout.dialogs.open or bool(desk.asked.dialog)


def _busy(desk: Desk, layout: Layout) -> bool:
    """Tells whether keys are a dialog's, a list's or a text field's."""
    return bool(_dialog(desk, layout) or layout.popup or imgui.get_io().want_text_input)
