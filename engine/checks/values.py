"""Values that somebody gave, as JSON and TOML hold them: whether they are numbers, and how a message shows them."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping
from typing import Any

LONGEST = 60  # characters that a message shows of a value
_DIGITS = 200  # bits of the longest integer that is shown by its digits


def is_integer(value: Any) -> bool:
    """Tells whether a value is an int, and no bool."""
    return isinstance(value, int) and not isinstance(value, bool)


def is_number(value: Any) -> bool:
    """Tells whether a value is an int or a float, no bool, and finite."""
    return is_integer(value) or (isinstance(value, float) and math.isfinite(value))


def is_within(value: Any, lo: float, hi: float, whole: bool = False) -> bool:
    """Tells whether a value is a finite number of [lo, hi]; `whole`: one without a fraction, as 3 and 3.0."""
    return is_number(value) and bool(lo <= value <= hi) and not (whole and value != int(value))


def described(value: Any) -> str:
    """Returns a value as a message shows it: ASCII, on one line, cut at `LONGEST`."""
    if isinstance(value, Mapping):
        return "an object"
    if isinstance(value, list | tuple) and len(value) > 6:
        return f"a list of {len(value)}"
    if isinstance(value, int) and value.bit_length() > _DIGITS:
        return f"an integer of about {int(value.bit_length() * 0.30103)} digits"
    try:
        text = json.dumps(value)
    except (TypeError, ValueError, RecursionError):
        very_long = isinstance(value, list | tuple)
        return "a list with very long numbers" if very_long else ascii(type(value).__name__)
    return text if len(text) <= LONGEST else text[:LONGEST] + "..."
