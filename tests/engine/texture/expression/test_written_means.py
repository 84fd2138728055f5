"""What a pixel of a written texture shows against its supersampled mean, at ten levels from far to near; and each level
against the next finer one, reduced: the shimmer test.  Errors are rms, in 1/255."""

import numpy as np
import pytest

from engine.numeric.address import Rect
from engine.texture.expression.defined import expression
from engine.texture.expression.examined import line_look, shimmer

LEVELS = range(-5, 5)
SIDE = 16  # pixels along a square that is looked at
EXACT = {  # what is linear, or has a mean in closed form: error at most
    "noise(x*4, y*4)": 0.3,
    "white(x*8, y*8)": 0.01,
    "fbm(x*2, y*2)": 1.0,
    "0.3*noise(x*9, y*5, 3) + 0.2*white(x*3, y*3) - 0.1*x": 0.3,
    "stripes(x*8, 0.3)": 0.01,
    "stripes(x*7 + y*3)": 1.0,
    "squares(x*8, y*8)": 0.01,
    "tiles(x*8, y*8)": 0.01,
    "bricks(x*4, y*8)": 0.01,
    "bricks_random(x*4, y*8)": 0.01,
    "fract(x*7)": 0.01,
    "mod(x, 0.2)*4": 0.01,
    "0.5 + 0.5*sin(40*x + 20*y)": 0.01,
    "luma(ramp(x, 0, #000000, 0.5, #ff8040, 1, #ffffff))": 0.01,
    "x < 0.7": 0.01,
    "smoothstep(0.1, 0.8, x)": 0.1,
    "clamp(x*2 + y, 0.1, 0.8)": 0.5,
}
CLOSE = {  # what goes by slopes and samples: error from level -3 on, where a period is 8 pixels wide
    "rotate(noise(x*4, y*4), 30)": 0.5,
    "rotate(squares(x*4, y*4), 30)": 1.2,
    "warp(fbm(x*2, y*2), 0.1*noise(x*2, y*2), 0)": 3.0,
    "ridged(x*2, y*2)": 3.0,
    "turbulence(x*2, y*2)": 3.0,
    "cells(x*3, y*3)": 3.0,
    "cells_edge(x*3, y*3)": 3.0,
    "cells_random(x*3, y*3)": 6.0,
    "dots(x*4, y*4)": 3.0,
    "hexagons(x*4, y*4)": 3.0,
    "hexagons_random(x*4, y*4)": 3.0,
    "fill(circle(x - 1, y - 1, 0.8))": 3.0,
    "fill(join(box(x - 1, y - 1, 1.5, 0.6, 0.1), circle(x - 1, y - 0.5, 0.3), 0.2))": 3.0,
    "fill(cut(polygon(x - 1, y - 1, 6, 0.9), star(x - 1, y - 1, 5, 0.7, 0.3)))": 5.0,
    "outline(segment(x, y, 0.3, 0.3, 1.5, 1.7), 0.2)": 3.0,
    "glow(distance(x, y) - 1, 0.5)": 1.0,
    "noise(x*4, y*4) > 0.6": 3.5,
    "a = noise(x*4, y*4) > 0.5; a*a": 3.5,
    "pow(outline(segment(x, y, 0.3, 0.3, 1.5, 1.7), 0.2), 2)": 2.0,
    "smoothstep(0.4, 0.6, noise(x*4, y*4))": 3.0,
    "luma(ramp(fbm(x*2, y*2), 0.3, #000000, 0.5, #ffffff, 0.7, #400000))": 3.0,
    "curve(noise(x*4, y*4), 0, 0, 0.4, 1, 0.6, 0, 1, 1)": 3.0,
    "repeat(fill(circle(x, y, 0.2 + 0.2*random(1))), 4, 4)": 3.0,
    "0.5 + 0.5*sin(40*x + 6*noise(x*3, y*3))": 3.0,
    "min(noise(x*4, y*4), 0.5) + max(noise(x*4, y*4), 0.4) + abs(noise(x*4, y*4) - 0.5)": 3.0,
    "noise(x*4, y*4) * noise(x*4, y*4, 1) / (1 + white(x, y))": 3.0,
    "pow(noise(x*4, y*4), 1.7) + sqrt(noise(x*4, y*4))*exp(-noise(x*2, y*2))": 3.0,
    "relief(noise(x*4, y*4), 315, 0.1)": 3.0,
    "x*0.1 if noise(x*4, y*4) < 0.4 else y*0.1": 3.0,
    "overlay(noise(x*4, y*4), noise(x*2, y*2))": 3.0,
    "smoothstep(0.9, 1, white(x*4, y*4))": 5.0,
}


