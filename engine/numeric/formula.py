"""The language of the artist's own raster-op: a formula as text to a checked tree, and the tree as text to compile.

Arithmetic over the names of NAMES, the functions of FUNCTIONS and numbers, in Python's notation:

    value if condition else other    < <= > >=    + -    * / %    - (sign)    **    ( )

The reader is our own (`engine.numeric.reader`), so nothing but these can be said: there are no attributes, strings,
subscripts, assignments or calls of anything else.  Size and depth are bounded.  A tree is nested tuples: ("number",
value), ("name", name), or (operation, parts ...), the operation being a row of _PRINTED.
"""

from __future__ import annotations

import math
import re
from typing import Any, NoReturn

from engine.numeric.reader import ARITHMETIC_SIGNS, COMPARISONS, NUMBER, Reader, Token, Words, quoted, tokens

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
_PRINTED = {  # what is written for an operation, once its parts are
    "+": "({0} + {1})",
    "-": "({0} - {1})",
    "*": "({0} * {1})",
    "/": "({0} / {1})",
    "neg": "(-{0})",
    "if": "({1} if {0} != 0.0 else {2})",
    **{sign: f"(1.0 if {{0}} {sign} {{1}} else 0.0)" for sign in COMPARISONS},
    **{name: f"_{name}({', '.join(('{0}', '{1}', '{2}')[:count])})" for name, count in FUNCTIONS.items()},
}
_TOKEN = re.compile(rf"[ \t\r\n]*(?:({NUMBER})|([A-Za-z_]\w*)|(\*\*|<=|>=|.))", re.ASCII)
_WORDS = Words({name: (n, n) for name, n in FUNCTIONS.items()}, CONSTANTS, NAMES, NODES_CAP, DEPTH_CAP)


class FormulaError(ValueError):
    """A formula that cannot be read: `str()` is one line; `column` counts characters from 1."""

    def __init__(self, column: int, found: str, expected: str) -> None:
        self.column, self.found, self.expected = column, found, expected
        super().__init__(f"formula, column {column}: found {found}, expected {expected}")

    def __reduce__(self) -> tuple[object, ...]:
        return type(self), (self.column, self.found, self.expected)


def parse(text: str) -> Tree:
    """Returns the checked tree of a formula.  FormulaError names the column of the first mistake."""
    if not isinstance(text, str) or not text.strip(" \t\r\n"):
        raise FormulaError(1, "nothing" if isinstance(text, str) else type(text).__name__, "a formula")
    if len(text) > FORMULA_CAP:
        raise FormulaError(FORMULA_CAP + 1, f"{len(text)} characters", f"{FORMULA_CAP} at most")
    found = list(tokens(text, _TOKEN, ("number", "name", "sign")))
    for token in found:
        if token.kind == "sign" and token.text not in ARITHMETIC_SIGNS:
            expected = "a number, a name or one of " + " ".join(ARITHMETIC_SIGNS)
            raise FormulaError(token.at + 1, quoted(token.text), expected)
    reader = _Reader(found, _WORDS)
    tree = reader.choice()
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


class _Reader(Reader[Tree]):
    def made(self, token: Token, operation: str, *parts: Tree) -> Tree:
        if operation == "number":
            return operation, float(token.text)
        if operation == "constant":
            return "number", CONSTANTS[token.text]
        return (operation, token.text) if operation == "name" else (operation, *parts)

    def mistake(self, at: int, found: str, expected: str) -> NoReturn:
        raise FormulaError(at + 1, found, expected)
