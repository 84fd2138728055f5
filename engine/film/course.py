"""A flight: legs one after another, at a pace that is the same to the eye, eased where it begins, ends or turns."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import accumulate, pairwise

from engine.film.aim import Aim
from engine.film.leg import OCTAVE, Heading, Leg, leg

EASE = 1.0  # seconds in which a flight comes to its pace, and to rest
EASED_PART = 3  # of the time of a short leg that is left for each of its easings, at most: one part in so many
SHARPNESS = 4  # how much a flight slows down for a bend: by the cosine, to this power


@dataclass(frozen=True, slots=True)
class _Stretch:
    """A leg in time: from `begin` on for `seconds`, eased for `ease` at both ends, where it goes at the parts `before`
    and `after` of its `pace`, which is length a second."""

    leg: Leg
    begin: float
    seconds: float
    ease: float
    before: float
    after: float
    pace: float

    def at(self, seconds: float) -> Aim:
        """Returns the view so long after it began."""
        left = self.seconds - seconds
        if seconds < left:
            return self.leg.at(self.pace * _eased(seconds, self.ease, self.before))
        return self.leg.at(self.leg.length - self.pace * _eased(left, self.ease, self.after))


@dataclass(frozen=True, slots=True)
class Flight:
    """Views over `seconds`.  `loops`: it ends where it began, so that it may begin again."""

    seconds: float
    loops: bool
    stretches: tuple[_Stretch, ...]

    def at(self, seconds: float) -> Aim:
        """Returns the view at a time, 0 to `seconds`."""
        if seconds >= self.seconds:
            return self.stretches[-1].leg.end
        i = bisect_right(self.stretches, seconds, key=lambda stretch: stretch.begin) - 1
        stretch = self.stretches[max(i, 0)]
        return stretch.at(seconds - stretch.begin)


def legs_through(aims: Sequence[Aim], width: int) -> list[Leg]:
    """Returns the legs between views, for a picture `width` pixels wide; one of no length if nothing moves."""
    legs = [leg(a, b, width) for a, b in pairwise(aims) if a != b]
    return legs or [leg(aims[0], aims[0], width)]


def length(legs: Sequence[Leg]) -> float:
    """Returns how long all legs are together, in levels of zoom."""
    return sum(one.length for one in legs) / OCTAVE


def flight(legs: Sequence[Leg], seconds: float) -> Flight:
    """Returns a flight along legs, each of which begins where the one before ends, that takes so many seconds.

    It begins and ends at rest.  Where it ends as it began it may go round and round: then it is not eased there, but
    as at every other joint, the more the sharper it turns.
    """
    loops = len(legs) > 1 and legs[0].start == legs[-1].end
    seam = _through(legs[-1].heading(True), legs[0].heading(False)) if loops else 0.0
    joints = [seam, *(_through(a.heading(True), b.heading(False)) for a, b in pairwise(legs)), seam]
    total = sum(one.length for one in legs)
    if total <= 0.0:
        return Flight(seconds, False, (_Stretch(legs[0], 0.0, seconds, 0.0, 1.0, 1.0, 0.0),))
    eases = [min(EASE, seconds / EASED_PART * one.length / total) for one in legs]
    lost = [0.5 * ease * (2.0 - a - b) for ease, (a, b) in zip(eases, pairwise(joints), strict=True)]
    pace = total / (seconds - sum(lost))
    times = [one.length / pace + late for one, late in zip(legs, lost, strict=True)]
    begins = [0.0, *accumulate(times)]
    rows = zip(legs, begins, times, eases, pairwise(joints), strict=False)
    return Flight(seconds, loops, tuple(_Stretch(one, t, n, e, a, b, pace) for one, t, n, e, (a, b) in rows))


def _through(before: Heading, after: Heading) -> float:
    """Returns the part of its pace that a flight keeps at a joint."""
    cosine = sum(a * b for a, b in zip(before, after, strict=True))
    return float(min(max(cosine, 0.0), 1.0) ** SHARPNESS)


def _eased(seconds: float, ease: float, first: float) -> float:
    """Returns how far one comes whose pace goes from `first` to 1 within `ease` seconds, and stays 1: the integral of
    first + (1 - first) (3 x^2 - 2 x^3)."""
    x = min(seconds / ease, 1.0) if ease > 0.0 else 1.0
    return seconds - (1.0 - first) * (min(seconds, ease) - ease * (x**3 - 0.5 * x**4))
