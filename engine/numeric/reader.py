"""Reads arithmetic in Python's notation, whatever the names in it are: of raster-ops' formulas, of written textures.

    value if condition else other    < <= > >=    + -    * / %    - (sign)    **    ( )    name    function(value, ...)

A reader is given a table of words; nothing but these can be said: there are no attributes, subscripts or calls of
anything else.  Size and depth are bounded.  What a part becomes, and how a mistake is told, each language says itself.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Generic, NamedTuple, NoReturn, TypeVar

COMPARISONS = ("<", "<=", ">", ">=")
ARITHMETIC_SIGNS = (*COMPARISONS, "+", "-", "*", "/", "%", "**", "(", ")", ",")
NUMBER = r"\d+\.?\d*(?:[eE][+-]?\d+)?|\.\d+(?:[eE][+-]?\d+)?"
_SHOWN = 24  # characters of a mistake

_Part = TypeVar("_Part")


class Token(NamedTuple):
    """`kind`: number, name, sign, end, or another of the language's own; `at`: characters before it."""

    kind: str
    text: str
    at: int


@dataclass(frozen=True)
class Words:
    """`functions`: how many values each takes, from, to; `parts`, `depth`: how large a text may be."""

    functions: Mapping[str, tuple[int, int]]
    constants: Mapping[str, float]
    names: Mapping[str, str]
    parts: int
    depth: int


def tokens(text: str, pattern: re.Pattern[str], kinds: tuple[str, ...]) -> Iterator[Token]:
    """Yields what a text is made of, the end last.  `pattern` matches at every place, one group for each kind."""
    at, end = 0, len(text.rstrip(" \t\r\n"))
    while at < end:
        found = pattern.match(text, at)
        assert found is not None
        assert found.lastindex is not None  # the last alternative takes any character
        yield Token(kinds[found.lastindex - 1], found[found.lastindex], found.start(found.lastindex))
        at = found.end()
    yield Token("end", "", end)


def quoted(text: str) -> str:
    """Returns a piece of text as a mistake tells it: short, in ASCII, in quotes."""
    told = ascii(text[:_SHOWN] + "..." if len(text) > _SHOWN else text)
    return f'"{told[1:-1]}"' if told[0] == "'" and '"' not in told else told


def values(least: int, most: int) -> str:
    """Says how many values a function takes."""
    return f"{least} value{'s' if least > 1 else ''}" if least == most else f"{least} to {most} values"


class Cursor:
    """Stands at a token, and tells what is wrong there."""

    def __init__(self, found: list[Token]) -> None:
        self._tokens, self._at = found, 0

    def mistake(self, at: int, found: str, expected: str) -> NoReturn:
        """Raises what tells of a mistake."""
        raise NotImplementedError

    @property
    def now(self) -> Token:
        """Gives the token that is read next."""
        return self._tokens[self._at]

    def refuse(self, expected: str, token: Token | None = None) -> NoReturn:
        """Tells that a token, the next one unless told, is none that may stand there."""
        token = self.now if token is None else token
        self.mistake(token.at, "the end" if token.kind == "end" else quoted(token.text), expected)

    def take(self, *texts: str) -> Token | None:
        """Reads the next token if it is one of these."""
        token = self.now
        if token.kind in ("sign", "name") and token.text in texts:
            self._at += 1
            return token
        return None

    def pop(self) -> Token:
        """Reads the next token."""
        self._at += 1
        return self._tokens[self._at - 1]

    def need(self, text: str, expected: str) -> None:
        """Reads what must stand there."""
        if self.take(text) is None:
            self.refuse(expected)


