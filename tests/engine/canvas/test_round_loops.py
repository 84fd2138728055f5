"""Pictures that contain themselves in a group, behind a mask, or round about others: as each turn of what is farther
out, at any depth, and each tile of them once."""

from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from unittest.mock import patch

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from test_self_turns import FRAME, POSES, as_seen, fixed, painted, picture

from engine.canvas import composite as compositing
from engine.canvas.composite import composite
from engine.canvas.layers import EMPTY, Alone, Group, Layer, find, walk
from engine.canvas.placing.composite_steps import Planned
from engine.canvas.placing.placement import Placement
from engine.canvas.placing.portions import Portions
from engine.canvas.placing.pose import Pose, SourcePart
from engine.canvas.reading import layer_planes
from engine.canvas.selecting.selection import Selection
from engine.numeric.address import Rect

HALF, QUARTER = POSES["half"], POSES["quarter"]


def itself(number, of=None, pose=HALF, part=FRAME, **more):
    return Placement(number, f"copy {number}", of=of, pose=pose, part=part, **more)


def grouped(pose=HALF, **more):
    """A group over a layer, with a copy of all in it."""
    a, b = painted()
    return replace(EMPTY, children=(a, Group(80, "g", children=(b, itself(90, pose=pose)), **more)))


def masked(pose=HALF, inverse=False):
    """The same behind a mask that hides a corner of the group, or all but that corner."""
    return grouped(pose, mask=Selection(painted()[1].pyramid, not inverse))


def round_about(pose=HALF, more=()):
    """A shows B as large as it is, B shows A smaller."""
    a, b = painted()
    to_b = itself(51, 60, Pose(at=(10, 10)), SourcePart(0, Rect(-10, -10, 118, 118)))
    whole = Group(50, "A", children=(a, to_b))
    return replace(EMPTY, children=(whole, Group(60, "B", children=(b, itself(61, 50, pose), *more), opacity=0.6)))


def behind_its_own(pose=HALF, inverse=False):
    """A layer that a copy of all lies over, and shows through a mask on the copy: all but a corner, or just that."""
    a, b = painted()
    return replace(EMPTY, children=(a, itself(90, pose=pose, mask=Selection(b.pyramid, not inverse))))


def below_paint(pose=HALF, **more):
    """The same with a layer over all, which is masked, too."""
    root = behind_its_own(pose)
    over = replace(painted()[1], opacity=0.8, mask=Selection(painted()[0].pyramid))
    return replace(root, children=(root.children[0], replace(root.children[1], **more), over))


TREES = {
    "in a group": grouped,
    "in a thin group": lambda pose: grouped(pose, opacity=0.7),
    "in a group and thin itself": lambda pose: replace(
        grouped(), children=(painted()[0], Group(80, "g", children=(itself(90, pose=pose, opacity=0.5),)))
    ),
    "behind a mask": masked,
    "within a mask": lambda pose: masked(pose, inverse=True),
    "behind a mask of its own": behind_its_own,
    "within a mask of its own": lambda pose: behind_its_own(pose, inverse=True),
    "behind a mask of its own, below paint": lambda pose: below_paint(pose),
    "thin behind a mask of its own": lambda pose: below_paint(pose, opacity=0.6),
    "round about": round_about,
    "round about twice": lambda pose: round_about(pose, (itself(62, 50, Pose(at=(60, 50), levels=-2, turn=1)),)),
    "beside a copy": lambda pose: replace(round_about(pose), children=(*round_about(pose).children, itself(70, 50))),
}


def at_once(root, level, rect):
    """What the picture is by what copies show of it farther out: they are layers of that."""
    copies = {one.id: one for one in walk(root) if isinstance(one, Placement)}

    def plain(node):
        if isinstance(node, Placement):
            return Layer(node.id, node.name, opacity=node.opacity, mask=node.mask)
        return replace(node, children=tuple(map(plain, node.children))) if isinstance(node, Group) else node

    def read(layer, level, rect):
        if layer.id not in copies:
            return layer_planes(layer, level, rect)
        one = copies[layer.id]
        part = one.pose.similarity.shown(one.part.rect, one.part.level, level).intersect(rect)
        if part.empty:
            return None
        source = one.pose.similarity.inverse().shown(part, level, level + one.pose.levels)
        out = np.zeros((4, rect.height, rect.width), np.float32)
        out[:, *part.slices(rect)] = as_seen(picture(shown(root, one), level + one.pose.levels, source), one.pose)
        return out

    return composite(plain(root), level, rect, read)


