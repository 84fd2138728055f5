"""A place as text: `12, 4096, 2048` is pixel (4096, 2048) of level 12.  Numbers of any size."""

from __future__ import annotations

import math
import re

from app.canvas.standpoint import Size, Standpoint, standpoint_at
from engine.checks.field_error import FieldError
from engine.painting.places import LARGEST_BOOKMARK, LEVEL_LIMIT, PLACE_LIMIT, Bookmark

FORM = "a level, level, x, y, or level, x, y, width, height"
_NUMBER = re.compile(r"[-+]?\d+(\.\d*)?|[-+]?\.\d+")
_AROUND = re.compile(r"level|[\[\](){}]", re.IGNORECASE)
_DIGITS = 2600  # of a number: a place has fewer


def place_text(here: Standpoint, level: int) -> str:
    """Returns the pixel of a level in the middle, as text that `typed_standpoint` reads."""
    x, y = here.place.pixel(level)
    return f"{level}, {x}, {y}"


def typed_standpoint(text: str, here: Standpoint, shown: int, size: Size) -> Standpoint:
    """Returns where a text leads from `here`, where level `shown` is seen on a screen of a size; FieldError if it is no
    place."""
    numbers = _numbers(text)
    level = numbers[0]
    if abs(level) > LEVEL_LIMIT:
        raise FieldError("level", f"{level:g}", f"-{LEVEL_LIMIT} to {LEVEL_LIMIT}")
    whole = math.floor(level)
    zoom = (here.level, here.fraction) if level == shown else (whole, level - whole)
    if len(numbers) == 1:
        return Standpoint(here.place, *zoom, here.angle, here.mirrored)
    if any(abs(number) > PLACE_LIMIT for number in numbers[1:3]):
        raise FieldError("place", "a number too large", "fewer digits")
    origin = numbers[1], numbers[2]
    if len(numbers) == 5:
        if not all(0 < side <= LARGEST_BOOKMARK for side in numbers[3:]):
            raise FieldError("size", "a side out of bounds", "more than 0, at most 2^40")
        there = standpoint_at(Bookmark("", level, origin, (numbers[3], numbers[4])), size)
        return Standpoint(there.place, there.level, there.fraction)
    corner = [number if isinstance(number, int) else number - 0.5 for number in origin]
    pixel = standpoint_at(Bookmark("", level, (corner[0], corner[1]), (1, 1)), (1, 1))  # the middle of the pixel
    return Standpoint(pixel.place, *zoom, here.angle, here.mirrored)


def _numbers(text: str) -> list[float]:
    words = [word for word in re.split(r"[\s,;]+", _AROUND.sub(" ", text.replace("−", "-"))) if word]
    if len(words) not in (1, 3, 5) or not all(_NUMBER.fullmatch(word) and len(word) <= _DIGITS for word in words):
        raise FieldError("place", f"“{text.strip()[:40]}”", FORM)
    return [float(word) if "." in word else int(word) for word in words]
