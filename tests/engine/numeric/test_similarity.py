"""Similarities against plain fractions: places, composition, rectangles, and what is read back."""

from fractions import Fraction
from math import ceil, floor

import pytest
from hypothesis import given
from hypothesis import strategies as st

from engine.numeric.address import Rect
from engine.numeric.similarity import IDENTITY, Dyadic, Similarity

integers = st.integers(-(1 << 300), 1 << 300)
numbers = st.builds(Dyadic.of, integers, integers, st.integers(-40, 4100))
turns = st.builds(
    lambda q, k: Dyadic.of(*((1, 0), (0, 1), (-1, 0), (0, -1))[q], -k), st.integers(0, 3), st.integers(-900, 900)
)
doubles = st.floats(-2, 2, allow_subnormal=False).filter(lambda v: abs(v) > 1e-3)
any_turn = st.one_of(turns, st.builds(Dyadic.exactly, doubles, doubles))
similarities = st.builds(Similarity, any_turn, numbers, st.booleans())
exact = st.builds(Similarity, turns, numbers, st.booleans())


def parts(number):
    scale = Fraction(2) ** -number.e
    return number.x * scale, number.y * scale


def plainly(f, x, y):
    (a, b), (c, d) = parts(f.c), parts(f.t)
    y = -y if f.mirror else y
    return a * x - b * y + c, a * y + b * x + d


@given(similarities, numbers)
def test_a_place_is_shown_where_fractions_say(f, place):
    assert parts(f(place)) == plainly(f, *parts(place))


@given(similarities, similarities, numbers)
def test_one_after_the_other_is_their_composition(f, g, place):
    assert f.then(g)(place) == g(f(place))
    assert IDENTITY.then(f) == f.then(IDENTITY) == f


@given(integers, integers, st.integers(-50, 50), st.integers(0, 70))
def test_equal_numbers_are_equal_objects(x, y, e, k):
    assert Dyadic.of(x << k, y << k, e + k) == Dyadic.of(x, y, e)


@given(exact, numbers)
def test_an_exact_one_has_an_exact_way_back(f, place):
    assert f.inverse()(f(place)) == place
    assert f(f.inverse()(place)) == place
    assert f.quarter is not None


@given(
    similarities, st.tuples(integers, integers), st.integers(-30, 30), st.integers(-30, 30), st.sampled_from([0, 8, 40])
)
def test_back_is_rounded_down(f, twice, level, to_level, bits):
    found = f.back(twice, level, to_level, bits)
    unit = Fraction(2) ** -(to_level + bits)
    place = Fraction(twice[0]) / Fraction(2) ** (level + 1), Fraction(twice[1]) / Fraction(2) ** (level + 1)
    (a, b), (c, d) = parts(f.c), parts(f.t)
    u, v, n = place[0] - c, place[1] - d, a * a + b * b
    x, y = (u * a + v * b) / n, (v * a - u * b) / n
    y = -y if f.mirror else y
    assert found == (x // unit, y // unit)


@given(exact, st.tuples(*[st.integers(-500, 500)] * 2), st.tuples(*[st.integers(1, 300)] * 2), st.integers(-8, 8))
def test_a_rectangle_is_shown_by_its_corners(f, corner, size, level):
    at_level = level - f.quarter[0]
    rect = Rect.at(*corner, *size)
    shown = f.shown(rect, level, at_level)
    width, height = size if f.quarter[1] % 2 == 0 else size[::-1]
    moved = f.aligned_from is None or at_level >= f.aligned_from
    assert (shown.width, shown.height) == (width, height) if moved else shown.width - width in (0, 1)


@given(similarities, st.integers(-3, 3))
def test_a_pixel_to_the_right_and_down_are_what_the_source_moves_by(f, level):
    to_level = level + f.like_levels
    right_x, right_y, down_x, down_y = f.pitch(level, to_level, 40)
    here = f.back((1, 1), level, to_level, 40)
    right, down = f.back((3, 1), level, to_level, 40), f.back((1, 3), level, to_level, 40)
    for moved, told in ((right, (right_x, right_y)), (down, (down_x, down_y))):
        assert abs(moved[0] - here[0] - told[0]) <= 1
        assert abs(moved[1] - here[1] - told[1]) <= 1


@given(similarities)
def test_a_source_of_like_density_has_one_pixel_for_each_about(f):
    ratio = 2.0 ** (f.like_levels - f.log_scale)
    assert 0.84 <= ratio <= 1.69


@pytest.mark.parametrize("angle", [(0.8660254037844387, 0.5), (0.6, 0.8), (-0.9063077870366499, 0.42261826174069944)])
def test_a_turn_by_rounded_doubles_is_read_at_its_own_level(angle):
    assert Similarity(Dyadic.exactly(*angle), Dyadic(0, 0)).like_levels == 0


@given(similarities)
def test_halving_is_told_exactly(f):
    n, e = f.squared
    assert f.halves == (Fraction(n) / Fraction(2) ** e <= Fraction(1, 4))


@given(similarities, numbers)
def test_a_cut_one_shows_places_where_it_did_nearly(f, place):
    cut = f.cut(192, 4160)
    (x, y), (u, v) = parts(f(place)), parts(cut(place))
    size = 1 + max(abs(value) for value in parts(place))
    assert max(abs(x - u), abs(y - v)) <= Fraction(2) ** -180 * size
    assert f.quarter is None or cut == f


@given(
    similarities, st.tuples(*[st.integers(-500, 500)] * 2), st.tuples(*[st.integers(1, 300)] * 2), st.integers(-8, 8)
)
def test_rectangles_hold_all_corners_that_are_shown_or_that_are_shown_in_them(f, corner, size, level):
    rect, unit = Rect.at(*corner, *size), Fraction(2) ** -level
    corners = [(x, y) for x in (rect.x0, rect.x1) for y in (rect.y0, rect.y1)]
    shown = [plainly(f, x * unit, y * unit) for x, y in corners]
    low, high = ([least(at[i] / unit for at in shown) for i in (0, 1)] for least in (min, max))
    assert f.shown(rect, level, level) == (*map(floor, low), *map(ceil, high))
    back = [f.back((2 * x, 2 * y), level, level, 0) for x, y in corners]
    low, high = ([least(at[i] for at in back) for i in (0, 1)] for least in (min, max))
    assert f.box(rect, level, level, 3) == (*(v - 3 for v in low), *(v + 4 for v in high))
