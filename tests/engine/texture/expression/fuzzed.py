"""Texts at random: what the language can say, and what it cannot.

    python fuzzed.py COUNT [SEED]

tries so many and tells how many were textures, the slowest, and the worst; it ends at the first that crashes.
"""

from __future__ import annotations

import random
import sys
import time

import numpy as np

from engine.checks.field_error import FieldError
from engine.numeric.address import Rect
from engine.numeric.arithmetic import EVERYWHERE
from engine.texture import table
from engine.texture.expression.defined import expression
from engine.texture.expression.language import FUNCTIONS
from engine.texture.expression.naming.bound import bound_anew
from engine.texture.expression.written import PLACE_NAMES

NUMBERS = ("0", "1", "0.5", "2", "7", "1e9", "1e-9", "1e300", "1e-300", ".1", "64", "3", "0.3", "33", "-1", "360")
COLOURS = ("#000000", "#ffffff", "#ff8040", "#20406080", "#00000000")
NAMES = (*PLACE_NAMES, "pi", "tau", "e")
SIGNS = ("+", "-", "*", "/", "%", "**", "<", "<=", ">", ">=")
JUNK = (
    *". : [ ] { } ' \" = := ; @ \\ $ ! ? , ) ( # // _ __class__ __import__ lambda import eval exec".split(),  # noqa: SIM905
    *"os while not and is None if else slider( pick( 1e999 0x10 1j".split(),  # noqa: SIM905
    *("\n", "\t", "\r", "\0", "\u202e", "\u212f", "\U0001f600", "\x7f", "\xe9"),
)
TEXTURES = ("rock", "squares", "text", "clouds", "nobody", "x")
PLACED = ("", "x, y", "y*3, x", "x/0, 1e300*y", "noise(x, y)*9, x", "white(x*9, y), 1", "x", '"rock"(), y')
NAMED = {name: bound_anew(table.instance(name, {}, 0, 0, arithmetic=EVERYWHERE)) for name in TEXTURES[:2]}
NAMED["text"] = expression({"text": 'noise(x*4, y*4)*"rock"(y, x)', "named": NAMED}, 0)
PLACES = ((0, Rect(-3, 5, 5, 9)), (-9, Rect(0, 0, 4, 2)), (21, Rect((5 << 21) - 2, -7, (5 << 21) + 6, -4)))


class Writer:
    """Writes texts: as the grammar has them, then now and then broken."""

    def __init__(self, seed: int) -> None:
        self._of = random.Random(seed)

    def text(self) -> str:
        """Returns one text."""
        names: list[str] = []
        lines = []
        for n in range(self._of.randrange(4)):
            name = f"n{n}"
            lines.append(f"{name} = {self._line(names)}")
            names.append(name)
        text = "\n".join([*lines, self._part(names, 0)])
        return self._broken(text) if self._of.random() < 0.35 else text

    def _line(self, names: list[str]) -> str:
        chance = self._of.random()
        if chance < 0.1:
            return f"slider({self._of.choice(NUMBERS)}, 0, {self._of.choice(NUMBERS)})"
        return f"pick({self._of.choice(COLOURS)})" if chance < 0.2 else self._part(names, 0)

    def _part(self, names: list[str], deep: int) -> str:
        chance = self._of.random()
        if deep > 5 or chance < 0.25:
            return self._leaf(names)
        if chance < 0.45:
            return f"({self._part(names, deep + 1)} {self._of.choice(SIGNS)} {self._part(names, deep + 1)})"
        if chance < 0.5:
            return (
                f"({self._part(names, deep + 1)} if {self._part(names, deep + 1)} else {self._part(names, deep + 1)})"
            )
        name = self._of.choice(tuple(FUNCTIONS))
        least, most = FUNCTIONS[name][:2]
        count = self._of.randint(least, min(most, least + 4))
        return f"{name}({', '.join(self._given(names, deep) for _ in range(count))})"

    def _given(self, names: list[str], deep: int) -> str:
        return self._leaf(names) if self._of.random() < 0.5 else self._part(names, deep + 1)

    def _leaf(self, names: list[str]) -> str:
        chance = self._of.random()
        if names and chance < 0.2:
            return self._of.choice(names)
        if self._of.random() < 0.06:
            return f'"{self._of.choice(TEXTURES)}"({self._of.choice(PLACED)})'
        if chance < 0.65:
            return self._of.choice(("x", "y", "x*4", "y*3", *NAMES))
        return self._of.choice(NUMBERS) if chance < 0.92 else self._of.choice(COLOURS)

    def _broken(self, text: str) -> str:
        for _ in range(self._of.randint(1, 4)):
            at, length = self._of.randrange(len(text) + 1), self._of.randrange(4)
            added = self._of.choice(
                (*JUNK, *SIGNS, *NAMES, *NUMBERS, "".join(self._of.choices(text, k=9)) if text else "")
            )
            text = text[:at] + added + text[at + length :]
        return text


def tried(text: str) -> bool:
    """Tells whether a text is a texture; AssertionError if it is one that has no values, or no mistake."""
    try:
        made = expression({"text": text, "named": NAMED}, -9)
    except FieldError as error:
        told = str(error)
    else:
        told = ""
    if told:
        assert "\n" not in told
        assert told.isascii()
        assert len(told) < 500
        return False
    for level, rect in PLACES:
        seen = made.appearance(level, rect)
        assert seen.shape in ((1, rect.height, rect.width), (4, rect.height, rect.width))
        assert np.isfinite(seen).all(), text
        assert np.abs(seen).max() <= 3.0
    return True


def main(count: int, seed: int = 0) -> None:
    """Tries so many texts."""
    writer, textures, slowest = Writer(seed), 0, (0.0, "")
    for _ in range(count):
        text = writer.text()
        start = time.process_time()
        try:
            textures += tried(text)
        except BaseException:
            print(repr(text))
            raise
        slowest = max(slowest, (time.process_time() - start, text))
    print(f"{count} texts, {textures} of them textures; the slowest took {slowest[0] * 1e3:.0f} ms: {slowest[1]!r}")


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))
