"""The ink mixer: textures stirred into the brush's colour, with a picture of what comes out."""

from __future__ import annotations

from dataclasses import replace

from imgui_bundle import ImVec2, imgui

from app import icons, theme
from app.desk import palette
from app.desk.colours import to_hex
from app.desk.desk import Desk
from app.desk.examples.following import Following
from app.desk.hand import mixed_now
from app.desk.holding import dipping
from app.desk.outside import pictured
from app.language import said
from app.panels.controls import texture_choice, texture_rows
from app.panels.controls import widgets as w
from app.panels.controls.colour_popup import colour_popup
from app.panels.controls.curve_editor import CurveEditor
from app.panels.controls.kept_switch import kept_switch
from app.panels.controls.late_picture import draw_late
from engine.brush.settings import COMPONENTS_CAP, Brush, Component
from engine.studio.requests import Swatch

DEEPER = 4  # levels: how far the second half of the picture is zoomed in
SWATCH_WIDTH, SWATCH_HEIGHT = 135, 46  # of each half, points
_ARROW = 2.6  # of a letter: what stands before the header's title, and a gap behind it
_COLOURS = {"white": "#ffffff", "rock": "#7a6f63", "stripes": "#20242c", "sawtooth": "#f0e2c0", "squares": "#f2f2f2"}


