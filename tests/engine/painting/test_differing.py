"""What differs between two states is found where it was painted, and where what had waited there was folded in."""

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from stepped import ROCK, stroke

from engine.canvas import commit, layers
from engine.canvas.tile_cache import TileCache
from engine.numeric.address import Rect
from engine.painting import commands as c
from engine.painting.value import Painting
from engine.session import differing
from engine.session.session import Session

WAITING = 2  # strokes that may wait: the next one over finer paint has one of them folded in
ACTS = st.one_of(
    st.builds(stroke, st.integers(0, 9), st.integers(-2, 3), st.sampled_from([2.0, 9.0]), st.sampled_from([(), ROCK])),
    st.integers(1, 3).map(c.Undo),
    st.integers(1, 3).map(c.Redo),
)


def by_looking(far, near):
    """The records of one state of the layers that another has not, found by looking at all of both."""
    found, beside = [], {layer.id: layer.pyramid for layer in layers.layers(near)}
    for layer in layers.layers(far):
        if layer.id in beside:
            there = dict(beside[layer.id].all_records())
            found += [(key, record, there.get(key)) for key, record in layer.pyramid.all_records()]
    return {(key, id(record), id(beside)) for key, record, beside in found if record is not beside}


def told(far, near):
    found = [(key, id(record), id(beside)) for key, record, beside in differing.changed_records(far, near)]
    assert len(set(found)) == len(found)
    return set(found)


@pytest.mark.parametrize("apart", [1, 3])
@settings(deadline=None, max_examples=20)
@given(st.lists(ACTS, min_size=6, max_size=20))
def test_no_record_that_differs_is_left_out_and_none_is_told_twice(apart, acts):
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(commit, "_MOST_WAITING", WAITING)
        session = Session(Painting(Rect.at(0, 0, 96, 96), 7), TileCache(4 << 20))
        for act in (stroke(0, 3), stroke(1, 2), stroke(2, -1), *acts):
            session.do(act)
            steps = session.history.steps.done[-apart:]
            if steps:
                before, after = steps[0].before.root, steps[-1].after.root
                assert told(before, after) == by_looking(before, after)
                assert told(after, before) == by_looking(after, before)


def test_what_is_folded_in_far_from_the_stroke_is_found_without_looking_at_all(monkeypatch):
    monkeypatch.setattr(commit, "_MOST_WAITING", 1)
    session = Session(Painting(Rect.at(0, 0, 96, 96), 7), TileCache(4 << 20))

    def dot(level, x, radius=2.0):
        brush = {"radius": radius, "opacity": 0.6, "colour": "#a06080"}
        y = 9.0 * 2.0**level
        points = [[x, y], [x + 3.0, y]]
        session.do(c.parse({"do": "stroke", "level": level, "points": points, "brush": brush}))

    for n in range(40):
        dot(2, 600.0 * n)
    dot(0, 1.0)  # over the first, where it waits
    dot(0, 600.0 * 30 / 4)  # over others: what waits over the first is folded in now
    looked, places = [], differing._places
    monkeypatch.setattr(differing, "_places", lambda *given: looked.extend(found := list(places(*given))) or found)
    step = session.history.steps.done[-1]
    before, after = step.before.root, step.after.root
    assert told(before, after) == by_looking(before, after)
    assert any(key.level == 2 and key.x < 3 for key, _, _ in differing.changed_records(before, after))
    assert 0 < len(looked) < 60
