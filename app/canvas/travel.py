"""A flight from one standpoint to another, at any depth: out, across and in as a film flies, and turned on the way."""

from __future__ import annotations

import math

from app.canvas.standpoint import Standpoint
from app.canvas.view import Place
from engine.film.aim import SUBPIXEL, Aim
from engine.film.leg import leg
from engine.numeric.scaling import scaled

_LEAST, _MOST, _UNIT = 0.25, 2.6, 0.22  # seconds of a flight, at least and at most; of a unit of its length


class Travel:
    """`seconds`: how long it takes.  `side`: pixels of the screen."""

    def __init__(self, begin: Standpoint, end: Standpoint, side: float) -> None:
        self._begin, self._end = begin, end
        self._leg = leg(_aim(begin), _aim(end), max(1, round(side)))
        self.seconds = min(_MOST, max(_LEAST, _UNIT * self._leg.length))

    def at(self, part: float) -> Standpoint:
        """Returns where one is after a part of the time, 0..1: exactly at the ends there."""
        if part <= 0.0 or part >= 1.0:
            return self._begin if part <= 0.0 else self._end
        eased = part * part * (3.0 - 2.0 * part)
        aim = self._leg.at(eased * self._leg.length)
        turn = math.remainder(self._end.angle - self._begin.angle, math.tau)
        angle = math.remainder(self._begin.angle + eased * turn, math.tau)
        place = Place(aim.x, aim.y, aim.level + SUBPIXEL)
        return Standpoint(place, aim.level, aim.fraction, angle, self._end.mirrored)


def _aim(at: Standpoint) -> Aim:
    finer = float(at.level + SUBPIXEL - at.place.exponent)
    return Aim(at.level, at.fraction, scaled(at.place.x, finer), scaled(at.place.y, finer))
