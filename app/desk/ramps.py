"""Editing ramps of colour: 2 to 8 stops (place, "#rrggbb"), places of 0..1 rising.

Pure: every function takes stops and gives new ones.
"""

from __future__ import annotations

from itertools import pairwise

from app.desk.colours import RGB, from_hex, to_hex

Stops = tuple[tuple[float, str], ...]

FEWEST, MOST = 2, 8
_GAP = 0.004  # between neighbours
PLAIN: Stops = ((0.0, "#000000"), (1.0, "#ffffff"))


def read(value: object) -> Stops:
    """Returns the stops that a brush holds; the plain ramp from black to white if it holds none that can be read."""
    try:
        stops = tuple((float(place), to_hex(from_hex(colour))) for place, colour in value)  # type: ignore[attr-defined]
    except (TypeError, ValueError):
        return PLAIN
    rising = all(a[0] < b[0] for a, b in pairwise(stops))
    return stops if FEWEST <= len(stops) <= MOST and rising else PLAIN


def colour_at(stops: Stops, place: float) -> RGB:
    """Returns the ramp's colour, as encoded; level before the first stop and after the last."""
    before = [s for s in stops if s[0] <= place] or [stops[0]]
    after = [s for s in stops if s[0] > place] or [stops[-1]]
    (p0, c0), (p1, c1) = before[-1], after[0]
    part = (place - p0) / (p1 - p0) if p1 > p0 and place > p0 else 0.0
    a, b = from_hex(c0), from_hex(c1)
    return a[0] + (b[0] - a[0]) * part, a[1] + (b[1] - a[1]) * part, a[2] + (b[2] - a[2]) * part


def added(stops: Stops, place: float) -> tuple[Stops, int | None]:
    """With one more stop of the colour that is there already, and its number; None where there is no room."""
    i = sum(p <= place for p, _ in stops)
    lo = stops[i - 1][0] + _GAP if i else 0.0
    hi = stops[i][0] - _GAP if i < len(stops) else 1.0
    if len(stops) >= MOST or lo > hi:
        return stops, None
    place = min(max(place, lo), hi)
    return (*stops[:i], (round(place, 4), to_hex(colour_at(stops, place))), *stops[i:]), i


def moved(stops: Stops, i: int, place: float) -> Stops:
    """Stop `i` brought to a place, or as near as its neighbours let it."""
    lo = stops[i - 1][0] + _GAP if i else 0.0
    hi = stops[i + 1][0] - _GAP if i + 1 < len(stops) else 1.0
    place = min(max(place, lo), hi) if lo <= hi else stops[i][0]
    return (*stops[:i], (round(place, 4), stops[i][1]), *stops[i + 1 :])


def recoloured(stops: Stops, i: int, colour: str) -> Stops:
    """Gives the ramp with another colour at stop `i`."""
    return (*stops[:i], (stops[i][0], colour), *stops[i + 1 :])


def removed(stops: Stops, i: int) -> Stops:
    """Without stop `i`; the last two stay."""
    return stops if len(stops) <= FEWEST else (*stops[:i], *stops[i + 1 :])


def turned(stops: Stops) -> Stops:
    """End for end."""
    return tuple((round(1.0 - place, 4), colour) for place, colour in reversed(stops))