class InkPanel:
    """Ink is the brush's colour plus textures, each with an amount and a colour of its own."""

    def __init__(self) -> None:
        self._curves, self._following = CurveEditor(), Following()

    def wants(self, desk: Desk, now: float) -> None:
        """Asks for the ink as painted, and much nearer."""
        brush, lab = desk.hand.dipped(), desk.lab.scene
        plain = Brush(16.0, colour=brush.colour, ink=brush.ink, shaping=brush.shaping)
        if self._following.due((plain, 0 if lab is None else lab.version), now):
            lacking, size = palette.lacking(desk), (int(SWATCH_WIDTH * desk.scale), int(SWATCH_HEIGHT * desk.scale))
            desk.awaited.ask("ink")
            desk.post(Swatch("ink", plain, size, "fill", textures=lacking, soon=True))
            desk.post(Swatch("ink near", plain, size, "fill", DEEPER, lacking, soon=True))

    def draw(self, desk: Desk) -> None:
        """Draws it into the present window."""
        corner, room = imgui.get_cursor_pos(), imgui.get_content_region_avail().x
        if not w.section("Ink mixer", "Textures in the paint; they show new detail as you zoom in", shared=True):
            return
        self._adder(desk, corner.x + room)
        self._picture(desk)
        self._welcome(desk)
        removed = None
        for i, component in enumerate(mixed_now(desk.hand).ink):
            imgui.push_id(i)
            changed, keep = self._component(desk, component)
            imgui.pop_id()
            if not keep:
                removed = i
            elif changed is not component:
                desk.hand.take(dipping.with_ink(desk.hand.brush, to_hex(desk.hand.colour), i, changed))
        if removed is not None:
            desk.hand.change(ink=(*desk.hand.brush.ink[:removed], *desk.hand.brush.ink[removed + 1 :]))
        if desk.hand.brush.ink:
            hint = "A curve that all these textures go through: harder, softer, turned round"
            reshaped, curve = self._curves.row(
                "Shaping of all", desk.hand.brush.shaping, desk.known.tables.curves, hint
            )
            if reshaped:
                desk.hand.change(shaping=curve)
        self._extent(desk)

    def _picture(self, desk: Desk) -> None:
        """Draws the ink as painted, and beside it 16 times nearer."""
        width = imgui.get_content_region_avail().x
        height = SWATCH_HEIGHT * desk.scale
        corner = imgui.get_cursor_screen_pos()
        imgui.dummy(ImVec2(width, height))
        w.tooltip(f"The ink as painted, and {1 << DEEPER} times nearer")
        painter = imgui.get_window_draw_list()
        for i, name in enumerate(("ink", "ink near")):
            left = corner.x + i * (width / 2 + desk.scale)
            end = ImVec2(left + width / 2 - desk.scale, corner.y + height)
            painter.add_rect_filled(ImVec2(left, corner.y), end, theme.packed(theme.look.field), 4 * desk.scale)
            if name in desk.pictures:
                painter.add_image_rounded(
                    desk.pictures[name],
                    ImVec2(left, corner.y),
                    end,
                    ImVec2(0, 0),
                    ImVec2(1, 1),
                    -1 & 0xFFFFFFFF,
                    4 * desk.scale,
                )
        draw_late(desk, "ink", corner, ImVec2(corner.x + width, corner.y + height))

    def _component(self, desk: Desk, component: Component) -> tuple[Component, bool]:
        """Draws one row; (the component as it is now, whether it stays)."""
        side, gap = imgui.get_frame_height(), imgui.get_style().item_spacing.x
        if w.swatch("colour", component.rgb, "The colour this texture leads to", (side, side)):
            imgui.open_popup("tint")
        rgb = colour_popup("tint", component.rgb)
        if rgb is not None:
            component = replace(component, colour=to_hex(rgb))
        imgui.same_line()
        name = texture_rows.label(desk, component.texture)
        room = imgui.get_content_region_avail().x - 3 * side - 3 * gap
        imgui.push_style_var(imgui.StyleVar_.cell_padding, ImVec2(0, 0))
        imgui.begin_child("amount", ImVec2(room, side))
        changed, amount = w.slider(name, component.amount * 100, (0.0, 100.0), "How much of it", form="%.0f%%")
        imgui.end_child()
        imgui.pop_style_var()
        if changed:
            component = replace(component, amount=round(amount / 100, 4))
        imgui.same_line()
        kept = kept_switch(dipping.is_fixed(component))
        if kept != dipping.is_fixed(component):
            component = dipping.fix(component, kept)
        imgui.same_line()
        if w.icon_button("more", icons.SLIDERS, "Its own settings"):
            imgui.open_popup("settings")
        component = self._parameters(desk, component)
        imgui.same_line()
        return component, not w.icon_button("drop", icons.CLOSE, "Take it out of the ink")

    def _parameters(self, desk: Desk, component: Component) -> Component:
        imgui.set_next_window_size(ImVec2(imgui.get_font_size() * 17, 0))
        if not imgui.begin_popup("settings"):
            return component
        said.text_disabled(texture_rows.label(desk, component.texture))
        parameters = texture_rows.sliders(desk, component.texture, component.parameters)
        if parameters != component.parameters:
            component = replace(component, parameters=parameters)
        if texture_rows.texture_kind(desk, component.texture) == "series":
            component = _pressing(component)
        hint = "A curve that this texture's values go through: harder, softer, turned round"
        changed, curve = self._curves.row("Shaping", component.shaping, desk.known.tables.curves, hint)
        if changed:
            component = replace(component, shaping=curve)
        imgui.end_popup()
        return component

    def _extent(self, desk: Desk) -> None:
        """Scattered textures can keep their marks whole at the stroke's rim."""
        if desk.hand.brush.extent or any(
            texture_rows.texture_kind(desk, part.texture) == "sparse" for part in desk.hand.brush.ink
        ):
            changed, on = said.checkbox("Whole marks at the rim", desk.hand.brush.extent)
            w.named("Whole marks at the rim")
            w.tooltip("The rim of a stroke takes the shape of the texture's marks: none is cut")
            if changed:
                desk.hand.change(extent=on)

    def _adder(self, desk: Desk, right: float) -> None:
        """Draws the button at the right end of the header just drawn: it stays where it is however many are stirred
        in."""
        full, below = len(desk.hand.brush.ink) >= COMPONENTS_CAP, imgui.get_cursor_pos()
        label, padding = f"{icons.ADD}  Add texture", ImVec2(8, 1) * imgui.get_style().font_scale_dpi
        taken = imgui.get_style().window_padding.x + said.calc_text_size("Ink mixer").x + imgui.get_font_size() * _ARROW
        wide = said.calc_text_size(label).x + 2 * padding.x
        if right - wide < taken:  # the title of some languages leaves room for the sign alone
            label, wide, padding = f"{icons.ADD}##Add texture", imgui.get_text_line_height() * 1.25, padding / 4
        imgui.same_line(right - wide)
        imgui.set_cursor_pos_y(imgui.get_cursor_pos_y() - 2)
        imgui.push_style_var(imgui.StyleVar_.frame_padding, padding)
        enabled = bool(desk.known.tables.kinds) and not full
        pressed = w.text_button(label, "Add a texture: it is stirred into the paint", enabled=enabled, width=wide)
        imgui.pop_style_var()
        if pressed:
            imgui.open_popup("add texture")
        imgui.set_cursor_pos(below)
        texture_choice.limit(desk)
        if not imgui.begin_popup("add texture"):
            return
        if said.selectable("Picture from a file…", False)[0]:
            desk.asked.show("texture picture")
        w.named("Picture from a file…")
        w.tooltip("Paint with a PNG, JPEG or TIFF; it repeats, and shows its own detail as you zoom in")
        if said.selectable("What is in view", False)[0]:
            pictured.from_view(desk)
        w.named("What is in view")
        w.tooltip("Paint with what the canvas shows now, finer detail included")
        imgui.separator()
        name = texture_choice.listed(desk)
        if name:
            part = Component(name, 0.6, _COLOURS.get(name, "#ffffff"))
            mixed = mixed_now(desk.hand)
            desk.hand.take(replace(mixed, ink=(*mixed.ink, part)))
        imgui.end_popup()

    def _welcome(self, desk: Desk) -> None:
        """A picture that was asked for is a texture now: it joins the ink."""
        name, scene = desk.asked.texture, desk.known.scene
        if not name or scene is None or name not in scene.textures:
            return
        part, desk.asked.texture = dipping.fix(Component(name, 1.0, "#ffffff")), ""
        if len(desk.hand.brush.ink) < COMPONENTS_CAP:
            desk.hand.change(ink=(*desk.hand.brush.ink, part))


def _pressing(component: Component) -> Component:
    """Returns a box to tick: a series of textures whose weight follows the pen."""
    pressed = isinstance(component.parameters.get("weight"), str | tuple)
    hint = "The harder the pen is pressed, the more of the second example it paints"
    changed, on = w.tick("Pen pressure sets the weight", pressed, hint)
    if not changed:
        return component
    return replace(component, parameters=component.parameters.set("weight", "pressure" if on else 0.5))
