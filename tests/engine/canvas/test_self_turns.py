"""Pictures that contain themselves: as the same turns built by hand, at any depth, whatever is asked for with them."""

from contextlib import contextmanager
from dataclasses import replace
from functools import cache
from unittest.mock import patch

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from engine.canvas.composite import composite
from engine.canvas.layers import EMPTY, Group, layers
from engine.canvas.placing import self_copies
from engine.canvas.placing.composite_steps import Planned
from engine.canvas.placing.placement import Placement
from engine.canvas.placing.portions import Portions
from engine.canvas.placing.pose import Pose, SourcePart
from engine.canvas.reading import kept_planes, layer_planes
from engine.canvas.tile_cache import TileCache
from engine.numeric.address import Rect
from engine.numeric.similarity import Dyadic
from engine.painting import commands as c
from engine.session.session import Session

FRAME = SourcePart(0, Rect(0, 0, 128, 128))
POSES = {
    "half": Pose(at=(30, 48), levels=-1),
    "quarter": Pose(at=(64, 40), levels=-2, turn=1),
    "mirrored": Pose(at=(96, 30), levels=-1, mirror=True),
    "spiral": Pose(at=(50, 20), turned=(0.9, 0.41), levels=-1),
    "sticks out": Pose(at=(-30, 40), levels=-1),
}


@cache
def painted():
    """A layer that fills the frame, and one with a little paint."""
    session = Session()
    for command in ({"do": "layer", "add": "a"}, {"do": "layer", "add": "b"}):
        session.do(c.parse(command))
    brush = {"radius": 90, "colour": "#406080", "hardness": 1}
    for layer, points, colour in (
        ("a", [[-20, 64], [150, 64]], {}),
        ("a", [[10, 20], [120, 30]], {"radius": 9, "colour": "#e04020"}),
        ("b", [[5, 5], [40, 12]], {"radius": 6, "colour": "#20c060"}),
        ("b", [[100, 120], [120, 100]], {"radius": 4, "colour": "#f0f010", "opacity": 0.5}),
    ):
        session.do(c.parse({"do": "stroke", "layer": layer, "points": points, "brush": {**brush, **colour}}))
    found = {layer.name: layer for layer in layers(session.painting.root)}
    return found["a"], found["b"]


def picture(root, level, rect):
    return composite(root, level, rect, layer_planes)


def itself(pose, below=1.0, above=None, **more):
    a, b = painted()
    over = () if above is None else (replace(b, opacity=above),)
    return replace(
        EMPTY, children=(replace(a, opacity=below), Placement(90, "itself", pose=pose, part=FRAME, **more), *over)
    )


def by_hand(pose, turns, below=1.0, above=None, **more):
    """As many turns as groups in one another."""
    a, b = painted()
    held = [replace(a, visible=False), replace(b, visible=False)]
    for n in range(turns + 1):
        inner = [Placement(200 + n, f"turn {n}", of=300 + n - 1, pose=pose, part=FRAME, **more)] if n else []
        over = [] if above is None else [Placement(400 + n, f"b {n}", of=b.id, opacity=above)]
        one = Placement(100 + n, f"a {n}", of=a.id, opacity=below)
        held.append(Group(300 + n, f"g {n}", visible=n == turns, children=(one, *inner, *over)))
    return replace(EMPTY, children=tuple(held))


def fixed(pose, level):
    """A pixel of a level at the place that a pose leaves where it is."""
    place = Dyadic(0, 0)
    for _ in range(level + 60):
        place = pose.similarity(place)
        drop = max(0, place.e - level - 40)
        place = Dyadic.of(place.x >> drop, place.y >> drop, place.e - drop)
    shift = place.e - level
    return place.x >> shift if shift > 0 else place.x << -shift, place.y >> shift if shift > 0 else place.y << -shift


@pytest.mark.parametrize("name", POSES)
@pytest.mark.parametrize(("below", "above"), [(1.0, None), (1.0, 0.8), (0.6, 1.0)])
def test_it_is_as_the_turns_built_by_hand(name, below, above):
    pose = POSES[name]
    x, y = fixed(pose, 4)
    rect = Rect.at(x - 100, y - 90, 190, 75)  # nearer to the middle turns are too small for their rims to be the same
    found = picture(itself(pose, below, above), 4, rect)
    plain = picture(by_hand(pose, 9, below, above), 4, rect)
    assert found.any()
    if name == "spiral":  # a group is sampled as one, its layers are not: rims differ by parts of a pixel
        assert np.abs(found - plain).mean() < 2e-3
    else:
        np.testing.assert_allclose(found, plain, atol=5e-4)


