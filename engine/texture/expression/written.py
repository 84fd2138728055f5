"""A written texture as text: named lines, each an expression, the last one the texture; a line break or `;` ends one.

    height = slider(0.5, 0, 1)         // a number that whoever uses it may set, its usual value, the least, the most
    moss = pick(#5a7a3a)               // a colour likewise
    mix(#302820, moss, fbm(x, y) * height)

Within brackets a line goes on; what stands behind // is a comment.  A line may be called as a function or a constant
is: with a bracket behind it the name is the function's, without it is the line's from there on.
"""

from __future__ import annotations

import difflib
import itertools
import re
from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass, field, replace
from typing import NoReturn

from engine.numeric.formula import CONSTANTS
from engine.numeric.reader import ARITHMETIC_SIGNS, NUMBER, Reader, Token, Words, quoted, tokens

CHARACTERS_MOST, LINES_MOST, PARTS_MOST, DEPTH_MOST = 16_384, 64, 2_000, 40
PRESSURE, OWN_RIM, OWN_WAY = "pressure", "rim", "direction"  # what a stroke tells of each of its pixels,
FELT = {
    PRESSURE: PRESSURE,
    OWN_RIM: "the rim",
    OWN_WAY: "the direction",
}  # as values of a text beside those of its sliders
STROKE_WAYS, FULL_TURN = 16, 360.0  # directions that differ, and degrees
USUAL_STAGES, STAGES_LEAST, STAGES_MOST = 5, 2, 9  # pressures from 0 to 1, between which is mixed
_STAGES_OF = (STAGES_MOST, STAGES_MOST, 5, 3)  # at most of a text that goes by so many: 144 textures for all three
STROKE_NAMES = {
    "along": "how far along its stroke a place lies",
    "across": "how far to the right of its stroke a place lies, seen along it",
    "heading": "which way the stroke runs there, in radians, clockwise from rightwards",
    "size": "how thick the stroke is there, 1 being its brush",
}
PLACERS = ("scatter", "row")
OUTER_WORD = "outer"
_YIELDING = (*STROKE_NAMES, OWN_RIM, OWN_WAY)  # places whose names a line may have, as in old texts
PLACE_NAMES = {
    **STROKE_NAMES,
    "x": "the place, in periods from the left",
    "y": "the place, in periods from the top",
    "fw": "the width of a pixel, in periods",
    "level": "the level that is looked at: each has twice the pixels of the one before",
    PRESSURE: "how hard the pen pressed, 0 to 1; 1 where there is no pen",
    OWN_RIM: "how far within its stroke's rim a place lies, 0 to 1: a radius of the brush; 1 where there is no stroke",
    OWN_WAY: "which way its stroke runs, in radians, clockwise from rightwards: one of 16",
    "seed": "the number that tells one texture from another of the same text",
}
SLIDER, PICK = "slider", "pick"
_CHOICE = ("if", "else")
_SETTERS = {SLIDER: (3, 4), PICK: (1, 1)}
_KINDS = ("number", "name", "colour", "string", "break", "sign")
_TOKEN = re.compile(rf'[ \t\r]*(?:({NUMBER})|([A-Za-z_]\w*)|(#\w+)|("[^"\n]*")|([\n;])|(\*\*|<=|>=|[^\n]))', re.ASCII)
_COMMENT = re.compile(r'("[^"\n]*")|//[^\n]*')
_COLOUR = re.compile(r"#(?:[0-9a-fA-F]{6}|[0-9a-fA-F]{8})")


class WrittenError(ValueError):
    """A text that cannot be read: `str()` is one line; lines and columns count from 1."""

    def __init__(self, place: tuple[int, int], found: str, expected: str) -> None:
        (self.line, self.column), self.found, self.expected = place, found, expected
        super().__init__(f"line {place[0]}, column {place[1]}: found {found}, expected {expected}")

    def __reduce__(self) -> tuple[object, ...]:
        return type(self), ((self.line, self.column), self.found, self.expected)


@dataclass(frozen=True, slots=True)
class Term:
    """A part of an expression: `operation` on other parts, or a "number", "name", "colour" as the token tells."""

    operation: str
    parts: tuple[Term, ...]
    token: Token = field(compare=False)
    told: str = ""

    @property
    def within(self) -> Iterator[Term]:
        """Yields it and all its parts, and theirs."""
        open_ = [self]
        while open_:
            term = open_.pop()
            yield term
            open_.extend(term.parts)


@dataclass(frozen=True, slots=True)
class Adjustable:
    """What may be set from outside: a number from `least` to `most`, whole multiples of `step` from there on if that is
    not 0; or a colour, "#rrggbb" or "#rrggbbaa"."""

    usual: float | str
    least: float = 0.0
    most: float = 1.0
    step: float = 0.0


