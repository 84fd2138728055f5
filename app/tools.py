"""The tools: each gesture is a generator that gets pen events from touch-down to lift-off.

A gesture may be closed early (Esc): it then leaves nothing half done.  Where the pen is lost (`events.ENDS`), strokes
end and stay; all other gestures are closed.
"""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Generator
from typing import NamedTuple

import numpy as np

from app import icons
from app.canvas.view import Place, View
from app.desk import palette
from app.desk.colours import to_hex
from app.desk.desk import Desk
from app.desk.examples import example_use
from app.desk.known import moved_by
from app.desk.match_state import SMALLEST
from app.input.events import ENDS, PenEvent
from app.trace import trace, trace_points
from engine.brush.smoothing import Smoother
from engine.numeric.address import Rect
from engine.painting.layer_commands import SetLayer
from engine.studio.moving.move_requests import Try
from engine.studio.requests import (
    Abandon,
    Begin,
    Do,
    Finish,
    LabBegin,
    LabEnd,
    LabPoints,
    Pick,
    Points,
    RegionBegin,
    RegionEnd,
    RegionPoints,
)

Gesture = Generator[None, PenEvent, None]


def _point(view: View, level: int, origin: tuple[int, int], event: PenEvent, start: float) -> list[float]:
    """Returns a pen event as a row of stroke points."""
    x, y = view.to_canvas(event.x, event.y).offset(level, *origin)
    pressure = event.pressure if event.pen else 1.0
    return [x, y, pressure, event.tilt_x, event.tilt_y, event.time - start]


def paint(desk: Desk, first: PenEvent) -> Gesture:
    """Returns a stroke, at the level that is shown."""
    if desk.known.opening and not desk.known.ready:  # who paints before the engine is there paints on a new painting
        desk.say("The paint engine is still loading")
        return
    if desk.past.looking is not None:
        desk.say("This is an earlier step: nothing can be painted on it", bad=True, offer="now")
        return
    layer = desk.known.active
    if layer is not None and layer.locked:
        desk.say(f"Layer “{layer.name}” is locked", bad=True)
        return
    if layer is not None and layer.shows is not None:
        desk.say(f"“{layer.name}” shows “{layer.shows.name or 'the painting'}”: paint on that", bad=True)
        return
    if desk.known.hiding:
        desk.say(f"“{desk.known.hiding[-1]}” is hidden: what you paint does not show", bad=True, offer="show_layer")
    example_use.fit_within_reach(desk)
    palette.provide(desk)
    level, brush = desk.stroke_brush(first.eraser)
    origin = desk.view.to_canvas(first.x, first.y).pixel(level)
    smoother = Smoother(desk.hand.stabiliser)
    desk.post(Begin(level, origin, brush))
    desk.painting = True
    done = False
    try:
        event = first
        while True:
            if event.kind in ("down", "move"):
                _post(desk, smoother.add(np.array([_point(desk.view, level, origin, event, first.time)])))
            if event.kind in ENDS:
                break
            event = yield
        _post(desk, smoother.finish())
        done = True
    finally:
        desk.painting = False
        desk.post(Finish() if done else Abandon())
        trace("a stroke is posted" if done else "a stroke is dropped")
    if brush.row.lays_ink:
        desk.hand.remember()


def paint_lab(desk: Desk, first: PenEvent) -> Gesture:
    """Returns a stroke in the texture lab's spectrum."""
    lab = desk.lab
    built_in = frozenset(row.name for row in desk.known.tables.kinds if not row.pictured)
    brush = lab.brush(desk.hand.brush, to_hex(desk.hand.colour), first.eraser, built_in)
    smoother = Smoother(desk.hand.stabiliser)
    desk.post(LabBegin(brush))
    lab.painting = True
    done = False
    try:
        event = first
        while True:
            if event.kind in ("down", "move"):
                pressure = event.pressure if event.pen else 1.0
                row = [*lab.place(event.x, event.y), pressure, event.tilt_x, event.tilt_y, event.time - first.time]
                _post(desk, smoother.add(np.array([row])), LabPoints)
            if event.kind in ENDS:
                break
            event = yield
        _post(desk, smoother.finish(), LabPoints)
        done = True
    finally:
        lab.painting = False
        desk.post(LabEnd(done))


def _post(desk: Desk, points: np.ndarray, form: type[Points | LabPoints | RegionPoints] = Points) -> None:
    if len(points):
        points.flags.writeable = False
        began = time.monotonic()
        desk.post(form(points))
        trace_points(len(points), began)


def pan(desk: Desk, first: PenEvent) -> Gesture:
    """The picture follows the pointer: the place that was touched stays under it."""
    desk.glide.stop()
    held = desk.view.to_canvas(first.x, first.y)
    while True:
        event = yield
        desk.view = desk.view.held(held, event.x, event.y)
        if event.kind == "up":
            return


def zoom(desk: Desk, first: PenEvent) -> Gesture:
    """Drag up or right to zoom in about the place touched; a click zooms in by one level."""
    desk.glide.stop()
    start = desk.view
    held = start.to_canvas(first.x, first.y)
    moved = 0.0
    while True:
        event = yield
        moved = max(moved, math.hypot(event.x - first.x, event.y - first.y))
        if event.kind == "up":
            break
        way = (event.x - first.x) - (event.y - first.y)
        desk.view = start.zoomed(way / (120 * desk.scale)).held(held, first.x, first.y)
    if moved < 4 * desk.scale:
        desk.view = start
        desk.glide.zoom(start, 1.0, first.x, first.y)


