"""Several rows of the panel of layers, chosen together: what is done with them is one step to undo."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from app.desk.desk import Desk
from app.desk.stack.chosen_layer import choose_layer
from app.desk.stack.new_names import new_layer_name
from engine.painting import commands as c
from engine.studio.requests import Do
from engine.studio.results import LayerRow

Stacks = dict[str | None, list[str]]  # by group, None the root: names from the bottom up


def chosen_rows(desk: Desk) -> list[LayerRow]:
    """Returns the rows that are chosen, the top-most first, but for those within a group that is chosen itself."""
    scene = desk.known.scene
    if scene is None:
        return []
    names = desk.stack.many or ({scene.active} if scene.active else set())
    parents = {row.name: row.parent for row in scene.layers}
    return [row for row in scene.layers if row.name in names and not names & set(groups_around(parents, row.name))]


def groups_around(parents: dict[str, str | None], name: str) -> Iterable[str]:
    """Yields the groups around a layer, the nearest first."""
    around = parents.get(name)
    while around is not None:
        yield around
        around = parents.get(around)


def post_together(desk: Desk, commands: Sequence[c.Command]) -> None:
    """Posts commands that are undone as one."""
    desk.stack.together += 1
    for command in commands:
        desk.post(Do(command, together=desk.stack.together))


def group_rows(desk: Desk, name: str) -> None:
    """Lays the chosen rows in a new group, where the top-most of them is."""
    chosen = chosen_rows(desk)
    top = chosen[0]
    moves = [c.MoveLayer(row.name, place, name) for place, row in enumerate(reversed(chosen))]
    post_together(desk, [c.AddLayer(name, kind="group", group=top.parent, to=top.position + 1), *moves])
    desk.post(Do(c.SelectLayer(name)))


def toggle_row(desk: Desk, row: LayerRow) -> None:
    """Adds a row to those that are chosen, as the active one, or takes it out."""
    scene = desk.known.scene
    active = scene.active if scene else None
    many = desk.stack.many or ({active} if active else set())
    if row.name not in many:
        desk.stack.many = {*many, row.name}
        choose_layer(desk, row.name)
    elif len(many) > 1:
        desk.stack.many = many - {row.name}
        if row.name == active and scene is not None:
            desk.post(Do(c.SelectLayer(next(one.name for one in scene.layers if one.name in desk.stack.many))))


def reach_row(desk: Desk, shown: Sequence[LayerRow], row: LayerRow) -> None:
    """Chooses all rows that are shown from the active one to another."""
    names = [one.name for one in shown]
    active = desk.known.scene.active if desk.known.scene else None
    if active not in names:
        toggle_row(desk, row)
        return
    first, last = sorted((names.index(active), names.index(row.name)))
    desk.stack.many = set(names[first : last + 1])


def free_group_name(desk: Desk) -> str:
    """Returns a name for a new group."""
    return new_layer_name(desk, "Group")


def dropped_rows(
    rows: Sequence[LayerRow], moved: Sequence[LayerRow], onto: LayerRow, where: float
) -> list[c.MoveLayer]:
    """Returns the commands for rows let go over another, `where` 0 (its top) to 1, which keep their order; none where
    they cannot go."""
    names, parents = {row.name for row in moved}, {row.name: row.parent for row in rows}
    if onto.name in names or names & set(groups_around(parents, onto.name)):
        return []
    stacks: Stacks = {}
    for row in reversed(rows):
        stacks.setdefault(row.parent, []).append(row.name)
    inside = onto.group and 0.25 < where < 0.75
    group, commands, below = onto.name if inside else onto.parent, list[c.MoveLayer](), ""
    for row in reversed(moved):
        stacks[row.parent].remove(row.name)
        stack = stacks.setdefault(group, [])
        to = len(stack) if inside else stack.index(below or onto.name) + (bool(below) or where < 0.5)
        stack.insert(to, row.name)
        commands.append(c.MoveLayer(row.name, to, group))
        below = row.name
    return commands
