"""A gamut mask: a convex polygon on the disc of colours, outside of which none can be picked there.

Places on the disc are complex numbers: the angle is the hue, the size how colourful, 0 to 1.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from app.desk.colours import RGB, off_disc, on_disc

MOST_CORNERS = 12
Corners = tuple[complex, ...]  # turning with the hue


@dataclass(frozen=True, slots=True)
class MaskShape:
    """A row: a title, a hint, and its corners, of which the first turns towards the present hue."""

    title: str
    hint: str
    corners: tuple[tuple[float, float], ...]  # how far out, degrees


MASK_SHAPES = {
    "triangle": MaskShape("Triangle", "Three colours that all others are mixed of", ((1, 0), (1, 120), (1, 240))),
    "mood": MaskShape("Mood", "One strong colour, and muted ones beside grey", ((1, 0), (0.5, 110), (0.5, 250))),
    "wedge": MaskShape("Wedge", "Neighbours on the wheel, and grey", ((1, -40), (1, 0), (1, 40), (0.12, 180))),
    "across": MaskShape("Across", "A colour and its complement, by grey", ((1, 0), (0.2, 90), (1, 180), (0.2, 270))),
    "square": MaskShape("Square", "Four colours, a quarter of the wheel apart", ((1, 0), (1, 90), (1, 180), (1, 270))),
    "muted": MaskShape("Muted", "No strong colour at all", tuple((0.5, 60.0 * i) for i in range(6))),
}  # fmt: skip


def shaped_mask(shape: str, hue: float) -> Corners:
    """Returns the corners of a row of MASK_SHAPES, turned to a hue."""
    rows = MASK_SHAPES[shape].corners
    return hull(cmath.rect(out, math.radians(hue + turn)) for out, turn in rows)


def hull(points: Iterable[complex]) -> Corners:
    """Returns the corners of the least convex polygon around points, in the order in which the hue turns."""
    rest = sorted({(point.real, point.imag) for point in points})
    if len(rest) < 3:
        return tuple(complex(*point) for point in rest)
    halves = []
    for way in (rest, rest[::-1]):
        half: list[complex] = []
        for point in (complex(*one) for one in way):
            while len(half) > 1 and _cross(half[-1] - half[-2], point - half[-1]) <= 0:
                half.pop()
            half.append(point)
        halves += half[:-1]
    return tuple(halves)


def held_at(corners: Corners, at: complex) -> complex:
    """Returns the place itself where it lies in the polygon, else the nearest that does."""
    sides = list(zip(corners, (*corners[1:], *corners[:1]), strict=True))
    if len(corners) > 2 and all(_cross(b - a, at - a) >= 0 for a, b in sides):
        return at
    return min((_nearest(a, b, at) for a, b in sides), key=lambda place: abs(place - at), default=at)


def held_in(corners: Corners, lch: RGB) -> RGB:
    """Returns the colour, or the nearest of its lightness that the mask allows; no corners allow all."""
    if not corners:
        return lch
    at = on_disc(lch)
    held = held_at(corners, at)
    return lch if abs(held - at) < 1e-9 else off_disc(lch[0], held)


def moved_corner(corners: Corners, which: int, to: complex) -> Corners:
    """Returns the polygon with a corner elsewhere on the disc; as it was, where it would lose a corner."""
    to = to if abs(to) <= 1 else to / abs(to)
    moved = hull((*corners[:which], to, *corners[which + 1 :]))
    return moved if len(moved) == len(corners) else corners


def mean_corner(corners: Sequence[complex]) -> complex:
    """Returns the mean of the corners, which lies inside."""
    return sum(corners) / len(corners)


def way_out(corners: Corners, middle: complex, towards: complex) -> complex:
    """Returns where one leaves the polygon from its middle in a direction."""
    reach = math.inf
    for a, b in zip(corners, (*corners[1:], *corners[:1]), strict=True):
        across = _cross(towards, b - a)
        if across > 1e-12:
            reach = min(reach, _cross(a - middle, b - a) / across)
    return middle + towards * (reach if math.isfinite(reach) else 0.0)


def _nearest(a: complex, b: complex, at: complex) -> complex:
    along = b - a
    size = abs(along) ** 2
    part = 0.0 if size == 0 else ((at - a) * along.conjugate()).real / size
    return a + max(0.0, min(1.0, part)) * along


def _cross(a: complex, b: complex) -> float:
    return a.real * b.imag - a.imag * b.real