class Reader(Cursor, Generic[_Part]):
    """Recursive descent over the tokens, one method a rank of operators; depth and parts are counted."""

    first = "a number, a name, a function or ("

    def __init__(self, found: list[Token], words: Words) -> None:
        super().__init__(found)
        self.words, self._parts = words, 0

    def made(self, token: Token, operation: str, *parts: _Part) -> _Part:
        """Makes a part of the tree: "number", "name", or an operation on others."""
        raise NotImplementedError

    def part(self, token: Token, operation: str, *parts: _Part) -> _Part:
        """Returns a new part of the tree, if there is room for it."""
        self._parts += 1
        if self._parts > self.words.parts:
            self.mistake(token.at, "one part more", f"{self.words.parts} parts at most")
        return self.made(token, operation, *parts)

    def _reach(self, depth: int) -> None:
        if depth > self.words.depth:
            self.mistake(self.now.at, "one level more", f"{self.words.depth} levels at most")

    def choice(self, depth: int = 0) -> _Part:
        """Reads value if condition else other, and all that binds more tightly."""
        self._reach(depth)
        value = self._comparison(depth)
        token = self.take("if")
        if token is None:
            return value
        condition = self._comparison(depth)
        self.need("else", '"else"')
        return self.part(token, "if", condition, value, self.choice(depth + 1))

    def _comparison(self, depth: int) -> _Part:
        left = self._sum(depth)
        token = self.take(*COMPARISONS)
        if token is None:
            return left
        made = self.part(token, token.text, left, self._sum(depth))
        if self.now.text in COMPARISONS:
            self.refuse("one comparison at a time")
        return made

    def _sum(self, depth: int) -> _Part:
        left = self._product(depth)
        while (token := self.take("+", "-")) is not None:
            left = self.part(token, token.text, left, self._product(depth))
        return left

    def _product(self, depth: int) -> _Part:
        left = self._signed(depth)
        while (token := self.take("*", "/", "%")) is not None:
            left = self.part(token, "mod" if token.text == "%" else token.text, left, self._signed(depth))
        return left

    def _signed(self, depth: int) -> _Part:
        self._reach(depth)
        token = self.take("-", "+")
        if token is None:
            return self._power(depth)
        value = self._signed(depth + 1)
        return value if token.text == "+" else self.part(token, "neg", value)

    def _power(self, depth: int) -> _Part:
        base = self._value(depth)
        token = self.take("**")
        return base if token is None else self.part(token, "pow", base, self._signed(depth + 1))

    def _value(self, depth: int) -> _Part:
        token = self.now
        if self.take("(") is not None:
            inside = self.choice(depth + 1)
            self.need(")", ") or an operator")
            return inside
        if token.kind in ("sign", "end") or token.text in ("if", "else"):
            self.refuse(self.first)
        self.pop()
        if token.kind == "number" and not math.isfinite(float(token.text)):
            self.refuse("a number below 1e308", token)
        if token.kind != "name":
            return self.part(token, token.kind) if token.kind == "number" else self.literal(token, depth)
        if token.text in self.words.functions and (self.now.text == "(" or token.text not in self.words.names):
            return self.call(token, depth, *self.words.functions[token.text])
        if token.text in self.words.names:
            return self.part(token, "name")
        if token.text not in self.words.constants:
            self.unknown(token)
        return self.part(token, "constant")

    def literal(self, token: Token, depth: int) -> _Part:
        """Reads what is neither number nor name."""
        self.refuse(self.first, token)

    def unknown(self, token: Token) -> NoReturn:
        """Tells of a name that nothing has."""
        words = self.words
        self.refuse("a name: " + ", ".join([*words.names, *words.constants, *words.functions]), token)

    def call(self, token: Token, depth: int, least: int, most: int) -> _Part:
        """Reads the values that a function is given."""
        wanted = values(least, most)
        self.need("(", f"( and {wanted} after {token.text}")
        parts = [self.choice(depth + 1)]
        while self.take(",") is not None:
            if len(parts) == most:
                self.mistake(self.now.at, "one value more", f"{wanted} for {token.text}")
            parts.append(self.choice(depth + 1))
        if len(parts) < least:
            self.refuse(f"{wanted} for {token.text}")
        self.need(")", ") or an operator")
        return self.part(token, token.text, *parts)
