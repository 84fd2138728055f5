"""Gestures that paint: on the canvas, in the spectrum of the texture lab, in the region of an example."""

from __future__ import annotations

import math
import time
from typing import NamedTuple

import numpy as np

from app.canvas.view import View, place_of_pixel
from app.desk import palette
from app.desk.colours import to_hex
from app.desk.desk import Desk
from app.desk.examples import chart_use, chart_work, cutting_work, example_use
from app.desk.guides import symmetry
from app.desk.guides.snapping import Snapper
from app.desk.guides.tile_seams import tell_seams
from app.desk.holding.size_lock import follow_view
from app.desk.land.land_relief import seen_brush
from app.desk.moving.painted_through import Aimed, Through, through
from app.input.events import ENDS, PenEvent
from app.tools.coming_down import come_down
from app.tools.gesture import Gesture
from app.tools.mask_strokes import MaskBegun, begin_on_mask
from app.trace import trace, trace_points
from engine.brush.settings import Brush
from engine.brush.smoothing import Smoother
from engine.brush.steadying import ON_ROPE
from engine.painting.points import REACH
from engine.studio.requests import Abandon, Begin, Finish, Points
from engine.studio.textures.texture_requests import LabBegin, LabEnd, LabPoints, RegionBegin, RegionEnd, RegionPoints


def _point(view: View, level: int, origin: tuple[int, int], event: PenEvent, start: float) -> list[float]:
    """Returns a pen event as a row of stroke points."""
    x, y = view.to_canvas(event.x, event.y).offset(level, *origin)
    pressure = event.pressure if event.pen else 1.0
    return [x, y, pressure, *_held(view, event), event.time - start, *_turned(view, event)]


def _held(view: View, event: PenEvent) -> tuple[float, float]:
    """Returns how the pen leans over the picture, which may be turned and mirrored."""
    a, b, c, d = view.matrix()
    return a * event.tilt_x + c * event.tilt_y, b * event.tilt_x + d * event.tilt_y


def _turned(view: View, event: PenEvent) -> tuple[float, ...]:
    """Returns how the pen's barrel is turned over the picture, if it tells that."""
    if event.rotation is None:
        return ()
    turn = -event.rotation if view.mirrored else event.rotation
    return ((180.0 if view.mirrored else 0.0) + turn + math.degrees(view.angle if view.mirrored else -view.angle),)


def refused(desk: Desk) -> bool:
    """Says why nothing can be painted now, if that is so."""
    if desk.known.opening and not desk.known.ready:  # who paints before the engine is there paints on a new painting
        desk.say("The paint engine is still loading")
        return True
    if desk.past.looking is not None:
        desk.say("This is an earlier step: nothing can be painted on it", bad=True, offer="now")
        return True
    layer = desk.known.active
    if layer is not None and layer.locked and not desk.selecting.masking:
        desk.say(f"Layer “{layer.name}” is locked", bad=True, of=layer)
        return True
    if layer is not None and layer.mask_turned and desk.masks.on(layer) and not desk.selecting.masking:
        desk.say(f"The mask of “{layer.name}” was turned or scaled with it", bad=True, offer="mask_lay", of=layer)
        return True
    return False


class Begun(NamedTuple):
    """A stroke that was begun: at a level, from an origin, with a brush; `aimed`: on what a placement shows."""

    level: int
    origin: tuple[int, int]
    brush: Brush
    aimed: Aimed | None

    def post(self, desk: Desk, points: np.ndarray) -> None:
        """Posts more of its points, float64 (n, 6) from the origin."""
        _post(desk, points if self.aimed is None else self.aimed.points(points))

    def end(self, desk: Desk, done: bool) -> None:
        """Ends it: it stays if it is `done`."""
        desk.post(Finish() if done else Abandon())


def begin_stroke(desk: Desk, first: PenEvent) -> Begun | MaskBegun | None:
    """Begins a stroke at the level that is shown; on a placement, on what it shows; on the mask, or the
    selection, while that is painted.  None where that cannot be, which is said."""
    if refused(desk):
        return None
    if desk.selecting.masking:
        return begin_on_mask(desk, first)
    layer = desk.known.active
    aim = _aim(desk)
    if isinstance(aim, str):
        desk.say(aim, bad=True, offers=("source", "independent"), of=layer)
        return None
    if desk.known.hiding:
        desk.say(f"“{desk.known.hiding[-1]}” is hidden: what you paint does not show", bad=True, offer="show_layer")
    example_use.fit_within_reach(desk)
    palette.provide(desk)
    follow_view(desk)
    level, brush = desk.stroke_brush(first.eraser)
    brush = seen_brush(desk, brush)
    if layer is not None and layer.wrap is not None:
        tell_seams(desk, layer.wrap, level, brush)
    origin = desk.view.to_canvas(first.x, first.y).pixel(level)
    symmetry.restore(desk)
    copies = symmetry.copies_at(desk, level, origin)
    aimed = None if aim is None else aim.begun(level, origin)
    if aim is None or aimed is None:
        desk.post(Begin(level, origin, brush, copies=copies, onto=desk.masks.onto(layer)))
    else:
        seen = aim.seen if desk.selecting.selected else None
        desk.post(Begin(aimed.level, aimed.origin, brush, aimed.layer, copies=aimed.copies(copies), seen=seen))
    return Begun(level, origin, brush, aimed)


