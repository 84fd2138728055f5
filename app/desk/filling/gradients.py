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
from engine.studio.requests import Do

FRAME_CAP = 1 << 22  # pixels of a frame that are filled: a larger one is at a coarser level
LAST = "Gradient"  # the name of the one laid last
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
    start, end = _in_cell(desk, level, start, end)
    name = _defined(desk, level, start, end)
    colour = to_hex(desk.hand.colour)
    if desk.filling.fades:
        brush = Brush(colour=colour, density=Surface(name))
    else:
        brush = Brush(colour=colour, ink=(Component(name),))
    ants = desk.selecting.ants
    if ants is not None and ants.bounded:
        post_fill(desk, Fill(brush, level=level))
    else:
        post_fill(desk, Fill(brush, _ground(desk, at), open=True))
    desk.hand.remember()


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
    state = desk.filling
    ends = ("#ffffff", "#ffffff00") if state.fades else (to_hex(desk.hand.colour), to_hex(desk.hand.other_colour))
    ramp = ((0.0, ends[0]), (1.0, ends[1]))
    told = Map({"kind": state.shape, "from": start, "to": end, "level": level, "ramp": ramp})
    free = _known(desk).get(LAST, "gradient") == "gradient" and not refers(desk.hand.brush, LAST)
    state.gradient = DefineTexture(LAST if free else _free(desk), "gradient", told)
    desk.post(Do(state.gradient))
    return state.gradient.name


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
    level = desk.view.shown_level
    x, y = at.pixel(0)
    frame = desk.known.frame
    if not (frame.x0 <= x < frame.x1 and frame.y0 <= y < frame.y1):
        return all_in(desk.view.visible(level), level)
    while frame.zoomed(level).area > FRAME_CAP:
        level -= 1
    return all_in(frame.zoomed(level), level)
