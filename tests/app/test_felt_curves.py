"""A brush's curves as the panel shows and gives them: nothing changes by looking, spans and heights come back."""

import pytest
from hypothesis import given
from hypothesis import strategies as st
from immutables import Map

from app.desk.knots import STRAIGHT
from app.panels.brush import felt_curves as f
from engine.brush.inputs import INPUTS
from engine.brush.settings import from_json
from engine.brush.targets import FOLLOWERS

KNOTS = ((0.0, 0.25), (0.5, 1.0), (1.0, 0.75))


def test_curves_are_listed_by_what_they_follow():
    assert f.by_input(None) == {}
    assert f.by_input("pressure") == {"pressure": "pressure"}
    assert [*f.by_input(Map({"speed": KNOTS, "pressure": KNOTS, "tilt": KNOTS}))] == ["pressure", "tilt", "speed"]


def test_one_of_pressure_alone_stays_as_brushes_of_old_have_it():
    dynamics = Map({"opacity": "pressure"})
    both = f.with_curve(dynamics, "opacity", "tilt", KNOTS)
    assert both["opacity"] == Map({"pressure": STRAIGHT, "tilt": KNOTS})
    assert f.with_curve(both, "opacity", "tilt", None)["opacity"] == STRAIGHT
    assert f.with_curve(f.with_curve(both, "opacity", "tilt", None), "opacity", "pressure", None) == Map()
    assert f.with_curve(Map(), "radius", "pressure", None) == Map()


@pytest.mark.parametrize("name", INPUTS)
@given(st.integers(1, 4000))
def test_a_curve_comes_back_from_the_editor(name, span):
    row = INPUTS[name]
    span = float(span) if row.open_ended else row.span
    drawn = f.spread(name, KNOTS, span)
    assert f.span_of(name, drawn) == span
    assert f.unit_knots(name, drawn) == KNOTS
    assert from_json({"dynamics": {"radius": {name: [list(k) for k in drawn]}}})


def test_a_curve_without_natural_end_keeps_its_span():
    short = f.spread("speed", ((0.0, 1.0), (0.5, 0.2)), 1000.0)
    assert short[-1] == (1000.0, 0.2)


@pytest.mark.parametrize("name", FOLLOWERS)
def test_the_middle_leaves_angles_and_colours_and_the_top_all_others(name):
    row = FOLLOWERS[name]
    heights = f.heights_of(row, None)
    leaves = 1.0 if heights == (0.0, 1.0) else 0.5
    assert f.raised(((0.0, leaves),), heights) == ((0.0, 1.0),)
    assert f.unit_heights(f.raised(KNOTS, heights), heights) == KNOTS
    assert (leaves == 0.5) == (row.turns or row.own is not None)


def test_an_angle_that_goes_from_none_on_is_shown_so():
    assert f.heights_of(FOLLOWERS["angle"], STRAIGHT) == (0.0, 1.0)
    assert f.heights_of(FOLLOWERS["angle"], ((0.0, 0.75), (1.0, 1.25))) == (0.5, 1.5)
