"""The machine of written textures against a plain walk through its operations, and slopes against differences."""

import math
from fractions import Fraction

import numpy as np
import pytest

from engine.texture.expression.codes import Code
from engine.texture.expression.language import read, weave
from engine.texture.expression.noise_words import LOUD
from engine.texture.expression.programs import WRAP, program, sample_places
from engine.texture.expression.weaving import Setting

PLAIN = {
    Code.ADD: np.add, Code.SUB: np.subtract, Code.MUL: np.multiply, Code.MIN: np.minimum, Code.MAX: np.maximum,
    Code.LESS: lambda a, b: (a < b) * 1.0, Code.LESS_EQUAL: lambda a, b: (a <= b) * 1.0, Code.ABS: np.abs,
    Code.FLOOR: np.floor, Code.SQRT: lambda a: np.sqrt(np.abs(a)), Code.SIN: np.sin, Code.COS: np.cos, Code.TAN: np.tan,
    Code.ATAN2: np.arctan2, Code.EXP: lambda a: np.exp(np.minimum(a, 700.0)), Code.DIV: np.divide,
    Code.LOG: lambda a: np.log(np.abs(a) + 1e-300), Code.POW: lambda a, b: np.power(np.abs(a), b),
    Code.SELECT: lambda test, a, b: np.where(test != 0.0, a, b),
}  # fmt: skip


def plainly(graph, shown, x, y):
    """What NumPy makes of a graph's arithmetic."""
    known = {}
    for node, told in enumerate(graph.operations[: max(shown) + 1]):
        parts = [known[part] for part in told.parts]
        if told.code == Code.CONST:
            known[node] = np.full(x.shape, told.numbers[0])
        elif told.code in (Code.X, Code.Y):
            known[node] = x if told.code == Code.X else y
        elif told.code in (Code.ADD_TO, Code.TIMES):
            known[node] = parts[0] + told.numbers[0] if told.code == Code.ADD_TO else parts[0] * told.numbers[0]
        elif told.code == Code.WIDTH:
            known[node] = np.minimum(np.hypot(*parts) * told.numbers[0], 1e30)
        elif told.code == Code.RAMP:
            known[node] = ramp(*parts, told)
        else:
            known[node] = PLAIN[told.code](*parts)
    return [known[node] for node in shown]


