"""What the maps of the chosen example mean to the brush."""

from __future__ import annotations

from immutables import Map

from app.desk.examples.example_state import Entry, ExampleState
from engine.brush.parts import BY_STROKE
from engine.brush.settings import Brush
from engine.texture.example.parameters import ORIENTATION, RIM_CHANNEL


def maps_of(state: ExampleState, entry: Entry) -> Map[str, object]:
    """Returns the maps that an example is painted with."""
    return state.charts.get(entry.ident, entry.maps)


def shades(state: ExampleState) -> tuple[str, ...]:
    """Returns the names of the maps of the chosen example that strokes may tell a number."""
    entry = state.entry
    if entry is None:
        return ()
    names = maps_of(state, entry) if entry.here is None else [row[0] for row in entry.here.get("controls", ())]
    return tuple(name for name in names if name not in (ORIENTATION, RIM_CHANNEL))


def told_number(brush: Brush, name: str) -> float | None:
    """Returns the number that a brush tells a map; None where it tells none."""
    found = brush.control.get(name)
    return float(found) if isinstance(found, int | float) else None


def runs(state: ExampleState, entry: Entry | None) -> bool:
    """Tells whether an example tells which way it runs."""
    if entry is None:
        return False
    if entry.here is None:
        return ORIENTATION in maps_of(state, entry)
    return any(row[:1] == (ORIENTATION,) for row in entry.here.get("controls", ()))


def control_of(state: ExampleState, brush: Brush) -> Map[str, str | float]:
    """Returns what a brush tells of the chosen example's maps: the way the pen goes, if that is to be followed."""
    if state.follows and runs(state, state.entry):
        return brush.control.set(ORIENTATION, BY_STROKE)
    told = brush.control.get(ORIENTATION)
    return brush.control.delete(ORIENTATION) if told == BY_STROKE else brush.control
