"""Whatever is written: a texture that has finite values everywhere, or a mistake in one line."""

import pytest
from fuzzed import Writer, tried

from engine.texture.expression.language import FUNCTIONS

# What one would try to get out, or to keep the program busy for ever.
HOSTILE = (
    "__import__('os').system('id')", "().__class__.__bases__[0].__subclasses__()", "x.__class__", "(lambda:0)()",
    "[x for x in (1,2)]", "f'{x}'", "'a'*10**9", "9**9**9**9", "1e999", "10**400", "x if x else (y:=1)", "\u1d49val",
    "sin(*(1,2))", "sin(x=1)", "open", "x[0]", "True", "None", "...", "1j", "x<y<1", "x and y", "x==y", "(yield x)",
    "await x", "x@y", "x//0", "1<<999999999", "not x", "~x", "{1}", "sin", "x;y", "x\0", "#", "",
    "(" * 5000 + "x" + ")" * 5000, "-" * 5000 + "x", "+".join(["x"] * 3000), "sin(" * 90 + "x" + ")" * 90,
    "0x" + "f" * 500,     "1_000", "x\u202e", "print(1)",
    "sin(sin)", "x/0", "log(-x)+sqrt(-1)", "pow(-2,0.5)", "x%0", "exp(1e300)", "tan(1e308*x)", "noise(1e300*x, 0/0)",
    "fbm(x*1e300, y/1e-300, 32, 1, 8)", "warp(x, 1/0, 0/0)", "repeat(x, 1e300, 0)", "scale(noise(x, y), 0)",
    "cells_edge(1/x, 1e9)", "white(0/0, x)", "ramp(x/0, #000000, #ffffff)", "curve(x, 0, 1e9, 1e-9, -1e9)",
    "hexagons(1e12*x, y)", "bricks(x, y, 9, 1e300)", "atan2(0, 0)", "smoothstep(0.5, 0.5, x)", "clamp(x, 1, 0)",
    "fade(#ff0000, 1/0)", "mix(1e300, -1e300, x)", "relief(1e300*noise(x, y), 0, 1e300)", "x**-1e9", "sin(1e22*x)",
    "a = slider(1e308, -1e308, 1.7e308); a*a*a", "star(x, y, 3, 0/0, 1)", '"moss"',
    '"', "a=b=x", "a=\nx", ";;;", "\r\nx\r\n", '"moss"(x, y)', '"moss"()', '"moss"(x)',
    "a=x;" * 70 + "x", "\n" * 9000 + "x y", "((((((x",
)  # fmt: skip


@pytest.mark.parametrize("text", HOSTILE, ids=range(len(HOSTILE)))
def test_hostile_texts_are_refused_or_harmless(text):
    tried(text)


@pytest.mark.parametrize("name", FUNCTIONS)
def test_every_function_bears_any_number(name):
    least, most = FUNCTIONS[name][:2]
    for value in ("0", "x", "1e300*x", "0/0*x", "-1", "1/x"):
        for count in {least, min(most, least + 2)}:
            tried(f"{name}({', '.join([value] * count)})")


def test_texts_at_random():
    writer = Writer(7)
    assert sum(tried(writer.text()) for _ in range(250)) > 25


@pytest.mark.nightly
def test_two_hundred_thousand_texts():
    writer = Writer(1)
    assert sum(tried(writer.text()) for _ in range(200_000)) > 20_000
