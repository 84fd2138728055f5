"""JSON as our files hold it: stricter than the standard library reads it, and read one named member at a time.

Refused: NaN and infinities in any spelling (1e999 too), members given twice, text that is not UTF-8, lone
surrogates, nesting beyond what the parser can take, numbers of more than 4,300 digits.
"""

from __future__ import annotations

import json
import math
import re
from collections.abc import Mapping
from typing import Any

from immutables import Map

from engine.brush.checks import frozen
from engine.checks.field_error import FieldError
from engine.checks.values import described, is_integer, is_within
from engine.files.fault import shown

BYTES_CAP = 8 << 20  # of one line or document
_NAME_CAP = 256  # characters
_LONE = re.compile("[\ud800-\udfff]")
# What no XML file can hold: names end up in stack.xml.
_UNPRINTABLE = re.compile("[\x00-\x1f\x7f\ufffe\uffff]")


def loads(data: bytes | str, cap: int = BYTES_CAP, twice: bool = False) -> Any:
    """Returns the value that `data`, one JSON document, holds.  FieldError tells the column where it is wrong.

    `twice`: a member may be given again, and the last counts, as other programs that write such files have it.
    """
    if len(data) > cap:
        raise FieldError("", f"more than {cap >> 20} MiB", "less")
    try:
        text = data.decode("utf-8-sig") if isinstance(data, bytes) else data
    except UnicodeDecodeError as error:
        raise FieldError(f"byte {error.start + 1}", "bytes that are not UTF-8", "UTF-8 text") from None
    try:
        value = (_PATIENT if twice else _DECODER).decode(text)
    except json.JSONDecodeError as error:
        raise FieldError(_place(text, error.pos), _excerpt(text, error.pos), f"JSON ({error.msg})") from None
    except RecursionError:
        raise FieldError("", "brackets nested too deeply", "a few levels") from None
    except FieldError:
        raise
    except ValueError:
        raise FieldError("", "a number of more than 4300 digits", "a shorter number") from None
    if "\\u" in text and _LONE.search(json.dumps(value, ensure_ascii=False)):
        raise FieldError("", "half of a surrogate pair", "whole characters")
    return value


def dumps(value: Any) -> str:
    """`value` on one line, without spaces after the separators of numbers; ValueError if it holds NaN or infinity."""
    return json.dumps(value, ensure_ascii=False, allow_nan=False, separators=(",", ":"))


def _place(text: str, position: int) -> str:
    line = text.count("\n", 0, position) + 1
    column = position - text.rfind("\n", 0, position)
    return f"column {column}" if line == 1 else f"line {line}, column {column}"


def _excerpt(text: str, position: int) -> str:
    rest = text[position : position + 20]
    return shown(rest) if rest.strip() else "the end"


def _constant(name: str) -> float:
    raise FieldError("", name, "a finite number")


def _finite(digits: str) -> float:
    value = float(digits)
    if not math.isfinite(value):
        raise FieldError("", shown(digits), "a number within the range of a 64-bit float")
    return value


def _members(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    members = dict(pairs)
    if len(members) < len(pairs):
        seen: set[str] = set()
        twice = next(name for name, _ in pairs if name in seen or seen.add(name))  # type: ignore[func-returns-value]
        raise FieldError("", f"{shown(twice)} given twice", "each name once")
    return members


_DECODER = json.JSONDecoder(parse_constant=_constant, parse_float=_finite, object_pairs_hook=_members)
_PATIENT = json.JSONDecoder(parse_constant=_constant, parse_float=_finite)


class _Missing:
    pass


REQUIRED: Any = _Missing()


class Fields:
    """The members of one JSON object, read by name and checked; `rest()` is what nobody asked for."""

    def __init__(self, value: Any, place: str) -> None:
        if not isinstance(value, Mapping):
            raise FieldError(place, described(value), "an object")
        self.place = place
        self._members = value
        self._asked: set[str] = set()

    def __contains__(self, name: str) -> bool:
        return name in self._members

    def all(self) -> Mapping[str, Any]:
        """Returns the whole object."""
        return self._members

    def at(self, name: str) -> str:
        """Gives the place of a member, for messages."""
        return f"{self.place}.{name}" if self.place else name

    def fault(self, name: str, expected: str) -> FieldError:
        """Makes the error that names a member, what was found there and what was expected."""
        found = described(self._members[name]) if name in self._members else "nothing"
        return FieldError(self.at(name), found, expected)

    def take(self, name: str, default: Any = REQUIRED, expected: str = "a value") -> Any:
        """Returns the member as it stands.  A missing one is `default`; without default it is an error."""
        self._asked.add(name)
        if name not in self._members:
            if default is REQUIRED:
                raise self.fault(name, expected)
            return default
        return self._members[name]

    def integer(self, name: str, default: Any = REQUIRED, *, lo: int, hi: int) -> Any:
        """Returns an integer of lo..hi; the default where it is missing.  FieldError for anything else."""
        expected = f"an integer{_range(lo, hi)}"
        value = self.take(name, default, expected)
        if name in self._members and not (is_integer(value) and lo <= value <= hi):
            raise self.fault(name, expected)
        return value

    def number(self, name: str, default: Any = REQUIRED, *, lo: float, hi: float) -> Any:
        """Returns a finite number of [lo, hi] as float."""
        expected = f"a number{_range(lo, hi)}"
        value = self.take(name, default, expected)
        if name not in self._members:
            return value
        if not is_within(value, lo, hi):
            raise self.fault(name, expected)
        return float(value) + 0.0  # no negative zero

    def flag(self, name: str, default: Any = REQUIRED) -> Any:
        """Returns true or false; the default where it is missing.  FieldError for anything else."""
        value = self.take(name, default, "true or false")
        if name in self._members and not isinstance(value, bool):
            raise self.fault(name, "true or false")
        return value

    def text(self, name: str, default: Any = REQUIRED, *, cap: int = _NAME_CAP) -> Any:
        """Returns a string of 1 to `cap` characters without control characters."""
        expected = f"a text of 1 to {cap} printable characters"
        value = self.take(name, default, expected)
        if name in self._members and not is_name(value, cap):
            raise self.fault(name, expected)
        return value

    def integers(self, name: str, count: int, default: Any = REQUIRED, *, limit: int) -> Any:
        """Returns a tuple of `count` integers of absolute value at most `limit`."""
        expected = f"a list of {count} integers{_range(-limit, limit)}"
        value = self.take(name, default, expected)
        if name not in self._members:
            return value
        if not (isinstance(value, list) and len(value) == count and all(map(is_integer, value))):
            raise self.fault(name, expected)
        if any(abs(v) > limit for v in value):
            raise self.fault(name, expected)
        return tuple(value)

    def rest(self) -> Map[str, Any]:
        """Returns the members that were not read, frozen: kept, so that what a newer version wrote survives."""
        out: Map[str, Any] = frozen({name: value for name, value in self._members.items() if name not in self._asked})
        return out


def is_name(value: Any, cap: int = _NAME_CAP) -> bool:
    """Tells whether a value may name a layer or texture: a text, not too long, that stack.xml can hold."""
    return isinstance(value, str) and 0 < len(value) <= cap and not _UNPRINTABLE.search(value)


def _range(lo: float, hi: float) -> str:
    return f" from {_bound(lo)} to {_bound(hi)}"


def _bound(value: float) -> str:
    if isinstance(value, int) and value.bit_length() > 40:
        sign, size = ("-", -value) if value < 0 else ("", value)
        return f"{sign}2^{(size + 1).bit_length() - 1}"
    return f"{value:g}" if isinstance(value, float) else str(value)