def _aim(desk: Desk) -> Through | str | None:
    """Returns how a stroke goes on what the active placement shows; why it cannot; None where no placement is active,
    or its mask is painted on."""
    layer = desk.known.active
    if layer is None or layer.shows is None or desk.masks.on(layer):
        return None
    return through(desk.known, layer, desk.view.shown_level)


def paint(desk: Desk, first: PenEvent) -> Gesture:
    """Returns a stroke, at the level that is shown; on a placement, on what it shows; drawn onto the guide that it goes
    along.  With Shift it is straight, and a click with Shift draws a straight line from where the last one ended."""
    begun = begin_stroke(desk, first)
    if begun is None:
        return
    level, origin, brush = begun.level, begun.origin, begun.brush
    smoother, straight = _smoother(desk, 1.0 / desk.view.scale(level)), desk.pointer.shift
    snapper = Snapper(desk, level, origin, straight)
    desk.painting = True
    done = False
    try:
        told = yield from come_down(first)
        while True:
            for event in told:
                if event.kind in ("down", "move"):
                    points = np.array([_point(desk.view, level, origin, event, first.time)])
                    begun.post(desk, snapper.add(smoother.add(points)))
                    _show_rope(desk, begun, smoother)
            if told[-1].kind in ENDS:
                break
            told = [(yield)]
        rest = snapper.add(smoother.finish())
        if straight and snapper.waits:
            begun.post(desk, _from_last(desk, level, origin, told[0] if len(told) > 1 else first))
        begun.post(desk, np.concatenate([rest, snapper.finish()]))
        done = True
        desk.guides.last = desk.view.to_canvas(told[-1].x, told[-1].y)
    finally:
        desk.painting, desk.hand_sight.brush_at = False, None
        begun.end(desk, done)
        trace("a stroke is posted" if done else "a stroke is dropped")
    if brush.row.lays_ink and not isinstance(begun, MaskBegun):
        desk.hand.remember()


def _smoother(desk: Desk, unit: float) -> Smoother:
    """Returns what steadies the hand; `unit`: how many pixels of what is painted on one of the screen is."""
    return Smoother(desk.hand.stabiliser, way=desk.hand.steadying, unit=unit)


def _show_rope(desk: Desk, begun: Begun | MaskBegun, smoother: Smoother) -> None:
    """Shows where the brush is, if that trails the pen on a rope."""
    if smoother.at is not None and desk.hand.steadying == ON_ROPE and desk.hand.stabiliser:
        corner = place_of_pixel(begun.level, *begun.origin)
        desk.hand_sight.brush_at = corner.moved(*smoother.at, begun.level)


def _from_last(desk: Desk, level: int, origin: tuple[int, int], first: PenEvent) -> np.ndarray:
    """Returns where the last stroke ended, as a point of a straight line from there; none where that is not known."""
    if desk.guides.last is None:
        return np.empty((0, 6))
    x, y = desk.guides.last.offset(level, *origin)
    near = max(abs(x), abs(y)) <= REACH
    pressure = first.pressure if first.pen else 1.0
    return np.array([[x, y, pressure, *_held(desk.view, first), 0.0, *_turned(desk.view, first)]])[:near]


def paint_lab(desk: Desk, first: PenEvent) -> Gesture:
    """Returns a stroke in the texture lab's spectrum."""
    lab = desk.lab
    built_in = frozenset(row.name for row in desk.known.tables.kinds if not row.pictured)
    brush = lab.brush(desk.hand.dipped(), to_hex(desk.hand.colour), first.eraser, built_in)
    smoother = _smoother(desk, lab.made.size[0] / (lab.spot[2] if lab.spot is not None else lab.made.size[0]))
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


def mark_region(desk: Desk, first: PenEvent) -> Gesture:
    """Returns a stroke that says what of an example's picture is to be kept, or dropped; as all strokes it may be
    given up."""
    state, finding = desk.examples, cutting_work.finding_of(desk)
    if finding is None:
        return
    event, done = first, False
    finding.begin(finding.way == "keep" and not first.eraser)
    try:
        while True:
            if event.kind in ("down", "move", "up"):
                finding.extend(*state.place(event.x, event.y))
            if event.kind in ENDS:
                break
            event = yield
        done = True
    finally:
        finding.end(desk.post, done)


def draw_map(desk: Desk, first: PenEvent) -> Gesture:
    """Returns a stroke on a map of an example; as all strokes it may be given up."""
    state, event, done = desk.examples, first, False
    state.chart.live = []
    try:
        while True:
            if event.kind in ("down", "move", "up"):
                state.chart.extend(*state.place(event.x, event.y))
            if event.kind in ENDS:
                break
            event = yield
        done = True
    finally:
        if state.entry is not None:
            chart_work.use(desk, state.chart.end(chart_use.maps_of(state, state.entry), done))


def _post(desk: Desk, points: np.ndarray, form: type[Points | LabPoints | RegionPoints] = Points) -> None:
    if len(points):
        points.flags.writeable = False
        began = time.monotonic()
        desk.post(form(points))
        trace_points(len(points), began)
