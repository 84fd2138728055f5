"""Which placements may show which: against every closed walk of small trees."""

import itertools
import math
from dataclasses import replace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from engine.canvas import layers
from engine.canvas.layers import Group, Layer
from engine.canvas.node_checks import LayerError
from engine.canvas.placing import loops
from engine.canvas.placing.placement import Placement
from engine.canvas.placing.pose import Pose, SourcePart
from engine.numeric.address import Rect

FRAME = SourcePart(0, Rect(0, 0, 64, 64))


def tree(*children):
    return layers.checked(Group(0, "root", children=children))


def shows(number, of, levels=-1, **more):
    return Placement(number, f"p{number}", of=of, pose=Pose(levels=levels), part=FRAME, **more)


def plainly(root):
    """Whether every simple loop of the tree has a product of at most 1/2."""
    ahead = {}
    for group in [root, *(node for node in layers.walk(root) if isinstance(node, Group))]:
        for child in group.children:
            ahead.setdefault(group.id, []).append((child.id, 0))
    for one in loops.placements(root):
        ahead.setdefault(one.id, []).append((one.of or 0, one.pose.levels))

    def all_halve(start, at, log, seen):
        for node, by in ahead.get(at, ()):
            if node == start:
                if log + by > -1:
                    return False
            elif node not in seen and not all_halve(start, node, log + by, seen | {node}):
                return False
        return True

    return all(all_halve(node, node, 0, {node}) for node in ahead)


@settings(deadline=None)  # the first one loads SciPy
@given(st.lists(st.tuples(st.integers(0, 8), st.integers(-3, 2)), min_size=1, max_size=4))
def test_loops_are_refused_exactly_where_one_does_not_halve(shown):
    held = [shows(number, of or None, levels) for number, (of, levels) in zip(range(5, 9), shown, strict=False)]
    known = {1, 2, 3, 4, *(one.id for one in held)}
    held = [one if one.of is None or one.of in known else shows(one.id, 1, one.pose.levels) for one in held]
    inner = Group(2, "g", children=(Layer(3, "a"), *held[:2]))
    root = tree(Layer(1, "b"), inner, Group(4, "h", children=tuple(held[2:])))
    if plainly(root):
        assert loops.checked(root) is root
    else:
        with pytest.raises(LayerError, match="does not halve each time round"):
            loops.checked(root)


def test_two_that_show_each_other_at_one_and_at_a_half_may_be():
    assert loops.checked(tree(Group(1, "a", children=(shows(3, 2, 0),)), Group(2, "b", children=(shows(4, 1, -1),))))


def test_a_loop_is_named():
    root = tree(Group(1, "a", children=(shows(3, 2, 0),)), Group(2, "b", children=(shows(4, 1, 0),)))
    with pytest.raises(LayerError, match=r"'p3' in 'a' in 'p4' in 'b'"):
        loops.checked(root)


@pytest.mark.parametrize("scale", [0.51, 0.70710678118654752])
def test_a_turn_by_less_than_a_half_is_refused(scale):
    c = (math.cos(0.3) * scale, math.sin(0.3) * scale)
    pose = Pose(turned=c)
    with pytest.raises(LayerError, match="does not halve"):
        loops.checked(tree(Layer(1, "a"), Placement(2, "p", pose=pose, part=FRAME)))


def test_what_shows_itself_needs_a_rectangle_and_lies_over_what_is_below():
    with pytest.raises(LayerError, match="no rect"):
        loops.checked(tree(Placement(2, "p", pose=Pose(levels=-1))))
    with pytest.raises(LayerError, match="'multiply' in a placement"):
        loops.checked(tree(shows(2, None, blend="multiply")))


def test_a_source_has_to_be_there():
    with pytest.raises(LayerError, match="not there"):
        loops.checked(tree(shows(2, 7)))


def test_a_thousand_that_show_the_painting_are_checked_in_a_moment():
    assert loops.checked(tree(*(shows(number, None) for number in range(1, 1001))))


def test_what_shows_a_node_is_told():
    root = tree(Group(1, "g", children=(Layer(2, "a"), shows(3, 2))), shows(4, 2), shows(5, 1))
    assert [one.name for one in loops.showing(root, "a")] == ["p3", "p4"]
    assert [one.name for one in loops.showing(root, "g")] == ["p4", "p5"]
    assert len(list(itertools.islice(loops.placements(root), 9))) == 3


def doubled(count, **more):
    """Groups of two placements of the group before."""
    return [
        Group(
            10 * n,
            f"g{n}",
            children=(shows(10 * n + 1, 10 * n - 10, 0, **more), shows(10 * n + 2, 10 * n - 10, 0, **more)),
        )
        for n in range(1, count + 1)
    ]


@pytest.mark.parametrize("visible", [False, True])
def test_more_than_anybody_could_wait_for_is_refused_before_it_is_drawn(visible):
    """Whether it is seen by now or not."""
    seed = Group(0x1000, "g0", children=(Layer(0x1001, "a"),))
    first = [Group(10, "g1", children=(shows(11, 0x1000, 0), shows(12, 0x1000, 0)), visible=visible), *doubled(60)[1:]]
    assert loops.checked(tree(seed, *first[:8]))
    with pytest.raises(LayerError, match=r"found \d+,\d+ layers and placements to draw in it, expected at most 65,536"):
        loops.checked(tree(seed, *first))


def test_a_chain_of_placements_has_an_end():
    """Where they are not drawn as one: turned, repeated or cut."""

    def chain(count, **more):
        return tree(Layer(1, "a"), *(Placement(n, f"p{n}", of=n - 1, **more) for n in range(2, count + 2)))

    part = SourcePart(0, Rect(0, 0, 9, 9))
    for more in ({"pose": Pose(turned=(0.6, 0.8))}, {"part": part}, {"part": part, "repeat": True}):
        assert loops.checked(chain(100, **more))
        with pytest.raises(LayerError, match="placements and groups in one another"):
            loops.checked(replace(chain(3000), children=chain(3000, **more).children[::-1]))
    assert loops.checked(chain(3000))


def test_thousands_of_placements_of_one_layer_may_be():
    assert loops.checked(tree(Layer(1, "a"), *(shows(number, 1, 0) for number in range(2, 3002))))
