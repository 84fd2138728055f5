"""The curve editor: a curve of 0..1 drawn by hand or held by knots, over a grid and the diagonal that changes nothing.

Lewis 1984, section 6.1, asks for shaping functions that are drawn and felt at once: every move of the pen gives a
new curve to the caller.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from typing import Any

import numpy as np
from imgui_bundle import ImVec2, imgui

from app import icons, theme
from app.desk import knots
from app.desk.knots import Knots
from app.language import said
from app.panels.controls import widgets as w
from engine.numeric.curves import smooth_curve
from engine.studio.results import CurveRow

Curve = str | Knots | None
Rows = Sequence[CurveRow]

_SIDE = 15  # of the canvas, in heights of the font
LINES = 4  # of the grid each way
_REACH = 0.045  # how near to a knot the pointer takes hold of it
FINE = 0.004  # what a curve drawn by hand may lose when it becomes knots
_GONE = -1
_PIECES = 96  # straight ones that a smooth curve is drawn by


class CurveEditor:
    """Remembers what the pointer holds; one editor serves any number of curves, one of them open.

    `smooth`: knots are joined by a smooth curve, and held first; else by straight lines, and drawn first."""

    def __init__(self, smooth: bool = False) -> None:
        self._smooth = smooth
        self.by_hand = not smooth
        self._held: int | None = None
        self._pen: tuple[float, float] | None = None

    def row(self, label: str, curve: Curve, rows: Rows, hint: str, spare: float = 0.0) -> tuple[bool, Curve]:
        """Returns a line with the curve's name and its picture, which opens the editor.  (changed, curve)

        `rows`: the named curves; None is the first of them, which reset brings back.  `spare`: room left beside it.
        """
        width, height = imgui.get_content_region_avail().x - spare, imgui.get_frame_height()
        corner = imgui.get_cursor_screen_pos()
        if imgui.invisible_button(f"curve {label}", ImVec2(width, height), imgui.ButtonFlags_.enable_nav):
            imgui.open_popup(f"edit {label}")
        hovered = imgui.is_item_hovered()
        w.named(f"curve {label}")
        w.tooltip(hint)
        painter, pad = imgui.get_window_draw_list(), imgui.get_style().frame_padding
        end = ImVec2(corner.x + width, corner.y + height)
        ground = theme.look.hover if hovered else theme.look.field
        painter.add_rect_filled(corner, end, theme.packed(ground), imgui.get_style().frame_rounding)
        said.add_text(
            painter, ImVec2(corner.x + pad.x, corner.y + pad.y), theme.packed(theme.look.soft), label.partition("##")[0]
        )
        picture = ImVec2(end.x - height * 1.5 - 2, corner.y + 3), ImVec2(end.x - 4, end.y - 3)
        plot(*picture, self._line(shape_of(curve, rows)), 1.5)
        text = title_of(curve, rows)
        at = ImVec2(picture[0].x - pad.x - said.calc_text_size(text).x, corner.y + pad.y)
        said.add_text(painter, at, theme.packed(theme.look.text if curve is not None else theme.look.quiet), text)
        _beside(corner, end)
        return self._popup(label, curve, rows)

    def _popup(self, label: str, curve: Curve, rows: Rows) -> tuple[bool, Curve]:
        if not imgui.begin_popup(f"edit {label}"):
            return False, curve
        before, side = curve, imgui.get_font_size() * _SIDE
        said.text_disabled(label.partition("##")[0])
        button, gap = imgui.get_frame_height(), imgui.get_style().item_spacing.x
        if rows:
            named = w.choice(
                "named", curve if isinstance(curve, str) else title_of(curve, rows).capitalize(),
                [(row.name, row.label) for row in rows], "Curves to start from", side - 3 * (button + gap),
                [row.tooltip for row in rows],
            )  # fmt: skip
            if named:
                curve = None if named == rows[0].name else named
            imgui.same_line()
        if w.icon_button("hand", icons.PENCIL, "Draw the curve by hand", on=self.by_hand):
            self.by_hand = True
        imgui.same_line()
        if w.icon_button("knots", icons.KNOTS, "Hold the curve by knots", on=not self.by_hand):
            self.by_hand = False
        imgui.same_line()
        if w.icon_button("reset", icons.UNDO, "Back to the first", enabled=curve is not None):
            curve = None
        curve = self._canvas(curve, rows, side)
        said.text_disabled("Drag to draw" if self.by_hand else "Click to add, right click to remove")
        imgui.end_popup()
        return curve != before, curve

    def _canvas(self, curve: Curve, rows: Rows, side: float) -> Curve:
        corner = imgui.get_cursor_screen_pos()
        end = ImVec2(corner.x + side, corner.y + side)
        buttons = imgui.ButtonFlags_.mouse_button_left | imgui.ButtonFlags_.mouse_button_right
        imgui.invisible_button("canvas", ImVec2(side, side), buttons)
        w.named("whole curve")
        mouse = imgui.get_io().mouse_pos
        at = (min(max((mouse.x - corner.x) / side, 0.0), 1.0), min(max((end.y - mouse.y) / side, 0.0), 1.0))
        shape = shape_of(curve, rows)
        edited = self._drawn(shape, at) if self.by_hand else self._knotted(curve, shape, at)
        if edited is not None:
            curve = None if edited == shape_of(None, rows) else edited
            shape = edited
        plot(corner, end, self._line(shape), 2.0, grid=True)
        if not self.by_hand:
            self._dots(corner, side, _knots(curve, shape), at)
        return curve

    def _line(self, shape: Knots) -> Knots:
        """Returns what is drawn of a curve."""
        if not self._smooth or len(shape) < 3:
            return shape
        places = np.linspace(0.0, 1.0, _PIECES + 1)
        return tuple(zip(places.tolist(), np.clip(smooth_curve(shape, places), 0.0, 1.0).tolist(), strict=True))

    def _drawn(self, shape: Knots, at: tuple[float, float]) -> Knots | None:
        """Returns the curve with the pen's newest piece in it; None when the pen does nothing."""
        if imgui.is_item_active() and imgui.is_mouse_down(imgui.MouseButton_.left):
            before, self._pen = self._pen or knots.at_edge(at, _REACH), at
            return knots.drawn_curve(shape, before, at)
        was, self._pen = self._pen, None
        if was is None:
            return None
        return knots.thinned(knots.drawn_curve(shape, was, knots.at_edge(was, _REACH)), FINE)

    def _knotted(self, curve: Curve, shape: Knots, at: tuple[float, float]) -> Knots | None:
        """Returns the curve with a knot added, moved or taken away; None when nothing is done to it."""
        held, near = _knots(curve, shape), None
        if imgui.is_item_hovered():
            near = knots.nearest(held, *at, _REACH)
        removing = imgui.is_mouse_clicked(imgui.MouseButton_.right) or (
            imgui.is_mouse_double_clicked(imgui.MouseButton_.left)
        )
        if near is not None and removing:
            self._held = _GONE
            return knots.removed(held, near)
        if imgui.is_item_activated() and imgui.is_mouse_clicked(imgui.MouseButton_.left):
            if near is None:
                held, near = knots.added(held, *at)
            self._held = near
            return held
        if not imgui.is_item_active() or not imgui.is_mouse_down(imgui.MouseButton_.left):
            self._held = None
        if self._held is None or not 0 <= self._held < len(held):
            return None
        return knots.moved_knot(held, self._held, *at)

    def _dots(self, corner: ImVec2, side: float, held: Knots, at: tuple[float, float]) -> None:
        painter, near = imgui.get_window_draw_list(), knots.nearest(held, *at, _REACH)
        for i, (x, y) in enumerate(held):
            place = ImVec2(corner.x + x * side, corner.y + (1.0 - y) * side)
            lit = i == self._held or (self._held is None and i == near)
            painter.add_circle_filled(place, 5.5, theme.packed(theme.look.field), 16)
            painter.add_circle_filled(place, 4.0, theme.packed(theme.look.text if lit else theme.look.accent), 16)


