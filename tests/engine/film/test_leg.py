"""The way between two views: that of van Wijk and Nuij, without a pixel lost at any depth."""

import math
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from engine.film.aim import SUBPIXEL, Aim, aim_at, shifted
from engine.film.leg import RHO, leg, levels_between
from engine.numeric.address import Rect

WIDTH = 1920
SIZE = WIDTH, 1080


def off(aim, other):
    """How far the middle of one view is from another's, in pixels of the picture."""
    level = max(aim.level, other.level)
    dx = shifted(other.x, level - other.level) - shifted(aim.x, level - aim.level)
    dy = shifted(other.y, level - other.level) - shifted(aim.y, level - aim.level)
    unit = Fraction(2) ** (aim.level - level - SUBPIXEL)
    return math.hypot(dx * unit, dy * unit) * 2.0**aim.fraction


def views(spread):
    return st.builds(
        lambda level, fraction, x, y: Aim(0, 0.0, x << 12, y << 12).at(level, fraction),
        st.integers(-spread, spread),
        st.floats(0.0, 0.999),
        st.integers(-(1 << 24), 1 << 24),
        st.integers(-(1 << 24), 1 << 24),
    )


def test_it_is_the_papers_path():
    """Equations of section 4, with u and w in pixels of level 0."""
    start, end = aim_at(0, Rect(0, 0, 1920, 1080), SIZE), aim_at(3, Rect(9000, 4000, 10920, 5080), SIZE)
    way = leg(start, end, WIDTH)
    w0, w1 = 1920.0, 240.0
    u1 = math.hypot((9000 + 960) / 8 - 960, (4000 + 540) / 8 - 540)
    b0 = (w1**2 - w0**2 + RHO**4 * u1**2) / (2 * w0 * RHO**2 * u1)
    b1 = (w1**2 - w0**2 - RHO**4 * u1**2) / (2 * w1 * RHO**2 * u1)
    r0, r1 = (math.log(-b + math.sqrt(b * b + 1)) for b in (b0, b1))
    assert way.length == pytest.approx((r1 - r0) / RHO)
    for s in np.linspace(0.0, way.length, 23):
        u = w0 / RHO**2 * (math.cosh(r0) * math.tanh(RHO * s + r0) - math.sinh(r0))
        w = w0 * math.cosh(r0) / math.cosh(RHO * s + r0)
        found = way.at(s)
        assert WIDTH / 2 ** (found.level + found.fraction) == pytest.approx(w, rel=1e-9)
        assert off(start, found) == pytest.approx(u, abs=1e-6)


@settings(deadline=None, max_examples=150)
@given(views(70), views(70), st.floats(0.0, 1.0), st.floats(0.0, 1.0))
def test_a_part_of_the_way_is_the_way_of_that_part(start, end, first, rest):
    """To some thousandths of a pixel of what is seen there, though the second half is reckoned from another view."""
    way = leg(start, end, WIDTH)
    middle = way.at(first * way.length)
    later = first + rest * (1.0 - first)
    there = way.at(later * way.length)
    again = leg(middle, end, WIDTH).at((later - first) * way.length)
    assert abs(levels_between(there, again)) < 1e-6
    assert off(there, again) < 5e-3
    back = leg(end, start, WIDTH).at((1.0 - later) * way.length)
    assert off(there, back) < 5e-3


@pytest.mark.parametrize("level", [60, 1000, 4000])
def test_no_pixel_is_lost_far_down(level):
    """The target moves over the picture by less and less, and stands where it should to 10^-6 of a pixel."""
    start = aim_at(0, Rect(0, 0, 1920, 1080), SIZE)
    end = aim_at(level, Rect.at((1 << level) * 700 + 12345, (1 << level) * 300 + 777, 1920, 1080), SIZE)
    way = leg(start, end, WIDTH)
    assert way.at(0.0) == start
    assert way.at(way.length) == end
    assert off(start, end) == pytest.approx(math.hypot(700 - 960, 300 - 540), rel=1e-6)
    for levels in (0.25, 1.0, 3.0, 20.0):
        near = way.at(way.length - levels * math.log(2.0) / RHO)
        assert levels_between(near, end) == pytest.approx(levels, abs=1e-6)
        ratio = math.sinh(levels * math.log(2.0)) / RHO**2 * WIDTH / math.cosh(min(way.last, 700.0))
        assert off(near, end) == pytest.approx(ratio, abs=1e-6)


def test_zooming_alone_is_steady():
    start, end = Aim(0, 0.25, 5 << 40, 3 << 40), Aim(0, 0.25, 5 << 40, 3 << 40).at(9, 0.5)
    way = leg(start, end, WIDTH)
    levels = [levels_between(start, way.at(way.length * i / 10)) for i in range(11)]
    assert np.allclose(np.diff(levels), 0.925)


def test_it_goes_back_before_it_goes_far():
    a, b = aim_at(8, Rect.at(0, 0, 1920, 1080), SIZE), aim_at(8, Rect.at(200_000, 0, 1920, 1080), SIZE)
    way = leg(a, b, WIDTH)
    middle = way.at(way.length / 2)
    assert levels_between(a, middle) < -4.0
    assert way.heading(False)[2] < -0.9
    assert way.heading(True)[2] > 0.9
