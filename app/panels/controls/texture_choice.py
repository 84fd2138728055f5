"""Textures to choose from: a picture and a name each, by where they come from."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from imgui_bundle import ImVec2, imgui
from immutables import Map

from app import theme
from app.desk.colours import to_hex
from app.desk.desk import Desk
from app.language import said
from app.panels.controls import texture_rows
from app.panels.controls import widgets as w
from app.panels.controls.dragged_off import is_let_go, over_canvas
from app.tools.filling_gestures import drop_texture
from engine.brush.parts import Component, Surface
from engine.brush.settings import Brush
from engine.studio.requests import Swatch

_PICTURE = (44, 28)  # of a texture, points
NAME = 116  # width of its name, points
ACROSS = 2
PERIOD = 96.0  # pixels, at most, that a texture's repeat has in its picture
_DARK, _LIGHT = "#22262c", "#f2f2f2"  # what it leads from and to


def chooser(desk: Desk, texture: str, hint: str, width: float = -1.0) -> str | None:
    """Returns a drop-down of all textures but plain white; the name chosen now, or None."""
    imgui.set_next_item_width(width)
    known = any(name == texture for name, _ in texture_rows.names(desk))
    shown = texture_rows.label(desk, texture) + ("" if known else " (not here)")
    limit(desk)
    if not said.begin_combo("##texture", shown, imgui.ComboFlags_.height_largest):
        w.tooltip(hint)
        return None
    chosen = listed(desk, texture, ("white",))
    imgui.end_combo()
    return chosen


def surface(desk: Desk, part: Surface, hint: str) -> Surface:
    """Returns a drop-down of the papers and, below them, of all textures but plain white; the surface chosen now, or
    `part`."""
    same = next((one.name for one in desk.known.papers if one.grain.texture == part.texture), "")
    paper = next((one.name for one in desk.known.papers if one.grain == part), "")
    imgui.set_next_item_width(-1)
    limit(desk)
    shown = paper or (f"{same}, changed" if same else texture_rows.label(desk, part.texture))
    if not said.begin_combo("##surface", shown, imgui.ComboFlags_.height_largest):
        w.tooltip(hint)
        return part
    said.text_disabled("Papers")
    chosen = part
    for i, one in enumerate(desk.known.papers):
        if i % ACROSS:
            imgui.same_line()
        if _row(desk, one.grain.texture, one.name, "", one.name == paper):
            texture_rows.bring(desk, one.grain.texture)
            chosen = one.grain
    name = listed(desk, "" if same else part.texture, ("white", *(one.grain.texture for one in desk.known.papers)))
    if name and name != part.texture:
        chosen = replace(part, texture=name, parameters=Map())
    imgui.end_combo()
    return chosen


def limit(desk: Desk) -> None:
    """Keeps the pop-up opened next from reaching out of the window: a longer list scrolls."""
    imgui.set_next_window_size_constraints(ImVec2(0, 0), ImVec2(1e6, 0.55 * desk.view.height))


def listed(desk: Desk, current: str = "", without: tuple[str, ...] = ()) -> str | None:
    """Returns all textures, in the present pop-up; the one chosen now, which the painting gets if it lacks it."""
    chosen = None
    for title, rows in texture_rows.groups(desk):
        shown = [row for row in rows if row[0] not in without]
        if shown:
            said.text_disabled(title)
        for i, (name, hint) in enumerate(shown):
            if i % ACROSS:
                imgui.same_line()
            if _row(desk, name, texture_rows.label(desk, name), hint, name == current):
                chosen = name
    if chosen:
        texture_rows.bring(desk, chosen)
    return chosen


def _row(desk: Desk, name: str, label: str, hint: str, on: bool) -> bool:
    """Returns a texture's picture beside a label, to be pressed."""
    scale, corner = desk.scale, imgui.get_cursor_screen_pos()
    wide, tall = (size * scale for size in _PICTURE)
    pressed = said.selectable(f"##{label} {name}", on, 0, ImVec2(wide + NAME * scale, tall))[0]
    w.named(f"texture {label}")
    w.tooltip(f"{label}\n{hint}\nDrag it into a region to fill that".strip())
    if _dragged(desk, name):
        imgui.close_current_popup()
    if not imgui.is_item_visible():
        return pressed
    painter, end = imgui.get_window_draw_list(), ImVec2(corner.x + wide, corner.y + tall)
    shown = _picture(desk, name)
    painter.add_rect_filled(corner, end, theme.packed(theme.look.field), 3 * scale)
    if shown is not None:
        zero, one, white = ImVec2(0, 0), ImVec2(1, 1), theme.packed((1.0, 1.0, 1.0))
        painter.add_image_rounded(shown, corner, end, zero, one, white, 3 * scale)
    at = ImVec2(end.x + 7 * scale, corner.y + (tall - imgui.get_font_size()) / 2)
    painter.push_clip_rect(corner, ImVec2(end.x + NAME * scale, end.y), True)
    said.add_text(painter, at, theme.packed(theme.look.text), label)
    painter.pop_clip_rect()
    return pressed


def _dragged(desk: Desk, name: str) -> bool:
    """Takes the picture of the texture just drawn along with the pointer; True where that lets it go on the canvas,
    whose region it fills."""
    if not over_canvas(desk):
        return False
    at = imgui.get_mouse_pos()
    if is_let_go():
        pictured = any(
            row.name == texture_rows.texture_kind(desk, name) and row.pictured for row in desk.known.tables.kinds
        )
        part = Component(name, 1.0, _LIGHT if pictured else to_hex(desk.hand.other_colour))
        drop_texture(desk, texture_rows.brought(desk, name), part, at.x, at.y)
        return True
    if imgui.is_item_active():
        shown, painter = desk.pictures.get(f"texture {name}"), imgui.get_foreground_draw_list()
        wide, tall = (size * desk.scale / 2 for size in _PICTURE)
        corner, end = ImVec2(at.x - wide, at.y - tall), ImVec2(at.x + wide, at.y + tall)
        if shown is not None:
            painter.add_image(shown, corner, end)
        painter.add_rect(corner, end, theme.packed((1.0, 1.0, 1.0)), 0.0, thickness=1.5 * desk.scale)
    return False


def _picture(desk: Desk, name: str) -> Any:
    """Returns its picture if there is one; asks for it when it is not of the texture that is meant now."""
    ident, meant = f"texture {name}", texture_rows.meant(desk, name)
    if desk.known.ready and desk.sampled.get(name) != meant:
        desk.sampled[name] = meant
        period = {row.name: row for row in texture_rows.rows(desk, name)}.get("period")
        usual = texture_rows.own(desk, name).get("period", period.default if period else PERIOD)
        given = Map() if period is None else Map(period=max(period.lo, min(usual, round(PERIOD * desk.scale))))
        brush = Brush(16.0, colour=_DARK, ink=(Component(name, 1.0, _LIGHT, given),))
        size = (int(_PICTURE[0] * desk.scale), int(_PICTURE[1] * desk.scale))
        desk.post(Swatch(ident, brush, size, "fill", textures=texture_rows.brought(desk, name), soon=True))
    return desk.pictures.get(ident)
