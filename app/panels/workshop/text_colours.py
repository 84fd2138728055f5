"""A text of the language in its parts, each with what it is, so that it is drawn in colours."""

from __future__ import annotations

import re
from functools import lru_cache
from typing import NamedTuple

from app import theme

NOTE, COLOUR_PART, NUMBER_PART, STRING, FUNCTION, PLACE, OWN_NAME, SIGN, OTHER_PART = (
    *("note", "colour", "number", "string", "function", "place", "own", "sign", "other"),
)
_PART = re.compile(
    r'(//.*)|(#[0-9a-fA-F]{8}\b|#[0-9a-fA-F]{6}\b)|("[^"]*"?)|((?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)|([A-Za-z_]\w*)'
    r"|([-+*/%=<>(),]+)|(\S)",
    re.ASCII,
)
_NAMED = re.compile(r"^[ \t]*([A-Za-z_]\w*)[ \t]*=(?!=)|;[ \t]*([A-Za-z_]\w*)[ \t]*=(?!=)", re.MULTILINE | re.ASCII)
_KINDS = {1: NOTE, 2: COLOUR_PART, 3: STRING, 4: NUMBER_PART, 6: SIGN, 7: OTHER_PART}
_TONES = {  # on a dark ground, and on a light one
    NOTE: ((0.50, 0.60, 0.50), (0.25, 0.42, 0.27)),
    STRING: ((0.84, 0.66, 0.52), (0.58, 0.25, 0.10)),
    NUMBER_PART: ((0.72, 0.82, 0.62), (0.16, 0.42, 0.16)),
    FUNCTION: ((0.55, 0.76, 0.96), (0.08, 0.32, 0.62)),
    PLACE: ((0.86, 0.68, 0.88), (0.48, 0.16, 0.52)),
    OWN_NAME: ((0.94, 0.84, 0.62), (0.48, 0.32, 0.02)),
}


class TextPart(NamedTuple):
    """Letters of a line from `at` on, and what they are."""

    at: int
    text: str
    kind: str


class Names(NamedTuple):
    """What names mean: those of functions, of places, and of lines."""

    functions: frozenset[str] = frozenset()
    places: frozenset[str] = frozenset()
    own: frozenset[str] = frozenset()


@lru_cache(1024)
def text_parts(line: str, names: Names) -> tuple[TextPart, ...]:
    """Returns the parts of a line."""
    out = []
    for found in _PART.finditer(line):
        kind = _KINDS.get(found.lastindex or 7, OTHER_PART)
        if found.lastindex == 5:
            kind = _meaning(found[0], names, line[found.end() :].lstrip().startswith("("))
        out.append(TextPart(found.start(), found[0], kind))
    return tuple(out)


def _meaning(name: str, names: Names, called: bool) -> str:
    if name in names.functions and (called or name not in names.own):
        return FUNCTION
    if name in names.own:
        return OWN_NAME
    return PLACE if name in names.places else OTHER_PART


@lru_cache(16)
def own_names(text: str) -> frozenset[str]:
    """Returns the names of a text's lines, whether it is right or not."""
    return frozenset(first or second for first, second in _NAMED.findall(text))


def tone(part: TextPart) -> tuple[float, float, float]:
    """Returns the colour in which a part is drawn."""
    look = theme.look
    light = int(look.field[0] > 0.5)
    if part.kind == SIGN:
        return look.soft
    return _TONES[part.kind][light] if part.kind in _TONES else look.text
