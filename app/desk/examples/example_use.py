"""Painting with an example: the brush takes one, at a size that fits what is seen; new ones come into the palette."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from immutables import Map

from app.desk import palette
from app.desk.desk import Desk
from app.desk.examples import chart_use, example_state
from app.desk.examples.example_state import Entry
from app.desk.hand import go_on_with_brush
from engine.brush.parts import BY_STROKE
from engine.brush.settings import Brush
from engine.painting.commands import Swap
from engine.studio.requests import Do, GetReady
from engine.texture.example.parameters import ORIENTATION

_NEAR = 1  # levels: an example that is chosen so near to where the last one was has the same pixels


def gather(desk: Desk) -> None:
    """Lists those that only the painting has, too."""
    state = desk.examples
    here = () if desk.known.scene is None else example_state.here(desk.known.scene.definitions, state)
    state.entries = tuple(example_state.arranged([*(entry for entry in state.entries if entry.here is None), *here]))
    if state.group not in (example_state.ALL, *state.groups()):
        state.group = example_state.ALL


def prepare(desk: Desk, now: float) -> None:
    """Has the engine get ready for examples, once, when the palette is open or something is painted with one."""
    state = desk.examples
    given = () if desk.known.scene is None else desk.known.scene.texture_kinds
    used = desk.hand.brush.row.grows or desk.strip == "examples" or any(kind == example_state.KIND for _, kind in given)
    if used and not state.prepared:
        state.prepared = True
        desk.learn(preparing=now)
        desk.post(GetReady())


def choose(desk: Desk, entry: Entry) -> None:
    """The brush paints with an example from now on, as large as its pixels are where the view is now."""
    state, level = desk.examples, desk.view.shown_level
    state.chosen = entry.ident
    if not desk.hand.brush.row.grows or abs(level - state.base) > _NEAR:
        state.base = level
    if not desk.hand.brush.row.grows:  # the tip and the width of a pencil, say, are not for this
        desk.hand.take(Brush(radius=state.radius, hardness=1.0), "")
    take_example(desk)


def take_example(desk: Desk) -> None:
    """The brush gets the chosen example with its settings, the painting with the first stroke; without one, the first
    of the palette, which opens."""
    state, entry = desk.examples, desk.examples.entry
    if entry is None:
        desk.strip, desk.panels, state.tab = "examples", True, "palette"
        if state.listed():
            choose(desk, state.listed()[0])
        return
    name, needs = state.needs(entry)
    others = (need for need in desk.hand.needs if need.name != name)
    desk.hand.take(replace(desk.hand.brush, mode="example", example=name), needs=(*others, *needs))
    go_on_with_brush(desk.hand)
    follow(desk)


def follow(desk: Desk) -> None:
    """The brush has the size and depth that are set."""
    state = desk.examples
    if desk.hand.brush.row.grows:
        control = chart_use.control_of(state, desk.hand.brush)
        members: dict[str, Any] = {**state.levels(), "depth": float(state.depth), "control": control}
        desk.hand.change(**members)


def set_following(desk: Desk, on: bool) -> None:
    """The texture runs the way each stroke goes, or as the example does; one that did not tell which way it runs does
    so rightwards."""
    state, entry = desk.examples, desk.examples.entry
    state.follows = on
    if on and entry is not None and entry.here is None and not chart_use.runs(state, entry):
        state.charts[entry.ident] = chart_use.maps_of(state, entry).set(ORIENTATION, Map({"strokes": ()}))
    take_example(desk)


def tell_number(desk: Desk, name: str, value: float | None) -> None:
    """Strokes tell a map of the example a number, 0..1, or None: what the example is in the mean."""
    control = desk.hand.brush.control
    if value is not None:
        control = control.set(name, value)
    elif name in control:
        control = control.delete(name)
    desk.hand.change(control=control)


def adopt(desk: Desk) -> None:
    """The panel shows what a brush has that came with an example of its own; its size fits what is seen."""
    state, brush = desk.examples, desk.hand.brush
    if not brush.row.grows:
        return
    need = next((need for need in desk.hand.needs if need.name == brush.example), None)
    told = None if need is None else need.arguments.get("bundled", need.arguments.get("path"))
    found = (entry for entry in state.entries if told in (str(entry.picture), None if entry.own else entry.name))
    entry = next(found, None) if told is not None else None
    state.chosen = entry.ident if entry is not None else ""
    state.size, state.depth = -brush.example_detail, round(brush.depth or 0)
    state.follows = brush.control.get(ORIENTATION) == BY_STROKE or not chart_use.runs(state, entry)
    fit_size(desk)


def fit_size(desk: Desk) -> None:
    """The texture's size goes by the pixels that are seen now."""
    desk.examples.base = desk.view.shown_level
    follow(desk)


def fit_within_reach(desk: Desk) -> None:
    """Before a stroke: the texture's size is fitted anew where the view is too far from where it was chosen."""
    if desk.hand.brush.row.grows and not example_state.within_reach(desk.hand.brush, desk.view.shown_level):
        fit_size(desk)
        desk.say("The texture’s size was set too far away: it fits this zoom now")


def swap(desk: Desk, x: float, y: float) -> None:
    """The texture at a point of the screen becomes like the chosen example."""
    level = desk.view.shown_level
    desk.examples.swapping = False
    take_example(desk)
    palette.provide(desk)
    if desk.hand.brush.example is not None:
        at = desk.view.to_canvas(x, y).pixel(level)
        desk.post(Do(Swap(level, at, desk.hand.brush.example, detail=desk.hand.brush.example_detail)))
