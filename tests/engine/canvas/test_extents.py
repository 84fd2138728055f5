"""Where what is shown many times lies is told: what lies beside is left out, and no pixel is another one for it."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from engine.canvas import layers
from engine.canvas.composite import composite
from engine.canvas.layers import EMPTY, Group, Layer
from engine.canvas.node_checks import LayerError
from engine.canvas.placing import composite_steps, loops
from engine.canvas.placing.composite_steps import Planned
from engine.canvas.placing.placement import Placement
from engine.canvas.placing.pose import Pose, SourcePart
from engine.canvas.placing.shared.extents import painted_at
from engine.canvas.reading import layer_planes
from engine.numeric.address import Rect
from engine.painting import commands as c
from engine.session.session import Session

PLACE = st.integers(-900, 900)
AT = st.tuples(PLACE, PLACE)


@pytest.fixture(scope="module")
def tree():
    session = Session()
    for command in (
        {"do": "layer", "add": "tree"},
        {"do": "stroke", "layer": "tree", "points": [[10, 10], [40, 60]], "brush": {"radius": 9}},
        {"do": "stroke", "layer": "tree", "level": 3, "points": [[130, 130], [140, 160]], "brush": {"radius": 4}},
        {"do": "stroke", "layer": "tree", "mode": "erase", "points": [[20, 10], [20, 60]], "brush": {"radius": 5}},
    ):
        session.do(c.parse(command))
    return session.painting.root.children[0]


def poses():
    quarter = st.builds(
        Pose,
        AT,
        st.integers(-2, 2),
        st.integers(-2, 2),
        st.integers(0, 3),
        mirror=st.booleans(),
    )
    turned = st.builds(Pose, AT, turned=st.sampled_from([(0.6, 0.8), (0.7, 0.1)]))
    return st.one_of(quarter, turned)


def forest(tree, poses, woods):
    trees = [Placement(1000 + i, f"t{i}", of=tree.id, pose=pose) for i, pose in enumerate(poses)]
    trees[0] = replace(trees[0], part=SourcePart(0, Rect(0, 5, 30, 50)))
    wood = Group(900, "wood", children=(*trees, Layer(901, "empty")))
    placed = [Placement(2000 + i, f"w{i}", of=900, pose=pose) for i, pose in enumerate(woods)]
    return loops.checked(replace(EMPTY, children=(replace(tree, visible=False), wood, *placed)))


@settings(max_examples=12, deadline=None)
@given(st.lists(poses(), min_size=2, max_size=4), st.lists(poses(), min_size=1, max_size=3), st.integers(-4, 3), AT)
def test_what_is_left_out_is_not_seen(tree, trees, woods, level, at):
    root = forest(tree, trees, woods)
    rect = Rect.at(*(v << 4 >> (4 - level) for v in at), 150, 110)
    expected = composite(root, level, rect, layer_planes)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(composite_steps, "_MANY", 1)
        plan = Planned.of(root)
        found = composite(plan, level, rect, layer_planes)
        again = composite(plan, level, rect, layer_planes)
    assert np.array_equal(found, expected)
    assert np.array_equal(again, expected)


@pytest.mark.parametrize("level", [-9, -3, 0, 2, 3, 4])
def test_nothing_lies_outside_the_extent_of_a_layer(tree, level):
    where = painted_at(tree, level)
    around = where.grown(60)
    pixels = layer_planes(tree, level, around)
    if pixels is not None:
        pixels = pixels.copy()
        pixels[:, *where.slices(around)] = 0
        assert not pixels.any()


def test_a_forest_may_be_large_and_reads_only_what_is_seen(tree):
    at = [(300 * (i % 10), 300 * (i // 10)) for i in range(100)]
    root = forest(tree, [Pose(place, 0) for place in at], [Pose((10 * x, 10 * y), 0) for x, y in at])  # 30,300 to draw
    reads = []

    def read(layer, level, rect):
        reads.append(layer)
        return layer_planes(layer, level, rect)

    pixels = composite(root, 0, Rect.at(9000, 9000, 128, 128), read)
    assert pixels[3].max() == 1
    assert len(reads) < 20


def test_a_loop_is_bounded_as_before(tree):
    trees = [Placement(1000 + i, f"t{i}", of=tree.id) for i in range(5000)]
    half = Placement(900, "half", of=None, pose=Pose(levels=-1), part=SourcePart(0, Rect(0, 0, 64, 64)))
    assert loops.checked(replace(EMPTY, children=(tree, *trees)))
    with pytest.raises(LayerError, match=r"found 10,\d+ layers and placements to draw in it, expected at most 8,192"):
        loops.checked(replace(EMPTY, children=(tree, *trees, half)))


def test_a_stroke_in_progress_may_reach_anywhere(tree):
    """It is read from the layer, which does not tell of it yet."""
    root = forest(tree, [Pose((9, 9), 0)] * 40, [Pose((700, 700), 0)])
    painted = layers.find(root, "tree")

    def read(layer, level, rect):
        return np.ones((4, rect.height, rect.width), np.float32) if layer is painted else None

    pixels = composite(Planned.of(root, painted=painted.id), 0, Rect.at(3000, 3000, 64, 64), read)
    assert pixels[3].min() == 1
