"""The wheel: a ring of hues around a triangle, or a disc of hue and chroma; harmonies and a gamut mask on it."""

from __future__ import annotations

import cmath
import colorsys
import math
from collections.abc import Sequence
from dataclasses import replace

from imgui_bundle import ImVec2, imgui

from app.desk.colours import RGB, from_oklch, off_disc, on_disc, to_hex
from app.desk.desk import Desk
from app.desk.holding.gamut_mask import held_at, held_in, moved_corner
from app.desk.holding.harmonies import HARMONIES, harmony
from app.desk.holding.kept_desk import change_kept
from app.desk.holding.wheel_record import WheelSet
from app.panels.colour.colour_disc import Round, draw_disc, draw_mask, draw_spot
from app.panels.controls import widgets as w
from app.panels.controls.colour_popup import PICKER_FLAGS

WHEEL_SIDE = 12.0  # of a letter: how wide the wheel is, with the room that it keeps beside itself
_RING = 0.46  # of the picker's height: how far out the middle of its ring lies
_MARK, _OWN, _GRIP = 5.0, 6.0, 8.0  # points: radii of marks; how near a corner is taken
_DARKEST, _LIGHTEST = 0.15, 0.97  # lightness that a press on the disc gives: beyond, there is no hue to be seen
_SHOWN = 0.42, 0.9  # lightness of the disc itself, as of the slider for hue: its colours can be told apart
_ON_DISC = "Hue round the disc, grey in its middle; how light it is, is set below"
_ON_MASK = "\nDrag a corner of the mask to reshape it"


class ColourWheel:
    """Remembers which corner of the mask is dragged."""

    def __init__(self) -> None:
        self._corner: int | None = None
        self._wheel: WheelSet | None = None  # as it is while a corner is dragged

    def draw(self, desk: Desk, lch: RGB) -> RGB | None:
        """Draws it in the middle of the present window; returns the lightness, chroma and hue picked on the disc or by
        a mark, None where neither was.  What is picked on the ring is in hand at once."""
        wheel = self._wheel or desk.kept.wheel
        room, start = imgui.get_content_region_avail().x, imgui.get_cursor_screen_pos()
        side, tall = wheel_sizes(room)
        left = start.x + (room - side) / 2
        circle = Round(left + side / 2, start.y + tall / 2, tall / 2)
        marks = [held_in(wheel.limits, mark) for mark in harmony(lch, wheel.harmony)]
        points = [_mark_point(circle, wheel, mark) for mark in marks]
        pressed = self._marks(desk, wheel, marks, points)
        imgui.set_cursor_screen_pos(ImVec2(left, start.y))
        picked = self._on_disc(desk, wheel, circle, lch) if wheel.disc else _on_ring(desk, side)
        for mark, point in zip(marks, points, strict=True):
            draw_spot(point, from_oklch(*mark), _MARK * desk.scale, desk.scale)
        return picked if pressed is None else pressed

    def _marks(self, desk: Desk, wheel: WheelSet, marks: Sequence[RGB], points: Sequence[ImVec2]) -> RGB | None:
        """Lays what takes the presses on marks: before the wheel, which leaves them to it."""
        pressed, half = None, (_MARK + 2) * desk.scale
        for i, (mark, point) in enumerate(zip(marks, points, strict=True)):
            imgui.set_cursor_screen_pos(ImVec2(point.x - half, point.y - half))
            if imgui.invisible_button(f"harmony {i}", ImVec2(2 * half, 2 * half), imgui.ButtonFlags_.enable_nav):
                pressed = mark
            w.named(f"harmony {i + 1}")
            w.tooltip(f"{HARMONIES[wheel.harmony].title}\n{to_hex(from_oklch(*mark))}", beside=True)
        return pressed

    def _on_disc(self, desk: Desk, wheel: WheelSet, circle: Round, lch: RGB) -> RGB | None:
        corner = imgui.get_cursor_screen_pos()
        side = 2 * circle.radius
        imgui.set_cursor_screen_pos(ImVec2(circle.x - circle.radius, corner.y))
        imgui.invisible_button("disc", ImVec2(side, side))
        w.named("disc")
        w.tooltip(_ON_DISC + (_ON_MASK if wheel.masked else ""), beside=True)
        light = max(_DARKEST, min(_LIGHTEST, lch[0]))
        draw_disc(circle, max(_SHOWN[0], min(_SHOWN[1], light)), desk.scale)
        if wheel.masked:
            draw_mask(circle, wheel.corners, desk.scale)
        draw_spot(circle.point(held_at(wheel.limits, on_disc(lch))), from_oklch(*lch), _OWN * desk.scale, desk.scale)
        at = circle.place(imgui.get_mouse_pos())
        if imgui.is_item_activated():
            reach = _GRIP * desk.scale / circle.radius
            near = [i for i, one in enumerate(wheel.limits) if abs(one - at) < reach]
            self._corner = min(near, key=lambda i: abs(wheel.corners[i] - at), default=None)
        if self._corner is not None:
            self._reshape(desk, wheel, at)
            return None
        if not imgui.is_item_active():
            return None
        at = held_at(wheel.limits, at if abs(at) <= 1 else at / abs(at))
        picked = off_disc(light, at)
        return picked if abs(at) > 1e-6 else (light, 0.0, lch[2])

    def _reshape(self, desk: Desk, wheel: WheelSet, at: complex) -> None:
        """Drags a corner along; the mask is kept when it is let go."""
        if imgui.is_item_active() and self._corner is not None:
            self._wheel = replace(wheel, corners=moved_corner(wheel.corners, self._corner, at))
            corner = self._wheel.corners
            self._corner = min(range(len(corner)), key=lambda i: abs(corner[i] - at))
            return
        change_kept(desk, replace(desk.kept, wheel=wheel))
        self._corner = self._wheel = None


def wheel_sizes(room: float) -> tuple[float, float]:
    """Returns how wide the wheel's field is, and how high it and the wheel are."""
    side = min(room, imgui.get_font_size() * WHEEL_SIDE)
    return side, side - imgui.get_frame_height() - imgui.get_style().item_inner_spacing.x


def _on_ring(desk: Desk, side: float) -> RGB | None:
    imgui.set_next_item_width(side)
    changed, value = imgui.color_picker3("##wheel", list(desk.hand.colour), PICKER_FLAGS)
    w.named("wheel")
    if changed:
        desk.hand.colour = (value[0], value[1], value[2])
    return None


def _mark_point(circle: Round, wheel: WheelSet, mark: RGB) -> ImVec2:
    if wheel.disc:
        return circle.point(on_disc(mark))
    hue = colorsys.rgb_to_hsv(*from_oklch(*mark))[0]
    return circle.point(cmath.rect(2 * _RING, math.tau * hue))
