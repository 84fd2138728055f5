"""Painting on what a placement shows: the stroke goes to its source, to where the source is seen under the pen."""

from __future__ import annotations

import cmath
import math
from dataclasses import dataclass

import numpy as np

from app.desk.known import Known
from engine.brush.copies import Copies, Copy
from engine.canvas.placing.pose import Pose
from engine.numeric.similarity import IDENTITY, Dyadic, Similarity
from engine.painting.places import LEVEL_LIMIT
from engine.painting.points import ALWAYS
from engine.studio.results import LayerRow


@dataclass(frozen=True, slots=True)
class Through:
    """A layer, and the similarity of quarter turns and powers of two by which it is seen."""

    layer: str
    similarity: Similarity

    @property
    def seen(self) -> Pose | None:
        """Gives where the layer is seen, by which what is selected limits strokes; None: where it lies."""
        return None if self.similarity == IDENTITY else Pose.of(self.similarity)

    def begun(self, level: int, origin: tuple[int, int]) -> Aimed:
        """Returns how a stroke of a level at a pixel goes on the layer."""
        assert self.similarity.quarter is not None
        levels = self.similarity.quarter[0]
        back = self.similarity.inverse()
        place, own = back(Dyadic.of(*origin, level)), level + levels
        up = own - place.e
        corner = (place.x << up, place.y << up) if up >= 0 else (place.x >> -up, place.y >> -up)
        rest = place + -Dyadic.of(*corner, own)
        x, y = (float(v) * 2.0 ** (own - rest.e) for v in (rest.x, rest.y))
        unit = back.c
        turn = complex((unit.x > 0) - (unit.x < 0), (unit.y > 0) - (unit.y < 0))
        return Aimed(self.layer, own, corner, (x, y), turn, back.mirror)


@dataclass(frozen=True, slots=True)
class Aimed:
    """A stroke on a layer: its level and origin there, where the seen origin lies from that, in its pixels, and how its
    points are turned; of the mirrored ones where it does `mirror`."""

    layer: str
    level: int
    origin: tuple[int, int]
    rest: tuple[float, float]
    turn: complex
    mirror: bool

    def points(self, points: np.ndarray) -> np.ndarray:
        """Returns points as they are on the layer: float64 (n, 6..7), x, y, the tilt and the barrel turned."""
        out = points.copy()
        for first, (x, y) in ((0, self.rest), (3, (0.0, 0.0))):
            across, down = points[:, first], -points[:, first + 1] if self.mirror else points[:, first + 1]
            out[:, first] = self.turn.real * across - self.turn.imag * down + x
            out[:, first + 1] = self.turn.imag * across + self.turn.real * down + y
        turn = math.degrees(cmath.phase(self.turn))
        out[:, ALWAYS:] = turn - points[:, ALWAYS:] if self.mirror else turn + points[:, ALWAYS:]
        return out

    def copies(self, copies: Copies) -> Copies:
        """Returns the copies of a stroke as they are on the layer."""
        out = []
        rest, square = complex(*self.rest), self.turn * self.turn
        for copy in copies:
            c, t = complex(copy.re, copy.im), complex(copy.x, copy.y)
            c, t = (c.conjugate(), t.conjugate()) if self.mirror else (c, t)
            t = self.turn * t + rest
            c, t = (c * square, t + c * square * rest.conjugate()) if copy.mirror else (c, t - c * rest)
            out.append(Copy(c.real, c.imag, t.real, t.imag, copy.mirror))
        return tuple(out)


def through(known: Known, row: LayerRow, level: int) -> Through | str:
    """Returns which layer a placement shows and how, or why it cannot be painted on there, at a level."""
    rows = {one.name: one for one in known.scene.layers} if known.scene else {}
    similarity, at, gone = IDENTITY, row, {row.name}
    while at.shows is not None:
        similarity = at.shows.pose.similarity.then(similarity)
        if at.shows.name is None:
            return f"“{row.name}” shows the whole painting: paint on one of its layers"
        at = rows[at.shows.name]
        if at.name in gone:
            return f"“{row.name}” shows itself"
        gone.add(at.name)
    if at.group:
        return f"“{row.name}” shows the group “{at.name}”: paint on one of its layers"
    if similarity.quarter is None:
        return f"“{row.name}” is turned or scaled by parts: paint on “{at.name}”, which it shows"
    if at.locked:
        return f"Layer “{at.name}”, which “{row.name}” shows, is locked"
    if abs(level + similarity.quarter[0]) > LEVEL_LIMIT:
        return f"“{row.name}” shows “{at.name}” from too far away: paint on that"
    return Through(at.name, similarity)