@pytest.mark.parametrize("name", ["half", "quarter", "mirrored"])
def test_opaque_turns_are_those_built_by_hand_to_the_bit(name):
    pose = POSES[name]
    x, y = fixed(pose, 5)
    for rect in (Rect.at(x - 900, y - 500, 500, 200), Rect.at(x + 100, y + 90, 300, 130)):
        np.testing.assert_array_equal(picture(itself(pose), 5, rect), picture(by_hand(pose, 9), 5, rect))


@pytest.mark.parametrize("more", [{"opacity": 0.5}, {}])
def test_a_turn_that_is_not_opaque_shows_those_around_it(more):
    pose = POSES["half"]
    x, y = fixed(pose, 4)
    rect = Rect.at(x - 100, y - 90, 190, 75)
    found = picture(itself(pose, 0.5, 0.5, **more), 4, rect)
    plain = picture(by_hand(pose, 9, 0.5, 0.5, **more), 4, rect)
    assert found[3].min() > 0.45
    np.testing.assert_allclose(found, plain, atol=5e-4)


def as_seen(pixels, pose):
    """Pixels of a source as they lie where a pose shows them."""
    if pose.mirror:
        pixels = pixels[:, :, ::-1]
    return np.rot90(pixels, -pose.turn, axes=(1, 2))


@settings(deadline=None, max_examples=12)
@given(
    st.sampled_from(["half", "quarter", "mirrored"]),
    st.sampled_from([4, 9, 30, 333, 1000]),
    st.tuples(st.integers(-200, 200), st.integers(-200, 200)),
)
def test_a_turn_deeper_it_is_the_same_to_the_bit(name, level, by):
    pose = POSES[name]
    x, y = fixed(pose, level)
    rect = Rect.at(x + by[0] - 75, y + by[1] - 45, 150, 90)
    deeper = pose.similarity.shown(rect, level, level - pose.levels)
    root = itself(pose)
    found = picture(root, level, rect)
    assert found.any()
    np.testing.assert_array_equal(as_seen(found, pose), picture(root, level - pose.levels, deeper))


@settings(deadline=None, max_examples=15)
@given(
    st.sampled_from(sorted(POSES)),
    st.sampled_from([0, 3, 40]),
    st.sampled_from([(1.0, None), (0.4, None), (1.0, 0.7), (0.5, 0.5)]),
    st.integers(0, 90),
    st.integers(0, 60),
)
def test_a_pixel_does_not_depend_on_what_else_was_asked_for(name, level, shares, left, top):
    root, (x, y) = itself(POSES[name], *shares), fixed(POSES[name], level)
    whole = Rect.at(x - 70, y - 60, 140, 110)
    part = Rect.at(whole.x0 + left, whole.y0 + top, 43, 50)
    one = picture(root, level, whole)
    np.testing.assert_array_equal(picture(root, level, part), one[:, *part.slices(whole)])


def test_what_is_read_in_kept_tiles_is_the_same():
    a, b = painted()
    cached = TileCache(1 << 24)
    for layer in (a, b):
        for level, rect in ((0, Rect(-30, 3, 170, 111)), (2, Rect(77, -300, 600, 400)), (0, Rect(-30, 3, 170, 111))):
            found, plain = kept_planes(layer, level, rect, cached), layer_planes(layer, level, rect)
            assert plain is not None
            np.testing.assert_array_equal(found, plain)
    assert kept_planes(b, 0, Rect(5000, 5000, 5300, 5300), cached) is None


def test_what_cuts_through_tiles_is_kept_as_it_is_and_follows_strokes():
    (a, b), cached, session = painted(), TileCache(1 << 24), Session()
    session.painting = replace(session.painting, root=replace(EMPTY, children=(a, b)))
    places = [Rect(-101, 3, 155, 230), Rect(-100, 0, 156, 230), Rect(-101, 3, 155, 230), Rect(155, 3, 200, 150)]
    for points in (None, [[0, 0], [90, 90]], [[300, 5], [140, 80]]):
        if points is not None:
            session.do(c.parse({"do": "stroke", "layer": "a", "level": -1, "points": points, "brush": {"radius": 9}}))
        layer = next(layers(session.painting.root))
        for rect in places:
            found, plain = kept_planes(layer, 1, rect, cached), layer_planes(layer, 1, rect)
            np.testing.assert_array_equal(0 if found is None else found, 0 if plain is None else plain)


_SIDES = st.sampled_from([-128, -60, 0, 3, 128, 131, 256])


