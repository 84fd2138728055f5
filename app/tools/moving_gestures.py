"""The gesture that moves, scales and turns layers, groups and placements."""

from __future__ import annotations

import math
from collections.abc import Callable

from app.canvas.view import View, dyadic_place
from app.desk.desk import Desk
from app.desk.moving import floating, held_box
from app.desk.moving.box import INSIDE, SCALES, TURN, opposite, spot
from app.desk.moving.move_hints import nothing_there
from app.desk.moving.move_state import Label, Trial
from app.desk.moving.poses import Spin, exact, factor, respun, scale_text, shifted, spin_of, turn_text
from app.desk.moving.setting_down import set_copy_down, set_down
from app.desk.moving.sheet_state import Carried
from app.input.events import ENDS, PenEvent
from app.tools.gesture import Gesture
from engine.canvas.placing.pose import UNMOVED, Pose, SourcePart
from engine.numeric.similarity import Dyadic
from engine.painting.layer_commands import COPY
from engine.painting.layering.placing_members import Placing
from engine.studio.moving.move_requests import Try
from engine.studio.results import LayerRow

Way = Callable[
    [PenEvent], tuple[Pose, str]
]  # from where the pointer is: where it takes what is held, and how that reads


def move(desk: Desk, first: PenEvent) -> Gesture:
    """The layer, group or placement that is chosen follows the pointer; by a handle of its box it is scaled or turned.

    It is seen there at once, and done when it is let go, as one step.  With Alt held, a copy of it is moved.  What is
    selected of a layer is lifted out of it, and floats until it is set down.
    """
    row = desk.known.active
    if row is None or desk.past.looking is not None:
        desk.say("There is no layer to move" if row is None else "This is an earlier step", bad=True)
        return
    if row.locked:
        desk.say(f"Layer “{row.name}” is locked", bad=True)
        return
    part = floating.takes_part(desk, row)
    if desk.moving.floating is None and desk.moving.empty(desk.known, row, part):
        desk.say(nothing_there(row.name, part), bad=True)
        return
    if part:
        yield from _move_part(desk, row, first)
        return
    box = held_box.seen_box(desk)
    desk.moving.grip = (box.grip(first.x, first.y) if box is not None else "") or INSIDE
    copying = desk.pointer.alt and desk.moving.grip == INSIDE
    way, start = _way(desk, row, first), desk.moving.pose(desk.known, row)
    event, pose, done = first, start, False
    desk.moving.sheets.begin()
    try:
        while event.kind not in ENDS:
            pose = _tried(desk, row, (pose, copying), way(event))
            event = yield
        done = event.kind == "up"
    finally:
        desk.moving.label, desk.moving.grip = None, ""
        if done and pose != start:
            (set_copy_down if copying else set_down)(desk, row, pose)
        else:
            desk.moving.trial = None
            _carries(desk, row, start, False)
            desk.post(Try(row.name, None))
        desk.moving.sheets.end(desk.post)


def _move_part(desk: Desk, row: LayerRow, first: PenEvent) -> Gesture:
    """What is selected of a layer follows the pointer; given up, it is where it was before."""
    box = held_box.seen_box(desk)
    desk.moving.grip = (box.grip(first.x, first.y) if box is not None else "") or INSIDE
    copying = desk.pointer.alt and desk.moving.grip == INSIDE
    if copying:
        floating.set_part_down(desk)  # the copy is of what is there now
    before = desk.moving.floating
    way, start = _way(desk, row, first), desk.moving.pose(desk.known, row)
    event, pose, done = first, start, False
    try:
        while event.kind not in ENDS:
            found, text = way(event)
            if found.wrong() is None:
                desk.moving.label = Label(f"copy  {text}" if copying else text, exact(found, desk.view.shown_level))
                if found != pose:
                    pose = found
                    floating.lift(desk, row, pose, COPY if copying else "")
            event = yield
        done = event.kind == "up"
    finally:
        desk.moving.label, desk.moving.grip = None, ""
        if not done and before is not None:
            floating.lift(desk, row, before.pose, before.way)
        elif not done:
            floating.let_go(desk)


