"""Similarities of the plane with exact dyadic coefficients: p -> c p + t, or c conj(p) + t.

Places are complex numbers x + iy in pixels of level 0, y downwards, pixel edges at whole numbers.  Everything is Python
integers, so composing is exact at any depth and any distance, and as every (re, im) is a true similarity no skew creeps
in.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

from engine.numeric.address import Rect

_SLACK, _SLACK_BITS = 46341, 16  # 2^-1/2: a scale of 1 + 1e-17, from a rounded cos and sin, is no level finer
_FRACTION, _PLACES = 40, 96  # bits of a logarithm behind the point, and of what it is worked out with
_QUOTIENT = 256  # bits of a quotient that is not dyadic
_QUARTERS = {(1, 0): 0, (0, 1): 1, (-1, 0): 2, (0, -1): 3}


@dataclass(frozen=True, slots=True)
class Dyadic:
    """The complex number (x + iy) 2^-e.  Make it by `of`: then equal numbers are equal objects."""

    x: int
    y: int
    e: int = 0

    @classmethod
    def of(cls, x: int, y: int, e: int = 0) -> Dyadic:
        """Makes (x + iy) 2^-e, with the smallest integers that tell it."""
        both = x | y
        if not both:
            return cls(0, 0, 0)
        k = (both & -both).bit_length() - 1
        return cls(x >> k, y >> k, e - k)

    @classmethod
    def exactly(cls, re: float, im: float = 0.0) -> Dyadic:
        """Makes the number that two finite doubles tell, to the last bit."""
        (a, b), (c, d) = re.as_integer_ratio(), im.as_integer_ratio()
        below = max(b, d)
        return cls.of(a * (below // b), c * (below // d), below.bit_length() - 1)

    def __mul__(self, other: Dyadic) -> Dyadic:
        a, b = self, other
        return Dyadic.of(a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x, a.e + b.e)

    def __add__(self, other: Dyadic) -> Dyadic:
        e = max(self.e, other.e)
        a, b = e - self.e, e - other.e
        return Dyadic.of((self.x << a) + (other.x << b), (self.y << a) + (other.y << b), e)

    def __neg__(self) -> Dyadic:
        return Dyadic(-self.x, -self.y, self.e)

    @property
    def conjugate(self) -> Dyadic:
        """Gives x - iy."""
        return Dyadic(self.x, -self.y, self.e)

    @property
    def zero(self) -> bool:
        """Tells whether it is 0."""
        return not (self.x or self.y)


@dataclass(frozen=True)
class Similarity:
    """q = c p + t; of the conjugate of p where `mirror`.  From a source's places to where they are shown."""

    c: Dyadic
    t: Dyadic
    mirror: bool = False

    @cached_property
    def quarter(self) -> tuple[int, int] | None:
        """Gives (k, q) where the scale is 2^k and the turn is q quarters clockwise; None for any other."""
        q = _QUARTERS.get((self.c.x, self.c.y))
        return None if q is None else (-self.c.e, q)

    @property
    def aligned_from(self) -> int | None:
        """Gives the coarsest level at which the move is by whole pixels; None if there is no move: at all."""
        return None if self.t.zero else self.t.e

    @cached_property
    def squared(self) -> tuple[int, int]:
        """Gives |c|^2 as (n, e): n 2^-e."""
        return self.c.x**2 + self.c.y**2, 2 * self.c.e

    @cached_property
    def log_scale(self) -> float:
        """Gives log2 |c|."""
        n, e = self.squared
        return (_log2(n) - e) / 2

    @cached_property
    def like_levels(self) -> int:
        """Gives ceil(log2 |c| - 1/4): how many levels finer than it is shown a source of like density is."""
        n, e = self.squared
        n, e = n * _SLACK, e + _SLACK_BITS
        low = n.bit_length() - 1 - e
        return -((-low) // 2) if n & (n - 1) == 0 else low // 2 + 1

    @property
    def halves(self) -> bool:
        """Tells whether |c| is at most 1/2."""
        n, e = self.squared
        return e >= 2 and n <= 1 << (e - 2)

    def then(self, outer: Similarity) -> Similarity:
        """Returns the similarity that does this one first, then `outer`."""
        c, t = (self.c.conjugate, self.t.conjugate) if outer.mirror else (self.c, self.t)
        return Similarity(outer.c * c, outer.c * t + outer.t, self.mirror != outer.mirror)

    def __call__(self, place: Dyadic) -> Dyadic:
        """Returns where a place of the source is shown."""
        return self.c * (place.conjugate if self.mirror else place) + self.t

    def inverse(self) -> Similarity:
        """Returns the similarity back.  Only of one with a quarter turn and a scale of 2^k: others have none that is
        dyadic."""
        return self._inverse

    @cached_property
    def _inverse(self) -> Similarity:
        assert self.quarter is not None
        c = Dyadic.of(self.c.x, -self.c.y, -self.c.e)
        c = c.conjugate if self.mirror else c
        back = Similarity(c, Dyadic(0, 0), self.mirror)
        return Similarity(c, -back(self.t), self.mirror)

    def cut(self, bits: int, finest: int) -> Similarity:
        """Returns the similarity with c rounded to so many bits and t to 2^-finest.  One of quarter turns stays."""
        if self.quarter is not None:
            return self
        drop = max(self.c.x.bit_length(), self.c.y.bit_length()) - bits
        return Similarity(_dropped(self.c, drop), _dropped(self.t, self.t.e - finest), self.mirror)

    def shown(self, rect: Rect, level: int, at_level: int) -> Rect:
        """Returns the pixels of `at_level` that meet what a rectangle of the source's `level` is shown as."""
        corners, e = _corners(self, rect, level)
        xs, ys, by = [x for x, _ in corners], [y for _, y in corners], at_level - e
        return Rect(_floor(min(xs), by), _floor(min(ys), by), _ceil(max(xs), by), _ceil(max(ys), by))

    def back(self, twice: tuple[int, int], level: int, to_level: int, bits: int) -> tuple[int, int]:
        """Returns the place of the source that is shown at `twice` / 2 pixels of `level`: in 2^-bits pixels of
        `to_level`, rounded down."""
        c, t, (n, e) = self.c, self.t, self.squared
        fine = max(level + 1, t.e)
        u = (twice[0] << fine - level - 1) - (t.x << fine - t.e)
        v = (twice[1] << fine - level - 1) - (t.y << fine - t.e)
        x, y = u * c.x + v * c.y, v * c.x - u * c.y
        up = e - fine - c.e + to_level + bits
        y = -y if self.mirror else y
        return ((x << up) // n, (y << up) // n) if up >= 0 else (x // (n << -up), y // (n << -up))

    def box(self, rect: Rect, level: int, to_level: int, margin: int) -> Rect:
        """Returns the pixels of the source's `to_level` that are shown in a rectangle of `level`, and `margin` more."""
        places = [(2 * rect.x0, 2 * rect.y0), (2 * rect.x1, 2 * rect.y1)]  # as in `shown`
        if self.quarter is None:
            places += [(2 * rect.x0, 2 * rect.y1), (2 * rect.x1, 2 * rect.y0)]
        corners = [self.back(place, level, to_level, 0) for place in places]
        xs, ys = [x for x, _ in corners], [y for _, y in corners]
        return Rect(min(xs) - margin, min(ys) - margin, max(xs) + margin + 1, max(ys) + margin + 1)

    def pitch(self, level: int, to_level: int, bits: int) -> tuple[int, int, int, int]:
        """Returns what one pixel of `level` to the right, and one down, is in the source: (right x, right y, down x,
        down y), in 2^-bits pixels of `to_level`, rounded."""
        n, e = self.squared
        up = e - self.c.e + to_level - level + bits

        def divided(value: int) -> int:
            above, below = (value << up, n) if up >= 0 else (value, n << -up)
            return (2 * above + below) // (2 * below)

        x, y = divided(self.c.x), divided(-self.c.y)
        sign = -1 if self.mirror else 1
        return x, sign * y, -y, sign * x


def since(before: Similarity, now: Similarity) -> Similarity:
    """Returns the similarity from where `before` shows a place to where `now` does; its c rounded to so many bits
    that no pixel tells, where it is not dyadic."""
    below = before.c if now.mirror == before.mirror else before.c.conjugate
    n, e = before.squared
    c = now.c * below.conjugate
    odd = n // (n & -n)
    if not (c.x % odd or c.y % odd):
        c = Dyadic.of(c.x // odd, c.y // odd, c.e - e + (n & -n).bit_length() - 1)
    else:
        c = Dyadic.of((c.x << _QUOTIENT) // n, (c.y << _QUOTIENT) // n, c.e - e + _QUOTIENT)
    mirror = now.mirror != before.mirror
    t = before.t.conjugate if mirror else before.t
    return Similarity(c, now.t + -(c * t), mirror)


def _corners(f: Similarity, rect: Rect, level: int) -> tuple[list[tuple[int, int]], int]:
    """Returns where corners of a rectangle of the source's `level` are shown, as (x, y) and e: (x + iy) 2^-e."""
    places = [(rect.x0, rect.y0), (rect.x1, rect.y1)]  # of quarter turns, two opposite corners tell
    if f.quarter is None:
        places += [(rect.x0, rect.y1), (rect.x1, rect.y0)]
    c, t, sign = f.c, f.t, -1 if f.mirror else 1
    e = max(c.e + level, t.e)
    up, left, top = e - c.e - level, t.x << e - t.e, t.y << e - t.e
    return [((c.x * x - c.y * sign * y << up) + left, (c.x * sign * y + c.y * x << up) + top) for x, y in places], e


def _dropped(number: Dyadic, bits: int) -> Dyadic:
    """Returns a number without its last bits."""
    return number if bits <= 0 else Dyadic.of(number.x >> bits, number.y >> bits, number.e - bits)


def _log2(number: int) -> float:
    """Returns the logarithm of a whole number, rounded down to 2^-40: the same on every machine."""
    whole, bits = number.bit_length() - 1, 0
    x = number << _PLACES >> whole
    for _ in range(_FRACTION):
        x = x * x >> _PLACES
        above = x >> _PLACES + 1
        x, bits = x >> above, 2 * bits + above
    return whole + bits / (1 << _FRACTION)


def _floor(value: int, shift: int) -> int:
    """Returns floor(value 2^shift)."""
    return value << shift if shift >= 0 else value >> -shift


def _ceil(value: int, shift: int) -> int:
    """Returns ceil(value 2^shift)."""
    return -_floor(-value, shift)


IDENTITY = Similarity(Dyadic(1, 0), Dyadic(0, 0))