@given(st.lists(st.tuples(st.integers(0, 1), _SIDES, _SIDES, st.sampled_from([64, 128, 200, 256])), max_size=6))
@settings(max_examples=40, deadline=None)
def test_what_was_kept_of_one_rectangle_is_never_taken_for_another(asked):
    (a, _), cached = painted(), TileCache(1 << 24)
    for level, left, top, side in ((0, -60, -60, 256), *asked, (0, 0, 0, 128)):
        rect = Rect.at(left, top, side, side)
        found, plain = kept_planes(a, level, rect, cached), layer_planes(a, level, rect)
        np.testing.assert_array_equal(0 if found is None else found, 0 if plain is None else plain)


def test_far_below_all_paint_nothing_is_told_by_what_is_stored():
    _, b = painted()
    cached = TileCache(1 << 24)
    for level in (5, 9, 40):
        for x in (-200, 5 << level, (37 << level) + 9, 127 << level):
            for y in (5 << level, (46 << level) + 3, 110 << level):
                rect = Rect.at(x, y, 90, 40)
                found, plain = layer_planes(b, level, rect, cached), layer_planes(b, level, rect)
                np.testing.assert_array_equal(0 if found is None else found, 0 if plain is None else plain)


def copied(poses, opacity=0.7):
    """Several copies of all, and a layer over them."""
    a, _ = painted()
    a = replace(a, opacity=opacity)
    copies = (Placement(90 + n, f"copy {n}", pose=pose, part=FRAME) for n, pose in enumerate(poses))
    return replace(EMPTY, children=(*copies, a))


def plainly(poses, level, rect):
    """Every copy of a copy on its own."""
    out = np.zeros((4, rect.height, rect.width), np.float32)
    for pose in poses if level > -2 else ():
        part = pose.similarity.shown(FRAME.rect, 0, level).intersect(rect)
        if not part.empty:
            source = pose.similarity.inverse().shown(part, level, level + pose.levels)
            pixels = as_seen(plainly(poses, level + pose.levels, source), pose)
            there = out[:, *part.slices(rect)]
            there[:] = pixels + (np.float32(1) - pixels[3]) * there
    over = composite(replace(EMPTY, children=(replace(painted()[0], opacity=0.7),)), level, rect, layer_planes)
    return over + (np.float32(1) - over[3]) * out


@pytest.mark.parametrize(
    "poses",
    [
        [Pose(at=(64 * x, 64 * y), levels=-1) for x in (0, 1) for y in (0, 1)],
        [Pose(at=(0, 0), levels=-1), Pose(at=(128, 0), levels=-1, turn=1), Pose(at=(48, 64), levels=-2, mirror=True)],
        [Pose(at=(8, 16), levels=-1), Pose(at=(32, 48), levels=-1)],
    ],
)
def test_several_copies_are_as_every_copy_of_a_copy_on_its_own(poses):
    root, rect = copied(poses), Rect(90, 30, 400, 290)
    found = picture(root, 2, rect)
    assert found.any()
    # Plainly, copies of the fifth turn and beyond are left out: less than a hundredth of a pixel is left of them.
    away = np.abs(found - plainly(poses, 2, rect))
    assert np.median(away) < 4e-3
    assert np.quantile(away, 0.95) < 0.03
    part = Rect(100, 40, 230, 111)
    np.testing.assert_array_equal(picture(root, 2, part), found[:, *part.slices(rect)])


@pytest.mark.parametrize("isolated", [False, True])
@pytest.mark.parametrize("name", POSES)
def test_a_placement_within_a_group_shows_the_picture_that_the_group_is_in(name, isolated):
    """At the level where all is painted it is the same as without the group; at others it comes to an end."""
    a, b = painted()
    inner = Group(80, "g", children=(b, Placement(90, "itself", pose=POSES[name], part=FRAME)), isolated=isolated)
    root = replace(EMPTY, children=(a, inner))
    flat = replace(EMPTY, children=(a, *inner.children))
    for level in (-7, -2, 0, 3):
        rect = Rect.at(0, 0, 128, 128).zoomed(level).grown(2)
        apart = np.abs(picture(root, level, rect) - picture(flat, level, rect))
        assert apart.mean() < 0.01


SPREAD = {
    "four": [Pose(at=(64 * x, 64 * y), levels=-1) for x in (0, 1) for y in (0, 1)],
    "three": [Pose(at=(0, 0), levels=-1), Pose(at=(128, 0), levels=-1, turn=1), Pose(at=(48, 64), levels=-2)],
    "over one another": [Pose(at=(8, 16), levels=-1), Pose(at=(32, 48), levels=-1, mirror=True)],
    "turned": [Pose(at=(8, 16), levels=-1, turned=(0.9, 0.41)), Pose(at=(32, 48), levels=-1)],
}


