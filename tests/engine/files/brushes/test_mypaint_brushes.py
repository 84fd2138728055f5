"""MyPaint's settings and what they follow mean here what they meant there, as far as there is anything like them."""

import math
from itertools import pairwise

import brush_bytes as w
import pytest

from engine.brush import settings
from engine.files.brushes.mypaint_brushes import read_myb


def read(**told):
    (brush,) = read_myb(w.myb(**told), "My_brush.myb").brushes
    settings.from_json(brush.settings)
    return brush


def at(knots, x):
    """Straight between knots, level beyond them."""
    if x <= knots[0][0]:
        return knots[0][1]
    for (x0, y0), (x1, y1) in pairwise(knots):
        if x <= x1:
            return y0 + (y1 - y0) * (x - x0) / (x1 - x0)
    return knots[-1][1]


def test_a_plain_brush_keeps_its_numbers():
    brush = read(radius_logarithmic=1.5, hardness=0.3, color_h=1 / 3, color_s=1.0, color_v=1.0, restore_color=1.0)
    told = brush.settings
    assert told["radius"] == pytest.approx(math.exp(1.5))
    assert (told["hardness"], told["colour"], brush.coloured, brush.left) == (0.3, "#00ff00", True, ())
    assert (brush.name, told["dynamics"]) == ("My brush", {})
    assert told["spacing"] == 0.5, "two dabs a radius"


def test_a_dab_lays_what_one_of_mypaint_does():
    plain = read(opaque=0.6, opaque_linearize=0.0).settings
    assert plain["flow"] == pytest.approx(0.6)
    evened = read(opaque=0.6, opaque_linearize=1.0, dabs_per_actual_radius=3.0).settings
    assert 1 - (1 - evened["flow"]) ** 6 == pytest.approx(0.6), "six dabs at each place cover as much together"
    pressed = read(opaque=0.8, opaque_multiply=(0.0, {"pressure": [[0, 0], [1, 1]]}), opaque_linearize=0.0).settings
    for pressure in (0.0, 0.3, 1.0):
        flow = pressed["flow"] * at(pressed["dynamics"]["flow"]["pressure"], pressure)
        assert flow == pytest.approx(0.8 * pressure, abs=1e-6)


def test_the_radius_follows_pressure_and_speed_as_it_did():
    told = read(radius_logarithmic=(2.0, {"pressure": [[0, -1], [1, 0.5]], "speed1": [[0, 0], [4, -0.8]]})).settings
    curves = told["dynamics"]["radius"]
    rise = 0.015 * (45 + math.exp(4.0))
    rest = 2.0 + 0.5 + 0.5 * -0.2
    assert told["radius"] == pytest.approx(math.exp(rest))
    assert told["radius"] * at(curves["pressure"], 0.0) == pytest.approx(math.exp(rest - 1.5))
    for value in (0.5, 1.0, 3.0, 4.0):
        radii = math.exp((value - 0.5) / rise) * (45 + math.exp(4.0)) - math.exp(4.0)
        factor = at(curves["speed"], radii * told["radius"])
        assert factor == pytest.approx(math.exp(-0.2 * (value - 0.5)), rel=0.02)


def test_a_tip_that_turns_with_the_stroke_follows_it():
    along = {"direction": [[0, 0], [180, 180]]}
    shape = read(elliptical_dab_ratio=4.0, elliptical_dab_angle=(30.0, along)).settings["shape"]
    assert (shape["ratio"], shape["angle"], shape["follow"]) == (0.25, 30.0, "direction")
    chance = {"random": [[0, -90], [1, 90]]}
    told = read(elliptical_dab_ratio=4.0, elliptical_dab_angle=(30.0, chance)).settings
    assert told["shape"]["follow"] == "none"
    assert told["dynamics"]["angle"] == {"random_dab": [(0.0, 0.75), (1.0, 1.25)]}
    still = read(elliptical_dab_ratio=1.0, elliptical_dab_angle=(30.0, chance)).settings
    assert still["dynamics"] == {}, "a round tip is not turned"


def test_tilt_stroke_direction_and_scatter_are_measured_as_here():
    told = read(
        hardness=(0.5, {"tilt_declination": [[0, 0.5], [90, 0]], "direction": [[0, 0], [180, 0.5]]}),
        offset_by_random=(0.0, {"stroke": [[0, 0], [1, 1]]}),
        stroke_duration_logarithmic=3.0,
        radius_logarithmic=2.0,
    ).settings
    tilt, way = told["dynamics"]["hardness"]["tilt"], told["dynamics"]["hardness"]["direction"]
    assert at(tilt, 90.0) > at(tilt, 0.0), "a pen that lies has a declination of 0"
    assert at(way, 90.0) == pytest.approx(at(way, 270.0), rel=1e-3), "there directions go over half a turn"
    far = told["dynamics"]["scatter"]["distance"]
    assert far[-1][0] == pytest.approx(math.exp(3.0) * math.exp(2.0))
    assert told["shape"]["scatter"] * far[-1][1] == pytest.approx(2.0), "a deviation of one radius"


def test_colours_that_change_by_chance_do_so_here():
    told = read(color_v=0.5, change_color_h=(0.0, {"random": [[0, -0.1], [1, 0.1]]})).settings
    assert told["dynamics"]["hue"]["random_dab"] == [(0.0, 0.9), (1.0, 1.1)]
    told = read(change_color_v=(0.0, {"random": [[0, -0.5], [1, 0.5]]})).settings
    assert told["dynamics"]["lightness"]["random_dab"] == [(0.0, 0.5), (1.0, 1.5)]


def test_what_is_left_out_is_told_in_words():
    brush = read(smudge=0.5, slow_tracking=2.0, hardness=(0.5, {"attack_angle": [[0, 0], [1, 1]]}), eraser=1.0)
    assert brush.settings["mode"] == "erase"
    assert brush.left == ("slow tracking", "what follows attack angle")
    assert read(dabs_per_second=80.0).left == ("dabs while the pen rests",)


def test_what_it_smudges_is_taken_up_here():
    told = read(smudge=0.5, smudge_length=0.7, paint_mode=1.0, dabs_per_actual_radius=2.0).settings["wet"]
    assert told == {"amount": 0.5, "length": pytest.approx(0.49), "mixing": "pigment"}
    following = read(smudge=(0.2, {"pressure": [[0, 0], [1, 0.5]]}))
    assert following.settings["wet"]["mixing"] == "light"
    assert "what smudging follows" in following.left
    assert "wet" not in read(hardness=0.5).settings
