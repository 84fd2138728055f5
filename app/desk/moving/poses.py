"""Where a drag, or a number, takes what is moved.  Scales and turns are told as people say them, and kept exactly.

What lands on a quarter turn and a power of two is told as such, so that it shows the very pixels; a turn set back to 0
is none.  Nothing is multiplied up: each pose follows from one scale, one angle and one place.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from fractions import Fraction

from engine.canvas.placing.pose import FINEST, Pose
from engine.numeric.similarity import Dyadic, Similarity

_BITS = 6  # levels finer than seen, to which a place is told where pixels are sampled anyway
_QUARTER = 2.5  # degrees around a quarter turn that are one
_POWER = 0.035  # of a doubling, around a power of two, that is one
TURN_STEP = 15.0  # degrees, where one turns by steps
_ROUNDED = 1e-12  # of a doubling, that a turned pose may be beside its scale: its two doubles are rounded
_SMALLEST, _LARGEST = -60, 60  # doublings by one drag


@dataclass(frozen=True, slots=True)
class Spin:
    """A scale, 2^levels times 1 <= size < 2, and an angle in degrees, clockwise, -180 < degrees <= 180."""

    levels: int
    size: float
    degrees: float

    @property
    def exact(self) -> bool:
        """Tells whether it shows the very pixels of what is turned so."""
        return self.size == 1.0 and self.degrees % 90 == 0

    @property
    def doublings(self) -> float:
        """Gives the logarithm of the scale to base 2."""
        return self.levels + math.log2(self.size)

    def scaled(self, factor: float) -> Spin:
        """Returns it larger by a factor."""
        size, levels = math.frexp(self.size * factor)
        return replace(self, levels=self.levels + levels - 1, size=2 * size)

    def turned(self, degrees: float) -> Spin:
        """Returns it at another angle."""
        rest = degrees % 360
        return replace(self, degrees=rest - 360 if rest > 180 else rest)

    def snapped_scale(self, within: float = _POWER) -> Spin:
        """Returns it at a power of two, if it is near one."""
        nearest = round(self.doublings)
        return replace(self, levels=nearest, size=1.0) if abs(self.doublings - nearest) <= within else self

    def snapped_turn(self, steps: bool) -> Spin:
        """Returns it at a quarter turn, if it is near one; at the nearest of all `steps` of 15 degrees."""
        quarter = 90.0 * round(self.degrees / 90)
        if steps:
            return self.turned(TURN_STEP * round(self.degrees / TURN_STEP))
        return self.turned(quarter) if abs(self.degrees - quarter) <= _QUARTER else self


def spin_of(pose: Pose) -> Spin:
    """Returns how a pose scales and turns."""
    if pose.turned is None:
        return Spin(pose.levels, 1.0, 0.0).turned(90.0 * pose.turn)
    re, im = pose.turned
    spin = Spin(pose.levels, 1.0, 0.0).scaled(math.hypot(re, im)).snapped_scale(_ROUNDED)
    return spin.turned(math.degrees(math.atan2(im, re)))


def _told(spin: Spin, mirror: bool) -> Pose:
    """Returns a pose at no place, of a scale and an angle."""
    if spin.exact:
        return Pose(levels=spin.levels, turn=round(spin.degrees / 90) % 4, mirror=mirror)
    if spin.degrees % 90 == 0:
        re, im = ((1, 0), (0, 1), (-1, 0), (0, -1))[round(spin.degrees / 90) % 4]
        return Pose(levels=spin.levels, turned=(re * spin.size, im * spin.size), mirror=mirror)
    angle = math.radians(spin.degrees)
    size, levels = (spin.size, spin.levels) if spin.size < 1.5 else (spin.size / 2, spin.levels + 1)
    turned = size * math.cos(angle), size * math.sin(angle)
    return Pose(levels=levels, turned=_at_most_one(*turned) if size == 1.0 else turned, mirror=mirror)


def _at_most_one(re: float, im: float) -> tuple[float, float]:
    """Returns a turn of length 1, or a hair less: of a longer one a picture in itself at a half does not halve."""
    while Fraction(re) ** 2 + Fraction(im) ** 2 > 1:
        re, im = (math.nextafter(re, 0.0), im) if abs(re) > abs(im) else (re, math.nextafter(im, 0.0))
    return re, im


def respun(pose: Pose, spin: Spin, about: Dyadic, level: int) -> Pose:
    """Returns a pose with another scale and angle that leaves a place of the canvas where it is: to a pixel of a level,
    where it shows the very pixels, else to a small part of one."""
    made = _told(spin, pose.mirror)
    at_level = level if spin.exact else min(level + _BITS, FINEST)
    before, after = pose.similarity, made.similarity.c
    w = (before.t + -about) * (after * before.c.conjugate)
    n, e = before.squared
    at = []
    for away, here in ((w.x, about.x), (w.y, about.y)):
        value = _times(Fraction(away, n), e - w.e + at_level) + _times(Fraction(here), at_level - about.e)
        at.append(math.floor(value + Fraction(1, 2)))
    return replace(made, at=(at[0], at[1]), level=at_level)


def _times(value: Fraction, doublings: int) -> Fraction:
    """Returns value 2^doublings."""
    return value * (1 << doublings) if doublings >= 0 else value / (1 << -doublings)


def mirrored(pose: Pose, about: Dyadic, across: bool) -> Pose:
    """Returns a pose mirrored in an upright line through a place, or in a level one if it is `across`."""
    twice = Dyadic.of(0, about.y, about.e - 1) if across else Dyadic.of(about.x, 0, about.e - 1)
    return pose.followed(Similarity(Dyadic(1, 0) if across else Dyadic(-1, 0), twice, True))


def shifted(pose: Pose, level: int, x: int, y: int) -> Pose:
    """Returns a pose moved by pixels of a level."""
    return pose.followed(Similarity(Dyadic(1, 0), Dyadic.of(x, y, level)))


def exact(pose: Pose, level: int) -> bool:
    """Tells whether a pose shows the very pixels of its source, as they are seen at a level."""
    aligned = pose.similarity.aligned_from
    return pose.similarity.quarter is not None and (aligned is None or aligned <= level)


def factor(value: float) -> float:
    """Returns a factor of scaling within what one drag does."""
    return min(max(value, 2.0**_SMALLEST), 2.0**_LARGEST)


def scale_text(spin: Spin) -> str:
    """Returns a scale as it is read."""
    if abs(spin.levels) > 20:
        return f"2^{spin.doublings:.2f}".removesuffix(".00")
    return f"{100 * math.ldexp(spin.size, spin.levels):.4g} %"


def turn_text(spin: Spin) -> str:
    """Returns an angle as it is read."""
    return f"{spin.degrees:.1f}".removesuffix(".0") + "°"