def _beside(corner: ImVec2, end: ImVec2) -> None:
    """Has the next pop-up open beside a row and not over it: towards the middle of the window, and inside it."""
    room, em = imgui.get_io().display_size, imgui.get_font_size()
    gap, high = em * 0.9, em * (_SIDE + 7)
    y = max(min(corner.y - em, room.y - high), 0.0)
    if corner.x > room.x / 2:
        imgui.set_next_window_pos(ImVec2(corner.x - gap, y), imgui.Cond_.appearing, ImVec2(1, 0))
    else:
        imgui.set_next_window_pos(ImVec2(end.x + gap, y), imgui.Cond_.appearing)


def plot(corner: ImVec2, end: ImVec2, shape: Knots, thick: float, grid: bool = False) -> None:
    """Draws the picture of a curve, with the ground under it a little lighter."""
    painter, wide, tall = imgui.get_window_draw_list(), end.x - corner.x, end.y - corner.y
    painter.add_rect_filled(corner, end, theme.packed(theme.look.field), 3.0)
    painter.push_clip_rect(corner, end, True)
    if grid:
        for i in range(1, LINES):
            x, y, faint = corner.x + wide * i / LINES, corner.y + tall * i / LINES, theme.packed(theme.look.grid)
            painter.add_line(ImVec2(x, corner.y), ImVec2(x, end.y), faint)
            painter.add_line(ImVec2(corner.x, y), ImVec2(end.x, y), faint)
        painter.add_line(ImVec2(corner.x, end.y), ImVec2(end.x, corner.y), theme.packed(theme.look.border))
    inset = min(2.0, thick)
    points: Any = [
        ImVec2(corner.x + wide * min(max(x, 0.0), 1.0), corner.y + inset + (tall - 2 * inset) * (1.0 - min(y, 1.0)))
        for x, y in ((0.0, shape[0][1]), *shape, (1.0, shape[-1][1]))
    ]
    under = theme.packed(theme.look.accent_soft, 0.35)
    for a, b in pairwise(points):
        if b.x > a.x:
            painter.add_quad_filled(ImVec2(a.x, end.y), a, b, ImVec2(b.x, end.y), under)
    painter.add_polyline(points, theme.packed(theme.look.accent), thickness=thick, flags=0)
    painter.pop_clip_rect()


def shape_of(curve: Curve, rows: Rows) -> Knots:
    """Any curve as points that straight lines join."""
    if isinstance(curve, tuple):
        return curve
    row = _row(curve, rows)
    if row is None:
        return knots.STRAIGHT
    heights = row.heights
    return knots.thinned(tuple((i / (len(heights) - 1), height) for i, height in enumerate(heights)), 0.001)


def title_of(curve: Curve, rows: Rows) -> str:
    """Gives what a curve is called: its row's title, or "own"."""
    if isinstance(curve, tuple):
        return "own"
    row = _row(curve, rows)
    return row.label.lower() if row else curve or ""


def _row(curve: str | None, rows: Rows) -> CurveRow | None:
    if curve is None:
        return rows[0] if rows else None
    return next((row for row in rows if row.name == curve), None)


def _knots(curve: Curve, shape: Knots) -> Knots:
    """Returns what the knots of a curve are: its own, or few that follow it."""
    return curve if isinstance(curve, tuple) else knots.thinned(shape, FINE)