@dataclass(frozen=True, slots=True)
class TextLine:
    """`name`: "" for a last line without one; `at`: characters of the text before it."""

    name: str
    term: Term
    at: int
    slider: Adjustable | None = None


@dataclass(frozen=True, slots=True)
class WrittenText:
    """A checked text."""

    text: str
    lines: tuple[TextLine, ...]

    @property
    def sliders(self) -> dict[str, Adjustable]:
        """Gives what may be set, by name."""
        return {line.name: line.slider for line in self.lines if line.slider is not None}

    @property
    def felt(self) -> tuple[str, ...]:
        """Gives what lines look at of that which a stroke tells of each pixel."""
        told = {term.told for term in self._terms()} - {line.name for line in self.lines}
        return tuple(name for name in FELT if name in told)

    @property
    def places(self) -> bool:
        """Tells whether any line places things."""
        return any(term.operation in PLACERS for term in self._terms())

    @property
    def named(self) -> list[Term]:
        """Gives the parts that name textures, in the order of the text."""
        return sorted((term for term in self._terms() if term.operation == "texture"), key=lambda term: term.token.at)

    @property
    def follows(self) -> bool:
        """Tells whether it is made for a stroke: places things, or goes by where the stroke runs."""
        own = {line.name for line in self.lines}
        told = STROKE_NAMES.keys() - own
        return any(term.operation in (*PLACERS, OUTER_WORD) or term.told in told for term in self._terms())

    def _terms(self) -> Iterator[Term]:
        return itertools.chain.from_iterable(line.term.within for line in self.lines)

    def place(self, at: int) -> tuple[int, int]:
        """Returns the line and the column, from 1, of a character of the text."""
        return row_and_column(self.text, at)


def most_stages(felt: Collection[str]) -> int:
    """Returns for how many pressures, or distances from the rim, a text that looks at these may have textures."""
    return _STAGES_OF[len(felt)]


def row_and_column(text: str, at: int) -> tuple[int, int]:
    """Returns the line and the column, from 1, of a character."""
    return text.count("\n", 0, at) + 1, at - (text.rfind("\n", 0, at) + 1) + 1


def words(functions: Mapping[str, tuple[int, int]]) -> Words:
    """Returns the words of written textures, whose functions these are, with the numbers of values they take."""
    return Words({**functions, **_SETTERS}, CONSTANTS, PLACE_NAMES, PARTS_MOST, DEPTH_MOST)


def parse_text(text: str, table: Words) -> WrittenText:
    """Returns a checked text.  WrittenError tells the first mistake."""
    if len(text) > CHARACTERS_MOST:
        raise WrittenError((1, 1), f"{len(text)} characters", f"{CHARACTERS_MOST} at most")
    return WrittenText(text, tuple(_Text(text_tokens(text), table, text).lines()))


def text_tokens(text: str) -> list[Token]:
    """Returns what a text is made of, without comments and without line breaks within brackets, the end last.
    WrittenError tells what the language does not have."""
    without = _COMMENT.sub(lambda found: found[1] or " " * len(found[0]), text)
    return _joined(text, list(tokens(without, _TOKEN, _KINDS)))


def _joined(text: str, found: list[Token]) -> list[Token]:
    """Returns tokens without line breaks within brackets; nothing is left that the language does not have."""
    out, depth = [], 0
    for token in found:
        depth += {"(": 1, ")": -1}.get(token.text, 0) if token.kind == "sign" else 0
        if token.kind == "sign" and token.text not in (*ARITHMETIC_SIGNS, "="):
            expected = "a number, a name or one of = " + " ".join(ARITHMETIC_SIGNS)
            if token.text == "#":
                expected = "a colour, #rrggbb; comments stand behind //"
            raise WrittenError(row_and_column(text, token.at), quoted(token.text), expected)
        if token.kind == "colour" and not _COLOUR.fullmatch(token.text):
            raise WrittenError(row_and_column(text, token.at), quoted(token.text), "a colour, #rrggbb or #rrggbbaa")
        if token.kind != "break" or depth <= 0:
            out.append(token)
    return out


