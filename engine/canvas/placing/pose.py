"""Where a placement shows its source, and which part of it."""

from __future__ import annotations

import math
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property

from engine.numeric.address import Rect
from engine.numeric.similarity import Dyadic, Similarity

MOST_LEVELS = 8192  # most powers of two by which a source is magnified or made smaller
FARTHEST = 1 << 8192  # pixels: as far as places are told
FINEST = 4096  # levels at which places and rectangles are told, and their negatives
_QUARTERS = ((1, 0), (0, 1), (-1, 0), (0, -1))


@dataclass(frozen=True)
class Pose:
    """Where a source is shown: its place p, x + iy with y downwards, at 2^levels c m(p) + at.

    c is `turn` quarters clockwise, or `turned`: its real and imaginary part, 1/2 <= |c| < 2, exactly what the doubles
    say.  m(x + iy) is -x + iy where `mirror` is set, else p.  `at`: in pixels of `level`.
    """

    at: tuple[int, int] = (0, 0)
    level: int = 0
    levels: int = 0
    turn: int = 0
    turned: tuple[float, float] | None = None
    mirror: bool = False

    @cached_property
    def similarity(self) -> Similarity:
        """Gives it as a similarity."""
        c = Dyadic.of(*_QUARTERS[self.turn]) if self.turned is None else Dyadic.exactly(*self.turned)
        c = Dyadic.of(c.x, c.y, c.e - self.levels)
        return Similarity(-c if self.mirror else c, Dyadic.of(*self.at, self.level), self.mirror)

    @classmethod
    def of(cls, similarity: Similarity) -> Pose:
        """Returns the pose that shows a source through a similarity; one that is not of quarter turns has a turn that
        two doubles tell."""
        c = -similarity.c if similarity.mirror else similarity.c
        at, level, mirror = (similarity.t.x, similarity.t.y), similarity.t.e, similarity.mirror
        if similarity.quarter is not None:
            return cls(at, level, similarity.quarter[0], _QUARTERS.index((c.x, c.y)), mirror=mirror)
        levels = max(abs(c.x), abs(c.y)).bit_length() - 1 - c.e  # the longer part is 1 to 2 times 2^levels
        if c.x**2 + c.y**2 >= 4 << (2 * (levels + c.e)):
            levels += 1
        return cls(at, level, levels, turned=(_double(c.x, c.e + levels), _double(c.y, c.e + levels)), mirror=mirror)

    def followed(self, by: Similarity) -> Pose:
        """Returns the pose that shows a source by this one and then by a similarity of quarter turns."""
        return Pose.of(self.similarity.then(by))

    def wrong(self) -> tuple[str, object, str] | None:
        """Returns what is wrong with it: the member, what was found there, what was expected; None if nothing is."""
        if max(map(abs, self.at)) > FARTHEST:
            return "at", "a place too far", "integers up to 2^8192"
        for name, most in (("level", FINEST), ("levels", MOST_LEVELS)):
            if abs(getattr(self, name)) > most:
                return name, getattr(self, name), f"an integer from -{most} to {most}"
        if self.turn not in range(4):
            return "turn", self.turn, "0, 1, 2 or 3 quarters"
        if self.turned is None:
            return None
        if self.turn:
            return "c", "a turn of quarters, too", "one of both"
        if not all(map(math.isfinite, self.turned)) or not 1 <= 4 * sum(Fraction(v) ** 2 for v in self.turned) < 16:
            return "c", list(self.turned), "[re, im] with 1/2 <= |c| < 2"
        return None


@dataclass(frozen=True, slots=True)
class SourcePart:
    """A rectangle of a source, of which only what lies within is shown: pixels of `level`."""

    level: int
    rect: Rect

    @property
    def whole_from(self) -> int:
        """Gives the coarsest level at which it is a rectangle of whole pixels."""
        sides = self.rect.x0 | self.rect.y0 | self.rect.x1 | self.rect.y1
        return self.level - ((sides & -sides).bit_length() - 1)


def _double(value: int, down: int) -> float:
    """Returns value 2^-down, which is a double."""
    return float(Fraction(value << max(-down, 0), 1 << max(down, 0)))


UNMOVED = Pose()
