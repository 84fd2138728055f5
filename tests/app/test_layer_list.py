"""Dragging layers: the command that a drop means, and that it does what the artist sees."""

from dataclasses import replace
from types import SimpleNamespace

import pytest

from app.actions.actions import ACTIONS, perform
from app.canvas.view import Place, View
from app.desk.desk import Desk
from app.panels.layers.layers_panel import blend_titles, dropped
from engine.canvas import layers
from engine.painting import commands as c
from engine.painting.value import Painting
from engine.session.apply import apply
from engine.studio.outline import rows
from engine.studio.ready import ready
from engine.studio.results import Ready


def painting(*names):
    made = Painting()
    for name in names:
        made = apply(made, c.AddLayer(name, group=None))
    made = apply(made, c.AddLayer("G", kind="group", group=None))
    for name in ("In 1", "In 2"):
        made = apply(made, c.AddLayer(name, group="G"))
    return made


def listed(made):
    return [row.name for row in rows(made.root)]


def drop(made, moved, onto, where):
    """The list, top-most first, after a row was let go over another."""
    table = tuple(rows(made.root))
    by_name = {row.name: row for row in table}
    command = dropped(table, by_name[moved], by_name[onto], where)
    return None if command is None else listed(apply(made, command))


START = ["G", "In 2", "In 1", "C", "B", "A"]


def test_the_list_has_the_top_most_first():
    assert listed(painting("A", "B", "C")) == START


@pytest.mark.parametrize(
    ("moved", "onto", "where", "after"),
    [
        ("A", "C", 0.1, ["G", "In 2", "In 1", "A", "C", "B"]),  # above C
        ("A", "C", 0.9, ["G", "In 2", "In 1", "C", "A", "B"]),  # below C
        ("C", "A", 0.9, ["G", "In 2", "In 1", "B", "A", "C"]),
        ("C", "A", 0.1, ["G", "In 2", "In 1", "B", "C", "A"]),
        ("A", "G", 0.5, ["G", "A", "In 2", "In 1", "C", "B"]),  # into the group, on top
        ("A", "G", 0.1, ["A", "G", "In 2", "In 1", "C", "B"]),  # above the group
        ("A", "In 1", 0.1, ["G", "In 2", "A", "In 1", "C", "B"]),
        ("In 2", "B", 0.1, ["G", "In 1", "C", "In 2", "B", "A"]),  # out of the group
        ("G", "A", 0.9, ["C", "B", "A", "G", "In 2", "In 1"]),
        ("B", "B", 0.5, None),
        ("G", "In 1", 0.1, None),  # not into itself
    ],
)
def test_a_drop_puts_the_layer_where_it_was_let_go(moved, onto, where, after):
    made = painting("A", "B", "C")
    assert drop(made, moved, onto, where) == after
    assert layers.has(made.root, moved)


def test_blend_modes_have_their_titles_before_the_engine_is_there():
    later = blend_titles(ready())
    assert blend_titles(Ready()) == later[:1] == [("src-over", "Normal")]
    assert len(later) > 10


def test_a_layer_becomes_the_height_of_the_land_and_part_of_the_picture_again():
    made = painting("Hills")
    desk = Desk(View(Place(0, 0, 0), 0, 0.0, 1280, 800), (posted := []).append)
    for expected in (True, False):
        row = next(row for row in rows(made.root) if row.name == "Hills")
        assert row.height is not expected
        scene = SimpleNamespace(layers=rows(made.root), active="Hills")
        desk.known = replace(desk.known, ready=True, scene=scene)
        perform(desk, ACTIONS["height"])
        made = apply(made, posted[-1].command)
    assert [node.role for node in layers.walk(made.root) if node.name == "Hills"] == [""]
