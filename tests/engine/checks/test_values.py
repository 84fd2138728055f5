"""Values that somebody gave: numbers are told from what only looks like them, and shown on one short line."""

import math
import pickle

import pytest
from immutables import Map

from engine.brush.checks import BrushError
from engine.checks.field_error import FieldError
from engine.checks.values import LONGEST, described, is_integer, is_number, is_within


@pytest.mark.parametrize("value", [True, None, "1", math.nan, math.inf, [1], 1j])
def test_what_is_no_number(value):
    assert not is_number(value)
    assert not is_within(value, -math.inf, math.inf)


@pytest.mark.parametrize(
    ("value", "inside", "whole"), [(1, True, True), (2.0, True, True), (1.5, True, False), (4, False, False)]
)
def test_within_a_range(value, inside, whole):
    assert is_within(value, 1, 3) == inside
    assert is_within(value, 1, 3, whole=True) == whole
    assert is_integer(value) == isinstance(value, int)


@pytest.mark.parametrize(
    ("value", "text"),
    [
        ("é\n", '"\\u00e9\\n"'),
        ({"a": 1}, "an object"),
        (Map(), "an object"),
        ([1] * 7, "a list of 7"),
        ((1, None), "[1, null]"),
        (10**300, "an integer of about 300 digits"),
        ([10**5000], "a list with very long numbers"),
        (object(), "'object'"),
        ("x" * 999, '"' + "x" * (LONGEST - 1) + "..."),
    ],
)
def test_a_value_is_shown_on_one_short_line(value, text):
    assert described(value) == text


def test_a_fault_is_one_line_and_crosses_processes():
    assert str(FieldError("", "3", "4")) == "found 3, expected 4"
    back = pickle.loads(pickle.dumps(BrushError("brush.radius", "-1", "a number")))
    assert (type(back), str(back)) == (BrushError, "brush.radius: found -1, expected a number")