def errors(text):
    """The error of each level, by what it is 16 or 32 times as finely."""
    made = expression({"text": text, "period": 64}, -20)
    for level in LEVELS:
        finer = 5 if level < 0 else 4
        rect = Rect.at(5, 7, SIDE, SIDE)
        fine = made.means(level + finer, rect.zoomed(finer)).astype(np.float64)[0] / 2
        mean = fine.reshape(SIDE, 1 << finer, SIDE, 1 << finer).mean((1, 3))
        apart = made.means(level, rect)[0] / 2 - mean
        yield level, float(np.square(apart).mean()) ** 0.5 * 255.0


@pytest.mark.parametrize("text", EXACT)
def test_what_has_an_exact_mean_shows_it_at_every_level(text):
    found = dict(errors(text))
    assert max(found.values()) <= EXACT[text], found
    made = expression({"text": text}, -20)
    for level in LEVELS:
        assert shimmer(made, level, Rect.at(-9, 4, 32, 32)).rms * 255.0 <= max(EXACT[text], 0.02), level


@pytest.mark.parametrize("text", CLOSE)
def test_what_has_none_is_close_to_it(text):
    found = dict(errors(text))
    assert max(found[level] for level in LEVELS if level >= -3) <= CLOSE[text], found


def test_from_far_the_mean_over_the_repeat_stands():
    """What bends within each repeat, of which a pixel holds many, and what is the same far and near."""
    for text in ("pow(0.5 + 0.5*sin(80*x), 4)*smoothstep(0.3, 0.7, noise(x*30, y*30))", "noise(x*40, y*40)*fract(x*9)"):
        made = expression({"text": text}, -20)
        near = made.means(0, Rect.at(0, 0, 512, 512)).mean()
        for level in (-4, -6, -9):
            assert abs(made.means(level, Rect.at(-40, 9, 32, 32)).mean() - near) * 127.5 < 5.0, (text, level)
    made = expression({"text": "fill(circle(x - 1, y - 1, 0.4))"}, -20)
    assert made.at(-4).fit is None or (made.at(-4).fit[0] == 1.0).all()


def test_what_repeats_has_its_mean_at_every_level():
    """From where a pixel holds nothing of a repeat to where it holds eight; by integrals of what falls off evenly."""

    def wholly(r, reach, power):  # a glow of a circle, to the first or second power, over a repeat
        rest = reach * r + reach**2 / 3 if power == 1 else reach * r * 2 / 3 + reach**2 / 6
        return np.pi * (r**2 + rest)

    some = "random(2)*glow(circle(x, y, 0.1*random(1)), 0.1)"
    for text, mean in (
        ("glow(circle(x, y, 0.2), 0.1)", wholly(0.2, 0.1, 1)),
        (some, np.mean(wholly(np.linspace(0, 0.1, 99), 0.1, 1)) / 2),
        (f"pow({some}, 2)", np.mean(wholly(np.linspace(0, 0.1, 99), 0.1, 2)) / 3),
        ("pow(fill(circle(x*10, y*10, 1)), 2)", wholly(0.1, 0, 1)),
        ("pow(max(0, 1 - 10*distance(x, y)), 2)", wholly(0, 0.1, 2)),
    ):
        made = expression({"text": f"repeat({text}, 31)"}, -20)
        for level in range(-5, 3):
            side = max(8, int(64 * 2.0**level))
            shown = made.means(level, Rect.at(0, 0, side, side)) / 2 + 0.5
            assert abs(shown.mean() - mean) < 0.03, (text, level)
            assert -0.01 < shown.min() <= shown.max() < 1.01, (text, level)


def test_few_samples_are_taken_where_few_are_enough():
    def samples(text, number=-1):
        made = expression({"text": text}, -20)
        return [line_look(made, number % len(made.text.split(";")), level).samples for level in (-3, 0, 6)]

    assert samples("fbm(x, y) + bricks(x, y)*0.5") == [1, 1, 1]
    assert samples("noise(x*4, y*4) > 0.5")[1:] == [1, 1]
    assert samples("luma(ramp(fbm(x*9, y*9, 12), 0, #000000, 0.45, #ffffff, 0.5, #000000, 0.55, #ffffff))")[0] != 1
    assert samples("smoothstep(0.1, 0.2, fract(x))")[1:] == [0, 0]  # those pixels alone in which it jumps
    assert samples("a = fract(x); fbm(x*3, y*3)") == [1, 1, 1]


def test_pixels_without_a_jump_are_as_with_one_sample():
    """A sawtooth, bent: where no tooth ends the pixel shows what one sample does, there the mean of sixteen."""
    made = expression({"text": "pow(fract(x), 1.5)", "period": 16}, 0)
    shown = made.means(0, Rect.at(0, 0, 64, 1))[0, 0] / 2 + 0.5
    places = (np.arange(64 * 16) + 0.5) / 256
    mean = (places % 1.0) ** 1.5
    assert np.abs(shown - mean.reshape(64, 16).mean(1)).max() < 0.02
    shifted = expression({"text": "pow(fract(x + 1/32), 1.5)", "period": 16}, 0).means(0, Rect.at(0, 0, 64, 1))[0, 0]
    assert 0.3 < (shifted / 2 + 0.5)[15::16].max() < 0.7
