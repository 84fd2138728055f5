"""A film through the land: from outlook to outlook, as fast as what is near allows."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from fractions import Fraction
from itertools import pairwise

import numpy as np

from engine.canvas.tile_cache import TileCache
from engine.numeric.address import Rect
from engine.painting.outlook import Outlook
from engine.painting.value import Painting
from engine.terrain.camera import Camera
from engine.terrain.drape import cover_of
from engine.terrain.land_picture import Shot, picture_of_land
from engine.terrain.plane import land

SAMPLES = 3  # of a pixel of a frame
_CACHE = 64 << 20  # bytes
_LEAST = 0.25  # of the height above the ground that two outlooks would have between them: no hill comes nearer
_FINEST = 32  # level at which the ground below an outlook is looked up, at most


def land_frames(
    painting: Painting, places: Sequence[Outlook], size: tuple[int, int], count: int
) -> Iterator[np.ndarray]:
    """Yields `count` frames of a flight through the land: uint8 (height, width, 3), read-only."""
    seen = land(painting, cache=TileCache(_CACHE))
    wet = seen.sea != 0.0
    cover = cover_of(seen, wet)

    def ground(outlook: Outlook) -> float:
        level = min(_FINEST, max(0, outlook.level))
        by = Fraction(2) ** level
        x, y = outlook.place()
        z = float(seen.height(level, Rect.at(math.floor(x * by), math.floor(y * by), 1, 1))[0, 0])
        return max(z, 0.0) if wet else z

    last: tuple[Camera, np.ndarray] | None = None
    for camera in cameras(places, count, ground):
        if last is None or last[0] != camera:
            frame = picture_of_land(seen, cover, Shot(camera, size, SAMPLES, wet=wet))
            frame.flags.writeable = False
            last = camera, frame
        yield last[1]


def cameras(places: Sequence[Outlook], count: int, ground: Callable[[Outlook], float]) -> Iterator[Camera]:
    """Yields where the eye is in each of `count` frames: at rest at each outlook.  `ground`: its height below one."""
    legs = list(pairwise(places)) or [(places[0], places[0])]
    for i in range(count):
        at = i / max(count - 1, 1) * len(legs)
        leg = min(int(at), len(legs) - 1)
        t = at - leg
        yield _between(*legs[leg], t * t * (3.0 - 2.0 * t), ground)


def _between(a: Outlook, b: Outlook, part: float, ground: Callable[[Outlook], float]) -> Camera:
    """Returns the eye after a part of the way: straight ahead, its speed in proportion to its height."""
    heights = [math.ldexp(one.height, -one.level) for one in (a, b)]
    height = heights[0] * (heights[1] / heights[0]) ** part
    apart = heights[0] - heights[1]
    gone = part if abs(apart) < 1e-3 * heights[0] else (heights[0] - height) / apart
    (ax, ay), (bx, by) = a.place(), b.place()
    share = Fraction(gone) if part < 1.0 else Fraction(1)
    x, y = ax + (bx - ax) * share, ay + (by - ay) * share
    below = [ground(one) for one in (a, b)]
    z = below[0] + heights[0] + (below[1] + heights[1] - below[0] - heights[0]) * gone
    level = a.level if part < 0.5 else b.level
    here = replace(a, level=level, x=x * Fraction(2) ** level, y=y * Fraction(2) ** level)
    turn = a.turn + math.remainder(b.turn - a.turn, 360.0) * part
    tilt, fov = a.tilt + (b.tilt - a.tilt) * part, a.fov + (b.fov - a.fov) * part
    return Camera(0, x, y, max(z - ground(here), _LEAST * height), turn % 360.0, tilt, fov)
