"""What is dragged off a panel: where it may be let go on the canvas, and a colour that is, which fills the region."""

from __future__ import annotations

from imgui_bundle import imgui

from app import theme
from app.desk.colours import RGB
from app.desk.desk import Desk
from app.tools.filling_gestures import drop_colour

_ANY = (
    imgui.HoveredFlags_.any_window
    | imgui.HoveredFlags_.allow_when_blocked_by_active_item
    | imgui.HoveredFlags_.allow_when_blocked_by_popup
)


def over_canvas(desk: Desk) -> bool:
    """Whether the pointer is over the canvas, and over no panel, popup or dialog that floats there."""
    at, (left, top, right, bottom) = imgui.get_mouse_pos(), desk.free_area()
    return left <= at.x < right and top <= at.y < bottom and not imgui.is_window_hovered(_ANY)


def is_let_go() -> bool:
    """Whether the item just drawn is no longer held, by the pointer: keys press patches, too, wherever that is."""
    return imgui.is_item_deactivated() and imgui.is_mouse_released(imgui.MouseButton_.left)


def carry_colour(desk: Desk, rgb: RGB) -> None:
    """Takes the patch just drawn along with the pointer; where that lets it go on the canvas, it fills the region."""
    if not over_canvas(desk):
        return
    at = imgui.get_mouse_pos()
    if is_let_go():
        drop_colour(desk, rgb, at.x, at.y)
    elif imgui.is_item_active() and imgui.is_mouse_down(imgui.MouseButton_.left):
        painter, radius = imgui.get_foreground_draw_list(), 9.0 * desk.scale
        painter.add_circle_filled(at, radius, theme.packed(rgb))
        painter.add_circle(at, radius, theme.packed((1.0, 1.0, 1.0)), 0, 1.5 * desk.scale)
