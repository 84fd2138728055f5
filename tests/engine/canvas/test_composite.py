"""Compositing of whole trees against a plain recursion over whole pictures, and what is promised about blocks."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from engine.canvas import layers
from engine.canvas.composite import BLOCK, blocks, composite
from engine.canvas.layers import EMPTY, Group, Layer
from engine.canvas.placing.composite_steps import steps
from engine.numeric.address import Rect
from engine.numeric.blend import BLENDS, blend
from engine.numeric.grid import snapped

CANVAS = Rect(-200, -150, 120, 140)


def paint(seed):
    """A picture of CANVAS with empty, translucent and opaque places; premultiplied on the grid, not all displayable."""
    rng = np.random.default_rng(seed)
    coarse = rng.random((4, 6, 7)) * 1.6 - 0.3
    planes = np.kron(coarse, np.ones((1, 50, 50)))[:, : CANVAS.height, : CANVAS.width]
    alpha = np.clip(planes[3], 0, 1)
    return snapped(np.concatenate([planes[:3] * alpha, planes[3:]]))


class Pictures:
    """A reader of made-up layers that remembers which layers were read where."""

    def __init__(self, empty=()):
        self.empty = set(empty)
        self.asked = []
        self.kept = {}

    def picture(self, layer):
        if layer.id not in self.kept:
            self.kept[layer.id] = paint(layer.id)
            self.kept[layer.id].flags.writeable = False
        return self.kept[layer.id]

    def __call__(self, layer, level, rect):
        assert level == 3
        self.asked.append((layer.name, rect))
        if layer.name in self.empty:
            return None
        rows, columns = rect.slices(CANVAS)
        return self.picture(layer)[:, rows, columns]


def plainly(root, read):
    """The whole canvas, node by node, with nothing skipped: the definition."""

    def onto(backdrop, group):
        for node in group.children:
            if not node.visible:
                continue
            if isinstance(node, Group) and layers.passes_through(node):
                onto(backdrop, node)
                continue
            source = np.zeros_like(backdrop)
            if isinstance(node, Group):
                onto(source, node)
            elif node.name not in read.empty:
                source[:] = read.picture(node)
            blend(node.blend, backdrop, source, node.opacity)
        return backdrop

    return onto(np.zeros((4, CANVAS.height, CANVAS.width), np.float32), root)


def pile(*nodes):
    return layers.checked(Group(0, "root", children=nodes))


def test_nothing_to_show_is_transparent():
    read = Pictures()
    assert not composite(EMPTY, 3, CANVAS, read).any()
    assert not composite(pile(Layer(1, "a", visible=False), Group(2, "g")), 3, CANVAS, read).any()
    assert not read.asked


@pytest.mark.parametrize("op", BLENDS)
def test_every_operator_over_a_painted_layer(op):
    read = Pictures()
    root = pile(Layer(1, "a"), Layer(2, "b", opacity=0.8, blend=op), Layer(3, "c", opacity=0.5))
    assert np.array_equal(composite(root, 3, CANVAS, read), plainly(root, read))


@pytest.mark.parametrize("op", BLENDS)
def test_an_empty_layer_still_acts_where_the_operator_says_so(op):
    read = Pictures(empty={"b"})
    root = pile(Layer(1, "a"), Layer(2, "b", blend=op))
    assert np.array_equal(composite(root, 3, CANVAS, read), plainly(root, read))
    group = pile(Layer(1, "a"), Group(2, "g", blend=op), Group(3, "h", blend=op, children=(Layer(4, "b"),)))
    assert np.array_equal(composite(group, 3, CANVAS, read), plainly(group, read))


names = st.integers(0, 10**6)
properties = {
    "opacity": st.sampled_from([0.0, 0.3, 1.0, 1.0]),
    "visible": st.sampled_from([True, True, True, False]),
    "blend": st.sampled_from(["src-over", "src-over", "src-over", *BLENDS]),
}
leaves = st.fixed_dictionaries(properties)
trees = st.recursive(
    st.lists(leaves, max_size=4),
    lambda inner: st.lists(
        st.one_of(leaves, st.fixed_dictionaries({**properties, "isolated": st.booleans(), "children": inner})),
        max_size=4,
    ),
    max_leaves=8,
)


def built(description, counter):
    nodes = []
    for entry in description:
        number = next(counter)
        fields = {k: v for k, v in entry.items() if k != "children"}
        if "children" in entry:
            nodes.append(Group(number, f"g{number}", children=built(entry["children"], counter), **fields))
        else:
            nodes.append(Layer(number, f"l{number}", **fields))
    return tuple(nodes)


@settings(deadline=None, max_examples=60)
@given(trees, st.sets(st.integers(1, 8).map(lambda i: f"l{i}"), max_size=3))
def test_any_tree_agrees_with_the_plain_definition(description, empty):
    root = pile(*built(description, iter(range(1, 1000))))
    read = Pictures(empty)
    assert np.array_equal(composite(root, 3, CANVAS, read), plainly(root, read))


@settings(deadline=None, max_examples=25)
@given(st.tuples(*(st.integers(lo, hi) for lo, hi in ((-200, 119), (-150, 139), (1, 320), (1, 290)))))
def test_a_part_equals_the_same_part_of_the_whole(part):
    x, y, width, height = part
    rect = Rect.at(x, y, width, height).intersect(CANVAS)
    root = pile(
        Layer(1, "a"),
        Group(2, "g", opacity=0.7, blend="overlay", children=(Layer(3, "b"), Layer(4, "c", blend="hue"))),
        Layer(5, "d", blend="src-atop", opacity=0.9),
    )
    read = Pictures()
    rows, columns = rect.slices(CANVAS)
    assert np.array_equal(composite(root, 3, rect, read), composite(root, 3, CANVAS, read)[:, rows, columns])


def test_blocks_tile_the_rectangle_on_the_grid_of_tiles():
    root = pile(Layer(1, "a"))
    seen = np.zeros((CANVAS.height, CANVAS.width), int)
    for place, pixels in blocks(root, 3, CANVAS, Pictures()):
        assert place.x0 == CANVAS.x0 or place.x0 % BLOCK == 0
        assert place.y1 == CANVAS.y1 or place.y1 % BLOCK == 0
        assert pixels.shape == (4, place.height, place.width)
        seen[place.slices(CANVAS)] += 1
    assert (seen == 1).all()


def test_layers_under_an_opaque_one_are_not_read():
    class Opaque(Pictures):
        def picture(self, layer):
            planes = super().picture(layer)
            return np.ones_like(planes) if layer.name == "lid" else planes

    root = pile(Layer(1, "a"), Layer(2, "b", blend="dst-out"), Layer(3, "lid"), Layer(4, "top", opacity=0.4))
    read = Opaque()
    whole = composite(root, 3, CANVAS, read)
    assert {name for name, _ in read.asked} == {"lid", "top"}
    assert np.array_equal(whole, plainly(root, read))


def test_invisible_and_fully_transparent_layers_are_not_read():
    read = Pictures()
    root = pile(
        Layer(1, "a", visible=False), Layer(2, "b", opacity=0), Layer(3, "c"), Layer(4, "d", blend="dst-in", opacity=0)
    )
    assert [step.source.name for step in steps(root)] == ["c", "d"]
    assert not composite(root, 3, CANVAS, read).any()


def test_a_group_that_passes_through_blends_with_what_is_below_it():
    read = Pictures()
    inner = (Layer(2, "b", blend="multiply"),)
    through = composite(pile(Layer(1, "a"), Group(3, "g", isolated=False, children=inner)), 3, CANVAS, read)
    flat = composite(pile(Layer(1, "a"), *inner), 3, CANVAS, read)
    isolated = composite(pile(Layer(1, "a"), Group(3, "g", isolated=True, children=inner)), 3, CANVAS, read)
    assert np.array_equal(through, flat)
    assert not np.array_equal(isolated, flat)


def test_result_is_displayable_and_can_go_to_a_given_array():
    read = Pictures()
    root = pile(Layer(1, "a"), Layer(2, "b", blend="color-dodge"), Layer(3, "c", blend="luminosity", opacity=0.9))
    out = np.full((4, CANVAS.height, CANVAS.width), np.nan, np.float32)
    assert composite(root, 3, CANVAS, read, out) is out
    assert out.min() >= 0
    assert out.max() <= 1
    assert (out[:3] <= out[3]).all()


def test_far_from_the_origin():
    far = 1 << 200
    flat = np.full((4, 5, 300), 0.5, np.float32)
    root = pile(Layer(1, "a"), Layer(2, "b"))
    rect = Rect.at(far - 7, -far, 300, 5)
    out = composite(root, 900, rect, lambda layer, level, r: flat[:, : r.height, : r.width])
    assert np.allclose(out, 0.75)