def a_turn_at_a_time(poses, opacity, level, rect):
    """What the picture is by what it is farther out: each copy of it, and a layer over them."""
    out = np.zeros((4, rect.height, rect.width), np.float32)
    for pose in poses:
        part = pose.similarity.shown(FRAME.rect, 0, level).intersect(rect)
        if not part.empty:
            source = pose.similarity.inverse().shown(part, level, level + pose.levels)
            pixels = as_seen(picture(copied(poses, opacity), level + pose.levels, source), pose)
            there = out[:, *part.slices(rect)]
            there[:] = pixels + (np.float32(1) - pixels[3]) * there
    over = picture(replace(EMPTY, children=(replace(painted()[0], opacity=opacity),)), level, rect)
    return over + (np.float32(1) - over[3]) * out


@settings(deadline=None, max_examples=7)
@given(
    st.sampled_from(["four", "three", "over one another"]),
    st.sampled_from([3, 5, 9, 20, 60, 333]),
    st.tuples(st.integers(-100, 100), st.integers(-100, 100)),
)
def test_several_copies_at_any_depth_are_copies_of_what_is_farther_out(name, level, by):
    x, y = fixed(SPREAD[name][-1], level)
    rect = Rect.at(x + by[0], y + by[1], 60, 40)
    found = picture(copied(SPREAD[name]), level, rect)
    assert found.any()
    np.testing.assert_allclose(found, a_turn_at_a_time(SPREAD[name], 0.7, level, rect), atol=2e-3)


@settings(deadline=None, max_examples=7)
@given(
    st.sampled_from(sorted(SPREAD)),
    st.sampled_from([0, 3, 8, 60, 1000]),
    st.sampled_from([0.05, 0.7]),
    st.integers(0, 90),
    st.integers(0, 60),
)
def test_a_pixel_of_several_copies_does_not_depend_on_what_else_was_asked_for(name, level, opacity, left, top):
    root, (x, y) = copied(SPREAD[name], opacity), fixed(SPREAD[name][0], level)
    whole = Rect.at(x - 70, y - 60, 140, 110)
    part = Rect.at(whole.x0 + left, whole.y0 + top, 43, 50)
    with fewer():
        one = picture(root, level, whole)
        np.testing.assert_array_equal(picture(root, level, part), one[:, *part.slices(whole)])


@contextmanager
def fewer():
    """Tiles are made of a few pieces at most, which is soon done."""
    with patch.object(self_copies, "MOST_READS", 24), patch.object(self_copies, "MOST_PIECES", 200):
        yield


@pytest.mark.parametrize("level", [60, 1000, 4000])
def test_a_tile_of_copies_over_one_another_is_made_of_few_pieces(level):
    poses = [Pose(at=(30, 30), levels=-1), Pose(at=(33, 35), levels=-1)]
    a, _ = painted()
    reads = []

    def read(layer, at, rect):
        reads.append(at)
        return layer_planes(layer, at, rect)

    x, y = fixed(poses[0], level)
    with fewer():
        found = composite(copied(poses, 0.02), level, Rect.at(x, y, 20, 20), read)
    assert len(reads) < 1 + 2 * 4 * 3 * 24  # by each copy four tiles, each tried, made of less, and of small ones
    assert min(reads) < level - 4  # it goes inwards nevertheless
    mean = picture(replace(EMPTY, children=(a,)), -7, Rect(0, 0, 1, 1))
    assert mean.any()
    np.testing.assert_allclose(found[:3] / found[3], np.broadcast_to(mean[:3] / mean[3], found[:3].shape), atol=0.2)


def test_a_turned_copy_is_nothing_far_beside_its_frame():
    root, pose = copied(SPREAD["turned"]), SPREAD["turned"][0]
    around = pose.similarity.shown(FRAME.rect, 0, 300)
    corner = Rect.at(around.x0, around.y0, 40, 40)
    alone = replace(EMPTY, children=root.children[-1:])
    np.testing.assert_array_equal(picture(root, 300, corner), picture(alone, 300, corner))


