"""The colour panel: wheel, OkLCH sliders, the two colours, and those painted with before."""

from __future__ import annotations

from functools import lru_cache

from imgui_bundle import ImVec2, imgui

from app import icons, theme
from app.actions.actions import keyed, tip
from app.desk.colours import MOST_CHROMA, RGB, from_hex, from_oklch, to_hex, to_oklch
from app.desk.desk import Desk
from app.desk.holding.gamut_mask import held_in
from app.panels.colour.colour_wheel import ColourWheel, wheel_sizes
from app.panels.colour.gradient_slider import gradient_slider
from app.panels.colour.palette_section import draw_palette
from app.panels.colour.wheel_sides import draw_left, draw_right
from app.panels.controls import widgets as w
from app.panels.controls.dragged_off import carry_colour

_STOPS = 18
_HISTORY_ACROSS = 12


class ColourPanel:
    """Keeps the hue and chroma that a grey would lose."""

    def __init__(self) -> None:
        self._rgb: RGB = (-1.0, 0.0, 0.0)
        self._lch: RGB = (0.0, 0.0, 0.0)
        self._text = ""
        self._round = ColourWheel()

    def draw(self, desk: Desk) -> None:
        """Draws it into the present window."""
        if not w.section("Colour"):
            return
        self._follow(desk)
        self._wheel(desk)
        self._sliders(desk)
        self._pair(desk)
        self._history(desk)
        draw_palette(desk)

    def _wheel(self, desk: Desk) -> None:
        """Draws the wheel between what stands beside it."""
        start, room = imgui.get_cursor_screen_pos(), imgui.get_content_region_avail().x
        wide, tall = wheel_sizes(room)
        picked = self._round.draw(desk, self._lch)
        if picked is not None:
            self._pick(desk, picked)
        beside = (room - tall) / 2 - 6 * desk.scale
        imgui.set_cursor_screen_pos(ImVec2(start.x + room - beside, start.y))
        shade = draw_right(desk, tall, beside)
        if shade is not None:
            desk.hand.colour = from_oklch(*held_in(desk.kept.wheel.limits, to_oklch(shade)))
        imgui.set_cursor_screen_pos(start)
        draw_left(desk, self._lch[2])
        imgui.set_cursor_screen_pos(start)
        imgui.dummy(ImVec2(wide, tall))

    def _pick(self, desk: Desk, lch: RGB) -> None:
        """Takes a colour as far as the gamut mask lets it, but remembers what was wished."""
        self._lch = lch
        desk.hand.colour = self._rgb = from_oklch(*held_in(desk.kept.wheel.limits, lch))

    def _follow(self, desk: Desk) -> None:
        """Takes over a colour that was chosen elsewhere."""
        if desk.hand.colour != self._rgb:
            new = to_oklch(desk.hand.colour)
            keep = new[1] < 0.004  # a grey has no hue of its own
            self._rgb, self._lch = desk.hand.colour, (new[0], new[1], self._lch[2] if keep else new[2])

    def _sliders(self, desk: Desk) -> None:
        self._follow(desk)
        light, chroma, hue = self._lch
        rows = (
            ("Lightness", light, "How light the colour looks (OkLCH)"),
            ("Chroma", chroma / MOST_CHROMA, "How colourful it is; past what the screen shows it stops"),
            ("Hue", hue / 360, "Its place on the wheel, at the same lightness"),
        )
        parts = [light, chroma / MOST_CHROMA, hue / 360]
        for i, (name, value, hint) in enumerate(rows):
            stops = _stops(i, round(light, 3), round(chroma, 3), round(hue, 1))
            changed, new_value = gradient_slider(name, max(0.0, min(1.0, value)), stops, f"{name}: {hint}")
            if changed:
                parts[i] = new_value
                self._pick(desk, (parts[0], parts[1] * MOST_CHROMA, parts[2] * 360))

    def _pair(self, desk: Desk) -> None:
        height = imgui.get_frame_height()
        wide = imgui.get_content_region_avail().x
        hint = "The colour you paint with; drag it into a region to fill that"
        w.swatch("now", desk.hand.colour, hint, (wide * 0.26, height))
        carry_colour(desk, desk.hand.colour)
        imgui.same_line()
        hint = keyed("The other colour; click to swap", "swap")
        if w.swatch("other", desk.hand.other_colour, hint, (wide * 0.16, height)):
            desk.hand.swap()
        carry_colour(desk, desk.hand.other_colour)
        imgui.same_line()
        if w.icon_button("swap", icons.SWAP, tip("swap")):
            desk.hand.swap()
        imgui.same_line()
        imgui.set_next_item_width(-1)
        _, self._text = imgui.input_text("##hex", self._text, imgui.InputTextFlags_.chars_no_blank)
        if imgui.is_item_deactivated_after_edit():
            try:
                desk.hand.colour = from_hex("#" + self._text.lstrip("#").lower())
            except ValueError:
                desk.say(f"“{self._text}” is no colour: write six hexadecimal digits", bad=True)
        elif not imgui.is_item_active():
            self._text = to_hex(desk.hand.colour)
        w.named("hex")
        w.tooltip("The colour as #rrggbb")

    def _history(self, desk: Desk) -> None:
        gap = 3 * desk.scale
        side = (imgui.get_content_region_avail().x - gap * (_HISTORY_ACROSS - 1)) / _HISTORY_ACROSS
        imgui.push_style_var(imgui.StyleVar_.item_spacing, ImVec2(gap, gap))
        imgui.push_style_var(imgui.StyleVar_.frame_rounding, 2.0)
        for i in range(_HISTORY_ACROSS):
            if i:
                imgui.same_line()
            if i < len(desk.hand.colours):
                colour = desk.hand.colours[i]
                if w.swatch(f"past{i}", colour, "Painted with before", (side, side)):
                    desk.hand.colour = colour
                carry_colour(desk, colour)
            else:
                corner = imgui.get_cursor_screen_pos()
                imgui.dummy(ImVec2(side, side))
                end = ImVec2(corner.x + side, corner.y + side)
                imgui.get_window_draw_list().add_rect_filled(corner, end, theme.packed(theme.look.grid), 2.0)
        imgui.pop_style_var(2)


@lru_cache(maxsize=12)
def _stops(axis: int, light: float, chroma: float, hue: float) -> tuple[RGB, ...]:
    """Returns the colours along one slider."""
    out = []
    for i in range(_STOPS + 1):
        t = i / _STOPS
        lch = [light, chroma, hue]
        lch[axis] = t * (1.0, MOST_CHROMA, 360.0)[axis]
        if axis == 2:
            lch[0], lch[1] = max(0.45, min(0.85, light)), max(chroma, 0.10)
        out.append(from_oklch(*lch))
    return tuple(out)
