"""The rim of what is selected, as the window is told it."""

import numpy as np
import pytest

from engine.canvas.selecting import outlines
from engine.canvas.selecting.joining import joined_with
from engine.canvas.selecting.selection import EVERYTHING
from engine.numeric.address import Rect
from engine.painting import commands as c
from engine.session.session import Session
from engine.studio.easel import Easel
from engine.studio.selecting.ants import AntsFinder, bounds_of, rim
from engine.studio.selecting.ants_records import AskAnts, PreviewSelection
from engine.studio.selecting.measure import measured

AREA = Rect(-10, -20, 290, 280)


def sides(lines):
    return sorted(tuple(int(v) for v in line) for line in lines)


def test_a_rectangle_has_four_sides_and_its_inverse_the_same():
    selection = joined_with(None, outlines.boxed(0, Rect(5, 7, 205, 150), "here"), "replace", 16)
    expected = [(15, 27, 15, 170), (15, 27, 215, 27), (15, 170, 215, 170), (215, 27, 215, 170)]
    assert sides(rim(selection, 0, AREA)) == expected
    assert sides(rim(selection.inverted(), 0, AREA)) == expected
    assert not len(rim(EVERYTHING, 0, AREA))


def test_the_rim_parts_all_that_is_selected_from_what_is_not():
    """Every pixel's side with another one's is crossed by lines as often as the two differ."""
    selection = joined_with(None, outlines.rounded_off(0, Rect(3, 9, 180, 140), "here"), "replace", 16)
    inside = selection.chosen(0, AREA)
    beside = np.zeros((AREA.height, AREA.width + 1), bool)
    above = np.zeros((AREA.height + 1, AREA.width), bool)
    for x0, y0, x1, y1 in rim(selection, 0, AREA).astype(int):
        if x0 == x1:
            beside[y0:y1, x0] = True
        else:
            above[y0, x0:x1] = True
    assert (beside[:, 1:-1] == (inside[:, 1:] != inside[:, :-1])).all()
    assert (above[1:-1] == (inside[1:] != inside[:-1])).all()


@pytest.mark.parametrize("level", [-2, 0, 3])
def test_bounds_are_those_of_the_pixels_at_its_level(level):
    selection = joined_with(None, outlines.boxed(level, Rect(-8, 16, 264, 160), "here"), "replace", 16)
    assert bounds_of(selection) == Rect(-8, 16, 264, 160).zoomed(-level)
    assert bounds_of(selection.inverted()) is None
    assert bounds_of(EVERYTHING) is None


def test_it_is_told_when_it_changes_and_not_for_strokes():
    sent = []
    easel = Easel(sent.append)
    finder = AntsFinder(easel)
    finder.handlers[AskAnts](AskAnts(0, AREA))
    assert not finder.pending
    easel.carry_out(c.parse({"do": "select", "rect": [0, 5, 7, 200, 143], "keep": "one"}))
    assert finder.pending
    finder.step()
    assert (sent[-1].selected, sent[-1].saved, len(sent[-1].lines)) == (True, ("one",), 4)
    assert sent[-1].bounds == Rect.at(5, 7, 200, 143)
    easel.carry_out(c.parse({"do": "stroke", "points": [[20, 20], [60, 60]]}))
    assert not finder.pending
    finder.handlers[AskAnts](AskAnts(1, AREA))
    assert finder.pending
    finder.step()
    tried = c.parse({"do": "select", "grow": 10})
    finder.handlers[PreviewSelection](PreviewSelection(tried))
    finder.step()
    assert sent[-1].bounds == Rect.at(-5, -3, 220, 163)
    assert easel.session.painting.selection.chosen(0, Rect(0, 0, 9, 9)).sum() == 8
    finder.handlers[PreviewSelection](PreviewSelection(c.parse({"do": "select", "grow": -400})))
    finder.step()
    assert not len(sent[-1].lines)  # nothing would be left
    finder.handlers[PreviewSelection](PreviewSelection(None))
    finder.step()
    assert sent[-1].bounds == Rect.at(5, 7, 200, 143)
    easel.carry_out(c.parse({"do": "select", "none": True}))
    finder.step()
    assert not finder.pending
    assert not sent[-1].selected


@pytest.mark.parametrize("op", ["rect", "ellipse", "outline"])
@pytest.mark.parametrize("feather", [0, 3, 8, 15])
def test_its_size_and_its_feather_are_told_as_they_were_asked_for(op, feather):
    box = [2, -30, 40, 300, 200]
    outline = {"level": 2, "origin": [-30, 40], "outline": [[0, 0], [300, 20], [260, 200], [10, 170]]}
    shape = outline if op == "outline" else {op: box}
    session = Session()
    session.do(c.parse({"do": "select", **shape, "feather": feather}))
    found = measured(session.painting.selection)
    assert found.level == 2
    assert max(abs(a - b) for a, b in zip(found.bounds, Rect(-30, 40, 270, 240), strict=True)) <= 1 + feather / 2
    assert abs(found.feather - feather) <= 1
    session.do(c.parse({"do": "select", "invert": True}))
    assert measured(session.painting.selection) == found


@pytest.mark.parametrize("op", ["rect", "outline", "stroke"])
def test_a_hard_rim_is_told_to_be_hard_at_whatever_level_it_was_drawn(op):
    """Made on a coarse level, seen on the frame's: by more pixels there, still without a feather."""
    line = [[0, 0], [60, 4], [52, 40], [2, 34]]
    told = {
        "rect": {"rect": [-2, 0, 0, 60, 40]},
        "outline": {"level": -2, "outline": line},
        "stroke": {"stroke": {"level": -2, "points": line, "brush": {"radius": 9, "hardness": 1}}},
    }[op]
    session = Session()
    session.do(c.parse({"do": "select", **told}))
    assert (measured(session.painting.selection).level, measured(session.painting.selection).feather) == (0, 0)
    session.do(c.parse({"do": "select", "level": -2, "feather": 6}))
    assert abs(measured(session.painting.selection).feather - 24) <= 6


def test_all_has_no_size():
    assert measured(EVERYTHING) is None
