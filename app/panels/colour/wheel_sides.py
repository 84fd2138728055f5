"""What stands beside the wheel: on its left how it is set and the paper's colour, on its right shades of the colour."""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache

from imgui_bundle import ImVec2, imgui

from app import icons, theme
from app.desk.colours import RGB, from_hex, to_hex
from app.desk.desk import Desk
from app.desk.holding.gamut_mask import MASK_SHAPES, shaped_mask
from app.desk.holding.harmonies import HARMONIES, SHADES, shades
from app.desk.holding.kept_desk import change_kept
from app.desk.holding.wheel_record import WheelSet
from app.language import said
from app.panels.controls import widgets as w
from app.panels.controls.dragged_off import carry_colour

_WIDEST = 1.25  # of a control's height: a shade
_BARE = (1.0, 1.0, 1.0)  # what a painting without paper is painted on


def draw_left(desk: Desk, hue: float) -> None:
    """Draws the buttons, and the paper's colour, from where the present window's cursor is."""
    wheel, side = desk.kept.wheel, imgui.get_frame_height()
    start, step = imgui.get_cursor_screen_pos(), side + 4 * desk.scale
    hint = "A disc of hue and chroma, or a ring of hues around a triangle"
    if w.icon_button("disc wheel", icons.ELLIPSE, hint, on=wheel.disc, size=side):
        _set(desk, replace(wheel, disc=not wheel.disc, masked=False))
    imgui.set_cursor_screen_pos(ImVec2(start.x, start.y + step))
    if w.icon_button(
        "harmony", icons.SHAPES, "Colours that go with this one, marked on the wheel", on=bool(wheel.harmony)
    ):
        imgui.open_popup("harmonies")
    imgui.set_cursor_screen_pos(ImVec2(start.x, start.y + 2 * step))
    if w.icon_button(
        "gamut mask", icons.POLYGON, "A mask on the disc: only colours within it are picked", on=wheel.masked
    ):
        imgui.open_popup("masks")
    _harmonies(desk, wheel)
    _masks(desk, wheel, hue)
    imgui.set_cursor_screen_pos(ImVec2(start.x, start.y + 3 * step))
    paper = desk.known.paper
    colour = _BARE if paper is None else from_hex(paper)
    hint = "The colour of the paper" if paper else "White: this painting has no paper (Edit > Paper)"
    if w.swatch("paper swatch", colour, hint, (side, side)):
        desk.hand.colour = colour


def draw_right(desk: Desk, tall: float, wide: float) -> RGB | None:
    """Draws two columns of shades, the lightest on top, duller ones on the right; returns the one pressed."""
    gap, picked = 2 * desk.scale, None
    across = min((wide - gap) / 2, _WIDEST * imgui.get_frame_height())
    down = (tall - gap * (SHADES - 1)) / SHADES
    start, painter = imgui.get_cursor_screen_pos(), imgui.get_window_draw_list()
    left = start.x + wide - 2 * across - gap
    for column, row in enumerate(_shades(desk.hand.colour)):
        for i, rgb in enumerate(row):
            at = ImVec2(left + column * (across + gap), start.y + (SHADES - 1 - i) * (down + gap))
            end = ImVec2(at.x + across, at.y + down)
            imgui.set_cursor_screen_pos(at)
            if imgui.invisible_button(f"shade {column} {i}", ImVec2(across, down), imgui.ButtonFlags_.enable_nav):
                picked = rgb
            carry_colour(desk, rgb)
            w.named(f"{'duller' if column else 'shade'} {i + 1}")
            w.tooltip(f"{_word(column, i)}\n{to_hex(rgb)}")
            painter.add_rect_filled(at, end, theme.packed(rgb), 2.0)
            if not column and i == SHADES // 2:
                painter.add_rect(at, end, theme.packed((1.0,) * 3), 2.0, thickness=desk.scale)
    return picked


@lru_cache(maxsize=4)
def _shades(rgb: RGB) -> tuple[tuple[RGB, ...], tuple[RGB, ...]]:
    return shades(rgb)


def _word(column: int, i: int) -> str:
    light = ("Darker", "The present colour" if not column else "As light", "Lighter")[
        1 + (i > SHADES // 2) - (i < SHADES // 2)
    ]
    return f"{light}, duller" if column else light


def _harmonies(desk: Desk, wheel: WheelSet) -> None:
    if not imgui.begin_popup("harmonies"):
        return
    for name, row in HARMONIES.items():
        if said.selectable(row.title, name == wheel.harmony)[0]:
            _set(desk, replace(wheel, harmony=name))
        w.named(row.title)
        w.tooltip(row.hint)
    imgui.end_popup()


def _masks(desk: Desk, wheel: WheelSet, hue: float) -> None:
    if not imgui.begin_popup("masks"):
        return
    changed, on = w.tick("Pick within the mask", wheel.masked, "Off: all colours can be picked; the mask is kept")
    if changed:
        corners = wheel.corners or shaped_mask("triangle", hue)
        _set(desk, replace(wheel, corners=corners, masked=on, disc=True))
    imgui.separator()
    for name, row in MASK_SHAPES.items():
        if said.selectable(row.title, False)[0]:
            _set(desk, replace(wheel, corners=shaped_mask(name, hue), masked=True, disc=True))
        w.named(row.title)
        w.tooltip(f"{row.hint}\nIt is turned towards the present hue; drag its corners to reshape it")
    imgui.end_popup()


def _set(desk: Desk, wheel: WheelSet) -> None:
    change_kept(desk, replace(desk.kept, wheel=wheel))
