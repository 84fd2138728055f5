"""The palette below the colours: which one, its swatches, and the ways in and out."""

from __future__ import annotations

from imgui_bundle import ImVec2, imgui

from app import icons, theme
from app.desk.colours import to_hex
from app.desk.desk import Desk
from app.desk.holding.palette_making import ask_palette_of_view
from app.desk.holding.palette_shelf import palette_to_write, show_palette, shown_palette
from app.language import said
from app.panels.controls import widgets as w
from app.panels.controls.dragged_off import carry_colour
from engine.files.swatches.colour_list import ColourList

_ACROSS = 12
_ROWS = 4.5  # of swatches in sight; half a row shows that there are more


def draw_palette(desk: Desk) -> None:
    """Draws it into the present window."""
    gap, side = 3 * desk.scale, imgui.get_frame_height()
    room = imgui.get_content_region_avail().x - 3 * (side + gap)
    options = [("", "No palette"), *((palette.name, palette.name) for palette in desk.known.palettes)]
    shown = shown_palette(desk)
    picked = w.choice("palette", shown.name if shown else "", options, "The palette that is shown here", room)
    if picked is not None:
        show_palette(desk, picked)
    imgui.same_line(0, gap)
    if w.icon_button("bring palette", icons.FOLDER, "Bring in a palette: .gpl, .aco, .ase or .kpl", size=side):
        desk.asked.show("palette from")
    imgui.same_line(0, gap)
    if w.icon_button("make palette", icons.IMAGE, "Make a palette of the colours of a picture", size=side):
        imgui.open_popup("make palette of")
    _making(desk)
    imgui.same_line(0, gap)
    hint = "Write this palette as .gpl, or the colours painted with where none is shown"
    if w.icon_button("write palette", icons.DISK, hint, size=side, enabled=bool(palette_to_write(desk).colours)):
        desk.asked.show("palette to")
    if shown is not None:
        _swatches(desk, shown)


def _making(desk: Desk) -> None:
    """Draws what a palette can be made of."""
    if not imgui.begin_popup("make palette of"):
        return
    if said.selectable("A picture file…", False)[0]:
        desk.asked.show("palette of picture")
    w.named("A picture file…")
    w.tooltip("A PNG, JPEG or TIFF: up to 24 colours that stand for all of it")
    imgui.begin_disabled(not desk.known.ready)
    if said.selectable("What is in view", False)[0]:
        ask_palette_of_view(desk)
    w.named("What is in view")
    w.tooltip("The colours of the painting that the canvas shows now, with its paper")
    imgui.end_disabled()
    imgui.end_popup()


def _swatches(desk: Desk, palette: ColourList) -> None:
    """Draws the colours in rows, as many in a row as the file asks for, if it asks for few."""
    gap = 2 * desk.scale
    across = palette.columns if 0 < palette.columns <= 2 * _ACROSS else _ACROSS
    inner = imgui.get_content_region_avail().x
    rows = -(-len(palette.colours) // across)
    wide = inner - (imgui.get_style().scrollbar_size if rows > _ROWS else 0.0)
    side = min((wide - gap * (across - 1)) / across, 1.7 * imgui.get_font_size())
    imgui.begin_child("palette", ImVec2(0, min(rows, _ROWS) * (side + gap)))
    corner, painter, now = imgui.get_cursor_screen_pos(), imgui.get_window_draw_list(), to_hex(desk.hand.colour)
    top = imgui.get_scroll_y()
    for i, (rgb, name) in enumerate(palette.colours):
        x, y = (i % across) * (side + gap), (i // across) * (side + gap)
        if not -side <= y - top <= imgui.get_window_height():
            continue
        at = ImVec2(corner.x + x, corner.y + y)
        end = ImVec2(at.x + side, at.y + side)
        painter.add_rect_filled(at, end, theme.packed(rgb), 2.0)
        if to_hex(rgb) == now:
            painter.add_rect(at, end, theme.packed((1.0,) * 3), 2.0, thickness=1.5 * desk.scale)
        imgui.set_cursor_screen_pos(at)
        if imgui.invisible_button(f"swatch {i}", ImVec2(side, side), imgui.ButtonFlags_.enable_nav):
            desk.hand.colour = rgb
        carry_colour(desk, rgb)
        w.named(f"swatch {i + 1}")
        w.tooltip(f"{name}\n{to_hex(rgb)}" if name else to_hex(rgb))
    imgui.set_cursor_screen_pos(ImVec2(corner.x, corner.y + rows * (side + gap) - gap))
    imgui.dummy(ImVec2(1, 1))
    imgui.end_child()
