"""Dragging layers: the command that a drop means, and that it does what the artist sees."""

from dataclasses import replace
from types import SimpleNamespace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from app.actions.actions import ACTIONS, perform
from app.canvas.view import Place, View
from app.desk.desk import Desk
from app.desk.stack.many_rows import chosen_rows, dropped_rows, reach_row, toggle_row
from app.panels.layers.layers_panel import blend_titles
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
    commands = dropped_rows(table, [row for row in table if row.name in moved.split("+")], by_name[onto], where)
    for command in commands:
        made = apply(made, command)
    return listed(made) if commands else None


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
        ("A+C", "B", 0.1, ["G", "In 2", "In 1", "C", "A", "B"]),
        ("A+C", "G", 0.5, ["G", "C", "A", "In 2", "In 1", "B"]),
        ("A+B", "C", 0.9, ["G", "In 2", "In 1", "C", "B", "A"]),
        ("In 1+C+A", "B", 0.9, ["G", "In 2", "B", "In 1", "C", "A"]),
        ("A+G", "In 1", 0.9, None),
        ("B", "B", 0.5, None),
        ("G", "In 1", 0.1, None),  # not into itself
    ],
)
def test_a_drop_puts_the_layer_where_it_was_let_go(moved, onto, where, after):
    made = painting("A", "B", "C")
    assert drop(made, moved, onto, where) == after
    assert all(layers.has(made.root, name) for name in moved.split("+"))


@given(st.sets(st.sampled_from(START), min_size=1), st.sampled_from(START), st.sampled_from((0.1, 0.5, 0.9)))
def test_rows_that_are_dropped_together_keep_their_order_side_by_side(names, onto, where):
    made = painting("A", "B", "C")
    desk = Desk(View(Place(0, 0, 0), 0, 0.0, 1280, 800), [].append)
    desk.known = replace(desk.known, scene=SimpleNamespace(layers=tuple(rows(made.root)), active=None))
    desk.stack.many = names
    chosen = chosen_rows(desk)
    table = desk.known.scene.layers
    commands = dropped_rows(table, chosen, next(row for row in table if row.name == onto), where)
    for command in commands:
        made = apply(made, command)
    after = [row.name for row in rows(made.root) if row.name in {one.name for one in chosen}]
    assert not commands or after == [row.name for row in chosen]
    assert sorted(listed(made)) == sorted(START)


@pytest.mark.parametrize("names", [{"A", "C"}, {"In 1", "B"}, {"G", "In 1"}, {"In 1", "In 2"}])
def test_what_is_chosen_is_grouped_where_its_top_most_is_and_deleted_at_once(names):
    made = painting("A", "B", "C")
    desk = Desk(View(Place(0, 0, 0), 0, 0.0, 1280, 800), (posted := []).append)
    table = tuple(rows(made.root))
    desk.known = replace(desk.known, ready=True, scene=SimpleNamespace(layers=table, active=min(names)))
    desk.stack.many = names
    chosen = [row.name for row in chosen_rows(desk)]
    perform(desk, ACTIONS["add_group"])
    grouped = made
    for request in posted:
        grouped = apply(grouped, request.command)
    assert [row.name for row in rows(grouped.root) if row.parent == "Group 1"] == chosen
    assert len({request.together for request in posted if isinstance(request.command, c.AddLayer | c.MoveLayer)}) == 1
    posted.clear()
    perform(desk, ACTIONS["remove"])
    for request in posted:
        made = apply(made, request.command)
    assert not names & set(listed(made))
    assert len({request.together for request in posted}) == 1


def test_rows_are_chosen_with_control_and_shift_and_let_go_with_another_active_one():
    made = painting("A", "B", "C")
    desk = Desk(View(Place(0, 0, 0), 0, 0.0, 1280, 800), (posted := []).append)
    table = tuple(rows(made.root))
    by_name = {row.name: row for row in table}
    desk.known = replace(desk.known, scene=SimpleNamespace(layers=table, active="C"))
    reach_row(desk, table, by_name["A"])
    assert desk.stack.many == {"A", "B", "C"}
    toggle_row(desk, by_name["C"])
    assert (desk.stack.many, posted[-1].command) == ({"A", "B"}, c.SelectLayer("B"))
    desk.stack.follow([].append, table, 0, "B")
    assert desk.stack.many == {"A", "B"}
    desk.stack.follow([].append, table, 0, "C")
    assert desk.stack.many == set()


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


def test_layers_asked_for_before_the_engine_has_made_the_one_before_have_names_of_their_own():
    posted = []
    desk = Desk(View(Place(0, 0, 0), 0, 0.0, 1280, 800), posted.append, behind=lambda: True)
    desk.learn(ready=True)
    for _ in range(3):
        perform(desk, ACTIONS["add_layer"])
    perform(desk, ACTIONS["add_group"])
    assert [request.command.name for request in posted] == ["Layer 1", "Layer 2", "Layer 3", "Group 1"]
    desk.behind = lambda: False
    perform(desk, ACTIONS["add_layer"])  # none of them came
    assert posted[-1].command.name == "Layer 1"
