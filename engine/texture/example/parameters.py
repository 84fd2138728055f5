"""How an example is used, and the TOML file that tells it (Ritter et al. 2006, sections 3 and 4)."""

from __future__ import annotations

import re
import tomllib
from collections.abc import Callable, Mapping
from dataclasses import dataclass, fields, replace
from typing import Any, NamedTuple

from engine.checks.field_error import FieldError
from engine.checks.values import is_integer, is_within

SEAMLESS = 2  # the method of new definitions
METHODS = ("correction", "scanline", SEAMLESS)
CHANNELS = ("colour", "luminance")
BOUNDARIES = ("auto", "yes", "no")
MOST_LEVELS = 8
ORIENTATION, RIM_CHANNEL = "orientation", "rim"  # control channels with a meaning of their own


@dataclass(frozen=True, slots=True)
class Parameters:
    """`kappa`: how much nearer a pixel from elsewhere in the example must be than one that continues what lies
    around it, at a rim 1.5 at most; `neighbourhood`: pixels along its side; `levels`: of the pyramid, 0 to choose
    by the example's size; `every`: one in so many pixels (scanline) or candidates of the coarsest level
    (correction) is searched for, 125 times as few with SEAMLESS; `channels`, `alpha`: what is compared; `e_max`:
    the energy of a pixel inside the region against one outside, where 1 is a channel from black to white;
    `boundary`: whether the example shows its rim ("auto": unless it fills its picture); `smooth`: pixels over which
    its mask is smoothed; `block`: pixels along the patches of the coarsest level; `passes`: corrections at each
    finer level; `feather`: pixels over which seams are blended, 0 to 3; half as many, rounded down, in an example
    with a rim; `method`: "correction", "scanline", or SEAMLESS, which lays out pieces that fit one another and
    takes rims from more places."""

    kappa: float = 2.0
    neighbourhood: int = 7
    levels: int = 0
    every: int = 8
    channels: str = "colour"
    alpha: bool = True
    e_max: float = 8.0
    boundary: str = "auto"
    smooth: float = 0.0
    block: int = 14
    passes: int = 1
    feather: int = 2
    method: str | int = "correction"


_USUAL = Parameters()
NEW = Parameters(method=SEAMLESS)  # what new definitions begin with


class Field(NamedTuple):
    """A row: what may stand in a field."""

    expected: str
    fits: Callable[[Any], bool]


def _shown(value: object) -> str:
    text = str(value).lower() if isinstance(value, bool) else f'"{value}"' if isinstance(value, str) else str(value)
    return _clipped(text)


def _clipped(text: str) -> str:
    plain = ascii(text)[1:-1].replace('\\"', '"') if not text.isascii() or not text.isprintable() else text
    return plain if len(plain) <= 40 else plain[:37] + "..."


def _number(low: float, high: float) -> Field:
    def fits(value: Any) -> bool:
        return is_within(value, low, high)

    return Field(f"a number from {low:g} to {high:g}", fits)


def _whole(low: int, high: int) -> Field:
    def fits(value: Any) -> bool:
        return is_integer(value) and low <= value <= high

    return Field(f"a whole number from {low} to {high}", fits)


def _one_of(*values: Any) -> Field:
    def fits(value: Any) -> bool:
        return any(value == known and type(value) is type(known) for known in values)

    return Field(" or ".join(map(_shown, values)), fits)


FIELDS: Mapping[str, Field] = {
    "kappa": _number(0.0, 100.0),
    "neighbourhood": _one_of(3, 5, 7),
    "levels": _whole(0, MOST_LEVELS),
    "every": _whole(1, 1000),
    "channels": _one_of(*CHANNELS),
    "alpha": _one_of(True, False),
    "e_max": _number(0.0, 16.0),
    "boundary": _one_of(*BOUNDARIES),
    "smooth": _number(0.0, 32.0),
    "block": _whole(1, 64),
    "passes": _whole(1, 4),
    "feather": _whole(0, 3),
    "method": _one_of(*METHODS),
}
assert tuple(FIELDS) == tuple(field.name for field in fields(Parameters))


def with_values(parameters: Parameters, values: Mapping[str, Any], place: str = "") -> Parameters:
    """With other values for some fields; FieldError at `place` and field for one that does not fit."""
    for name, value in values.items():
        check(name, value, f"{place}{name}")
    numbers = {name: float(value) for name, value in values.items() if FIELDS[name].expected.startswith("a number")}
    return replace(parameters, **{**values, **numbers})


def check(name: str, value: Any, place: str) -> None:
    """FieldError, unless `value` fits the field."""
    row = FIELDS.get(name)
    if row is None:
        raise FieldError(place, "an unknown field", f"one of {', '.join(FIELDS)}")
    if not row.fits(value):
        raise FieldError(place, _shown(value), row.expected)


def read_toml(data: bytes, usual: Parameters = _USUAL) -> Parameters:
    """Returns the parameters in a file's bytes, `usual` ones where it does not tell; `title` and `group`, under which a
    palette lists the example, and its `maps` are none of them.

    FieldError names the line and the field.
    """
    told, text = _told(data)
    for field in ("title", "group"):
        name = told.pop(field, "")
        if not isinstance(name, str):
            raise FieldError(f"line {line_of(text, field)}, {field}", _shown(name), "a name to list the example under")
    if not isinstance(told.pop("maps", {}), dict):
        raise FieldError(f"line {line_of(text, 'maps')}, maps", "something else", "a table of maps")
    for field, value in told.items():
        check(field, value, f"line {line_of(text, field)}, {_clipped(field)}")
    return with_values(usual, told)


def map_table(data: bytes) -> dict[str, object]:
    """Returns what the bytes of such a file tell of maps."""
    found = _told(data)[0].get("maps", {})
    return found if isinstance(found, dict) else {}


def _told(data: bytes) -> tuple[dict[str, Any], str]:
    """Returns what a file tells, and its text."""
    try:
        text = data.decode("utf-8")
        return tomllib.loads(text), text
    except UnicodeDecodeError as error:
        line = data[: error.start].count(b"\n") + 1
        raise FieldError(f"line {line}", "bytes that are not UTF-8", "TOML") from None
    except tomllib.TOMLDecodeError as error:
        raise _of_syntax(str(error), text) from None
    except RecursionError:
        raise FieldError("line 1", "brackets too deep", "TOML") from None
    except ValueError:  # of a whole number with thousands of digits
        raise FieldError("line 1", "a number too long", "TOML") from None


def line_of(text: str, field: str) -> int:
    """Returns the line, from 1, on which a file sets `field`; the parser does not tell."""
    bare = re.escape(field)
    start = re.compile(rf"""\s*(\[+\s*)?(["']?){bare}\2\s*[].=]""")
    lines = text.splitlines()
    return next((number for number, line in enumerate(lines, 1) if start.match(line)), 1)


def _of_syntax(message: str, text: str) -> FieldError:
    found = re.search(r"^(.*?) \(at line (\d+), column (\d+)\)$", message)
    if found is None:
        told = message.removesuffix(" (at end of document)").lower()
        return FieldError(f"line {max(1, len(text.splitlines()))}", _clipped(told), "field = value")
    told, line, column = found.groups()
    return FieldError(f"line {line}, column {column}", _clipped(told.lower()), "field = value")