def turn(desk: Desk, first: PenEvent) -> Gesture:
    """Turns the picture about the middle of the free area."""
    desk.glide.stop()
    x, y = desk.middle()
    start, place = desk.view, desk.view.to_canvas(x, y)
    begin = math.atan2(first.y - y, first.x - x)
    while True:
        event = yield
        angle = start.angle + math.atan2(event.y - y, event.x - x) - begin
        quarter = round(angle / (math.pi / 2)) * (math.pi / 2)
        desk.view = desk.view.turned(quarter if abs(angle - quarter) < 0.04 else angle, x, y).held(place, x, y)
        if event.kind == "up":
            return


def pick(desk: Desk, first: PenEvent) -> Gesture:
    """Takes the colour under the pointer."""
    event = first
    while True:
        place: Place = desk.view.to_canvas(event.x, event.y)
        level = desk.view.shown_level
        desk.post(Pick(level, *place.pixel(level)))
        if event.kind == "up":
            return
        event = yield


def mark(desk: Desk, first: PenEvent) -> Gesture:
    """A rectangle of the canvas becomes an example to match."""
    match, index = desk.match, desk.match.marking or 0
    event = first
    try:
        while event.kind != "up":
            match.marked = first.x, first.y, event.x, event.y
            event = yield
    finally:
        match.marked = None
    level, view = desk.view.shown_level, desk.view
    corners = [view.to_canvas(x, y).pixel(level) for x in (first.x, event.x) for y in (first.y, event.y)]
    xs, ys = zip(*corners, strict=True)
    rect = Rect(min(xs), min(ys), max(xs), max(ys))
    if min(rect.width, rect.height) < SMALLEST:
        desk.say(f"An example has at least {SMALLEST} pixels along each side", bad=True)
        return
    match.show_area(index, level, rect)


def paint_region(desk: Desk, first: PenEvent) -> Gesture:
    """Returns a stroke in the region of an example; as all strokes it may be dropped.  A click takes a colour out of
    it."""
    state, region = desk.examples, desk.examples.region
    if region is None:
        return
    event = first
    if region.way == "colour" and not first.eraser:
        x, y = state.place(first.x, first.y)
        region.pick(desk.post, int(x // 1), int(y // 1))
        while event.kind != "up":
            event = yield
        return
    op = "add" if region.way == "in" and not first.eraser else "subtract"
    desk.post(RegionBegin(region.scene.ident, op, region.radius))
    done = False
    try:
        while True:
            if event.kind in ("down", "move", "up"):
                _post(desk, np.array([[*state.place(event.x, event.y), 1.0, 0.0, 0.0, 0.0]]), RegionPoints)
            if event.kind in ENDS:
                break
            event = yield
        done = True
    finally:
        desk.post(RegionEnd(done))


def move(desk: Desk, first: PenEvent) -> Gesture:
    """The layer, group or placement that is chosen follows the pointer, by whole pixels of the level that is shown."""
    row = desk.known.active
    if row is None or desk.past.looking is not None:
        desk.say("There is no layer to move" if row is None else "This is an earlier step", bad=True)
        return
    if row.locked:
        desk.say(f"Layer “{row.name}” is locked", bad=True)
        return
    level = desk.view.shown_level
    start, event, placing = desk.view.to_canvas(first.x, first.y).pixel(level), first, None
    done = False
    try:
        while event.kind not in ENDS:
            x, y = desk.view.to_canvas(event.x, event.y).pixel(level)
            way = moved_by(row, level, x - start[0], y - start[1])
            if way != placing:
                placing = way
                desk.post(Try(row.name, way))
            event = yield
        done = event.kind == "up"
    finally:
        if done and placing is not None:
            desk.post(Do(SetLayer(row.name, placing=placing)))
        else:
            desk.post(Try(row.name, None))


def swap(desk: Desk, first: PenEvent) -> Gesture:
    """Returns what was painted with an example, at the place touched, becomes like the chosen one."""
    event = first
    while event.kind != "up":
        event = yield
    example_use.swap(desk, event.x, event.y)


def ask_here(desk: Desk, first: PenEvent) -> Gesture:
    """Asks for the strokes that show at the place touched."""
    event = first
    while event.kind != "up":
        event = yield
    level = desk.view.shown_level
    desk.past.ask(desk.post, level, *desk.view.to_canvas(event.x, event.y).pixel(level))


class Tool(NamedTuple):
    """A row of the table of tools."""

    title: str
    icon: str
    gesture: Callable[[Desk, PenEvent], Gesture]
    hint: str
    outline: bool = False  # shows the brush's circle


TOOLS: dict[str, Tool] = {
    "brush": Tool("Brush", icons.BRUSH, paint, "Paint with the chosen brush", True),
    "move": Tool("Move", icons.MOVE, move, "Drag the layer, by whole pixels of what you see; nothing of it is lost"),
    "pan": Tool("Pan", icons.HAND, pan, "Drag the picture (Space or the middle button with any tool)"),
    "zoom": Tool("Zoom", icons.ZOOM, zoom, "Drag to zoom, click to go one level deeper (the wheel with any tool)"),
    "turn": Tool("Turn", icons.ROTATE, turn, "Drag to turn the view; the painting itself stays as it is"),
    "pick": Tool(
        "Pick colour", icons.PICK, pick, "Take a colour from the picture (Ctrl or the right button with any tool)"
    ),
}
