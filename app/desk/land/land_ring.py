"""The brush's circle as it lies on the land, seen in the window."""

from __future__ import annotations

import math
from fractions import Fraction

from app.desk.land.land_state import LandState
from engine.terrain.seen.eye import as_fraction
from engine.terrain.seen.land_tiles import QUADS, LandTile
from engine.terrain.seen.meeting import ground_under

_CORNERS = 48


def ring_on_land(
    state: LandState, x: float, y: float, radius: float, level: int | None = None
) -> list[tuple[float, float]]:
    """Returns points of the window around a point of it, as far away on the ground as a stroke of that radius, in
    pixels of a level, would reach; none in the sky.  `level`: None for that which is seen there."""
    found, eye = state.hit(x, y), state.eye
    if found is None or eye is None:
        return []
    wide = math.ldexp(radius, -(state.level_at(found.away) if level is None else level))
    tiles = [
        kept.tile for key in state.drawn if (kept := state.kept.get(key)) and _near(kept.tile, found.x, found.y, wide)
    ]
    axes, pixel, out = eye.axes(), eye.pixel(state.size[0]), []
    for i in range(_CORNERS):
        turn = 2.0 * math.pi * i / _CORNERS
        at = found.x + as_fraction(wide * math.cos(turn)), found.y + as_fraction(wide * math.sin(turn))
        z = ground_under(tiles, *at)
        across, down = eye.offset(*at)
        right, up, ahead = (axes @ (across, down, (found.z if z is None else z) - eye.z)).tolist()
        if ahead <= 0.0:
            return []
        left, top, width, height = state.room
        out.append((left + width / 2 + right / (ahead * pixel), top + height / 2 - up / (ahead * pixel)))
    return out


def _near(tile: LandTile, x: Fraction, y: Fraction, wide: float) -> bool:
    """Tells whether a tile may lie under a square around a place."""
    side, by = Fraction(QUADS) / Fraction(2) ** tile.key.level, as_fraction(wide)
    return (
        tile.key.x * side <= x + by
        and x - by <= (tile.key.x + 1) * side
        and (tile.key.y * side <= y + by and y - by <= (tile.key.y + 1) * side)
    )
