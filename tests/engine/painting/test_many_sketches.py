"""Many strokes that wait for their kernels look as each alone would, and few of them are kept as strokes."""

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from engine.brush.settings import Brush
from engine.numeric.address import Rect
from engine.numeric.colour import to_premul8
from engine.painting import commands as c
from engine.session.session import Session
from engine.studio import requests as q
from engine.studio.preparing import sketch as sketches
from engine.studio.preparing.sketch import Sketch

SQUARE = {"do": "select", "rect": [0, 20, 20, 60, 60]}
STROKES = st.tuples(
    st.sampled_from(["paint", "paint", "erase"]),
    st.sampled_from([0, 1]),
    st.integers(-40, 200),
    st.integers(-40, 200),
    st.sampled_from(["#c04020", "#2040c0"]),
    st.sampled_from([0.3, 0.8, 1.0]),
)


def requests(strokes):
    for mode, level, x, y, colour, opacity in strokes:
        points = np.zeros((4, 6))
        points[:, 0], points[:, 1], points[:, 2] = x + np.arange(4) * 9.0, y, 1.0
        brush = Brush(mode=mode, radius=9.0, hardness=0.4, opacity=opacity, colour=colour)
        yield from (q.Begin(level, (0, 0), brush), q.Points(points), q.Finish())


@settings(deadline=None, max_examples=6)
@given(st.lists(STROKES, min_size=9, max_size=14), st.integers(0, 3))
def test_many_strokes_look_as_each_alone_would(strokes, more):
    few, all_of_them = Sketch(), Sketch()
    told = list(requests(strokes))
    few.begin(told[: 3 * (len(strokes) - more)])
    for request in told[3 * (len(strokes) - more) :]:
        few.add(request)
    most, sketches._FEW = sketches._FEW, 100
    try:
        all_of_them.begin(told)
    finally:
        sketches._FEW = most
    assert len(few._strokes) <= most < len(all_of_them._strokes)
    below = np.linspace(0.0, 1.0, 4 * 260 * 260, dtype=np.float32).reshape(4, 260, 260) ** 2
    for level in (0, 1):
        rect = Rect.at(-50, -50, 260, 260)
        seen, wanted = (one.over(level, rect, below) for one in (few, all_of_them))
        assert np.abs(to_premul8(seen).astype(int) - to_premul8(wanted)).max() <= 1
        assert set(few.rects(level)) == set(all_of_them.rects(level))
    assert (below == np.linspace(0.0, 1.0, 4 * 260 * 260, dtype=np.float32).reshape(4, 260, 260) ** 2).all()
    few.begin([])
    assert few.over(0, rect, below) is below
    assert not few.rects(0)


def test_a_sketch_stays_within_what_is_selected():
    painting = Session().do(c.parse(SQUARE))
    free, limited = Sketch(), Sketch(lambda: painting.selection)
    for sketch in (free, limited):
        sketch.begin(requests([("paint", 0, 10, 40, "#c04020", 1.0)] * (sketches._FEW + 2)))
    rect = Rect.at(-50, -50, 260, 260)
    ground = np.zeros((4, 260, 260), np.float32)
    chosen = np.zeros((260, 260), bool)
    chosen[70:130, 70:130] = True
    whole, left = (sketch.over(0, rect, ground) for sketch in (free, limited))
    assert (left[:, chosen] == whole[:, chosen]).all()
    assert whole[3, ~chosen].any()
    assert not left[:, ~chosen].any()
