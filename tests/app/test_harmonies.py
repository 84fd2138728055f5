"""Harmonies, shades and the gamut mask: what lies where on the wheel."""

import cmath
import itertools
import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from app.desk.colours import from_oklch, off_disc, on_disc, to_oklch
from app.desk.holding.gamut_mask import (
    MASK_SHAPES,
    held_at,
    held_in,
    hull,
    mean_corner,
    moved_corner,
    shaped_mask,
    way_out,
)
from app.desk.holding.harmonies import HARMONIES, SHADES, harmony, shades
from app.desk.holding.wheel_record import WheelSet, read_wheel, wheel_told
from engine.checks.field_error import FieldError

HUES = st.floats(0, 360, exclude_max=True)
PLACES = st.builds(cmath.rect, st.floats(0, 1), st.floats(0, math.tau))
MASKS = st.builds(shaped_mask, st.sampled_from(sorted(MASK_SHAPES)), HUES)
CHANNEL = st.integers(0, 255).map(lambda v: v / 255)
COLOURS = st.tuples(CHANNEL, CHANNEL, CHANNEL)


@given(PLACES, st.floats(0.15, 0.95))
def test_what_a_place_of_the_disc_shows_lies_there(at, light):
    lch = off_disc(light, at)
    assert abs(on_disc(lch) - at) < 1e-6
    assert to_oklch(from_oklch(*lch))[0] == pytest.approx(light, abs=2e-3)


@given(MASKS, PLACES)
def test_a_mask_lets_nothing_out_and_leaves_what_is_within(corners, at):
    held = held_at(corners, at)
    assert abs(held_at(corners, held) - held) < 1e-9
    middle = mean_corner(corners)
    assert held_at(corners, middle) == middle
    towards = at - middle
    if abs(towards) > 1e-6:
        towards /= abs(towards)
        rim = way_out(corners, middle, towards)
        inside = abs(at - middle) <= abs(rim - middle) + 1e-9
        assert (abs(held - at) < 1e-6) == inside or abs(abs(at - middle) - abs(rim - middle)) < 1e-5


@given(MASKS, COLOURS)
def test_what_a_mask_holds_is_as_light_and_no_mask_holds_all(corners, rgb):
    lch = to_oklch(rgb)
    assert held_in((), lch) == lch
    assert held_in(corners, lch)[0] == lch[0]


@given(MASKS, st.integers(0, 2), PLACES.map(lambda at: 2 * at))
def test_a_corner_stays_on_the_disc_and_none_is_lost(corners, which, to):
    moved = moved_corner(corners, which, to)
    assert len(moved) == len(corners)
    assert hull(moved) == moved
    assert max(map(abs, moved)) < 1 + 1e-9


@given(COLOURS, st.sampled_from(sorted(HARMONIES)))
def test_colours_of_a_harmony_are_as_light_and_as_strong(rgb, name):
    light, chroma, hue = to_oklch(rgb)
    found = harmony((light, chroma, hue), name)
    assert all(one[:2] == (light, chroma) for one in found)
    assert len(found) in (0, len(HARMONIES[name].turns))
    turned = sorted(round((one[2] - hue) % 360, 6) for one in found)
    assert not found or turned == sorted(round(turn % 360, 6) for turn in HARMONIES[name].turns)


@given(COLOURS)
def test_shades_go_from_dark_to_light_with_the_colour_itself_in_the_middle(rgb):
    row, dull = shades(rgb)
    assert row[SHADES // 2] == rgb
    lights = [to_oklch(one)[0] for one in row]
    assert all(a <= b + 2e-3 for a, b in itertools.pairwise(lights))
    assert all(to_oklch(d)[1] <= to_oklch(r)[1] + 1e-3 for r, d in zip(row, dull, strict=True))


@given(st.booleans(), st.sampled_from(sorted(HARMONIES)), st.just(()) | MASKS, st.booleans())
def test_how_the_wheel_is_set_is_read_as_it_was_told(disc, name, corners, masked):
    on = masked and bool(corners)
    wheel = WheelSet(disc or on, name, corners, on)
    read = read_wheel(wheel_told(wheel))
    assert (read.disc, read.harmony, read.masked) == (wheel.disc, name, on)
    near = all(min(abs(one - other) for other in corners) < 2e-4 for one in read.corners)
    assert near
    assert len(read.corners) == len(corners)


@pytest.mark.parametrize("value", [[], {"corners": 3}, {"corners": [[0, 0], [1, 1]]}, {"corners": [[0, "x"]] * 3}])
def test_a_wheel_that_is_none_is_refused_in_a_line(value):
    with pytest.raises(FieldError, match="expected"):
        read_wheel(value)
