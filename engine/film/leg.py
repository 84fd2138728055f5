"""A way from one view to another that is smooth and short to the eye: van Wijk and Nuij 2003, "Smooth and efficient
zooming and panning".

A view is a place and the width w that is seen.  Zooming by a factor is as long as its logarithm over RHO; moving by u
is as long as RHO u / w.  The shortest way is then a half circle over the places, of which r tells a point:
w = C / cosh(r), u = C tanh(r) / RHO^2 + constant.  All that is reckoned here is relative to the nearer end, in units
of what is seen at the moment, so that no depth loses a pixel.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

from engine.film.aim import Aim, log2, shifted

RHO = math.sqrt(2.0)  # how much longer moving is than zooming: what the paper's subjects liked, 1.42
_LN2 = math.log(2.0)
OCTAVE = _LN2 / RHO  # the length of one level
_TURNING = RHO / 2.0  # the length of a radian: of as much as the rim of the picture moves
_LARGE = 30.0  # logarithms of what is so large that asinh(x) is ln(2 x)
_NOTHING = 2.0**-20  # of a picture's width: a place moved by less stays where it is

Heading = tuple[float, float, float, float]  # across, down, nearer, turning: of length 1


@dataclass(frozen=True, slots=True)
class Leg:
    """The way from `start` to `end`, for a picture `width` pixels wide, `length` long: that of the longest of moving,
    turning and mirroring.

    `first`, `last`: r at its ends; None where the place stays and only the zoom changes; `towards`: where the end lies
    from the start, of length 1.
    """

    start: Aim
    end: Aim
    width: int
    length: float
    first: float | None
    last: float | None
    towards: tuple[float, float]

    def at(self, distance: float) -> Aim:
        """Returns the view after so much of the length."""
        if distance <= 0.0:
            return self.start
        if distance >= self.length:
            return self.end
        part = distance / self.length
        turn = self.start.turn + part * _turn_between(self.start, self.end)
        share = min(max((distance - self.length / 2.0) / min(OCTAVE, self.length) + 0.5, 0.0), 1.0)
        mirrored = self.start.mirrored + share * (self.end.mirrored - self.start.mirrored)
        return replace(self._place(part), turn=turn, mirrored=mirrored)

    def _place(self, part: float) -> Aim:
        """Returns the place and zoom after so much of the length, 0..1."""
        if self.first is None or self.last is None:
            levels = part * levels_between(self.start, self.end)
            return self.end.at(self.start.level, self.start.fraction + levels)
        r = self.first + part * (self.last - self.first)
        if r < 0.0:
            aim = _nearer(self.start, _ln_cosh(r) - _ln_cosh(self.first))
            return self._moved(aim, _part(r, self.first))
        aim = _nearer(self.end, _ln_cosh(r) - _ln_cosh(self.last))
        return self._moved(aim, -_part(-r, -self.last))

    def _moved(self, aim: Aim, part: float) -> Aim:
        across, down = self.towards
        return aim.moved(part * self.width * across, part * self.width * down)

    def heading(self, at_end: bool) -> Heading:
        """Tells which way it goes at one of its ends."""
        r = self.last if at_end else self.first
        turning = _TURNING * _turn_between(self.start, self.end)
        if r is None or self.first is None or self.last is None:
            across, nearer = 0.0, levels_between(self.start, self.end) * OCTAVE
        else:
            moving = (self.last - self.first) / RHO
            across, nearer = moving / math.cosh(min(abs(r), 300.0)), moving * math.tanh(r)
        whole = math.hypot(across, nearer, turning) or 1.0
        return across * self.towards[0] / whole, across * self.towards[1] / whole, nearer / whole, turning / whole


def leg(start: Aim, end: Aim, width: int) -> Leg:
    """Returns the way between two views of a picture `width` pixels wide."""
    level = max(start.level, end.level)
    dx, dy = (shifted(b, level - end.level) - shifted(a, level - start.level) for a, b in _places(start, end))
    bits = max(abs(dx).bit_length(), abs(dy).bit_length()) - 60
    x, y = float(shifted(dx, -bits)), float(shifted(dy, -bits))
    far = math.hypot(x, y)
    levels = levels_between(start, end)
    least = max(_TURNING * abs(_turn_between(start, end)), OCTAVE * abs(end.mirrored - start.mirrored))
    # Logarithms of what is seen at both ends, and of the way, in 2^-24 pixels of `level`.
    seen = [(level - aim.level - aim.fraction + 24.0 + log2(width)) * _LN2 for aim in (start, end)]
    way = math.log(far) + bits * _LN2 if far else -math.inf
    if way < min(seen) + math.log(_NOTHING):
        return Leg(start, end, width, max(abs(levels) * OCTAVE, least), None, None, (0.0, 0.0))
    way += 2.0 * math.log(RHO)
    first = _asinh(seen[0] - way, 2.0 * seen[1] - seen[0] - way, way - seen[0])
    last = -_asinh(seen[1] - way, 2.0 * seen[0] - seen[1] - way, way - seen[1])
    return Leg(start, end, width, max((last - first) / RHO, least), first, last, (x / far, y / far))


def _places(start: Aim, end: Aim) -> tuple[tuple[int, int], tuple[int, int]]:
    return (start.x, end.x), (start.y, end.y)


def levels_between(start: Aim, end: Aim) -> float:
    """Returns the levels of zoom from one view to another."""
    return (end.level - start.level) + (end.fraction - start.fraction)


def _turn_between(start: Aim, end: Aim) -> float:
    """Returns by how many radians clockwise the picture turns, the shorter way."""
    return math.remainder(end.turn - start.turn, math.tau)


def _nearer(aim: Aim, ratio: float) -> Aim:
    """Returns an aim magnified by e^ratio, at the same place."""
    return aim.at(aim.level, aim.fraction + ratio / _LN2)


def _asinh(a: float, b: float, c: float) -> float:
    """Returns asinh((e^a - e^b - e^c) / 2), whatever the exponents."""
    most = max(a, b, c)
    total = math.exp(a - most) - math.exp(b - most) - math.exp(c - most)
    if most < _LARGE or abs(total) < 1e-9:
        return math.asinh(0.5 * total * math.exp(min(most, 300.0)))
    return math.copysign(most + math.log(abs(total)), total)


def _ln_cosh(r: float) -> float:
    return abs(r) + math.log1p(math.exp(-2.0 * abs(r))) - _LN2


def _part(r: float, end: float) -> float:
    """Returns the way from an end of a leg to r, end <= r <= 0, in widths of what is seen there:
    sinh(r - end) / (RHO^2 cosh(end))."""
    return (math.exp(r) - math.exp(2.0 * end - r)) / (1.0 + math.exp(2.0 * end)) / RHO**2
