"""What a brush refuses, in one line: the place, what was found, what was expected."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Any

from immutables import Map

from engine.checks.field_error import FieldError
from engine.checks.values import described, is_within
from engine.numeric.curves import KNOTS_CAP

TEXT_CAP = 256  # characters of a name
OUTPUT_CAP = 16.0  # the largest factor by which a curve may multiply a setting

_COLOUR = re.compile("#[0-9a-fA-F]{6}")
_UNPRINTABLE = re.compile("[\x00-\x1f\x7f]")

Knots = tuple[tuple[float, float], ...]


class BrushError(FieldError):
    """A brush, a pen point or a stroke that cannot be used: `str()` is one line."""


def number(value: Any, place: str, lo: float, hi: float) -> float:
    """Returns a finite number of [lo, hi], as float."""
    if not is_within(value, lo, hi):
        raise BrushError(place, described(value), f"a number from {lo:g} to {hi:g}")
    return float(value) + 0.0  # no negative zero


def integer(value: Any, place: str, lo: int, hi: int) -> int:
    """Returns an integer of [lo, hi]."""
    if not is_within(value, lo, hi, whole=True):
        raise BrushError(place, described(value), f"an integer from {lo} to {hi}")
    return int(value)


def text(value: Any, place: str, what: str = "a name", cap: int = TEXT_CAP) -> str:
    """Returns the text; BrushError if it is none, or has other than printable characters."""
    if not isinstance(value, str) or not 0 < len(value) <= cap or _UNPRINTABLE.search(value):
        raise BrushError(place, described(value), f"{what}, a text of 1 to {cap} printable characters")
    return value


def one_of(value: Any, place: str, names: tuple[str, ...]) -> str:
    """Returns the name; BrushError if it is none of `names`."""
    if not isinstance(value, str) or value not in names:
        raise BrushError(place, described(value), f"one of {', '.join(names)}")
    return value


def colour(value: Any, place: str) -> str:
    """`#rrggbb`, in lower case."""
    if not isinstance(value, str) or not _COLOUR.fullmatch(value):
        raise BrushError(place, described(value), 'a colour "#rrggbb"')
    return value.lower()


def rgb(value: str) -> tuple[float, float, float]:
    """Red, green and blue of `#rrggbb`, 0..1 as encoded."""
    red, green, blue = (int(value[i : i + 2], 16) / 255.0 for i in (1, 3, 5))
    return red, green, blue


def knots(value: Any, place: str, most: float = OUTPUT_CAP, widest: float = 1.0) -> Knots:
    """[[in, out], ...]: 1 to 64 pairs, inputs rising strictly within 0..`widest`, outputs within 0..`most`."""
    if not isinstance(value, list | tuple) or not 1 <= len(value) <= KNOTS_CAP:
        raise BrushError(place, described(value), f"a list of 1 to {KNOTS_CAP} knots [in, out]")
    pairs: list[tuple[float, float]] = []
    for i, pair in enumerate(value):
        at = f"{place}[{i}]"
        if not isinstance(pair, list | tuple) or len(pair) != 2:
            raise BrushError(at, described(pair), "a knot [in, out]")
        knot = number(pair[0], at, 0.0, widest), number(pair[1], at, 0.0, most)
        if pairs and knot[0] <= pairs[-1][0]:
            raise BrushError(at, described(pair), f"an input above {pairs[-1][0]:g}, that of the knot before")
        pairs.append(knot)
    return tuple(pairs)


def frozen(value: Any) -> Any:
    """Returns a JSON value with its lists as tuples and its objects as immutable maps."""
    if isinstance(value, Mapping):
        return Map({str(name): frozen(part) for name, part in value.items()})
    return tuple(frozen(part) for part in value) if isinstance(value, list | tuple) else value


def thawed(value: Any) -> Any:
    """Returns the plain JSON value of a frozen one; members in order of their names."""
    if isinstance(value, Mapping):
        return {name: thawed(value[name]) for name in sorted(value)}
    return [thawed(part) for part in value] if isinstance(value, tuple) else value
