"""The maps of an example: which way it runs, drawn on its picture; how wide its rim is; and others of its file.

Strokes come from `tools.painting_gestures.draw_map`.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from imgui_bundle import ImVec2, imgui
from immutables import Map

from app import icons, theme
from app.actions.action import Action
from app.actions.actions import ACTIONS
from app.desk.desk import Desk
from app.desk.examples import chart_state, chart_use, chart_work
from app.desk.examples.chart_state import ChartState, strokes_of
from app.desk.examples.thumbnails import map_ident, map_path
from app.language import said
from app.panels.controls import widgets as w
from app.panels.controls.widgets import Col
from app.panels.examples.region_picture import draw_picture
from engine.texture.example.parameters import ORIENTATION, RIM_CHANNEL

_WIDE = 232.0  # width of the tools, points
_THROUGH = 0.7  # how opaque the picture of a map lies on the example
_ARROW = (1.0, 0.85, 0.25)  # sRGB
_RUNS = "Draw on the picture which way it runs: strokes of the brush turn it as they go"
_SHADES = "Paint dark and light: where a brush tells this map a value, what was painted alike grows"


class MapsPanel:
    """Draws the strip's inside."""

    def draw(self, desk: Desk) -> None:
        """Draws it into the present window."""
        state, entry, region = desk.examples, desk.examples.entry, desk.examples.region
        if entry is None or region is None:
            return
        maps = chart_use.maps_of(state, entry)
        names = [ORIENTATION, *(name for name in maps if name not in (ORIENTATION, RIM_CHANNEL))]
        if state.chart.name not in names:
            state.chart = ChartState()
        room, gap = imgui.get_content_region_avail(), imgui.get_style().item_spacing.x
        imgui.begin_child("map picture", ImVec2(room.x - _WIDE * desk.scale - gap, 0))
        radius = None if state.chart.name == ORIENTATION else state.chart.radius
        draw_picture(desk, (f"region {state.chosen}",), region.scene.size, radius)
        _picture(desk, map_path(maps.get(state.chart.name)))
        _strokes(desk, state.chart, strokes_of(maps, state.chart.name))
        imgui.end_child()
        imgui.same_line()
        imgui.begin_child("map tools", ImVec2(0, 0))
        imgui.begin_child("charts", ImVec2(0, -imgui.get_frame_height_with_spacing()))
        self._map(desk, maps, names)
        self._rim(desk, maps)
        imgui.end_child()
        changed = maps != entry.maps
        text, hint = ("Save", "Keep these maps") if entry.own else ("Save as my own", "They go to a copy of your own")
        imgui.push_style_color(Col.button, theme.vec(theme.look.accent_soft if changed else theme.look.raised))
        if w.text_button(f"{icons.DISK} {text}###save maps", hint, enabled=changed, width=-1):
            chart_work.keep_maps(desk)
        imgui.pop_style_color()
        imgui.end_child()

    def takes(self, desk: Desk, action: Action) -> bool:
        """Steps through what was drawn; False for other actions."""
        steps = {ACTIONS["undo"]: True, ACTIONS["redo"]: False}
        if action not in steps or desk.examples.entry is None:
            return False
        self._step(desk, steps[action])
        return True

    def _map(self, desk: Desk, maps: Map[str, object], names: list[str]) -> None:
        """Draws which map it is, and what a stroke tells of it."""
        chart = desk.examples.chart
        options = [(name, "Direction" if name == ORIENTATION else name) for name in names]
        wide = imgui.get_content_region_avail().x
        picked = w.choice("map", chart.name, options, "Which map is drawn: those of the example’s file", wide)
        if picked is not None and picked != chart.name:
            desk.examples.chart = chart = ChartState(picked)
        path = map_path(maps.get(chart.name))
        imgui.push_text_wrap_pos(0.0)
        said.text_disabled(_RUNS if chart.name == ORIENTATION else _SHADES)
        if path:
            said.text_disabled(f"Over {Path(path).name}")
        imgui.pop_text_wrap_pos()
        if chart.name != ORIENTATION:
            hint = "What a stroke tells: dark is 0, light is 100 %"
            _, value = w.slider("Value", 100.0 * chart.value, (0.0, 100.0), hint, form="%.0f%%")
            chart.value = round(value) / 100.0
            hint = "Radius of the stroke, in pixels of the picture"
            _, chart.radius = w.slider("Width", chart.radius, (1.0, 128.0), hint, form="%.1f px", curved=True)
        side, gap, drawn = imgui.get_frame_height(), 2 * desk.scale, bool(strokes_of(maps, chart.name))
        if w.icon_button("undo map", icons.UNDO, "Take the last stroke back", enabled=drawn, size=side):
            self._step(desk, True)
        imgui.same_line(0, gap)
        if w.icon_button("redo map", icons.REDO, "Draw it again", enabled=bool(chart.undone), size=side):
            self._step(desk, False)
        imgui.same_line(0, gap)
        if w.text_button("Clear map", "Take this map away", enabled=chart.name in maps, width=-1):
            chart_work.use(desk, maps.delete(chart.name))

    def _rim(self, desk: Desk, maps: Map[str, object]) -> None:
        """Draws whether the distance to the rim counts, and how far in."""
        width = chart_state.rim_width(maps)
        hint = "How far from the rim a pixel lies counts: for burnt paper, frayed cloth, beaches"
        changed, on = w.tick("Wide rim", width > 0, hint)
        if changed:
            chart_work.use(desk, chart_state.with_rim_width(maps, chart_state.USUAL_WIDTH if on else 0))
        elif width:
            hint = "How far in the rim is seen, in pixels of the picture"
            changed, value = w.slider("Rim width", float(width), chart_state.WIDTHS, hint, form="%.0f px")
            if changed:
                chart_work.use(desk, chart_state.with_rim_width(maps, round(value)))

    def _step(self, desk: Desk, back: bool) -> None:
        state, entry = desk.examples, desk.examples.entry
        if entry is not None:
            chart_work.use(desk, state.chart.step(chart_use.maps_of(state, entry), back))


