"""The brush dipped into a colour: which of its inks go along with that, and which keep a colour of their own.

A brush in the hand is as it was mixed: its inks belong to its own `colour`.  Dipped into another, each ink lies to the
new colour as it lay to that one; so does the tint of its rim.  A fixed one stays: it says so among those members that
strokes do not know.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from functools import lru_cache

from immutables import Map

from app.desk.colours import RGB, gone_along, to_hex
from engine.brush import checks
from engine.brush.parts import Component, Edge
from engine.brush.settings import Brush

FIXED = "fixed"  # true where a part keeps its colour
INK = "ink"  # of the values of a written texture, the colour that is the hand's


def is_fixed(part: Component | Edge) -> bool:
    """Tells whether a part of a brush keeps its colour, whatever the brush is dipped into."""
    return (part.parameters if isinstance(part, Component) else part.extra).get(FIXED) is True


def fix(part: Component, on: bool = True) -> Component:
    """Returns an ink that keeps its colour, or goes along."""
    told = part.parameters
    return replace(part, parameters=told.set(FIXED, True) if on else told.delete(FIXED) if FIXED in told else told)


def fix_rim(part: Edge, on: bool = True) -> Edge:
    """Returns a rim whose tint stays, or goes along."""
    told = part.extra
    return replace(part, extra=told.set(FIXED, True) if on else told.delete(FIXED) if FIXED in told else told)


@lru_cache(maxsize=64)
def in_colour(brush: Brush, colour: str) -> Brush:
    """Returns the brush as it is to be mixed for a colour `#rrggbb`; what is fixed still says so."""
    if colour == brush.colour:
        return brush
    old, new = brush.rgb, checks.rgb(colour)
    ink = tuple(part if is_fixed(part) else _gone(part, (old, new), colour) for part in brush.ink)
    edge = brush.edge
    if edge is not None and edge.colour is not None and not is_fixed(edge):
        edge = replace(edge, colour=to_hex(gone_along(edge.rgb, old, new)))
    return replace(brush, colour=colour, ink=ink, edge=edge)


def _gone(part: Component, ways: tuple[RGB, RGB], hand: str) -> Component:
    """Returns an ink gone along from one colour to another, `hand`, which its texture's text may ask for."""
    told, colour = part.parameters, to_hex(gone_along(part.rgb, *ways))
    values = told.get("values")
    if isinstance(values, Mapping) and INK in values:
        told = told.set("values", Map({**values, INK: hand}))
    return replace(part, colour=colour, parameters=told)


@lru_cache(maxsize=64)
def dipped(brush: Brush, colour: str) -> Brush:
    """Returns the brush that strokes in a colour are painted with."""
    made = in_colour(brush, colour)
    edge = None if made.edge is None else fix_rim(made.edge, on=False)
    return replace(made, ink=tuple(fix(part, on=False) for part in made.ink), edge=edge)


def with_ink(brush: Brush, colour: str, i: int, part: Component) -> Brush:
    """Returns the brush with another ink in the place of its `i`th; `part`: as it is to be in `colour`."""
    before, shown = brush.ink[i], in_colour(brush, colour).ink[i]
    if not is_fixed(part):
        if part.colour == shown.colour and not is_fixed(before):
            part = replace(part, colour=before.colour)
        else:
            brush = in_colour(brush, colour)
    return replace(brush, ink=(*brush.ink[:i], part, *brush.ink[i + 1 :]))


def with_rim(brush: Brush, colour: str, part: Edge | None) -> Brush:
    """Returns the brush with another rim, as it is to be in `colour`."""
    before, shown = brush.edge, in_colour(brush, colour).edge
    if part is not None and not is_fixed(part):
        same = before is not None and shown is not None and part.colour == shown.colour and not is_fixed(before)
        if same and before is not None:
            part = replace(part, colour=before.colour)
        else:
            brush = in_colour(brush, colour)
    return replace(brush, edge=part)
