"""The columns beside the canvas: panels one below another, each with room of its own, so that none pushes another."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import NamedTuple

from imgui_bundle import ImVec2, imgui

from app import theme
from app.desk.arranging.arrangement import (
    COLUMNS,
    DOCKS,
    PanelBox,
    docked,
    edge_dragged,
    filling,
    floated,
    heights_in,
    widened,
    widths_in,
)
from app.desk.desk import Desk
from app.faults.fault_guard import FaultGuard
from app.panels.arranging.dock_edge import DockEdge, Edge
from app.panels.arranging.dock_menu import draw_dock_menu
from app.panels.controls.grips import begin_grip, end_grip

Begin = Callable[[str, PanelBox, int], bool]  # a window at a place of the screen, pixels
GAP = 5.0  # points between panels of a column
_NEAR = 30.0  # points from the window's side where a panel is dropped into a column that is empty
_SIGNS = {"left": 1.0, "right": -1.0}
_TOP = 3.0  # points above a panel's first line
FLOATS = -1  # in place of flags: above the others, and resized by its corner


@dataclass(slots=True)
class _Carried:
    """A panel that is dragged: where in it it was taken, and how large it is, pixels."""

    name: str
    at: ImVec2
    size: ImVec2


class _Drop(NamedTuple):
    """Where it would lie: in a column above another panel, or floating; `line`: the height of its upper end."""

    side: str
    above: str
    line: float


def dock_unit(desk: Desk) -> float:
    """Returns the pixels that a point of a panel is: they grow with the screen's scale and with the font."""
    return desk.scale * max(1.0, imgui.get_style().font_scale_main)


