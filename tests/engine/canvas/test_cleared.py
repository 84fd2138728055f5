"""What a selection takes away is the same however much of the layer is gone through for it."""

from unittest import mock

import numpy as np
from hypothesis import example, given, settings
from hypothesis import strategies as st

from engine.canvas.evaluate import evaluate
from engine.canvas.merging import cleared
from engine.canvas.selecting.selection import Selection
from engine.numeric.address import Rect
from engine.painting import commands as c
from engine.session.session import Session

SIDES = st.integers(1, 300)
PLACES = st.tuples(st.integers(-200, 200), st.integers(-200, 200))
STROKES = st.lists(st.tuples(st.integers(0, 2), PLACES, st.integers(2, 20)), min_size=1, max_size=3)


def painted(strokes):
    session = Session()
    for level, at, radius in strokes:
        session.do(c.parse({"do": "stroke", "level": level, "points": [list(at)], "brush": {"radius": radius}}))
    return session.painting.root.children[0].pyramid


def selected(level, at, size, inverse):
    session = Session()
    session.do(c.parse({"do": "select", "rect": [level, *at, *size]}))
    chosen = session.painting.selection
    assert chosen is not None
    return Selection(chosen.pyramid, inverse)


@settings(deadline=None, max_examples=15)
@given(STROKES, st.integers(0, 2), PLACES, st.tuples(SIDES, SIDES), st.booleans())
@example([(0, (118, 64), 10)], 2, (512, 240), (80, 32), False)  # what spreads over a tile's edge below the stroke
@example([(0, (100, 20), 20), (0, (600, 20), 20)], 2, (300, 20), (2500, 60), False)  # wider than any tile leads to
def test_nothing_that_is_passed_over_would_have_changed(strokes, level, at, size, inverse):
    paint, chosen = painted(strokes), selected(level, at, size, inverse)
    found = cleared.without(paint, chosen)
    with mock.patch.object(cleared, "_bounds", return_value=None):
        wanted = cleared.without(paint, chosen)
    assert {k: set(v) for k, v in found.levels.items()} == {k: set(v) for k, v in wanted.levels.items()}
    for k in range(-1, 4):
        around = Rect(at[0], at[1], at[0] + size[0], at[1] + size[1]).zoomed(k - level).grown(9)
        part = around.intersect(Rect.at(around.x0, around.y0, 300, 300))
        np.testing.assert_array_equal(evaluate(found, k, part).rgba, evaluate(wanted, k, part).rgba)


def test_a_small_part_of_wide_paint_is_cleared_without_going_through_all_of_it():
    paint = painted([(0, (0, 0), 300)])
    chosen, seen = selected(7, (0, 0), (6, 6), False), []
    evaluated = cleared.evaluate_sparse

    def counted(*given):
        seen.append(given)
        return evaluated(*given)

    with mock.patch.object(cleared, "evaluate_sparse", counted):
        left = cleared.without(paint, chosen)
    assert len(seen) < 400  # of 90,000 tiles of level 7 on which there is paint
    assert evaluate(left, 7, Rect(1, 1, 2, 2)).rgba[3] == 0
    assert evaluate(left, 7, Rect(40, 40, 41, 41)).rgba[3] == 1
