"""Texts of the language as nodes: what is read is written again, and each change is one of the text."""

import pytest
from hypothesis import given
from hypothesis import strategies as st
from imgui_bundle import ImVec2

from app.desk.workshop.text_nodes import Slot, text_nodes
from app.panels.workshop.node_layout import legible
from engine.studio.workshop.language_words import language_words
from engine.texture.expression.defined import expression
from engine.texture.expression.language import read
from engine.texture.expression.library.bundled_texts import written_library

KNOWN = language_words()
WALL = """// a wall
worn = slider(0.4, 0, 1)
wall = bricks(x*4, y*8, 0.12)  // joints
tone = fbm(x - -0.5, y); mix(#b0a898, #8a3a2a*(1 - worn), wall)
"""
NO_LINES = "scatter", "row", "slider", "pick", "outer"
SIGN = st.sampled_from(("+", "-", "*", "/", "%", "**", "<", ">="))
LEAF = st.sampled_from(["x", "y", "0.5", "-2", "7e3", "#204060", "pi", "fw", "a0", "a1"])


def _joined(parts):
    pair = st.tuples(parts, parts)
    return st.one_of(
        st.tuples(parts, SIGN, parts).map(lambda p: f"({p[0]} {p[1]} {p[2]})"),
        pair.map(lambda p: f"noise({p[0]},{p[1]})"),
        pair.map(lambda p: f"{p[0]}-{p[1]}*-{p[0]}"),
        pair.map(lambda p: f"-{p[0]}**-{p[1]}"),
        pair.map(lambda p: f"({p[0]} if {p[1]} else {p[0]})"),
    )


PART = st.recursive(LEAF, _joined, max_leaves=6)
TEXT = st.lists(PART, min_size=3, max_size=4).map(
    lambda parts: "\n".join(f"a{n} = {p}  // {n}" for n, p in enumerate(["x", "y", *parts[:-1]])) + f"\n{parts[-1]}"
)


def terms(text):
    """What a text says, wherever it stands."""
    return [(line.name, line.term) for line in read(text).lines]


def slots(found):
    return [slot for node in found.nodes for row in node.rows for slot in row.slots]


def slot(found, told):
    return next(slot for slot in slots(found) if slot.text == told)


@given(TEXT, st.integers(0, 99))
def test_what_is_read_is_written_again(text, number):
    found = text_nodes(text, KNOWN)
    assert terms("\n".join(node.told for node in found.nodes)) == terms(text)
    if not slots(found):
        return
    one = slots(found)[number % len(slots(found))]
    usable = next(node for node in found.nodes if node.at <= one.at < node.end).name not in ("a0", "a1")
    assert found.replaced(one, one.text) == text
    for told in ("0.25", "-1.5", "#123456", *(("a0",) if usable else ())):
        changed = found.replaced(one, told)
        again = text_nodes(changed, KNOWN)
        assert again is not None, changed
        assert [node.head for node in again.nodes] == [node.head for node in found.nodes]


@pytest.mark.parametrize("name", written_library())
def test_texts_of_the_library_are_nodes(name):
    text = written_library()[name].text
    found = text_nodes(text, KNOWN)
    assert terms("\n".join(node.told for node in found.nodes)) == terms(text)
    columns = found.columns()
    assert max(columns) == columns[-1]


def test_a_line_is_a_node_whose_rows_are_the_values_of_its_function():
    found = text_nodes(WALL, KNOWN)
    assert [(node.name, node.head) for node in found.nodes] == [
        *(("worn", "slider"), ("wall", "bricks"), ("tone", "fbm"), ("", "mix"))
    ]
    assert [row.label for row in found.nodes[1].rows] == ["x", "y", "gap"]
    assert [piece if isinstance(piece, str) else piece.text for piece in found.nodes[2].rows[0].pieces] == [
        *("x", "-", "-0.5")
    ]
    assert found.nodes[3].sources == {"worn", "wall"}
    assert found.columns() == (0, 0, 0, 1)
    assert slot(found, "0.4").set_
    assert text_nodes("mix(", KNOWN) is None


def test_a_link_is_a_name_and_brings_its_line_before_what_uses_it():
    found = text_nodes(WALL, KNOWN)
    assert "gap" not in found.nodes[1].sources
    text = found.linked(slot(found, "0.12"), "tone")
    again = text_nodes(text, KNOWN)
    assert [node.name for node in again.nodes] == ["worn", "tone", "wall", ""]
    assert "bricks(x*4, y*8, tone)  // joints" in text
    assert text.startswith("// a wall")
    assert found.linked(slot(found, "0.4"), "wall") is None  # of a slider
    assert again.linked(slot(again, "-0.5"), "wall") is None  # round in a circle
    assert "mix(wall, #8a3a2a" in found.linked(slot(found, "#b0a898"), "wall")


def test_lines_come_and_go():
    found = text_nodes(WALL, KNOWN)
    assert found.removed(found.nodes[1]) is None
    assert found.removed(found.nodes[3]) is None
    without = found.removed(found.nodes[2])
    assert terms(without) == [one for one in terms(WALL) if one[0] != "tone"]
    more = found.added(KNOWN.functions[0])
    again = text_nodes(more, KNOWN)
    assert len(again.nodes) == 5
    assert terms(again.removed(again.nodes[3])) == terms(WALL)


@pytest.mark.parametrize(
    "word",
    [w for w in KNOWN.functions if w.name not in ("scatter", "row", "slider", "pick", "outer")],
    ids=lambda w: w.name,
)
def test_a_function_that_is_added_is_right_as_it_stands(word):
    expression({"text": text_nodes("x", KNOWN).added(word).replace("\nx", f"\n{word.name}_1")}, -4)


def test_a_slot_tells_its_number():
    assert Slot(0, "- 0.5", "number").number == -0.5


def test_where_all_nodes_are_too_small_to_be_read_the_last_ones_are_shown():
    boxes = [(ImVec2(x, 0), ImVec2(x + 90, 60)) for x in (0, 200, 100, 300)]
    assert legible(boxes, ImVec2(400, 100)) == (3, 1, 2, 0)
    assert legible(boxes, ImVec2(290, 100)) == (3, 1, 2)
    assert legible(boxes, ImVec2(100, 20)) == (3,)