class _Text(Reader[Term]):
    first = "a number, a colour, a name, a function or ("

    def __init__(self, found: list[Token], table: Words, text: str) -> None:
        super().__init__(found, table)
        self._text, self._own = text, dict(table.names)

    def made(self, token: Token, operation: str, *parts: Term) -> Term:
        told = token.text if operation in ("number", "name", "constant", "colour", "texture") else ""
        return Term(operation, parts, token, told)

    def mistake(self, at: int, found: str, expected: str) -> NoReturn:
        raise WrittenError(row_and_column(self._text, at), found, expected)

    def lines(self) -> list[TextLine]:
        out: list[TextLine] = []
        while self._broken().kind != "end":
            if len(out) == LINES_MOST:
                self.mistake(self.now.at, "one line more", f"{LINES_MOST} lines at most")
            if out and not out[-1].name:
                self.mistake(out[-1].at, "a line without a name", "name = value: only the last line may have none")
            out.append(self._line())
        if not out:
            self.mistake(0, "nothing", "an expression")
        if out[-1].slider is not None:
            self.refuse("a line behind the sliders: the texture")
        return out

    def _broken(self) -> Token:
        while self.now.kind == "break":
            self.pop()
        return self.now

    def _line(self) -> TextLine:
        start, name = self.now, ""
        if self._is_name():
            name = self.pop().text
            self.need("=", "=")
        term = self.choice()
        if self.now.kind not in ("break", "end"):
            self.refuse("an operator or the end of the line")
        slider = self._slider(term, name)
        _only_there(self, term, slider)
        if name:
            self._own[name] = ""
            self.words = replace(self.words, names=self._own)
        return TextLine(name, term, start.at, slider)

    def _is_name(self) -> bool:
        """Tells whether a name follows, which the line is to have; it must be nobody else's."""
        token = self.now
        if token.kind != "name" or self._tokens[self._at + 1].text != "=":
            return False
        if token.text in _YIELDING and self._own.get(token.text):
            self._own.pop(token.text)
            return True
        if token.text in _CHOICE or self._own.get(token.text):
            self.refuse(f"a name of your own, such as my_{token.text}: this one has a meaning", token)
        if token.text in self._own:
            self.refuse(f"a name of your own, such as {self._free(token.text)}: this one is taken", token)
        return True

    def _free(self, name: str) -> str:
        """Returns a name like another that no line has."""
        stem, number = name.rstrip("0123456789"), 2
        while f"{stem}{number}" in self._own:
            number += 1
        return f"{stem}{number}"

    def literal(self, token: Token, depth: int) -> Term:
        if token.kind == "colour":
            return self.part(token, "colour")
        if token.kind != "string":
            self.refuse(self.first, token)
        self.need("(", "( and a place, or nothing, and ) after the name of a texture")
        parts = []
        if self.now.text != ")":
            parts = [self.choice(depth + 1)]
            self.need(",", ", and how far down")
            parts.append(self.choice(depth + 1))
            if self.now.text == ",":  # of a series, which of it
                self.pop()
                parts.append(self.choice(depth + 1))
        self.need(")", ") or an operator")
        return self.part(token, "texture", *parts)

    def unknown(self, token: Token) -> NoReturn:
        like = close_to(token.text, [*self._own, *self.words.constants, *self.words.functions])
        self.refuse(f"a name that there is{', such as ' + like if like else ''}", token)

    def _slider(self, term: Term, name: str) -> Adjustable | None:
        if term.operation not in _SETTERS:
            return None
        if not name:
            self.refuse(f"a name: name = {term.operation}(...)", term.token)
        if term.operation == PICK:
            if term.parts[0].operation != "colour":
                self.refuse("a colour, #rrggbb or #rrggbbaa", term.parts[0].token)
            return Adjustable(term.parts[0].told.lower())
        numbers = [self._number(part) for part in term.parts]
        usual, least, most, step = (*numbers, 0.0)[:4]
        if not least < most or not least <= usual <= most or step < 0.0:
            self.refuse("slider(usual, least, most), rising from least to most", term.token)
        return Adjustable(usual, least, most, step)

    def _number(self, term: Term) -> float:
        if term.operation == "neg":
            return -self._number(term.parts[0])
        if term.operation != "number":
            self.refuse("a number: sliders have no others", term.token)
        return float(term.told)


def _only_there(reader: _Text, term: Term, slider: Adjustable | None) -> None:
    """Tells of a slider that is not a line of its own."""
    for one in term.within if slider is None else ():
        if one.operation in _SETTERS:
            reader.refuse(f"it in a line of its own: name = {one.operation}(...)", one.token)


def close_to(word: str, known: list[str]) -> str:
    """Returns that of some words which is most like another; "" if none is."""
    found = difflib.get_close_matches(word, known, 1)
    return found[0] if found else ""


def is_colour(text: str) -> bool:
    """Tells whether a text is "#rrggbb" or "#rrggbbaa"."""
    return _COLOUR.fullmatch(text) is not None


def samples_told(samples: int) -> str:
    """Tells in words how many samples a pixel takes: 0 where each takes as many as it needs."""
    return {0: "1 to 16 samples", 1: "1 sample"}.get(samples, f"{samples} samples")
