"""Fills of all regions that a line goes round: inside alone, and the same as each region filled by itself."""

import json

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from test_filling import done, seen

from engine.numeric.address import Rect
from engine.painting import commands as c
from engine.painting.value import Refusal, Unclosed
from engine.session.replay import replay

BOX = [[-1, -1], [150, -1], [150, 110], [-1, 110]]  # from 4, 4: all but the frame's own rim
SIDE = 20


def square(x, y, gap=0.0):
    """A line round a cell, but for a gap at its right."""
    corners = [[SIDE, SIDE / 2 - gap / 2], [SIDE, 0], [0, 0], [0, SIDE], [SIDE, SIDE], [SIDE, SIDE / 2 + gap / 2]]
    points = [[x + u, y + v] for u, v in corners]
    return {"do": "stroke", "points": points, "brush": {"radius": 2, "colour": "#101418", "hardness": 1}}


def fill(at=(4, 4), within=BOX, **members):
    like = {"at": list(at), "of": None, **({"within": within} if within else {}), **members}
    return {"do": "fill", "like": like, "brush": {"colour": "#c06020"}}


def filled(session, *commands):
    for command in commands:
        session.do(c.parse(command))
    return seen(session.painting)


CELLS = [(14 + 34 * i, 14 + 32 * j) for i in range(4) for j in range(3)]


@given(cells=st.lists(st.sampled_from(CELLS), min_size=1, max_size=5, unique=True), open_one=st.booleans())
@settings(max_examples=8, deadline=None)
def test_it_equals_filling_each_region_that_lies_within(cells, open_one):
    lines = [square(x, y, 8.0 if open_one and n == 0 else 0.0) for n, (x, y) in enumerate(cells)]
    whole = cells[1:] if open_one else cells
    if not whole:
        with pytest.raises(Refusal, match="nothing closed that lies within"):
            filled(done(*lines), fill())
        return
    at_once = filled(done(*lines), fill())
    each = [fill((x + SIDE // 2, y + SIDE // 2), None) for x, y in whole]
    one_by_one = filled(done(*lines), *each)
    assert (at_once == one_by_one).all()
    assert (at_once == filled(done(*lines), fill(regions="empty"))).all()


@given(
    corners=st.lists(st.tuples(st.integers(0, 156), st.integers(0, 116)), min_size=3, max_size=7),
    regions=st.sampled_from(["alike", "empty", "all", "line"]),
    gap=st.sampled_from([0, 9]),
    grow=st.sampled_from([0, 5.5]),
)
@settings(max_examples=12, deadline=None)
def test_nothing_changes_outside_of_the_line(corners, regions, gap, grow):
    lines = [square(x, y) for x, y in CELLS[::2]]
    before, session = seen(done(*lines).painting), done(*lines)
    within = [[x - 4, y - 4] for x, y in corners]
    try:
        grown = grow if regions != "line" else 0
        after = filled(session, {**fill(within=within, regions=regions, gap=gap), "grow": grown})
    except Refusal:
        return
    told = done({"do": "select", "outline": [list(at) for at in corners]}).painting.selection
    part = np.broadcast_to(told.part(0, Rect(0, 0, 160, 120), None), (120, 160))
    inside = part > 0.0 if regions == "line" else part >= 0.5
    assert not (before != after).any(axis=0)[~inside].any()


def test_gaps_that_are_closed_make_a_region_of_what_they_open():
    lines = [square(20, 20, 8.0), square(80, 60)]
    narrow, wide = (filled(done(*lines), fill(gap=gap)) for gap in (0, 12))
    assert narrow[3, 30, 30] == 0.0 < narrow[3, 70, 90]
    assert wide[3, 30, 30] == wide[3, 70, 90] == 1.0
    assert wide[3, 8, 8] == 0.0


def test_all_takes_the_lines_and_alike_those_of_one_colour():
    ground = {"do": "fill", "like": {"at": [30, 30], "of": None}, "brush": {"colour": "#2050d0"}}
    base = done(square(20, 20), square(80, 60), ground)
    lines = seen(base.painting)
    alike = filled(base, fill())
    assert (alike[:, 30, 30] == lines[:, 30, 30]).all()  # another colour is there
    assert (alike[:, 20, 30] == lines[:, 20, 30]).all()  # a line
    everything = filled(base, fill(regions="all"))
    assert (everything[:, 30, 30] == everything[:, 20, 30]).all()
    assert (everything[:, 30, 30] == everything[:, 70, 90]).all()
    assert everything[3, 8, 8] == 0.0


@pytest.mark.parametrize("regions", ["alike", "empty", "all"])
def test_it_goes_under_the_lines_as_far_as_it_is_told_to_grow(regions):
    """Both ends of what a row of pixels through the cell shows of it lie so far farther out."""
    colours = [filled(done(square(70, 50)), {**fill(regions=regions), "grow": grow})[:, 60, :] for grow in (0, 3)]
    base = seen(done(square(70, 50)).painting)[:, 60, :]
    kept, grown = ((base != row).any(axis=0) for row in colours)
    assert kept[80]
    assert grown[80]
    assert np.flatnonzero(grown).min() + 3 == np.flatnonzero(kept).min()
    assert np.flatnonzero(grown).max() - 3 == np.flatnonzero(kept).max()


def test_all_that_the_line_goes_round_is_filled_on_empty_ground_as_if_it_were_selected():
    line = [[0, 0], [60.5, 3], [33, 70]]
    gone_round = filled(done(), fill((20, 11), line, regions="line"))
    chosen = {"do": "select", "outline": line, "origin": [20, 11]}
    selected = filled(done(), chosen, {"do": "fill", "brush": {"colour": "#c06020"}})
    assert gone_round[3].max() == 1.0
    assert (gone_round == selected).all()
    with pytest.raises(Unclosed, match="nothing closed that lies within"):
        filled(done(), fill((20, 11), line))


def test_it_is_one_step_selects_as_well_and_a_replay_is_equal():
    session = done(square(20, 20), square(80, 60))
    before = seen(session.painting)
    command = c.parse(fill(gap=3, regions="empty"))
    assert c.parse(json.loads(json.dumps(c.to_json(command)))) == command
    session.do(command)
    after = seen(session.painting)
    session.do(c.Undo())
    assert (seen(session.painting) == before).all()
    chosen = {"do": "select", "like": {"at": [4, 4], "of": None, "within": BOX, "gap": 3}}
    session.do(c.parse(chosen))
    session.do(c.parse({"do": "fill", "brush": {"colour": "#c06020"}}))
    assert np.abs(seen(session.painting) - after).max() <= 2**-15
    assert (seen(replay(session.recording()).painting) == seen(session.painting)).all()


@pytest.mark.parametrize(
    ("members", "why"),
    [
        ({"within": [[0, 0], [9, 9]]}, "3 points"),
        ({"rect": [0, 0, 9, 9]}, "rect and within"),
        ({"regions": "some"}, "alike"),
        ({"within": None, "regions": "all"}, "within"),
    ],
)
def test_what_is_told_wrongly_is_refused(members, why):
    with pytest.raises(ValueError, match=why):
        c.parse(fill(**members))


def test_a_line_around_too_much_is_refused():
    with pytest.raises(Refusal, match="at most"):
        done(fill(within=[[0, 0], [9000, 0], [9000, 9000]]))
