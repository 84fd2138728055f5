"""The coverage of a few pixels by many strokes at once is that of their masks, bit for bit."""

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from engine.brush.dabs import Stroker
from engine.brush.mask import StrokeMask
from engine.numeric.address import Rect
from engine.painting import commands as c
from engine.strokes import spots
from engine.strokes.coverage_at import bounds_of, plainly

ORIGINS = st.sampled_from([(0, 0), (-3, 117), (2**70 + 1, -(2**65) - 5)])
CURVES = st.sampled_from(
    [{}, {"dynamics": {"radius": "pressure"}}, {"dynamics": {"flow": [[0, 0.2], [0.5, 1], [1, 0]]}}]
)


@st.composite
def strokes(draw):
    brush = {
        "radius": draw(st.sampled_from((0.3, 2.0, 9.5, 70.0))),
        "hardness": draw(st.sampled_from((0.0, 0.4, 1.0))),
        "opacity": draw(st.sampled_from((0.001, 0.3, 1.0))),
        "flow": draw(st.sampled_from((0.1, 1.0))),
        "spacing": draw(st.sampled_from((0.01, 0.25))),
        **draw(CURVES),
    }
    places = st.tuples(st.floats(-40, 40), st.floats(-40, 40), st.floats(0, 1))
    return {
        "do": "stroke",
        "points": [list(at) for at in draw(st.lists(places, min_size=1, max_size=5))],
        "brush": brush,
    }


@settings(deadline=None, max_examples=25)
@given(
    ORIGINS,
    st.lists(strokes(), min_size=1, max_size=4),
    st.sampled_from(((-20, -9, 16, 16), (3, 11, 1, 1), (120, 0, 9, 2))),
)
def test_it_is_what_the_masks_have(origin, told, part):
    made = [c.parse({**one, "origin": list(origin)}) for one in told]
    rect = Rect.at(origin[0] + part[0], origin[1] + part[1], *part[2:])
    found = spots.covered(made, 0, rect)
    for stroke, own, bounds in zip(made, found, bounds_of(made), strict=True):
        assert plainly(stroke, 0)
        mask = StrokeMask(0, origin)
        mask.paint(Stroker(stroke.brush).walk(stroke.points))
        coverage = mask.coverage()
        wanted = np.zeros((rect.height, rect.width), np.float32)
        for key in rect.tiles(0):
            inner = key.rect.intersect(rect)
            wanted[inner.slices(rect)] = coverage.on_grid(key)[inner.slices(key.rect)]
        assert np.array_equal(own, wanted)
        assert not own.any() or bounds.meets(rect)


def test_it_is_the_same_where_nothing_is_compiled(monkeypatch):
    told = {"do": "stroke", "points": [[2, 3, 0.7], [40, 9], [12, 30]], "brush": {"radius": 7, "hardness": 0.3}}
    made = [c.parse({**told, "origin": [n, -n]}) for n in range(3)]
    wanted = [spots.covered(made, coarser, Rect.at(0, 0, 9, 6)) for coarser in (0, 2)]
    assert all(one.any() for one in wanted)
    monkeypatch.setattr(spots, "_cover", spots._cover.plain)
    found = [spots.covered(made, coarser, Rect.at(0, 0, 9, 6)) for coarser in (0, 2)]
    assert all(map(np.array_equal, found, wanted))
