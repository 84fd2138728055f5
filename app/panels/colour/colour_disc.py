"""The disc of colours of one lightness, and the gamut mask on it: hue round it, grey in the middle."""

from __future__ import annotations

import cmath
import math
from functools import lru_cache

from imgui_bundle import ImVec2, imgui

from app import theme
from app.desk.colours import RGB, from_oklch, off_disc
from app.desk.holding.gamut_mask import Corners, mean_corner, way_out

_SPOKES, _RINGS = 60, 4
_DARK = 0.72  # how much of what is outside of the mask is darkened
_HANDLE = 4.0  # points: half a corner's side
_Vertices = list[tuple[float, float, int]]  # across and down, in radii; colour
_Drawn = tuple[_Vertices, tuple[int, ...]]


class Round:
    """A circle on the screen, and the way between it and places of the disc."""

    def __init__(self, x: float, y: float, radius: float) -> None:
        self.x, self.y, self.radius = x, y, radius

    def point(self, at: complex) -> ImVec2:
        """Returns where a place of the disc lies on the screen."""
        return ImVec2(self.x + self.radius * at.real, self.y + self.radius * at.imag)

    def place(self, point: ImVec2) -> complex:
        """Returns the place of the disc below a point of the screen, beyond 1 where that is outside."""
        return complex(point.x - self.x, point.y - self.y) / self.radius


def draw_disc(circle: Round, light: float, scale: float) -> None:
    """Draws all colours of a lightness into the present window."""
    _draw(circle, _disc(round(light, 2)))
    painter, rim = imgui.get_window_draw_list(), ImVec2(circle.x, circle.y)
    painter.add_circle(rim, circle.radius + 0.3 * scale, theme.packed(theme.look.panel), 0, 1.6 * scale)


def draw_mask(circle: Round, corners: Corners, scale: float) -> None:
    """Darkens what is outside of a mask, and draws its sides and corners."""
    _draw(circle, _outside(corners))
    painter, points = imgui.get_window_draw_list(), [circle.point(at) for at in corners]
    for grey, wide in ((0.0, 2.5), (1.0, 1.2)):
        for point, after in zip(points, (*points[1:], points[0]), strict=True):
            painter.add_line(point, after, theme.packed((grey,) * 3, 0.8), wide * scale)
    half = _HANDLE * scale
    for point in points:
        least, most = ImVec2(point.x - half, point.y - half), ImVec2(point.x + half, point.y + half)
        painter.add_rect_filled(least, most, theme.packed((1.0,) * 3))
        painter.add_rect(least, most, theme.packed((0.0,) * 3), thickness=scale)


def draw_spot(point: ImVec2, rgb: RGB, radius: float, scale: float) -> None:
    """Draws a round mark of a colour, ringed in black and white so that it stands out on all."""
    painter = imgui.get_window_draw_list()
    painter.add_circle_filled(point, radius, theme.packed(rgb))
    painter.add_circle(point, radius + scale, theme.packed((0.0,) * 3), 0, scale)
    painter.add_circle(point, radius, theme.packed((1.0,) * 3), 0, 1.5 * scale)


@lru_cache(maxsize=8)
def _disc(light: float) -> _Drawn:
    vertices = [(0.0, 0.0, theme.packed(from_oklch(light, 0.0, 0.0)))]
    for ring in range(1, _RINGS + 1):
        for spoke in range(_SPOKES):
            at = cmath.rect(ring / _RINGS, math.tau * spoke / _SPOKES)
            vertices.append((at.real, at.imag, theme.packed(from_oklch(*off_disc(light, at)))))
    indices = list[int]()
    for spoke in range(_SPOKES):
        after = (spoke + 1) % _SPOKES
        indices += (0, 1 + spoke, 1 + after)
        for ring in range(_RINGS - 1):
            inner, outer = 1 + ring * _SPOKES, 1 + (ring + 1) * _SPOKES
            indices += _quad(inner + spoke, outer + spoke, outer + after, inner + after)
    return vertices, tuple(indices)


@lru_cache(maxsize=4)
def _outside(corners: Corners) -> _Drawn:
    middle, dark = mean_corner(corners), theme.packed((0.0,) * 3, _DARK)
    turns = {math.tau * spoke / _SPOKES for spoke in range(_SPOKES)}
    turns |= {cmath.phase(corner - middle) % math.tau for corner in corners}
    vertices: _Vertices = []
    for turn in sorted(turns):
        towards = cmath.rect(1.0, turn)
        inner = way_out(corners, middle, towards)
        along = (middle * towards.conjugate()).real
        outer = middle + towards * (math.sqrt(max(0.0, along**2 + 1 - abs(middle) ** 2)) - along)
        outer = outer if abs(outer - middle) > abs(inner - middle) else inner
        vertices += [(inner.real, inner.imag, dark), (outer.real, outer.imag, dark)]
    count, indices = len(vertices), list[int]()
    for i in range(0, count, 2):
        indices += _quad(i, i + 1, (i + 3) % count, (i + 2) % count)
    return vertices, tuple(indices)


def _quad(a: int, b: int, c: int, d: int) -> tuple[int, ...]:
    return a, b, c, a, c, d


def _draw(circle: Round, drawn: _Drawn) -> None:
    vertices, indices = drawn
    painter, white = imgui.get_window_draw_list(), imgui.get_font_tex_uv_white_pixel()
    painter.prim_reserve(len(indices), len(vertices))
    first = painter._vtx_current_idx
    for index in indices:
        painter.prim_write_idx(first + index)
    for across, down, colour in vertices:
        painter.prim_write_vtx(
            ImVec2(circle.x + circle.radius * across, circle.y + circle.radius * down), white, colour
        )
