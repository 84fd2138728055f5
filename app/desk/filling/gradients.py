"""Gradients as the window asks for them: a texture from one place to another, and one fill with it."""

from __future__ import annotations

import math
from dataclasses import replace

from immutables import Map

from app.canvas.view import Place
from app.desk.colours import to_hex
from app.desk.desk import Desk
from app.desk.filling.fill_state import all_in
from app.desk.filling.pouring import post_fill
from app.desk.guides.shape_paths import Corner
from app.desk.naming import free_name
from engine.brush.parts import Component, Surface
from engine.brush.settings import Brush
from engine.makers.definitions import refers
from engine.painting.commands import DefineTexture
from engine.painting.fill_command import Fill, Like
from engine.painting.places import LEVEL_LIMIT
from engine.studio.adjusting.trial_records import TryFill
from engine.studio.requests import Do

FRAME_CAP = 1 << 22  # pixels of a frame that are filled: a larger one is at a coarser level
LAST = "Gradient"  # the name of the one laid last
_COARSER = 2  # levels by which what is seen of one while it is dragged is coarser
_DEEPEST_PLACE = float(1 << 50)  # px: beyond, the ends of a gradient would not be where they were put

GRADIENT_SHAPES = (
    ("linear", "Linear", "Along the line that you drag"),
    ("radial", "Radial", "Around the place where you press"),
    ("angular", "Angular", "Once around the place where you press, clockwise"),
)


def lay(desk: Desk, at: Place, level: int, start: Corner, end: Corner) -> None:
    """Fills what is selected, else the frame, or what is in sight outside of it, with a gradient from one place to
    another, in pixels of a level; `at`: where that was begun."""
    if max(map(abs, (*start, *end))) > _DEEPEST_PLACE:
        desk.say("This is too deep for a gradient", bad=True)
        return
    name = _defined(desk, level, start, end)
    brush, ants = _brush(desk, name), desk.selecting.ants
    if ants is not None and ants.bounded:
        post_fill(desk, Fill(brush, level=level))
    else:
        post_fill(desk, Fill(brush, _ground(desk, at), open=True))
    desk.hand.remember()


def look(desk: Desk, at: Place, level: int, start: Corner, end: Corner) -> None:
    """Shows the gradient that `lay` would lay, at a coarser level and as far as it is in sight."""
    if max(map(abs, (*start, *end))) > _DEEPEST_PLACE:
        return
    ants = desk.selecting.ants
    coarse = max(desk.view.shown_level - _COARSER, -LEVEL_LIMIT)
    area, frame = desk.view.visible(coarse), desk.known.frame.zoomed(coarse)
    if not (ants is not None and ants.bounded) and _in_frame(desk, at):
        area = area.intersect(frame)
    name = LAST if _lists_one(desk) else free_name(LAST, {*desk.filling.named, *_known(desk)})
    texture = DefineTexture(name, "gradient", _told(desk, level, start, end))
    wanted = TryFill(_brush(desk, name), coarse, area, texture, desk.masks.onto(desk.known.active))
    if wanted != desk.filling.tried and not area.empty:
        desk.filling.tried = wanted
        desk.post(wanted)


def leave(desk: Desk) -> None:
    """Shows the painting as it is."""
    if desk.filling.tried is not None:
        desk.filling.tried = None
        desk.post(TryFill(None))


def _brush(desk: Desk, name: str) -> Brush:
    """Returns the brush that fills with a gradient of a name."""
    colour = to_hex(desk.hand.colour)
    if desk.filling.fades:
        return Brush(colour=colour, density=Surface(name))
    return Brush(colour=colour, ink=(Component(name),))


def _in_cell(desk: Desk, level: int, start: Corner, end: Corner) -> tuple[Corner, Corner]:
    """Returns the ends by whole periods of a layer that wraps around in its cell, where its paint lies."""
    row = desk.known.active
    cell = None if row is None or row.wrap is None or level < row.wrap.whole_from else row.wrap
    if cell is None:
        return start, end
    rect = cell.rect.zoomed(level - cell.level)
    x = (math.floor(start[0]) - rect.x0) // rect.width * rect.width
    y = (math.floor(start[1]) - rect.y0) // rect.height * rect.height
    return (start[0] - x, start[1] - y), (end[0] - x, end[1] - y)


def _defined(desk: Desk, level: int, start: Corner, end: Corner) -> str:
    """Defines the texture of the gradient, and returns its name: the painting lists the last one alone, however many
    are laid, but for those that are kept."""
    told = _told(desk, level, start, end)
    gradient = DefineTexture(LAST if _lists_one(desk) else _free(desk), "gradient", told)
    desk.filling.gradient = gradient
    desk.post(Do(gradient))
    return gradient.name


def _told(desk: Desk, level: int, start: Corner, end: Corner) -> Map[str, object]:
    """Returns the arguments that define a gradient from one place to another."""
    state = desk.filling
    start, end = _in_cell(desk, level, start, end)
    ends = ("#ffffff", "#ffffff00") if state.fades else (to_hex(desk.hand.colour), to_hex(desk.hand.other_colour))
    ramp = ((0.0, ends[0]), (1.0, ends[1]))
    return Map({"kind": state.shape, "from": start, "to": end, "level": level, "ramp": ramp})


def _lists_one(desk: Desk) -> bool:
    """Tells whether the one laid last may be listed under the name that it always has."""
    return _known(desk).get(LAST, "gradient") == "gradient" and not refers(desk.hand.brush, LAST)


def may_keep(desk: Desk) -> bool:
    """Tells whether a gradient was laid that has no name of its own."""
    last = desk.filling.gradient
    return last is not None and last.name == LAST and _known(desk).get(LAST) == "gradient"


def keep_gradient(desk: Desk) -> None:
    """Gives the gradient laid last a name of its own, under which it stays among the textures."""
    last = desk.filling.gradient
    if last is not None:
        desk.filling.gradient = replace(last, name=_free(desk))
        desk.post(Do(desk.filling.gradient))
        desk.say(f"Kept as “{desk.filling.gradient.name}”")


def _known(desk: Desk) -> dict[str, str]:
    """Returns the kinds of the painting's textures, by their names."""
    return {} if desk.known.scene is None else dict(desk.known.scene.texture_kinds)


def _free(desk: Desk) -> str:
    """Returns a name for a gradient that no other texture has."""
    name = free_name(LAST, {*desk.filling.named, *_known(desk)})
    desk.filling.named.add(name)  # the painting is told of it with its next scene
    return name


def _ground(desk: Desk, at: Place) -> Like:
    """Returns all that a gradient covers where no more is selected than elsewhere."""
    level, frame = desk.view.shown_level, desk.known.frame
    if not _in_frame(desk, at):
        return all_in(desk.view.visible(level), level)
    while frame.zoomed(level).area > FRAME_CAP:
        level -= 1
    return all_in(frame.zoomed(level), level)


def _in_frame(desk: Desk, at: Place) -> bool:
    (x, y), frame = at.pixel(0), desk.known.frame
    return frame.x0 <= x < frame.x1 and frame.y0 <= y < frame.y1
