"""What differs between two trees of layers is found without going through what does not."""

from dataclasses import replace

from hypothesis import given
from hypothesis import strategies as st

from engine.canvas import layers
from engine.canvas.layers import EMPTY, Group, Layer
from engine.canvas.store import Pyramid
from engine.session.held_pyramids import changed_nodes, pyramids, pyramids_of, related

NUMBERS = st.integers(0, 30)


def tree():
    """Some layers, in groups and beside them."""
    leaves = [Layer(n, f"l{n}", pyramid=Pyramid()) for n in range(1, 6)]
    inner = Group(7, "inner", children=(leaves[3], leaves[4]))
    return replace(EMPTY, children=(leaves[0], Group(6, "outer", children=(leaves[1], inner)), leaves[2]))


def edited(root, action, number):
    """A tree after a change of one of its nodes."""
    nodes = list(layers.walk(root))
    if not nodes:
        return root
    node = nodes[number % len(nodes)]
    if action == "remove":
        return layers.remove(root, node.name)
    if action == "copy":
        return layers.duplicate(root, node.name, f"n{layers.next_id(root)}")
    if action == "up":
        return layers.move(root, node.name, None, 0)
    if action == "paint" and isinstance(node, Layer):
        return layers.with_pyramid(root, node.name, replace(node.pyramid, commits=number))
    return layers.set_fields(root, node.name, visible=not node.visible)


@given(st.lists(st.tuples(st.sampled_from(["remove", "copy", "up", "paint", "hide"]), NUMBERS), max_size=5))
def test_changed_nodes_are_those_that_are_no_longer_there(actions):
    old = new = tree()
    for action, number in actions:
        new = edited(new, action, number)
    lost, found = changed_nodes(old, new)
    before, after = ({id(node): node for node in layers.walk(root)} for root in (old, new))
    assert {*map(id, lost)} == before.keys() - after.keys()
    assert {*map(id, found)} == after.keys() - before.keys()
    assert len(lost) + len(found) == len({*map(id, lost)}) + len({*map(id, found)})


def test_only_copies_are_of_one_family():
    root = layers.duplicate(tree(), "l1", "copy")
    held = pyramids(root)
    one, copy = held[1, "paint"], held[layers.find(root, "copy").id, "paint"]
    assert one.uid != copy.uid
    assert related(root, {one.family}) == [one, copy]
    assert len(related(root, {pyramid.family for pyramid in held.values()})) == 6
    assert pyramids_of([layers.find(root, "copy")]) == {(layers.find(root, "copy").id, "paint"): copy}