@pytest.mark.parametrize(
    ("more", "parts", "within"),
    [
        ({"above": 0.03}, 4, False),
        ({"below": 0.05}, 4, True),
        ({"opacity": 0.95}, 4, False),
        ({"below": 0.05, "above": 0.03}, 8, True),
    ],
)
def test_turns_that_are_gone_on_with_come_to_the_same_to_the_bit(more, parts, within):
    """Also those of a picture shown in another; what there is at first is near to it."""
    pose, level = POSES["half"], 150
    x, y = fixed(pose, level)
    over = {} if "above" not in more else {"above": 1.0}
    root = itself(pose, **{**more, **over})
    if over:  # paint over the place that all turns share
        session = Session()
        session.do(c.parse({"do": "layer", "add": "c"}))
        at = [coordinate * 2.0**-level for coordinate in (x, y)]
        thin = {"radius": 40, "opacity": more["above"], "colour": "#e0a020", "hardness": 1}
        session.do(c.parse({"do": "stroke", "layer": "c", "points": [at, [at[0] + 1, at[1]]], "brush": thin}))
        glaze = replace(next(layers(session.painting.root)), id=95, name="c")
        root = replace(root, children=(*root.children[:-1], glaze))
    if within:
        inner = Group(
            80,
            "g",
            visible=False,
            children=tuple(replace(one, of=80) if isinstance(one, Placement) else one for one in root.children),
        )
        root = replace(EMPTY, children=(inner, Placement(81, "shown", of=80)))
    rect = Rect.at(x - 20, y - 12, 40, 24)
    complete, portions = picture(root, level, rect), Portions(10)
    planned = Planned.of(root, None, portions)
    made = []
    while not made or not made[-1][1]:
        made.append(portions.picture(lambda: composite(planned, level, rect, layer_planes)))
    assert len(made) >= parts
    assert complete.any()
    np.testing.assert_array_equal(made[-1][0], complete)
    first = np.abs(made[0][0] - complete).mean()
    assert 0 < first < 0.7 * np.abs(complete).mean() + 0.1
    np.testing.assert_array_equal(picture(planned, level, rect), complete)  # all at once, as exports


@pytest.mark.parametrize(
    ("name", "level", "within"), [("over one another", 60, False), ("turned", 6, False), ("four", 9, True)]
)
def test_several_copies_that_are_gone_on_with_come_to_the_same_to_the_bit(name, level, within):
    """Also where what holds them is shown elsewhere; no picture on the way does more than its portion."""
    root, (x, y) = copied(SPREAD[name], 0.4), fixed(SPREAD[name][0], level)
    if within:
        children = (replace(one, of=80) if isinstance(one, Placement) else one for one in root.children)
        inner = Group(80, "g", visible=False, children=tuple(children))
        root = replace(EMPTY, children=(inner, Placement(81, "shown", of=80)))
    rect, reads = Rect.at(x - 20, y - 12, 40, 24), []

    def read(layer, at, part):
        reads.append(at)
        return layer_planes(layer, at, part)

    with fewer():
        complete, portions = picture(root, level, rect), Portions(4)
        planned, made = Planned.of(root, None, portions), []
        while not made or not made[-1][1]:
            reads.clear()
            made.append(portions.picture(lambda: composite(planned, level, rect, read)))
            assert len(reads) <= 4 * (4 + 8 * 2)
        assert complete.any()
        assert len(made) >= 2
        np.testing.assert_array_equal(made[-1][0], complete)
        first = np.abs(made[0][0] - complete).mean()
        assert 0 < first < 0.7 * np.abs(complete).mean() + 0.1
        np.testing.assert_array_equal(picture(planned, level, rect), complete)


@pytest.mark.parametrize("name", ["half", "two"])
def test_a_group_that_holds_such_a_picture_is_kept_only_as_a_whole(name):
    """Its tiles are kept where there are many placements: what is gone on with would never come to its end."""
    root, level = (itself(POSES["half"], below=0.05), 40) if name == "half" else (copied(SPREAD["turned"], 0.4), 6)
    x, y = fixed(POSES["half"] if name == "half" else SPREAD["turned"][0], level)
    inner = (replace(one, of=80) if isinstance(one, Placement) else one for one in root.children)
    holder = Group(83, "holder", visible=False, children=(Placement(84, "in it", of=80),))
    many = (Placement(200 + n, f"many {n}", of=83, visible=n == 0) for n in range(33))
    root = replace(EMPTY, children=(Group(80, "g", visible=False, children=tuple(inner)), holder, *many))
    rect, portions = Rect.at(x - 40, y - 32, 80, 64), Portions(4)
    with fewer():
        complete = picture(root, level, rect)
        planned, made = Planned.of(root, None, portions), []
        while not made or not made[-1][1]:
            made.append(portions.picture(lambda: composite(planned, level, rect, layer_planes)))
        assert complete.any()
        np.testing.assert_array_equal(made[-1][0], complete)
        np.testing.assert_array_equal(picture(planned, level, rect), complete)
