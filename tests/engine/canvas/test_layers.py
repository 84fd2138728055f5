"""The layer tree: what each change makes of it, what it refuses, and what it says then."""

import dataclasses

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from engine.canvas import layers
from engine.canvas.layers import EMPTY, Group, Layer
from engine.canvas.node_checks import LayerError
from engine.canvas.store import Pyramid


@pytest.fixture
def tree():
    """root: Sky, Land(Hill, Town(Roofs)), Ink; bottom first."""
    root = layers.insert(EMPTY, Layer(1, "Sky"))
    root = layers.insert(root, Group(2, "Land"))
    root = layers.insert(root, Layer(3, "Hill"), "Land")
    root = layers.insert(root, Group(4, "Town"), "Land")
    root = layers.insert(root, Layer(5, "Roofs"), "Town")
    return layers.insert(root, Layer(6, "Ink"))


def outline(root):
    return [(node.name, outline(node)) if isinstance(node, Group) else node.name for node in root.children]


def test_walk_goes_bottom_up_and_enters_groups(tree):
    assert [node.name for node in layers.walk(tree)] == ["Sky", "Land", "Hill", "Town", "Roofs", "Ink"]
    assert [layer.name for layer in layers.layers(tree)] == ["Sky", "Hill", "Roofs", "Ink"]


def test_insert_at_a_position(tree):
    tree = layers.insert(tree, Layer(7, "Mist"), "Land", 1)
    assert outline(tree) == ["Sky", ("Land", ["Hill", "Mist", ("Town", ["Roofs"])]), "Ink"]
    assert layers.place(tree, "Mist") == ("Land", 1)
    assert layers.place(tree, "Ink") == (None, 2)


def test_changes_share_everything_else(tree):
    hill, sky = layers.find(tree, "Hill"), layers.find(tree, "Sky")
    pyramid = Pyramid()
    painted = layers.with_pyramid(tree, "Roofs", pyramid)
    assert layers.find(painted, "Roofs").pyramid is pyramid
    assert layers.find(painted, "Hill") is hill
    assert painted.children[0] is sky
    assert layers.find(tree, "Roofs").pyramid is not pyramid


def test_move_counts_positions_without_the_node_itself(tree):
    assert outline(layers.move(tree, "Sky", None, 2))[-1] == "Sky"
    assert outline(layers.move(tree, "Ink", None, 0))[0] == "Ink"
    assert outline(layers.move(tree, "Roofs", None, 1)) == ["Sky", "Roofs", ("Land", ["Hill", ("Town", [])]), "Ink"]
    assert outline(layers.move(tree, "Town", None, 3))[-1] == ("Town", ["Roofs"])
    assert outline(layers.move(tree, "Sky", "Town", 0))[0] == ("Land", ["Hill", ("Town", ["Sky", "Roofs"])])


def test_remove_takes_what_a_group_holds(tree):
    assert outline(layers.remove(tree, "Land")) == ["Sky", "Ink"]
    assert outline(layers.remove(tree, "Roofs"))[1] == ("Land", ["Hill", ("Town", [])])


def test_duplicate_a_group_right_above_with_new_names_and_ids(tree):
    twice = layers.duplicate(layers.duplicate(tree, "Land", "Land 2"), "Land", "Land 3")
    assert outline(twice)[2] == ("Land 3", ["Hill copy 2", ("Town copy 2", ["Roofs copy 2"])])
    assert outline(twice)[3] == ("Land 2", ["Hill copy", ("Town copy", ["Roofs copy"])])
    original, copy = layers.find(twice, "Hill").pyramid, layers.find(twice, "Hill copy").pyramid
    assert copy.levels is original.levels
    assert copy.last is original.last
    assert copy.uid != original.uid


def test_set_fields_and_rename(tree):
    tree = layers.set_fields(tree, "Hill", opacity=0.5, blend="multiply", alpha_locked=True)
    hill = layers.find(tree, "Hill")
    assert (hill.opacity, hill.blend, hill.alpha_locked, hill.id) == (0.5, "multiply", True, 3)
    tree = layers.rename(tree, "Hill", "Mountain")
    assert dataclasses.replace(layers.find(tree, "Mountain"), name="Hill") == hill
    assert layers.set_fields(tree, "Town", isolated=False).children[1].children[1].isolated is False


def test_locks_and_visibility_are_inherited(tree):
    assert not layers.is_locked(tree, "Roofs")
    assert layers.is_locked(layers.set_fields(tree, "Land", locked=True), "Roofs")
    assert layers.is_locked(layers.set_fields(tree, "Roofs", locked=True), "Roofs")
    assert [group.name for group in layers.ancestors(tree, "Roofs")] == ["Land", "Town"]


def test_isolation_written_is_what_krita_and_mypaint_read_alike():
    """Krita passes every group through that is not marked 'isolate'; so 'auto' only where all agree."""
    assert layers.isolation(Group(1, "g", isolated=False)) == "auto"
    for group in (
        Group(1, "g"),
        Group(1, "g", isolated=False, opacity=0.5),
        Group(1, "g", isolated=False, blend="multiply"),
    ):
        assert not layers.passes_through(group)
        assert layers.isolation(group) == "isolate"


def test_alone_shows_a_hidden_translucent_layer_in_full(tree):
    hidden = layers.set_fields(tree, "Ink", visible=False, opacity=0.1, blend="dst-in")
    (only,) = layers.alone(layers.find(hidden, "Ink"), hidden).children
    assert (only.name, only.visible, only.opacity, only.blend) == ("Ink", True, 1.0, "src-over")


