"""How a pen is felt: what the artist prefers its pressure to become, and whether fingers do anything."""

from __future__ import annotations

from dataclasses import replace

from app.desk import knots
from app.input.events import PenEvent
from engine.keeping.preferences import Preferences


def felt(event: PenEvent, preferences: Preferences) -> PenEvent | None:
    """Returns an event as it is meant; None for one that means nothing.  Where a pen lies down lightly, its pressure
    stays above none if it was."""
    if event.touch and preferences.ignore_touch:
        return None
    if not event.pen or not (preferences.constant or preferences.curve):
        return event
    return replace(event, pressure=felt_pressure(event.pressure, preferences))


def felt_pressure(pressure: float, preferences: Preferences) -> float:
    """Returns what becomes of a pen's pressure, 0..1."""
    if preferences.constant:
        return preferences.constant
    return knots.at(preferences.curve, pressure) if preferences.curve else pressure
