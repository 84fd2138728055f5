"""Layers of which little is painted, read without a look at the rest: the same pixels."""

from functools import cache

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from engine.canvas.layers import layers
from engine.canvas.placing.unpainted import Unpainted
from engine.canvas.reading import layer_planes
from engine.numeric.address import Rect
from engine.painting import commands as c
from engine.session.session import Session

SEEN = Unpainted()


@cache
def sparse():
    """A layer with a stroke at a coarse level and two at finer ones."""
    session = Session()
    for level, radius, points in (
        (-2, 3, [[-8, 2], [5, 9]]),
        (0, 6, [[60, 60], [300, 90]]),
        (1, 4, [[5, 5], [40, 12]]),
    ):
        brush = {"radius": radius, "colour": "#20c060", "opacity": 0.6}
        session.do(c.parse({"do": "stroke", "level": level, "points": points, "brush": brush}))
    return next(layers(session.painting.root))


@given(st.integers(-3, 9), st.integers(-300, 700), st.integers(-300, 500), st.integers(1, 40), st.integers(1, 40))
@settings(max_examples=60, deadline=None)
def test_what_is_not_looked_at_is_empty(level, x, y, width, height):
    x, y = (round(value * 2.0**level) for value in (x, y))
    rect = Rect.at(x, y, width, height)
    spared, plain = (read(sparse(), level, rect) for read in (SEEN.reading(layer_planes, None), layer_planes))
    assert spared is None or np.array_equal(spared, plain)
    assert spared is not None or plain is None or not plain.any()


def test_far_from_paint_nothing_is_read_but_of_a_layer_that_is_painted_on():
    asked = []

    def read(layer, level, rect):
        asked.append(layer.id)

    far = Rect.at(4000 << 5, 4000 << 5, 128, 128)
    SEEN.reading(read, None)(sparse(), 5, far)
    assert not asked
    SEEN.reading(read, sparse().id)(sparse(), 5, far)
    assert asked == [sparse().id]