def test_names_and_ids_for_new_layers(tree):
    assert layers.unique_name(tree) == "Layer 1"
    named = layers.rename(layers.rename(tree, "Sky", "Layer 1"), "Ink", "Layer 3")
    assert layers.unique_name(named) == "Layer 2"
    assert layers.next_id(tree) == 7
    assert layers.next_id(EMPTY) == 1


@settings(deadline=None, max_examples=60)
@given(st.lists(st.one_of(st.text(max_size=8), st.sampled_from(["", "a", " a ", "a 1", "x" * 500])), max_size=12))
def test_free_names_are_allowed_and_unique_whatever_is_wanted(wanted):
    root = EMPTY
    for i, text in enumerate(wanted):
        name = layers.free_name(root, text)
        if text and text.isprintable() and text.strip() == text and len(text) < 200 and not layers.has(root, text):
            assert name == text
        root = layers.insert(root, Layer(i + 1, name))


REFUSED = {
    "unknown": (lambda t: layers.find(t, "Sea"), r"found 'Sea', expected one of 'Sky', 'Land'"),
    "nothing there": (lambda t: layers.find(EMPTY, "Sea"), "there are no layers"),
    "name taken": (lambda t: layers.insert(t, Layer(9, "Roofs")), "found 'Roofs' twice"),
    "rename to taken": (lambda t: layers.rename(t, "Ink", "Town"), "found 'Town' twice"),
    "id taken": (lambda t: layers.insert(t, Layer(5, "New")), "id: found 5, expected a positive number not in use"),
    "into a layer": (lambda t: layers.move(t, "Sky", "Ink", 0), "found 'Ink', which is a layer, expected a group"),
    "into itself": (lambda t: layers.move(t, "Land", "Land", 0), "expected another group"),
    "into its own part": (lambda t: layers.move(t, "Land", "Town", 0), "found itself or a part of it"),
    "too high": (
        lambda t: layers.move(t, "Sky", None, 3),
        r"position: found 3, expected an integer from 0 \(bottom\) to 2",
    ),
    "negative": (lambda t: layers.insert(t, Layer(9, "New"), None, -1), "found -1"),
    "position of another type": (lambda t: layers.move(t, "Sky", None, True), "found True, expected an integer"),
    "opacity": (
        lambda t: layers.set_fields(t, "Sky", opacity=1.5),
        r"'Sky': opacity: found 1.5, expected a number from 0",
    ),
    "opacity NaN": (lambda t: layers.set_fields(t, "Sky", opacity=float("nan")), "found nan"),
    "blend": (lambda t: layers.set_fields(t, "Sky", blend="normal"), "found 'normal', expected one of src-over, mul"),
    "flag": (lambda t: layers.set_fields(t, "Sky", visible=1), "found 1, expected true or false"),
    "property": (
        lambda t: layers.set_fields(t, "Land", alpha_locked=True),
        "found 'alpha_locked', expected one of opacity",
    ),
    "not settable": (lambda t: layers.set_fields(t, "Land", name="x"), "property: found 'name'"),
    "empty name": (lambda t: Layer(9, ""), "layer name: found ''"),
    "control character": (lambda t: Group(9, "a\x00b"), "expected 1 to 200 characters, no controls"),
    "line end": (lambda t: Layer(9, "a\u2028b"), "layer name: found"),
    "lone surrogate": (lambda t: Layer(9, "a\udc80"), "layer name: found"),
    "blanks around": (lambda t: Layer(9, " a"), "layer name: found ' a'"),
    "long name": (lambda t: Layer(9, "x" * 201), "layer name: found 'xxx"),
    "paint on a group": (lambda t: layers.with_pyramid(t, "Land", Pyramid()), "which is a group, expected a layer"),
}


@pytest.mark.parametrize("case", REFUSED)
def test_refused_in_one_clear_line(tree, case):
    act, message = REFUSED[case]
    with pytest.raises(LayerError, match=message) as caught:
        act(tree)
    assert "\n" not in str(caught.value)
    assert len(str(caught.value)) < 500


def test_nesting_is_bounded_and_walking_a_deep_tree_does_not_recurse():
    root = EMPTY
    for i in range(layers.MAX_DEPTH):
        root = layers.insert(root, Group(i + 1, f"g{i}"), f"g{i - 1}" if i else None)
    root = layers.insert(root, Layer(900, "leaf"), f"g{layers.MAX_DEPTH - 1}")
    with pytest.raises(LayerError, match="expected at most 32 groups"):
        layers.insert(layers.insert(root, Group(901, "g32"), "g31"), Layer(902, "leaf 2"), "g32")
    hostile = Layer(1, "bottom")
    for i in range(5000):
        hostile = Group(i + 2, f"g{i}", children=(hostile,))
    with pytest.raises(LayerError, match="nesting"):
        layers.checked(Group(0, "root", children=(hostile,)))


NAMES = [f"n{i}" for i in range(6)]
moves = st.lists(st.tuples(st.sampled_from(NAMES), st.sampled_from([None, *NAMES]), st.integers(0, 6)), max_size=25)


@settings(deadline=None, max_examples=60)
@given(moves)
def test_any_moves_keep_every_node_exactly_once(script):
    root = EMPTY
    for i, name in enumerate(NAMES):
        root = layers.insert(root, Layer(i + 1, name) if i % 2 else Group(i + 1, name))
    for name, group, to in script:
        try:
            root = layers.move(root, name, group, to)
        except LayerError:
            continue
        assert layers.place(root, name) == (group, to)
    assert sorted(node.name for node in layers.walk(root)) == NAMES
