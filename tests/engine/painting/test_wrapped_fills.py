"""Fills on layers that wrap around: a region goes on over the rim of the tile, and lies in every tile."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from test_wrapping import CELL, moved, own, painted, seen, stroke, wrap

from engine.numeric.address import Rect
from engine.numeric.flood import Likeness
from engine.numeric.torus_flood import region_around
from engine.painting import commands as c
from engine.painting.value import Refusal
from engine.session.replay import replay

LINES = (
    stroke([[60, 0], [60, 200]], radius=3, hardness=1, colour="#000000"),
    stroke([[-24, 100], [130, 100]], radius=3, hardness=0.4, colour="#000000"),
)


def fill(at, level=0, brush=None, **like):
    about = {"at": list(at), "level": level, **like}
    return {"do": "fill", "like": about, "brush": {"colour": "#c04020", **(brush or {})}}


@settings(deadline=None, max_examples=25)
@given(arrays(bool, (7, 9), elements=st.booleans()), st.integers(0, 8), st.integers(0, 6))
def test_a_region_is_all_that_hangs_together_on_the_torus(shut, x, y):
    picture = np.repeat(shut[None], 4, axis=0).astype(np.float32)
    reached, queue = {(y, x)}, [(y, x)]
    while queue:
        i, j = queue.pop()
        for step in ((i - 1, j), (i + 1, j), (i, j - 1), (i, j + 1)):
            there = step[0] % 7, step[1] % 9
            if there not in reached and shut[there] == shut[y, x]:
                reached.add(there)
                queue.append(there)
    found = region_around(picture, x, y, Likeness())
    assert set(zip(*np.nonzero(found == 1), strict=True)) >= reached
    assert all(
        found[i, j] < 1 for i in range(7) for j in range(9) if shut[i, j] == shut[y, x] and (i, j) not in reached
    )


@settings(deadline=None, max_examples=20)
@given(
    arrays(np.uint8, (19, 23), elements=st.sampled_from((0, 0, 0, 90, 255))),
    st.integers(0, 22), st.integers(0, 18), st.integers(0, 40), st.integers(0, 40), st.integers(0, 1), st.booleans(),
)  # fmt: skip
def test_where_the_rim_lies_does_not_matter(values, x, y, right, down, gap, contiguous):
    picture = np.repeat(values[None] / np.float32(255), 4, axis=0)
    likeness = Likeness(0.1, 3 * gap, contiguous)
    rolled = region_around(np.roll(picture, (down, right), (1, 2)), (x + right) % 23, (y + down) % 19, likeness)
    expected = np.roll(region_around(picture, x, y, likeness), (down, right), (0, 1))
    np.testing.assert_array_equal(rolled, expected)


@settings(deadline=None, max_examples=3)
@given(st.integers(-3, 3), st.integers(-3, 3), st.integers(0, 200), st.integers(20, 90), st.sampled_from((0, 6)))
def test_a_fill_in_any_tile_is_the_same_and_lies_in_all(across, down, x, y, gap):
    here = painted(wrap(), *LINES, fill((x, y), gap=gap))
    there = painted(wrap(), *LINES, fill((x + across * CELL.width, y + down * CELL.height), gap=gap))
    np.testing.assert_array_equal(own(here, CELL), own(there, CELL))
    for level in (0, 1, -2):
        cell = CELL.zoomed(level)
        np.testing.assert_array_equal(
            seen(here, cell, level), seen(here, moved(cell, -3 * cell.width, cell.height), level)
        )
    assert seen(here, CELL)[0].max() > 0.7


def test_it_goes_on_over_the_rim_and_stops_at_lines():
    session = painted(wrap(), *LINES, fill((70, 50)))
    red = seen(session, CELL)[0] > 0.7
    upright, level = 60 - CELL.x0, 100 - CELL.y0
    assert red[:80, : upright - 6].all()  # from the right it came in on the left
    assert red[:80, upright + 6 :].all()
    assert red[level + 8 :, 170:].all()  # where the line has its end, it goes round it
    assert not red[:, upright].any()
    rim = seen(session, Rect.at(4 * CELL.x1 - 20, 4 * CELL.y0 + 40, 40, 60), 2)
    assert (rim == rim[:, :1, :1]).all()  # finer, nothing shows at the rim
    before = session.painting
    again = replay(session.recording())
    np.testing.assert_array_equal(seen(again, CELL, 1), seen(session, CELL, 1))
    session.do(c.Undo())
    assert session.painting.root is not before.root


@pytest.mark.parametrize("brush", [{"mode": "erase"}, {"mode": "smooth", "radius": 9}, {"ink": [{"texture": "rock"}]}])
def test_whatever_a_brush_does_lies_in_every_tile(brush):
    session = painted(wrap(), *LINES, fill((70, 50)), fill((70 - CELL.width, 50), brush=brush))
    plain = painted(wrap(), *LINES, fill((70, 50)))
    np.testing.assert_array_equal(seen(session, CELL), seen(session, moved(CELL, CELL.width, 0)))
    assert (seen(session, CELL) != seen(plain, CELL)).any()


def test_what_is_selected_in_any_tile_is_filled_in_this_one():
    """A selection over the rim of the next tile but one: both parts are filled, nothing besides."""
    right = 2 * CELL.width
    box = {"do": "select", "rect": [0, CELL.x1 + right - 10, 50, 30, 20]}
    session = painted(wrap(), box, {"do": "fill", "brush": {"colour": "#ffffff"}})
    alpha = seen(session, CELL)[3]
    expected = np.zeros_like(alpha)
    expected[50 - CELL.y0 : 70 - CELL.y0, -10:] = 1
    expected[50 - CELL.y0 : 70 - CELL.y0, :20] = 1
    np.testing.assert_array_equal(alpha, expected)
    inside = painted(wrap(), box, fill((CELL.x1 + right - 5, 55)))
    assert (seen(inside, CELL)[3, 50 - CELL.y0 : 70 - CELL.y0, -10:] == 1).all()
    assert not seen(inside, CELL)[3, :, 30:200].any()


def test_a_tile_without_whole_pixels_or_too_large_is_refused():
    with pytest.raises(Refusal, match="zoom in"):
        painted(wrap(), fill((0, 0), level=-4))
    with pytest.raises(Refusal, match="zoom out"):
        painted(wrap(), fill((0, 0), level=6))


def test_a_fill_that_grows_goes_under_lines_beyond_the_rim():
    """Where the rim lies does not matter: both lines are moved onto it."""
    right, down = 2 - 60, 1 - 100
    lines = [{**line, "points": [[x + right, y + down, *rest] for x, y, *rest in line["points"]]} for line in LINES]
    plain = own(painted(wrap(), *LINES, fill((90, 50))), CELL)
    grown = own(painted(wrap(), *LINES, {**fill((90, 50)), "grow": 3}), CELL)
    rolled = own(painted(wrap(), *lines, {**fill((90 + right, 50 + down)), "grow": 3}), CELL)
    assert (grown != plain).any(axis=0).sum() > 500
    np.testing.assert_array_equal(rolled, np.roll(grown, (down, right), (1, 2)))
