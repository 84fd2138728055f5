"""Painting with an example, in the brush panel: which one, how large, at what depth; and what the eraser takes."""

from __future__ import annotations

from imgui_bundle import ImVec2, imgui

from app import icons, theme
from app.actions.actions import tip
from app.desk.desk import Desk
from app.desk.examples import chart_use, example_use, thumbnails
from app.desk.examples.example_state import DEPTHS
from app.language import said
from app.panels.controls import widgets as w

_SIZES = (
    ("-2", "¼", "A quarter as large; zooming in shows the rest of its detail"),
    ("-1", "½", "Half as large; zooming in shows the rest of its detail"),
    ("0", "1", "As large as it is, in pixels of the zoom it was chosen at"),
    ("1", "2", "Twice as large"),
    ("2", "4", "Four times as large"),
)
_FOLLOW = "The texture runs the way each stroke goes: for thatch, fur, hair. Stroke over it again to comb it"
_TELL = "What strokes tell this map of the example: parts as dark or light grow. At the left end, its mean"
_DEPTH = (
    "At the same depth the same texture joins, another takes its place. A greater depth lies over what is there, a "
    "smaller one goes under it"
)


def draw(desk: Desk) -> None:
    """Draws the example's own settings, in place of those that do not count for it."""
    _shown(desk)
    state, side, gap = desk.examples, imgui.get_frame_height(), 2 * desk.scale
    imgui.align_text_to_frame_padding()
    said.text_disabled("Size")
    imgui.same_line(48 * desk.scale + imgui.get_style().window_padding.x)
    picked = w.segments("size", str(state.size), _SIZES, imgui.get_content_region_avail().x - side - gap)
    if picked is not None:
        state.size = int(picked)
        example_use.follow(desk)
    imgui.same_line(0, gap)
    fits = state.base == desk.view.shown_level
    hint = "Fit to this zoom: the texture gets the pixels that are seen now. Strokes of another size do not join"
    if w.icon_button("fit texture", icons.FIT, hint, enabled=not fits, size=side):
        example_use.fit_size(desk)
    changed, depth = w.stepper("Depth", state.depth, DEPTHS, _DEPTH)
    if changed:
        state.depth = depth
        example_use.follow(desk)
    changed, on = w.tick("Follow the pen", state.follows and chart_use.runs(state, state.entry), _FOLLOW)
    if changed:
        example_use.set_following(desk, on)
    for name in chart_use.shades(state):
        told = chart_use.told_number(desk.hand.brush, name)
        form = "as it is" if told is None else "%.0f%%"
        changed, value = w.slider(
            f"Map {name}", -1.0 if told is None else 100.0 * told, (-1.0, 100.0), _TELL, form=form
        )
        if changed:
            example_use.tell_number(desk, name, None if value < 0.0 else round(value) / 100.0)


def draw_eraser(desk: Desk) -> None:
    """Draws what the eraser takes of what was painted with examples."""
    state = desk.examples
    hint = "Erases only what was painted with examples at one depth; paint stays"
    changed, on = w.tick("One depth only", state.eraser is not None, hint)
    if changed:
        state.eraser = state.depth if on else None
    if state.eraser is not None:
        changed, depth = w.stepper("Depth", state.eraser, DEPTHS, "The depth that is erased")
        state.eraser = depth if changed else state.eraser


def _shown(desk: Desk) -> None:
    """Draws the example that is painted with; a click opens the palette."""
    entry = desk.examples.entry
    ours = entry is not None and desk.hand.brush.example is not None
    side, scale = 40 * desk.scale, desk.scale
    corner, wide = imgui.get_cursor_screen_pos(), imgui.get_content_region_avail().x
    pressed = imgui.invisible_button("example", ImVec2(wide, side), imgui.ButtonFlags_.enable_nav)
    hovered = imgui.is_item_hovered()
    w.tooltip(tip("examples"))
    if pressed:
        desk.strip, desk.examples.tab = "examples", "palette"
    painter, end = imgui.get_window_draw_list(), ImVec2(corner.x + wide, corner.y + side)
    painter.add_rect_filled(corner, end, theme.packed(theme.look.hover if hovered else theme.look.raised), 4 * scale)
    picture = desk.pictures.get(thumbnails.ident(entry)) if entry is not None and ours else None
    if picture is not None:
        square = ImVec2(corner.x + side, corner.y + side)
        white = theme.packed((1.0, 1.0, 1.0))
        painter.add_image_rounded(picture, corner, square, ImVec2(0, 0), ImVec2(1, 1), white, 4 * scale)
    text = entry.title if entry is not None and ours else desk.hand.brush.example or "Choose an example"
    at = ImVec2(corner.x + side + 9 * scale, corner.y + (side - imgui.get_font_size()) / 2)
    painter.push_clip_rect(corner, ImVec2(end.x - 24 * scale, end.y), True)
    said.add_text(painter, at, theme.packed(theme.look.text), text)
    painter.pop_clip_rect()
    sign = ImVec2(end.x - 21 * scale, corner.y + (side - imgui.get_font_size()) / 2)
    said.add_text(painter, sign, theme.packed(theme.look.quiet), icons.GRID)
