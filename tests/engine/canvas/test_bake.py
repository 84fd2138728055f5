"""What was placed as paint: the source's values at every level at which the move is by whole pixels, ink included."""

from functools import cache

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from engine.canvas import layers
from engine.canvas.evaluate import evaluate
from engine.canvas.placing.bake import baked
from engine.canvas.placing.pose import Pose
from engine.canvas.store import Pyramid
from engine.numeric.address import Rect
from engine.painting import commands as c
from engine.painting.recording import Header
from engine.painting.value import first_painting
from engine.session.session import Session
from engine.texture.placed import PlacedInk, oriented
from engine.texture.table import TextureError, from_key

INKS = ([], [{"texture": "rock", "colour": "#e0d0b0", "period": 24}], [{"texture": "stripes", "colour": "#102080"}])


@cache
def painted(grid=16, strokes=((0, 20, 1), (2, 9, 2), (-2, 7, 0), (3, 12, 1), (0, 8, 0))):
    session = Session(first_painting(Header(grid=grid)))
    for n, (level, radius, ink) in enumerate(strokes):
        points = [[(30 * n - 40) * 2.0**level, -20 * 2.0**level], [(25 - 9 * n) * 2.0**level, 60 * 2.0**level]]
        brush = {"radius": radius, "colour": f"#{30 * n + 20:02x}5070", "ink": INKS[ink], "opacity": 0.8}
        session.do(c.parse({"do": "stroke", "level": level, "points": points, "brush": brush}))
    return next(iter(layers.layers(session.painting.root))).pyramid


poses = st.builds(
    Pose,
    at=st.tuples(st.integers(-99, 99), st.integers(-99, 99)),
    level=st.integers(-3, 2),
    levels=st.integers(-2, 2),
    turn=st.integers(0, 3),
    mirror=st.booleans(),
)


def values(planes):
    """By ink, told by what it is in the source, and the colours; those that are zero all over left out."""
    out = {"colour": planes.data[:4]}
    for i, ink in enumerate(planes.inks):
        plane = planes.data[4 + 3 * i : 7 + 3 * i]
        if plane.any():
            out[ink.inner.key if isinstance(ink, PlacedInk) else ink.key] = plane
    return out


def compare(pyramid, made, similarity, level, rect):
    at = level + similarity.quarter[0]
    source = values(evaluate(pyramid, at, similarity.inverse().shown(rect, level, at)))
    found = values(evaluate(made, level, rect))
    assert set(source) == set(found)
    for name, planes in source.items():
        np.testing.assert_array_equal(found[name], oriented(planes, similarity))
    return found["colour"].any()


@settings(deadline=None, max_examples=20)
@given(poses)
def test_at_every_aligned_level_it_is_the_source(pose):
    similarity = pose.similarity
    made = baked(painted(), similarity)
    aligned = similarity.aligned_from
    first = min(made.levels) if aligned is None else aligned
    for level in range(max(first, -4), 7):
        around = similarity.shown(Rect(-130, -130, 190, 190), 0, level)
        middle = Rect.at((around.x0 + around.x1) // 2 - 70, (around.y0 + around.y1) // 2 - 60, 140, 120)
        painted_there = compare(painted(), made, similarity, level, middle)
        assert painted_there or level > 2


@pytest.mark.parametrize("grid", [16, 12])
def test_a_move_by_large_powers_of_two_moves_every_record(grid):
    pyramid = painted(grid)
    similarity = Pose(at=(1 << 40, -(1 << 40)), turn=1).similarity
    made = baked(pyramid, similarity)
    assert sorted(made.levels) == sorted(pyramid.levels)
    for level in range(min(made.levels), 4):
        rect = similarity.shown(Rect(-200, -200, 200, 200).zoomed(level), level, level)
        compare(
            pyramid, made, similarity, level, rect if level < 1 else Rect.at(rect.x0 + 100, rect.y0 + 100, 200, 200)
        )


def test_a_move_by_single_pixels_is_exact_on_the_coarse_grid():
    pyramid = painted(12)
    for pose in (Pose(at=(5, 3)), Pose(at=(-7, 1), level=1, turn=1), Pose(at=(1, 1), level=-1, mirror=True)):
        similarity = pose.similarity
        made = baked(pyramid, similarity)
        for level in range(similarity.aligned_from or 0, 4):
            around = similarity.shown(Rect(-130, -130, 190, 190), 0, level)
            middle = Rect.at((around.x0 + around.x1) // 2 - 70, (around.y0 + around.y1) // 2 - 60, 140, 120)
            compare(pyramid, made, similarity, level, middle)


def test_nothing_stays_nothing():
    assert not baked(Pyramid(), Pose(at=(3, 4)).similarity).levels


def test_one_that_was_placed_is_placed_by_both():
    first, second = Pose(at=(6, -2), turn=1).similarity, Pose(at=(-9, 5), levels=1, mirror=True).similarity
    once, twice = baked(painted(), first.then(second)), baked(baked(painted(), first), second)
    for level in (0, 2, 5):
        rect = second.shown(first.shown(Rect(-40, -40, 60, 60), 0, 0), 0, 0).zoomed(level)
        rect = Rect.at(rect.x0, rect.y0, 150, 120)
        one, other = values(evaluate(once, level, rect)), values(evaluate(twice, level, rect))
        assert set(one) == set(other)
        for name, planes in one.items():
            np.testing.assert_array_equal(planes, other[name])


def test_a_key_tells_the_texture():
    levels = baked(painted(), Pose(at=(3, 1), turn=3).similarity).levels
    inks = {ink for level in levels.values() for record in level.values() for ink in record.inks}
    assert inks
    for ink in inks:
        assert isinstance(ink, PlacedInk)
        assert from_key(list(ink.key), {}) == ink


@pytest.mark.parametrize(
    "told",
    [
        ["placed", 0, [1, 0, 0, 0, 0, 0, 0]], ["placed", 0, [1, 1, 0, 0, 0, 0, 0], ["white", 0]],
        ["placed", 0, [1, 0, 0, 1, 0, 3, 0], ["white", 0]], ["placed", -4, [1, 0, 0, 0, 0, 0, 0], ["white", 0]],
        ["placed", 0, [1, 0, 0, 0, 0, 0, 2], ["white", 0]], ["placed", 0, "x", ["white", 0]],
        ["placed", 0, [1, 0, 1 << 20, 0, 0, 0, 0], ["white", 0]],
        ["placed", 0, [1, 0, 0, 0, 0, 0, 0], ["placed", 0, [1, 0, 0, 0, 0, 0, 0], ["white", 0]]],
    ],
)  # fmt: skip
def test_a_key_that_cannot_be_is_told(told):
    with pytest.raises(TextureError):
        from_key(told, {})