class Docks:
    """Draws the panels of both columns and those that float.  `panels`: what draws each."""

    def __init__(self, panels: Mapping[str, Callable[[Desk], None]], begin: Begin, guard: FaultGuard) -> None:
        self._panels, self._begin, self._guard = panels, begin, guard
        self._edge = DockEdge(begin)
        self._carried: _Carried | None = None
        self._boxes: dict[str, PanelBox] = {}  # of the panels in columns, in this frame
        self._fixed: dict[str, float] = {}  # how high the tools are, by the last frame

    def widths(self, desk: Desk) -> tuple[float, float]:
        """Returns the widths of the columns, pixels."""
        unit = dock_unit(desk)
        left, right = widths_in(desk.arranged.now, desk.view.width / unit)
        return left * unit, right * unit

    def draw(self, desk: Desk, top: float, heights: tuple[float, float], widths: tuple[float, float]) -> None:
        """Draws everything; the columns begin at `top`, and each has a height and a width."""
        self._boxes = {}
        for side, high, wide in zip(COLUMNS, heights, widths, strict=True):
            if wide:
                self._column(desk, side, (0.0 if side == "left" else desk.view.width - wide, top, wide, high))
        for name, box in sorted(desk.arranged.now.floating.items()):
            if name not in desk.arranged.now.hidden:
                self._floating(desk, name, box, top)
        if self._carried is not None:
            self._carry(desk, self._carried, top, widths)

    def _column(self, desk: Desk, side: str, box: PanelBox) -> None:
        told, unit, (left, top, wide, high) = desk.arranged.now, dock_unit(desk), box
        names, gap = told.column(side), round(GAP * desk.scale)
        folded = {name: _folded_height() / unit for name in names if _folds(desk, name)}
        fixed = {name: self._fixed.get(name, DOCKS[name].high * unit) / unit for name in names if name == "tools"}
        found = heights_in(told, names, folded, (high - gap * (len(names) - 1)) / unit, fixed)
        y = round(top)
        for i, (name, points) in enumerate(zip(names, found, strict=True)):
            bottom = y + points * unit
            if i == len(names) - 1 and filling(names, {**folded, **fixed}):
                bottom = top + high  # no rounding leaves a gap
            bottom = round(bottom)
            self._boxes[name] = left, y, wide, bottom - y
            self._docked(desk, name, self._boxes[name])
            y = bottom
            if i < len(names) - 1:
                self._between(desk, (left, y, wide, gap), (names, found, i), {**folded, **fixed})
                y += gap
        if y < top + high - 1:
            self._begin(f"{side} column", (left, y, wide, top + high - y), 0)
            imgui.end()
        out = 4 * desk.scale
        edge = Edge(f"{side} edge", (wide if side == "left" else left - out, top, out, high), False, _SIGNS[side])
        wanted = self._edge.draw(desk, edge, wide)
        if wanted is not None:
            desk.arranged.now = widened(told, side, wanted / unit)

    def _between(
        self, desk: Desk, box: PanelBox, column: tuple[tuple[str, ...], list[float], int], settled: Mapping[str, float]
    ) -> None:
        """Draws what lies between two panels: the nearest above and below that are not folded change their heights."""
        names, heights, i = column
        above = next((k for k in range(i, -1, -1) if names[k] not in settled), None)
        below = next((k for k in range(i + 1, len(names)) if names[k] not in settled), None)
        still, unit = above is None or below is None, dock_unit(desk)
        edge = Edge(f"below {names[i]}", box, True, still=still, lined=True)
        wanted = self._edge.draw(desk, edge, 0.0 if above is None else heights[above] * unit)
        if wanted is not None and above is not None and below is not None:
            pair, now = (names[above], names[below]), (heights[above], heights[below])
            by, filler = wanted / unit - now[0], filling(names, settled)
            desk.arranged.now = edge_dragged(desk.arranged.now, pair, now, by, filler)

    def _docked(self, desk: Desk, name: str, box: PanelBox) -> None:
        """As wide with a scrollbar as without: it takes the margin, and nothing moves when it comes."""
        padding = imgui.get_style().window_padding
        imgui.push_style_var(imgui.StyleVar_.window_padding, ImVec2(padding.x, _TOP * desk.scale))
        imgui.set_next_window_content_size(ImVec2(box[2] - 2 * padding.x, 0))
        begun = self._begin(name, box, 0)
        imgui.pop_style_var()
        self._panel(desk, name, begun)

    def _panel(self, desk: Desk, name: str, begun: bool) -> None:
        """Draws a panel into the window that was begun, which ends here."""
        if begun:
            begin_grip()
            with self._guard.spare_drawing(f"drawing the panel {DOCKS[name].title}"):
                self._panels[name](desk)
            grip = end_grip()
            if name == "tools":
                self._fixed[name] = imgui.get_cursor_pos().y - imgui.get_style().item_spacing.y + 2 * _TOP * desk.scale
            if grip.dragged and self._carried is None:
                pressed = imgui.get_io().mouse_pos - imgui.get_mouse_drag_delta(imgui.MouseButton_.left, 0.0)
                self._carried = _Carried(name, pressed - imgui.get_window_pos(), imgui.get_window_size())
            draw_dock_menu(desk, name, grip.asked)
        imgui.end()

    def _floating(self, desk: Desk, name: str, box: PanelBox, top: float) -> None:
        """Draws a panel over the canvas, wholly within the window."""
        unit, view = dock_unit(desk), desk.view
        wide, high = min(box[2] * unit, view.width), min(box[3] * unit, view.height - top)
        if _folds(desk, name):
            high = _folded_height()
        x = max(0.0, min(box[0] * unit, view.width - wide))
        y = max(top, min(box[1] * unit, view.height - high))
        imgui.push_style_var(imgui.StyleVar_.window_border_size, max(1.0, desk.scale))
        imgui.push_style_var(imgui.StyleVar_.window_padding, ImVec2(10, 6) * desk.scale)
        imgui.push_style_var(imgui.StyleVar_.window_min_size, ImVec2(120, 38) * unit)
        begun = self._begin(f"{name}##floating", (x, y, wide, high), FLOATS)
        size = imgui.get_window_size()
        imgui.pop_style_var(3)
        self._panel(desk, name, begun)
        if not _folds(desk, name) and (abs(size.x - round(wide)) > 1 or abs(size.y - round(high)) > 1):
            told = desk.arranged.now
            box = (x / unit, y / unit, size.x / unit, size.y / unit)
            desk.arranged.now = replace(told, floating=told.floating.set(name, box))

    def _carry(self, desk: Desk, carried: _Carried, top: float, widths: tuple[float, float]) -> None:
        """Shows where a panel that is dragged would lie, and lays it there when it is let go."""
        drop = self._drop(desk, carried.name, top, widths)
        corner = imgui.get_io().mouse_pos - carried.at
        painter, lit = imgui.get_foreground_draw_list(), theme.packed(theme.look.accent)
        if drop is None:
            painter.add_rect(corner, corner + carried.size, lit, 4 * desk.scale, thickness=2 * desk.scale)
        else:
            wide = max(widths[COLUMNS.index(drop.side)], _NEAR * desk.scale)
            left = 0.0 if drop.side == "left" else desk.view.width - wide
            end = ImVec2(left + wide, drop.line + 4 * desk.scale)
            painter.add_rect_filled(ImVec2(left, drop.line), end, lit)
        if imgui.is_mouse_down(imgui.MouseButton_.left):
            return
        self._carried = None
        if drop is not None:
            desk.arranged.now = docked(desk.arranged.now, carried.name, drop.side, drop.above)
            return
        unit, size = dock_unit(desk), carried.size
        high = max(size.y / unit, DOCKS[carried.name].least)
        if carried.name not in desk.arranged.now.floating:
            high = min(high, DOCKS[carried.name].high)
        box = (corner.x / unit, max(corner.y, top) / unit, size.x / unit, high)
        desk.arranged.now = floated(desk.arranged.now, carried.name, box)

    def _drop(self, desk: Desk, name: str, top: float, widths: tuple[float, float]) -> _Drop | None:
        """Returns where the panel would be laid; None where it floats."""
        at, near = imgui.get_io().mouse_pos, _NEAR * desk.scale
        over = (at.x < max(widths[0], near), at.x >= desk.view.width - max(widths[1], near))
        side = next((side for side, there in zip(COLUMNS, over, strict=True) if there), "")
        if not side:
            return None
        others = [other for other in desk.arranged.now.column(side) if other != name and other in self._boxes]
        for other in others:
            box = self._boxes[other]
            if at.y < box[1] + box[3] / 2:
                return _Drop(side, other, box[1])
        if not others:
            return _Drop(side, "", top)
        last = self._boxes[others[-1]]
        return _Drop(side, "", last[1] + last[3] - 4 * desk.scale)


def _folds(desk: Desk, name: str) -> bool:
    """Tells whether a panel is its header alone."""
    section = DOCKS[name].section
    return bool(section) and not desk.remembered.folded.get(section, True)


def _folded_height() -> float:
    """Returns how high a header is, pixels."""
    style = imgui.get_style()
    return imgui.get_text_line_height() * 1.25 + style.item_spacing.y * 2 + 2 * _TOP * style.font_scale_dpi
