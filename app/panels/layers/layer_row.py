"""What stands in a row of the panel of layers beside the name: the eye, a small picture; and its menu."""

from __future__ import annotations

from imgui_bundle import ImVec2, imgui

from app import icons, theme
from app.actions import actions
from app.desk.desk import Desk
from app.desk.stack.chosen_layer import choose_layer
from app.desk.stack.many_rows import chosen_rows, post_together
from app.desk.stack.row_colours import ROW_COLOURS, colour_rows
from app.language import said
from app.panels.controls import widgets as w
from engine.painting import commands as c
from engine.studio.results import LayerRow
from engine.studio.stack.stack_requests import layer_picture

_EYE = "Show or hide, with all that are chosen along with it\nAlt: show only this, and all again"
_WIDE = 1.4  # of a picture's height
_MORE = (  # actions, by groups
    ("show_only", "duplicate", "show_again", "merge_down", "merge_group", "clear", "adjust"),
    ("clip", "mask_full", "mask_empty", "wrap"),
    ("raise", "lower"),
    ("remove",),
)


def eye(desk: Desk, row: LayerRow) -> None:
    """Draws the eye; with Alt a click shows only this layer, in place of the painting."""
    only = desk.stack.only
    shown = icons.EYE if row.visible or row.name == only else icons.EYE_OFF
    imgui.push_style_var(imgui.StyleVar_.alpha, 1.0 if only in (None, row.name) else 0.4)
    pressed = w.icon_button("eye", shown, "", on=row.name == only)
    imgui.pop_style_var()
    w.tooltip(_EYE, beside=True)
    if pressed and (imgui.get_io().key_alt or row.name == only):
        desk.stack.toggle(desk.post, row.name)
    elif pressed:
        together = chosen_rows(desk) if row.name in desk.stack.many else [row]
        post_together(desk, [c.SetLayer(one.name, visible=not row.visible) for one in together])


def small_picture(desk: Desk, row: LayerRow) -> None:
    """Draws what is painted on the layer; a click chooses it."""
    shown = desk.pictures.get(layer_picture(row.name))
    if shown is None:
        return
    height = imgui.get_frame_height()
    corner, size = imgui.get_cursor_screen_pos(), ImVec2(height * _WIDE, height)
    frame = desk.known.frame
    scale = min(size.x / frame.width, size.y / frame.height)
    wide, high = max(frame.width * scale, 2.0), max(frame.height * scale, 2.0)
    at = ImVec2(round(corner.x + (size.x - wide) / 2), round(corner.y + (size.y - high) / 2))
    to = ImVec2(at.x + round(wide), at.y + round(high))
    if imgui.invisible_button("picture", size, imgui.ButtonFlags_.enable_nav):
        choose_layer(desk, row.name)
    w.named(f"picture of {row.name}")
    imgui.get_window_draw_list().add_image(shown, at, to)
    imgui.same_line(0, 4 * desk.scale)


def menu(desk: Desk, row: LayerRow) -> bool:
    """Draws what a right click on the item just drawn opens: of the row's layer, which is the active one from then on.
    Returns whether it is to be called otherwise."""
    imgui.push_style_var(imgui.StyleVar_.window_padding, ImVec2(8 * desk.scale, 6 * desk.scale))
    imgui.push_style_var(imgui.StyleVar_.item_spacing, ImVec2(8 * desk.scale, 5 * desk.scale))
    rename = imgui.begin_popup_context_item("of the layer")
    if rename:
        rename = _items(desk, row)
        imgui.end_popup()
    imgui.pop_style_var(2)
    return rename


def _colours(desk: Desk, row: LayerRow) -> None:
    """Draws the colours that a row can have, or all that are chosen along with it."""
    side, now = imgui.get_text_line_height(), desk.stack.colours.get(row.name, "")
    for colour, rgb in ROW_COLOURS.items():
        hint = "No colour for the row" if colour == now else f"Colour the row {colour}"
        if w.swatch(f"row {colour}", rgb, hint, (side, side)):
            names = list(desk.stack.many) if row.name in desk.stack.many else [row.name]
            colour_rows(desk, names, "" if colour == now else colour)
            imgui.close_current_popup()
        if colour == now:
            painter, white = imgui.get_window_draw_list(), theme.packed((1.0,) * 3)
            painter.add_rect(
                imgui.get_item_rect_min(), imgui.get_item_rect_max(), white, 2.0, thickness=1.5 * desk.scale
            )
        imgui.same_line(0, 4 * desk.scale)
    imgui.new_line()
    imgui.separator()


def row_colour(desk: Desk, row: LayerRow) -> None:
    """Draws the row's colour as a bar at its left end, before all else of it."""
    colour = ROW_COLOURS.get(desk.stack.colours.get(row.name, ""))
    if colour is not None:
        corner, height = imgui.get_cursor_screen_pos(), imgui.get_frame_height()
        left, wide = corner.x - 3 * desk.scale, imgui.get_content_region_avail().x + 3 * desk.scale
        painter, low = imgui.get_window_draw_list(), corner.y + height
        painter.add_rect_filled(ImVec2(left, corner.y), ImVec2(left + wide, low), theme.packed(colour, 0.16))
        painter.add_rect_filled(ImVec2(left, corner.y), ImVec2(left + 3 * desk.scale, low), theme.packed(colour))


def _items(desk: Desk, row: LayerRow) -> bool:
    if imgui.is_window_appearing() and desk.known.scene is not None and desk.known.scene.active != row.name:
        if row.name not in desk.stack.many:
            desk.stack.many = set()
        choose_layer(desk, row.name)
    _colours(desk, row)
    rename = said.menu_item("Rename", "", False)[0]
    w.named("Rename")
    w.tooltip("Call it otherwise; a double click does so, too", beside=True)
    for number, group in enumerate(_MORE):
        if number:
            imgui.separator()
        for name in group:
            action = actions.ACTIONS[name]
            checked = action.checked is not None and action.checked(desk)
            key = action.keys[0] if action.keys else ""
            if said.menu_item(action.title, key, checked, action.when(desk))[0]:
                actions.perform(desk, action)
            w.named(action.title)
            w.tooltip(action.hint, beside=True)
    return rename