def _tried(desk: Desk, row: LayerRow, before: tuple[Pose, bool], found: tuple[Pose, str]) -> Pose:
    """Shows it, or a copy of it, where it is now, and returns that; where it was before, if it cannot be there."""
    (was, copying), (pose, text) = before, found
    if pose.wrong() is not None:
        return was
    desk.moving.label = Label(f"copy  {text}" if copying else text, exact(pose, desk.view.shown_level))
    if pose != was:
        desk.moving.trial = Trial(desk.known.scene, row.name, pose)
        if not _carries(desk, row, pose, copying):
            desk.post(Try(row.name, Placing.at_pose(pose), copying))
    return pose


def _carries(desk: Desk, row: LayerRow, pose: Pose, copying: bool) -> bool:
    """Shows what is dragged elsewhere by the window alone; False where only the engine can."""
    held = held_box.part(desk, row)
    if held is None:
        return False
    return desk.moving.sheets.carry(desk.known, row, desk.view, Carried(pose, spot(held, UNMOVED, 0, 0), copying))


def _way(desk: Desk, row: LayerRow, first: PenEvent) -> Way:
    """Returns what a drag does, by what it took hold of."""
    held, pose, grip = held_box.part(desk, row), desk.moving.pose(desk.known, row), desk.moving.grip
    if held is not None and grip in SCALES:
        return _scaling(desk, first, pose, (held, grip))
    if held is not None and grip == TURN:
        return _turning(desk, first, pose, spot(held, pose, 0, 0))
    return _moving(desk, first, pose)


def _moving(desk: Desk, first: PenEvent, pose: Pose) -> Way:
    level = desk.view.shown_level
    start = desk.view.to_canvas(first.x, first.y).pixel(level)

    def way(event: PenEvent) -> tuple[Pose, str]:
        x, y = (now - was for now, was in zip(_pixel(desk.view, event, level), start, strict=True))
        if desk.pointer.shift:
            x, y = (x, 0) if abs(x) >= abs(y) else (0, y)
        return (shifted(pose, level, x, y) if x or y else pose), f"{_signed(x)}, {_signed(y)} px"

    return way


def _scaling(desk: Desk, first: PenEvent, pose: Pose, held: tuple[SourcePart, str]) -> Way:
    part, handle = held
    level, spin = desk.view.shown_level, spin_of(pose)
    middle = desk.pointer.alt
    about = spot(part, pose, 0, 0) if middle else opposite(part, pose, handle)
    before = _away(desk.view, first, about)
    long = before[0] ** 2 + before[1] ** 2 or 1.0

    def way(event: PenEvent) -> tuple[Pose, str]:
        now = _away(desk.view, event, about)
        by = (now[0] * before[0] + now[1] * before[1]) / long
        found = spin.scaled(factor(by)).snapped_scale()
        return _spun(pose, spin, found, (about, level)), scale_text(found)

    return way


def _turning(desk: Desk, first: PenEvent, pose: Pose, about: Dyadic) -> Way:
    level, spin = desk.view.shown_level, spin_of(pose)
    x, y = _away(desk.view, first, about)
    begin = math.atan2(y, x)

    def way(event: PenEvent) -> tuple[Pose, str]:
        x, y = _away(desk.view, event, about)
        found = spin.turned(spin.degrees + math.degrees(math.atan2(y, x) - begin)).snapped_turn(desk.pointer.shift)
        return _spun(pose, spin, found, (about, level)), turn_text(found)

    return way


def _spun(pose: Pose, before: Spin, found: Spin, where: tuple[Dyadic, int]) -> Pose:
    return pose if found == before else respun(pose, found, *where)


def _pixel(view: View, event: PenEvent, level: int) -> tuple[int, int]:
    return view.to_canvas(event.x, event.y).pixel(level)


def _away(view: View, event: PenEvent, place: Dyadic) -> tuple[float, float]:
    """Returns how far the pointer is from a place, in pixels of the level that is shown."""
    level = view.shown_level
    x, y = view.centre.pixel(level)
    (ax, ay), (bx, by) = (at.offset(level, x, y) for at in (view.to_canvas(event.x, event.y), dyadic_place(place)))
    return ax - bx, ay - by


def _signed(value: int) -> str:
    return f"{value:+d}".replace("-", "−") if value else "0"