def _picture(desk: Desk, path: str) -> None:
    """Draws the picture that the map is over the example's, which is seen through it."""
    state, seen = desk.examples, desk.pictures.get(map_ident(path))
    if state.spot is None or state.region is None or seen is None:
        return
    (left, top, scale), (width, height) = state.spot, state.region.scene.size
    end, corners = ImVec2(left + width * scale, top + height * scale), (ImVec2(0, 0), ImVec2(1, 1))
    imgui.get_window_draw_list().add_image(
        seen, ImVec2(left, top), end, *corners, theme.packed((1.0, 1.0, 1.0), _THROUGH)
    )


def _strokes(desk: Desk, chart: ChartState, strokes: tuple[object, ...]) -> None:
    """Draws what was drawn: as arrows, or as it was shaded; and the stroke in progress."""
    if desk.examples.spot is None:
        return
    left, top, scale = desk.examples.spot
    told = [(_points(stroke), _shade(stroke)) for stroke in strokes]
    if chart.live:
        told.append((tuple(chart.live), (chart.value, chart.radius)))
    painter = imgui.get_window_draw_list()
    for points, (grey, radius) in told:
        places = [ImVec2(left + x * scale, top + y * scale) for x, y in points]
        if chart.name == ORIENTATION:
            _arrow(places, desk.scale)
            continue
        wide, colour = 2.0 * radius * scale, theme.packed((grey,) * 3, 0.6)
        if len(set(points)) > 1:
            painter.add_polyline([*places], colour, wide, 0)
        else:
            painter.add_circle_filled(places[0], wide / 2.0, colour)


def _points(stroke: object) -> tuple[tuple[float, float], ...]:
    points = stroke.get("points", ()) if isinstance(stroke, Mapping) else ()
    return tuple((float(point[0]), float(point[1])) for point in points)


def _shade(stroke: object) -> tuple[float, float]:
    """Returns how light a stroke is, 0..1, and its radius."""
    brush = stroke.get("brush", {}) if isinstance(stroke, Mapping) else {}
    colour = str(brush.get("colour", "#000000"))
    return int(colour[1:3], 16) / 255.0, float(brush.get("radius", 16.0))


def _arrow(places: list[ImVec2], scale: float) -> None:
    """Draws a line with a head at its end."""
    painter, end = imgui.get_window_draw_list(), places[-1]
    before = next((place for place in reversed(places) if _far(place, end) > 6.0 * scale), places[0])
    length = max(_far(before, end), 1e-3)
    x, y = (end.x - before.x) / length * 10.0 * scale, (end.y - before.y) / length * 10.0 * scale
    heads = [ImVec2(end.x - x - side * y, end.y - y + side * x) for side in (-0.55, 0.55)]
    for colour, wide in ((theme.packed((0.0, 0.0, 0.0), 0.7), 4.0 * scale), (theme.packed(_ARROW), 2.0 * scale)):
        painter.add_polyline([*places], colour, wide, 0)
        if len(places) > 1:
            painter.add_polyline([heads[0], end, heads[1]], colour, wide, 0)


def _far(one: ImVec2, other: ImVec2) -> float:
    return float(((one.x - other.x) ** 2 + (one.y - other.y) ** 2) ** 0.5)
