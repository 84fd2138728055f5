"""Where a film looks: a place and a zoom, exact at any depth.

A place is an integer of any size in 2^-24 pixels of the level that is looked at, so nothing is lost at level 60 or
1000: only distances within the picture become floats.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import NamedTuple

from engine.numeric.address import Rect
from engine.painting.places import Bookmark, middle_of

SUBPIXEL = 24  # bits of a place below a pixel


@dataclass(frozen=True, slots=True)
class Aim:
    """The middle (x, y) of the picture, in 2^-24 pixels of `level`, and 2^(level + fraction) pixels of the picture for
    each of level 0; 0 <= fraction < 1.

    It is turned clockwise by `turn`, in radians, about its middle; before that, so much of it as `mirrored` says, 0..1,
    has its left and right swapped.
    """

    level: int
    fraction: float
    x: int
    y: int
    turn: float = 0.0
    mirrored: float = 0.0

    @property
    def upright(self) -> bool:
        """Tells whether the picture is neither turned nor mirrored."""
        return self.turn == 0.0 and self.mirrored == 0.0

    def across(self, size: tuple[int, int]) -> tuple[int, int]:
        """Returns the sides of an upright picture in which one of `size` (width, height) lies, turned."""
        cos, sin = abs(math.cos(self.turn)), abs(math.sin(self.turn))
        if self.upright:
            return size
        return math.ceil(cos * size[0] + sin * size[1]), math.ceil(sin * size[0] + cos * size[1])

    def at(self, level: int, fraction: float) -> Aim:
        """Returns the same middle at another zoom, rounded to 2^-24 pixels of its level."""
        whole = math.floor(fraction)
        level, fraction = level + whole, fraction - whole
        x, y = shifted(self.x, level - self.level), shifted(self.y, level - self.level)
        return replace(self, level=level, fraction=fraction, x=x, y=y)

    def moved(self, dx: float, dy: float) -> Aim:
        """Returns the aim with its middle moved by pixels of the picture as it was, if it stood upright."""
        scale = 2.0 ** (SUBPIXEL - self.fraction)
        return replace(self, x=self.x + round(dx * scale), y=self.y + round(dy * scale))

    def window(self, size: tuple[int, int], level: int) -> Crop:
        """Returns where an upright picture of `size` (width, height) lies in the pixels of a level near the aim's."""
        step = 2.0 ** (level - self.level - self.fraction)
        (x, left), (y, top) = (
            _corner(shifted(middle, level - self.level), side * step / 2)
            for middle, side in zip((self.x, self.y), size, strict=True)
        )
        return Crop(level, x, y, left, top, step, size)


class Crop(NamedTuple):
    """A picture of `size` (width, height) among the pixels of a level: its corner lies (left, top) from that of pixel
    (x, y), 0 <= left, top < 1; each of its pixels is `step` pixels of the level wide."""

    level: int
    x: int
    y: int
    left: float
    top: float
    step: float
    size: tuple[int, int]

    @property
    def rect(self) -> Rect:
        """Gives the pixels of the level that the picture meets."""
        width, height = self.size
        return Rect.at(
            self.x, self.y, math.ceil(self.left + width * self.step), math.ceil(self.top + height * self.step)
        )


def _corner(middle: int, half: float) -> tuple[int, float]:
    """Returns the pixel, and how far in it, that lies `half` pixels before `middle`, in 2^-24 pixels."""
    units = middle - round(half * (1 << SUBPIXEL))
    return units >> SUBPIXEL, (units & ((1 << SUBPIXEL) - 1)) / (1 << SUBPIXEL)


def shifted(value: int, bits: int) -> int:
    """Returns value * 2^bits, rounded to the nearest."""
    return value << bits if bits >= 0 else (value + (1 << (-bits - 1))) >> -bits


def aim_at(level: int, rect: Rect, size: tuple[int, int]) -> Aim:
    """Returns the nearest aim that shows a whole rectangle of `level` in a picture of `size` (width, height)."""
    zoom = min(log2(size[0]) - log2(rect.width), log2(size[1]) - log2(rect.height))
    half = SUBPIXEL - 1
    return Aim(level, 0.0, (rect.x0 + rect.x1) << half, (rect.y0 + rect.y1) << half).at(level, zoom)


def aim_of(bookmark: Bookmark, size: tuple[int, int]) -> Aim:
    """Returns the nearest aim that shows a whole bookmark in a picture of `size` (width, height)."""
    x, y, exponent = middle_of(bookmark)
    zoom = bookmark.level + min(math.log2(side / wide) for side, wide in zip(size, bookmark.size, strict=True))
    level = math.floor(zoom)
    bits = level + SUBPIXEL - exponent
    x, y = shifted(x, bits), shifted(y, bits)
    return Aim(level, zoom - level, x, y, math.radians(bookmark.angle), float(bookmark.mirrored))


def log2(value: int) -> float:
    """Returns the binary logarithm of a whole number of any size, above 0."""
    more = max(value.bit_length() - 64, 0)
    return math.log2(value >> more) + more