def shown(root, one):
    """A tree of what a copy shows."""
    if one.of is None:
        return root
    node = next(node for node in walk(root) if node.id == one.of)
    return Alone(0, "root", children=(replace(node, opacity=1.0),), tree=root)


@settings(deadline=None, max_examples=8)
@given(
    st.sampled_from(sorted(TREES)),
    st.sampled_from(["half", "quarter", "mirrored"]),
    st.sampled_from([1, 4, 9, 40, 333, 1000]),
    st.tuples(st.integers(-60, 60), st.integers(-60, 60)),
)
def test_a_turn_is_what_lies_farther_out(name, pose, level, by):
    root = TREES[name](POSES[pose])
    x, y = fixed(POSES[pose], level)
    rect = Rect.at(x + by[0], y + by[1], 50, 40)
    found = picture(root, level, rect)
    assert found.any()
    np.testing.assert_allclose(found, at_once(root, level, rect), atol=4e-3)


@settings(deadline=None, max_examples=4)
@given(
    st.sampled_from(["half", "quarter", "mirrored"]),
    st.sampled_from([4, 40, 1000]),
    st.integers(1, 3),
    st.tuples(st.integers(-60, 60), st.integers(-60, 60)),
)
def test_turns_deeper_a_copy_behind_a_mask_is_the_same_to_the_bit(name, level, turns, by):
    pose = POSES[name]
    root, (x, y) = behind_its_own(pose), fixed(pose, level)
    there = Rect.at(x + by[0] - 25, y + by[1] - 20, 50, 40)
    seen = picture(root, level, there)
    assert seen.any()
    for _ in range(turns):
        there = pose.similarity.shown(there, level, level - pose.levels)
        level, seen = level - pose.levels, as_seen(seen, pose)
    np.testing.assert_array_equal(picture(root, level, there), seen)


@settings(deadline=None, max_examples=6)
@given(
    st.sampled_from(sorted(TREES)),
    st.sampled_from(sorted(POSES)),
    st.sampled_from([0, 3, 8, 200]),
    st.integers(0, 90),
    st.integers(0, 60),
)
def test_a_pixel_does_not_depend_on_what_else_was_asked_for(name, pose, level, left, top):
    root, (x, y) = TREES[name](POSES[pose]), fixed(POSES[pose], level)
    whole = Rect.at(x - 70, y - 60, 140, 110)
    part = Rect.at(whole.x0 + left, whole.y0 + top, 43, 50)
    one = picture(root, level, whole)
    np.testing.assert_array_equal(picture(root, level, part), one[:, *part.slices(whole)])


@pytest.mark.parametrize("name", ["in a thin group", "round about twice"])
def test_two_threads_see_what_one_sees(name):
    root, (x, y) = TREES[name](HALF), fixed(HALF, 6)
    parts = [Rect.at(x + 64 * i, y - 40 * j, 64, 40) for i in (-1, 0, 1) for j in (0, 1)]
    with ThreadPoolExecutor(2) as pool:
        together = list(pool.map(lambda part: picture(root, 6, part), parts))
    for part, found in zip(parts, together, strict=True):
        np.testing.assert_array_equal(found, picture(root, 6, part))


def test_each_tile_is_made_once_however_many_ways_lead_round():
    """A in B eight times, in each of which B is once more: 8^9 copies of copies."""
    more = tuple(itself(62 + n, 50, Pose(at=(16 * n, 8 * n), levels=-1)) for n in range(7))
    reads = []

    def read(layer, level, rect):
        reads.append(level)
        return layer_planes(layer, level, rect)

    composite(round_about(more=more), 3, Rect.at(300, 300, 100, 100), read)
    assert 0 < len(reads) < 4000


