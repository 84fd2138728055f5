"""By what a panel is taken: its topmost header, which is dragged elsewhere or asked for the panel's menu."""

from __future__ import annotations

from typing import NamedTuple

from imgui_bundle import imgui

_FAR = 7.0  # points that a press moves before it drags
_ARROW = 1.8  # ems on the left of a header, which fold it at the press


class Grip(NamedTuple):
    """What the hand does to it now: `dragged`: since this frame; `asked`: for the menu."""

    dragged: bool = False
    asked: bool = False


_waits = False  # whether the next header is a grip
_grip = Grip()


def begin_grip() -> None:
    """The next header that is drawn is a panel's grip."""
    global _waits, _grip
    _waits, _grip = True, Grip()


def note_grip() -> None:
    """Notes what is done to the item just drawn, if it is the one that is waited for."""
    global _waits, _grip
    if _waits:
        far = _FAR * imgui.get_style().font_scale_dpi
        pressed_at = imgui.get_mouse_pos().x - imgui.get_mouse_drag_delta(imgui.MouseButton_.left, 0.0).x
        beside = imgui.get_item_rect_min().x + _ARROW * imgui.get_font_size()
        dragged = imgui.is_item_active() and imgui.is_mouse_dragging(imgui.MouseButton_.left, far)
        dragged = dragged and pressed_at > beside
        _waits, _grip = False, Grip(dragged, imgui.is_item_clicked(imgui.MouseButton_.right))


def end_grip() -> Grip:
    """Returns what is done to the grip; one that is dragged lets go of the press, which would fold the section."""
    global _waits
    _waits = False
    if _grip.dragged:
        imgui.internal.clear_active_id()
    return _grip
