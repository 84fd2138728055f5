"""The small picture of a mask in a row of the panel of layers: a click paints on the mask."""

from __future__ import annotations

from imgui_bundle import ImVec2, imgui

from app import icons, theme
from app.actions import actions
from app.desk.desk import Desk
from app.desk.stack.chosen_layer import choose_layer
from app.language import said
from app.panels.controls import widgets as w
from engine.painting import commands as c
from engine.painting.layering.mask_member import MASK_OFF, MASK_ON, MaskOp
from engine.studio.masked.mask_requests import picture_name
from engine.studio.requests import Do
from engine.studio.results import LayerRow

_HINT = (
    "Click: paint on the mask, white shows, black hides\nAlt: see it alone   Shift: mask off or on\nRight click: more"
)
_MORE = "select_mask", "mask_invert", "mask_off", "mask_lay", "mask_apply", "unmask"  # actions


def draw(desk: Desk, row: LayerRow) -> None:
    """Draws it as wide as it is high, framed while the mask is painted on, crossed out while it is off."""
    side = imgui.get_frame_height()
    corner = imgui.get_cursor_screen_pos()
    pressed = imgui.invisible_button("mask", ImVec2(side, side), imgui.ButtonFlags_.enable_nav)
    w.named(f"mask of {row.name}")
    hovered = imgui.is_item_hovered()
    w.tooltip(_HINT, beside=True)
    edge, end = 2 * desk.scale, ImVec2(corner.x + side, corner.y + side)
    at, to = ImVec2(corner.x + edge, corner.y + edge), ImVec2(end.x - edge, end.y - edge)
    painter, shown = imgui.get_window_draw_list(), desk.pictures.get(picture_name(row.name))
    if shown is None:
        said.add_text(painter, at, theme.packed(theme.look.quiet), icons.MASK)
    else:
        painter.add_image(shown, at, to)
    here = desk.masks.on(row)
    if here or hovered:
        colour = theme.packed(theme.look.accent if here else theme.look.quiet)
        painter.add_rect(corner, end, colour, 2 * desk.scale, thickness=(2 if here else 1) * desk.scale)
    if row.mask_off:
        painter.add_line(at, to, theme.packed(theme.look.warn), 2 * desk.scale)
        painter.add_line(ImVec2(to.x, at.y), ImVec2(at.x, to.y), theme.packed(theme.look.warn), 2 * desk.scale)
    if pressed:
        _pressed(desk, row)
    _more(desk, row)


def _more(desk: Desk, row: LayerRow) -> None:
    """Draws the menu of a mask, whose layer is the active one from then on: the actions are of that."""
    if not imgui.begin_popup_context_item("of the mask"):
        return
    if imgui.is_window_appearing():
        _activate(desk, row)
    for name in _MORE:
        action = actions.ACTIONS[name]
        if said.menu_item(action.title, "", action.checked is not None and action.checked(desk), action.when(desk))[0]:
            actions.perform(desk, action)
        w.named(action.title)
        w.tooltip(actions.tip(name), beside=True)
    imgui.end_popup()


def _activate(desk: Desk, row: LayerRow) -> None:
    if desk.known.scene is not None and desk.known.scene.active != row.name:
        choose_layer(desk, row.name)


def _pressed(desk: Desk, row: LayerRow) -> None:
    keys = imgui.get_io()
    if keys.key_shift:
        desk.post(Do(c.SetLayer(row.name, mask=MaskOp(MASK_ON if row.mask_off else MASK_OFF))))
        return
    _activate(desk, row)
    desk.masks.begin(desk.post, row.name, alone=keys.key_alt and not (desk.masks.on(row) and desk.masks.alone))
