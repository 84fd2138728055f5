"""Edges that are dragged: between panels, and between a column or a strip and the canvas."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

from imgui_bundle import ImVec2, imgui

from app import theme
from app.desk.arranging.arrangement import PanelBox
from app.desk.desk import Desk
from app.panels.controls import widgets as w

_FLAGS = imgui.WindowFlags_.no_scrollbar | imgui.WindowFlags_.no_scroll_with_mouse


class Edge(NamedTuple):
    """`upright`: it is dragged up and down; `sign`: -1 where what it measures grows to the left, or upwards; `still`:
    nothing can give way to it; `lined`: a line shows it, on the ground of the panels."""

    name: str
    box: PanelBox
    upright: bool
    sign: float = 1.0
    still: bool = False
    lined: bool = False


class DockEdge:
    """Draws one after another, of which one can be dragged."""

    def __init__(self, begin: Callable[[str, PanelBox, int], bool]) -> None:
        self._begin, self._start = begin, 0.0

    def draw(self, desk: Desk, edge: Edge, measure: float) -> float | None:
        """Returns what is to be measured instead of `measure`, pixels, while it is dragged."""
        imgui.push_style_var(imgui.StyleVar_.window_padding, ImVec2(0, 0))
        imgui.push_style_var(imgui.StyleVar_.window_min_size, ImVec2(1, 1))
        ground = 0 if edge.lined else imgui.WindowFlags_.no_background
        begun = self._begin(edge.name, edge.box, _FLAGS | ground)
        imgui.pop_style_var(2)
        wanted = self._button(desk, edge, measure) if begun else None
        imgui.end()
        return wanted

    def _button(self, desk: Desk, edge: Edge, measure: float) -> float | None:
        corner, size, painter = imgui.get_window_pos(), imgui.get_window_size(), imgui.get_window_draw_list()
        end = corner + size
        if edge.lined:
            y = round((corner.y + end.y) / 2)
            painter.add_line(ImVec2(corner.x, y), ImVec2(end.x, y), theme.packed(theme.look.line), desk.scale)
        if edge.still:
            return None
        imgui.invisible_button(edge.name, size)
        w.named(edge.name)
        w.tooltip("Drag to give what is beside it more room or less")
        if imgui.is_item_activated():
            self._start = measure
        held = imgui.is_item_active()
        if imgui.is_item_hovered() or held:
            imgui.set_mouse_cursor(imgui.MouseCursor_.resize_ns if edge.upright else imgui.MouseCursor_.resize_ew)
            painter.add_rect_filled(corner, end, theme.packed(theme.look.accent, 0.9 if held else 0.5))
        if not held:
            return None
        drag = imgui.get_mouse_drag_delta(imgui.MouseButton_.left, 0.0)
        return self._start + edge.sign * (drag.y if edge.upright else drag.x)
