"""The pictures that the panel of examples asks the engine for: a stroke with the one that is chosen, and thumbnails of
those that only the painting has."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from immutables import Map

from app.desk.examples import chart_use
from app.desk.examples.example_state import ExampleState
from engine.brush.parts import BY_STROKE
from engine.brush.settings import Brush
from engine.painting.commands import DefineTexture
from engine.studio.requests import Request, Swatch
from engine.texture.example.parameters import ORIENTATION

SAMPLE = "example sample"  # what the picture of a stroke is called


def ask_sample(state: ExampleState, post: Callable[[Request], None], now: float) -> None:
    """Posts the sample stroke that the panel shows, no faster than it can be seen.  `now`: seconds."""
    entry = state.entry
    drafted = state.tab == "settings"
    follows = state.follows and chart_use.runs(state, entry)
    wanted = None if entry is None else (*state.needs(entry, drafted), state.sampled, state.size, follows, entry.here)
    if state.following.due(wanted, now) and wanted is not None and min(state.sampled) > 0:
        state.sampling = state.chosen
        post(_stroke(*wanted[:5]))


def ask_thumbnails(state: ExampleState, post: Callable[[Request], None], side: int) -> None:
    """Posts the pictures of those that only the painting has: a stroke each, pixels of the framebuffer square."""
    for entry in state.entries:
        if entry.here is not None and state.hung.get(entry.ident) != (entry.here, side):
            state.hung[entry.ident] = entry.here, side
            brush = Brush(radius=side / 5, mode="example", example=entry.name, hardness=1.0, example_detail=1)
            post(Swatch(f"example {entry.ident}", brush, (side, side), soon=True))


def _stroke(name: str, needs: tuple[DefineTexture, ...], size: tuple[int, int], octaves: int, follows: bool) -> Swatch:
    """Returns a broad stroke with an example, which is so many octaves larger than it is, and `follows` the pen."""
    radius = max(2.0, min(0.24 * size[1], 0.11 * size[0]))
    brush = Brush(radius=radius, mode="example", example=name, hardness=1.0)
    control = Map({ORIENTATION: BY_STROKE}) if follows else Map()
    brush = replace(brush, example_level=-max(octaves, 0), example_detail=max(-octaves, 0), control=control)
    plain = tuple(replace(need, arguments=need.arguments.delete("detail")) for need in needs)  # below what is seen
    return Swatch(SAMPLE, brush, size, textures=plain, soon=True)