def ramp(t, width, told):
    """The mean of a piecewise linear function, by many points."""
    knots = np.array(told.numbers)
    places, values = knots[: knots.size // 2], knots[knots.size // 2 :]
    half = np.maximum(width, 1e-9) / 2
    if told.slope:
        return (np.interp(t + half, places, values) - np.interp(t - half, places, values)) / (2 * half)
    points = (np.arange(400) + 0.5) / 200 - 1
    return np.mean([np.interp(t + p * half, places, values) for p in points], axis=0)


def setting(width=0.01):
    return Setting({}, 0, 3, width)


def grid(made, xs, ys):
    """What a program makes of one sample at each crossing: (planes, ys, xs)."""
    places = (np.ascontiguousarray(one.reshape(1, -1)) for one in np.meshgrid(xs, ys))
    return made.over(*places, xs.size).reshape(-1, ys.size, xs.size)


ARITHMETIC = (
    "x*y - 3/(x + 7) + y**3 - x**0.7 + 2**y",
    "sin(x*9)*cos(y*7) + tan(x/3)*0.1 + atan2(y, x) + exp(-x) - log(y)",
    "min(x, y) + max(x, 0.3)*abs(y - x) - clamp(x*y, -0.2, 0.3) + floor(x*3) + fract(y*5) + mod(x, 0.37)",
    "x if x < y else sqrt(y - 2)",
    "smoothstep(0.2, 0.9, x*y) + step(0.4, x + y) + mix(x, y, x*y) + (x >= y)",
    "curve(x*y, -1, 0, 0, 1, 0.5, 0.2, 1, 2) + luma(ramp(x + y, -1, #102030, 0.7, #ffeedd))",
    "stripes(x*5 + y, 0.3)*squares(x*3, y*4) + tiles(x, y, 0.2) + bricks(x*2, y*3)",
    "fill(star(x, y, 5, 0.9, 0.4)) + outline(box(x, y, 1, 0.6, 0.1), 0.1) + glow(circle(x, y, 0.3), 0.4)",
    "luma(soft_light(hsv(x, 0.7, y), overlay(x, y))) + screen(x, y) + burn(0.7, y) - dodge(0.2, x)",
    "rotate(hexagons(x*3, y*3), 20) + repeat(distance(x, y), 3, 4, 0.5) + warp(x*x, y, x)",
)


@pytest.mark.parametrize("text", ARITHMETIC)
@pytest.mark.parametrize("width", [1e-6, 0.01, 0.3])
def test_the_machine_does_what_the_operations_say(text, width):
    woven = weave(read(text), setting(width))
    made = program(woven, 1)
    xs, ys = np.linspace(-1.13, 0.97, 41), np.linspace(-0.77, 1.21, 9)
    x, y = (a.ravel() for a in np.meshgrid(xs, ys))
    with np.errstate(all="ignore"):
        told = plainly(woven.graph, woven.value.nodes, x, y)
    for plane, expected in zip(grid(made, xs, ys), told, strict=True):
        bounded = np.clip(np.nan_to_num(expected, nan=0.0), -1.0, 2.0).reshape(plane.shape)
        apart = np.abs(plane - bounded)
        assert np.median(apart) < 1e-6
        assert (apart > 1e-4).mean() < 0.02  # jumps at places that end in other last bits


SLOPED = (
    "noise(x, y)", "fbm(x*2, y*3, 5)", "cells(x*2, y)", "cells_edge(x*2, y*2)", "sin(x*3)*cos(y) + x*y",
    "exp(x)/(y + 3)", "pow(x + 2, 1.7)", "atan2(y + 3, x)", "distance(x + 2, y + 2)",
    "log(x + 3) + sqrt(y + 2) + tan(x/4)",
    "warp(noise(x, y), y, x)",
    "curve(x, -3, 0, 0, 1, 3, 5)", "ridged(x, y, 3)", "rotate(noise(x*2, y), 33)",
)  # fmt: skip


@pytest.mark.parametrize("text", SLOPED)
def test_slopes_are_those_of_differences(text):
    step = 1e-5
    values = weave(read(f"v = {text}\n(v)*0.01"), setting(1e-7))
    xs, ys = np.linspace(-0.9, 0.93, 23), np.linspace(-0.8, 0.71, 7)
    made = program(values, 1)
    for axis, name in enumerate(("slope_x", "slope_y")):
        sloped = grid(program(weave(read(f"{name}({text})*0.01"), setting(1e-7)), 1), xs, ys)[0]
        moved = [
            grid(made, xs + d * (1 - axis), ys + d * axis)[0].astype(np.float64) for d in (-step * 100, step * 100)
        ]
        told = (moved[1] - moved[0]) / (200 * step)
        assert np.median(np.abs(sloped - told)) < 2e-4
        assert (np.abs(sloped - told) > 2e-3).mean() < 0.1  # bends


def test_noise_is_smooth_even_and_as_loud_as_told():
    made = program(weave(read("noise(x, y)"), setting(1e-3)), 1)
    places = np.arange(0, 60, 0.05)
    seen = grid(made, places, places)[0].astype(np.float64)
    assert abs(seen.mean() - 0.5) < 0.005
    assert abs(seen.std() - LOUD * 0.463) < 0.005
    assert np.abs(np.diff(seen, axis=0)).max() < 0.15
    assert np.abs(np.diff(seen, 2, axis=1)).max() < 0.05
    across, down = (np.square(np.diff(seen, axis=axis)).mean() for axis in (0, 1))
    assert abs(across / down - 1.0) < 0.05


def test_white_noise_is_even_and_balanced():
    made = program(weave(read("white(x, y)"), setting(1e-9)), 1)
    places = np.arange(0, 256) + 0.5
    seen = grid(made, places, places)[0].astype(np.float64)
    assert np.abs(np.histogram(seen, 8, (0, 1))[0] / seen.size - 0.125).max() < 0.005
    assert np.abs(seen.reshape(128, 2, 128, 2).mean((1, 3)) - 0.5).max() < 1e-6


def test_places_are_exact_however_far_away():
    near = sample_places(-3, 4, 2, Fraction(64))
    assert (near == (np.arange(-6, 2) + 0.5) / 128).all()
    assert (sample_places(64 * WRAP * 10**30, 3, 1, Fraction(64)) == (np.arange(3) + 0.5) / 64).all()
    edge = sample_places(64 * WRAP // 2 - 1, 2, 1, Fraction(64))
    assert edge[0] == -edge[1] == WRAP / 2 - 1 / 128
    assert math.isclose(sample_places(10**40, 1, 1, Fraction(10) ** 40)[0], 1.0)