def test_what_a_mask_hides_of_a_copy_is_not_read():
    mask = replace(painted()[1], id=3)
    hidden = Group(80, "g", children=(itself(90),), mask=Selection(mask.pyramid))
    root = replace(EMPTY, children=(painted()[0], hidden))
    reads = []

    def read(layer, level, rect):
        reads.append(layer.name)
        return layer_planes(layer, level, rect)

    rect = Rect.at(500, 500, 90, 90)  # far from the mask's paint
    composite(root, 3, rect, read)
    assert sorted(set(reads)) == ["a", "g"]
    assert find(root, "copy 90").of is None


def test_what_lies_below_a_copy_is_not_read_where_its_mask_hides_nothing():
    root, (x, y) = behind_its_own(), fixed(HALF, 120)
    reads = []

    def read(layer, level, rect):
        reads.append(layer.name)
        return layer_planes(layer, level, rect)

    rect = Rect.at(x, y, 64, 64)
    found = composite(root, 120, rect, read)
    assert 0 < reads.count("a") < 30  # of 120 turns
    covers = compositing._covers
    with patch.object(
        compositing, "_covers", lambda step, source: not isinstance(source, list) and covers(step, source)
    ):
        np.testing.assert_array_equal(composite(root, 120, rect, layer_planes), found)  # read to the bottom


@pytest.mark.parametrize("tree", [behind_its_own, below_paint])
def test_a_masked_copy_is_read_as_often_at_any_depth(tree):
    counts = []
    for level in (40, 400):
        x, y = fixed(HALF, level)
        reads = []

        def read(layer, level, rect, reads=reads):
            reads.append(layer.name)
            return layer_planes(layer, level, rect)

        composite(tree(), level, Rect.at(x - 31, y - 23, 64, 64), read)
        counts.append(len(reads))
    assert counts[1] <= counts[0] + 6
    assert counts[0] < 80


@pytest.mark.parametrize("name", ["in a thin group", "round about twice", "behind a mask"])
def test_a_planned_picture_is_the_same_and_its_copies_are_made_once(name):
    root, (x, y) = TREES[name](HALF), fixed(HALF, 5)
    reads = []

    def read(layer, level, rect):
        reads.append(level)
        return layer_planes(layer, level, rect)

    planned, rect = Planned.of(root), Rect.at(x - 64, y - 40, 64, 40)
    for part in (rect, Rect.at(x, y, 64, 40), rect):
        np.testing.assert_array_equal(composite(planned, 5, part, read), picture(root, 5, part))
    before = len(reads)
    composite(planned, 5, rect, read)
    again = len(reads) - before
    assert again < before / 8


@pytest.mark.parametrize("masked", [False, True])
def test_a_stroke_in_progress_is_seen_however_deep(masked):
    """It lies on a layer above the copy, or on the copy's mask: neither is what is stored of it."""
    a, b = painted()
    mask = Selection(b.pyramid, inverse=True) if masked else None
    over = () if masked else (b,)
    root, (x, y) = replace(EMPTY, children=(a, itself(90, mask=mask), *over)), fixed(HALF, 60)
    rect, number = Rect.at(x - 20, y - 20, 40, 40), -90 if masked else b.id

    def read(layer, level, rect):
        if layer.id != number:
            return layer_planes(layer, level, rect)
        return np.full((4, rect.height, rect.width), 0.5, np.float32)

    seen = composite(Planned.of(root, painted=number), 60, rect, read)
    assert np.abs(seen - composite(root, 60, rect, layer_planes)).max() > 0.1


def test_turns_of_a_masked_copy_that_are_gone_on_with_come_to_the_same_to_the_bit():
    root, (x, y) = below_paint(opacity=0.95), fixed(HALF, 150)
    rect = Rect.at(x - 20, y - 12, 40, 24)
    complete, portions, made = picture(root, 150, rect), Portions(10), []
    planned = Planned.of(root, None, portions)
    while not made or not made[-1][1]:
        made.append(portions.picture(lambda: composite(planned, 150, rect, layer_planes)))
    assert len(made) >= 4
    assert 0 < np.abs(made[0][0] - complete).mean() < 0.7 * np.abs(complete).mean() + 0.1
    np.testing.assert_array_equal(made[-1][0], complete)
