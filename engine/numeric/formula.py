"""The language of the artist's own raster-op: a formula as text to a checked tree, and the tree as text to compile.

Arithmetic over the names of NAMES, the functions of FUNCTIONS and numbers, in Python's notation:

    value if condition else other    < <= > >=    + -    * / %    - (sign)    **    ( )

The reader is this module's own, so nothing but these can be said: there are no attributes, strings, subscripts,
assignments or calls of anything else.  Size and depth are bounded.  A tree is nested tuples: ("number", value),
("name", name), or (operation, parts ...), the operation being a row of _PRINTED.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from typing import Any, NamedTuple, NoReturn

FORMULA_CAP = 4096  # characters
NODES_CAP = 160  # parts of the tree; so what is printed has fewer brackets in one another than Python reads
DEPTH_CAP = 40

NAMES = {
    "pic": "the channel's value before the stroke, 0 to 1",
    "luma": "the pixel's brightness before the stroke, 0 to 1",
    "tex": "the brush's textures mixed, 0 to 1; 1 for a brush without",
    "d": "how far the stroke covers the pixel, 0 to 1",
    "colour": "the channel's value in the brush's colour, 0 to 1",
    "pressure": "the strongest pen pressure over the pixel, 0 to 1",
    "x": "pixels to the right of the stroke's origin",
    "y": "pixels below the stroke's origin",
    "level": "the level that the stroke is painted at",
}
CONSTANTS = {"pi": math.pi, "tau": math.tau, "e": math.e}
FUNCTIONS = {
    "sin": 1, "cos": 1, "tan": 1, "atan2": 2, "sqrt": 1, "abs": 1, "exp": 1, "log": 1, "floor": 1, "fract": 1,
    "min": 2, "max": 2, "clamp": 3, "mix": 3, "step": 2, "smoothstep": 3, "pow": 2, "mod": 2, "noise": 2,
}  # fmt: skip

Tree = tuple[Any, ...]
_COMPARISONS = ("<", "<=", ">", ">=")
_PRINTED = {  # what is written for an operation, once its parts are
    "+": "({0} + {1})",
    "-": "({0} - {1})",
    "*": "({0} * {1})",
    "/": "({0} / {1})",
    "neg": "(-{0})",
    "if": "({1} if {0} != 0.0 else {2})",
    **{sign: f"(1.0 if {{0}} {sign} {{1}} else 0.0)" for sign in _COMPARISONS},
    **{name: f"_{name}({', '.join(('{0}', '{1}', '{2}')[:count])})" for name, count in FUNCTIONS.items()},
}
_TOKEN = re.compile(
    r"[ \t\r\n]*(?:(\d+\.?\d*(?:[eE][+-]?\d+)?|\.\d+(?:[eE][+-]?\d+)?)|([A-Za-z_]\w*)|(\*\*|<=|>=|.))", re.ASCII
)
_SIGNS = (*_COMPARISONS, "+", "-", "*", "/", "%", "**", "(", ")", ",")
_VALUE = "a number, a name, a function or ("


class FormulaError(ValueError):
    """A formula that cannot be read: `str()` is one line; `column` counts characters from 1."""

    def __init__(self, column: int, found: str, expected: str) -> None:
        self.column, self.found, self.expected = column, found, expected
        super().__init__(f"formula, column {column}: found {found}, expected {expected}")

    def __reduce__(self) -> tuple[object, ...]:
        return type(self), (self.column, self.found, self.expected)


class _Token(NamedTuple):
    kind: str  # number, name, sign, end
    text: str
    column: int


def parse(text: str) -> Tree:
    """Returns the checked tree of a formula.  FormulaError names the column of the first mistake."""
    if not isinstance(text, str) or not text.strip(" \t\r\n"):
        raise FormulaError(1, "nothing" if isinstance(text, str) else type(text).__name__, "a formula")
    if len(text) > FORMULA_CAP:
        raise FormulaError(FORMULA_CAP + 1, f"{len(text)} characters", f"{FORMULA_CAP} at most")
    reader = _Reader(list(_tokens(text)))
    tree = reader.choice(0)
    if reader.now.kind != "end":
        reader.refuse("an operator or the end")
    return tree


def variables(tree: Tree) -> frozenset[str]:
    """Returns the names that a tree looks at."""
    if tree[0] == "name":
        return frozenset(tree[1:])
    return frozenset().union(*(variables(part) for part in tree[1:] if isinstance(part, tuple)))


def printed(tree: Tree) -> str:
    """Returns a checked tree as one Python expression over NAMES and `_` + FUNCTIONS, every part in brackets."""
    if tree[0] == "number":
        return f"({float(tree[1])!r})"
    if tree[0] == "name":
        return next(name for name in NAMES if name == tree[1])
    return _PRINTED[tree[0]].format(*(printed(part) for part in tree[1:]))


def _tokens(text: str) -> Iterator[_Token]:
    at, end = 0, len(text.rstrip(" \t\r\n"))
    while at < end:
        found = _TOKEN.match(text, at)
        assert found is not None
        assert found.lastindex is not None  # the last alternative takes any character
        kind, column = ("number", "name", "sign")[found.lastindex - 1], found.start(found.lastindex) + 1
        token = _Token(kind, found[found.lastindex], column)
        if kind == "sign" and token.text not in _SIGNS:
            raise FormulaError(column, _shown(token.text), "a number, a name or one of " + " ".join(_SIGNS))
        yield token
        at = found.end()
    yield _Token("end", "", end + 1)


def _shown(text: str) -> str:
    shown = ascii(text[:24] + "..." if len(text) > 24 else text)
    return f'"{shown[1:-1]}"' if shown[0] == "'" and '"' not in shown else shown


class _Reader:
    """Recursive descent over the tokens, one method a rank of operators; depth and parts are counted."""

    def __init__(self, tokens: list[_Token]) -> None:
        self._tokens, self._at, self._nodes = tokens, 0, 0

    @property
    def now(self) -> _Token:
        return self._tokens[self._at]

    def refuse(self, expected: str, token: _Token | None = None) -> NoReturn:
        token = self.now if token is None else token
        found = "the end" if token.kind == "end" else _shown(token.text)
        raise FormulaError(token.column, found, expected)

    def _take(self, *texts: str) -> _Token | None:
        token = self.now
        if token.kind in ("sign", "name") and token.text in texts:
            self._at += 1
            return token
        return None

    def _need(self, text: str, expected: str) -> None:
        if self._take(text) is None:
            self.refuse(expected)

    def _node(self, token: _Token, *parts: Any) -> Tree:
        """Returns a new part of the tree, if there is room for it."""
        self._nodes += 1
        if self._nodes > NODES_CAP:
            raise FormulaError(token.column, "one part more", f"{NODES_CAP} parts at most")
        return parts

    def _reach(self, depth: int) -> None:
        if depth > DEPTH_CAP:
            raise FormulaError(self.now.column, "one level more", f"{DEPTH_CAP} levels at most")

    def choice(self, depth: int) -> Tree:
        """value if condition else other"""
        self._reach(depth)
        value = self._comparison(depth)
        token = self._take("if")
        if token is None:
            return value
        condition = self._comparison(depth)
        self._need("else", '"else"')
        return self._node(token, "if", condition, value, self.choice(depth + 1))

    def _comparison(self, depth: int) -> Tree:
        left = self._sum(depth)
        token = self._take(*_COMPARISONS)
        if token is None:
            return left
        made = self._node(token, token.text, left, self._sum(depth))
        if self.now.text in _COMPARISONS:
            self.refuse("one comparison at a time")
        return made

    def _sum(self, depth: int) -> Tree:
        left = self._product(depth)
        while (token := self._take("+", "-")) is not None:
            left = self._node(token, token.text, left, self._product(depth))
        return left

    def _product(self, depth: int) -> Tree:
        left = self._signed(depth)
        while (token := self._take("*", "/", "%")) is not None:
            left = self._node(token, "mod" if token.text == "%" else token.text, left, self._signed(depth))
        return left

    def _signed(self, depth: int) -> Tree:
        self._reach(depth)
        token = self._take("-", "+")
        if token is None:
            return self._power(depth)
        value = self._signed(depth + 1)
        return value if token.text == "+" else self._node(token, "neg", value)

    def _power(self, depth: int) -> Tree:
        base = self._value(depth)
        token = self._take("**")
        return base if token is None else self._node(token, "pow", base, self._signed(depth + 1))

    def _value(self, depth: int) -> Tree:
        token = self.now
        if self._take("(") is not None:
            inside = self.choice(depth + 1)
            self._need(")", ") or an operator")
            return inside
        if token.kind not in ("number", "name") or token.text in ("if", "else"):
            self.refuse(_VALUE)
        self._at += 1
        if token.kind == "number":
            value = float(token.text)
            if not math.isfinite(value):
                self.refuse("a number below 1e308", token)
            return self._node(token, "number", value)
        if token.text in FUNCTIONS:
            return self._call(token, depth)
        if token.text in CONSTANTS:
            return self._node(token, "number", CONSTANTS[token.text])
        if token.text not in NAMES:
            self.refuse("a name: " + ", ".join([*NAMES, *CONSTANTS, *FUNCTIONS]), token)
        return self._node(token, "name", token.text)

    def _call(self, token: _Token, depth: int) -> Tree:
        count = FUNCTIONS[token.text]
        wanted = f"{count} value" + ("s" if count > 1 else "")
        self._need("(", f"( and {wanted} after {token.text}")
        parts = [self.choice(depth + 1)]
        while self._take(",") is not None:
            if len(parts) == count:
                raise FormulaError(self.now.column, "one value more", f"{wanted} for {token.text}")
            parts.append(self.choice(depth + 1))
        if len(parts) < count:
            self.refuse(f"{wanted} for {token.text}")
        self._need(")", ") or an operator")
        return self._node(token, token.text, *parts)
