"""Where panels lie: every panel has one place, columns are filled, and what is kept is read as it was."""

import json

import pytest
from hypothesis import given
from hypothesis import strategies as st
from immutables import Map

from app.desk.arranging.arrangement import (
    COLUMNS,
    DOCKS,
    FREE,
    NARROWEST_COLUMN,
    Arrangement,
    docked,
    edge_dragged,
    filling,
    floated,
    heights_in,
    shown_or_hidden,
    sides_swapped,
    widened,
    widths_in,
)
from app.desk.arranging.kept_arrangement import arrangement_json, arrangement_of, workspaces_of
from engine.checks.field_error import FieldError

NAMES = st.sampled_from(sorted(DOCKS))
BOXES = st.tuples(*[st.floats(-500, 5000)] * 2, *[st.floats(60, 4000)] * 2)
STEPS_OF_ONE = st.lists(
    st.one_of(
        st.tuples(st.just(docked), NAMES, st.sampled_from(COLUMNS), NAMES),
        st.tuples(st.just(floated), NAMES, BOXES),
        st.tuples(st.just(shown_or_hidden), NAMES),
        st.tuples(st.just(sides_swapped)),
        st.tuples(st.just(widened), st.sampled_from(COLUMNS), st.floats(0, 900)),
    ),
    max_size=12,
)


def arranged(steps):
    told = Arrangement()
    for step, *words in steps:
        told = step(told, *words)
    return told


@given(STEPS_OF_ONE)
def test_whatever_is_done_each_panel_has_one_place_and_is_kept_as_it_lies(steps):
    told = arranged(steps)
    assert sorted((*told.left, *told.right, *told.floating)) == sorted(DOCKS)
    assert arrangement_of(json.loads(json.dumps(arrangement_json(told))), "panels") == told
    assert sides_swapped(sides_swapped(told)) == told


@given(STEPS_OF_ONE, st.floats(200, 4000), st.sets(NAMES), st.dictionaries(NAMES, st.floats(0, 5000)))
def test_a_column_is_filled_and_no_panel_has_less_than_nothing(steps, room, folded, dragged):
    told = arranged(steps)
    for name, high in dragged.items():
        told = edge_dragged(told, (name, "tools"), (high, 85.0), 0.0, "tools")
    for side in COLUMNS:
        names = told.column(side)
        small = {name: 30.0 for name in names if name in folded}
        heights = heights_in(told, names, small, room, {name: 85.0 for name in names if name == "tools"})
        assert all(high >= 0 for high in heights)
        assert len(heights) == len(names)
        if set(names) - folded - {"tools"} and room > 400:
            assert sum(heights) == pytest.approx(room)
        for name, high in zip(names, heights, strict=True):
            assert name not in small or high == 30.0


def test_an_edge_moves_what_lies_beside_it_alone():
    told, names = Arrangement(), Arrangement().right
    before = heights_in(told, names, {}, 740.0, {})
    told = edge_dragged(told, ("colour", "ink"), (before[0], before[1]), -50.0, filling(names, ()))
    after = heights_in(told, names, {}, 740.0, {})
    assert after == pytest.approx([before[0] - 50, before[1] + 50, before[2]])
    assert set(told.heights) == {"colour", "ink"}


@given(STEPS_OF_ONE, st.floats(300, 4000))
def test_columns_leave_some_of_the_canvas(steps, room):
    told = arranged(steps)
    widths = widths_in(told, room)
    assert all((width > 0) == bool(told.column(side)) for side, width in zip(COLUMNS, widths, strict=True))
    assert sum(widths) <= max(room - FREE, 2 * NARROWEST_COLUMN) + 1e-6


def test_panels_of_another_program_are_passed_over_and_missing_ones_are_at_home():
    told = arrangement_of({"left": ["of a newer program", "ink", "ink"], "hidden": ["gone"], "right": []}, "panels")
    assert (told.left, told.right) == (("ink", "tools", "brushes", "settings"), ("colour", "layers"))
    assert told.hidden == frozenset()


@pytest.mark.parametrize(
    "found",
    [
        [],
        {"left": "tools"},
        {"left": [[]]},
        {"widths": [1e9, 286]},
        {"widths": [300]},
        {"heights": {"ink": float("nan")}},
        {"heights": 3},
        {"floating": {"ink": [0, 0, 1, 1]}},
        {"floating": {"ink": [0, 0]}},
        {"strip": True},
        {"hidden": {}},
    ],
)
def test_what_is_no_arrangement_is_told_in_a_line(found):
    for read in (lambda: arrangement_of(found, "panels"), lambda: workspaces_of({"Mine": found})):
        with pytest.raises(FieldError) as told:
            read()
        assert "\n" not in str(told.value)


def test_workspaces_have_short_names():
    assert workspaces_of({"Mine": {}}) == Map({"Mine": Arrangement()})
    for bad in ({"": {}}, {"n" * 61: {}}, [], {str(n): {} for n in range(51)}):
        with pytest.raises(FieldError):
            workspaces_of(bad)
