"""The actions of pictures that contain themselves."""

from __future__ import annotations

from app.actions.action import Action as A
from app.actions.action import ready
from app.desk.desk import Desk
from app.desk.naming import free_name
from app.desk.places import endless, going
from app.desk.stack.new_names import new_layer_name
from engine.canvas.placing.pose import SourcePart
from engine.painting import commands as c
from engine.studio.layer_rows import LayerRow
from engine.studio.requests import Do


def _place_in_itself(desk: Desk) -> None:
    frame = desk.known.frame
    middle = frame.x0 + frame.width // 4, frame.y0 + frame.height // 4
    at = middle[0] - frame.x0 // 2, middle[1] - frame.y0 // 2
    placing = c.Placing(of=None, at=at, level=0, levels=-1, part=SourcePart(0, frame))
    name = new_layer_name(desk, "In itself")
    desk.post(Do(c.AddPlacement(name, placing)))
    desk.post(Do(c.SelectLayer(name)))  # what is moved next, and zoomed into


def _has_scene(desk: Desk) -> bool:
    return ready(desk) and desk.known.scene is not None


def _itself(desk: Desk) -> LayerRow | None:
    """Returns the row of the chosen placement if it shows the painting, or a group, that it lies in; else that of the
    topmost that does."""
    scene = desk.known.scene
    if scene is None:
        return None
    rows = {one.name: one for one in scene.layers}
    chosen = [] if desk.known.active is None else [desk.known.active]
    return next((row for row in (*chosen, *scene.layers) if _shows_itself(row, rows)), None)


def _shows_itself(row: LayerRow, rows: dict[str, LayerRow]) -> bool:
    if row.shows is None or row.shows.part is None:
        return False
    within: set[str | None] = {None}
    parent = row.parent
    while parent is not None:
        within.add(parent)
        parent = rows[parent].parent
    return row.shows.name in within


def _can_zoom(desk: Desk) -> bool:
    return ready(desk) and _itself(desk) is not None


def _endless(desk: Desk) -> None:
    row, scene = _itself(desk), desk.known.scene
    assert row is not None
    assert scene is not None
    assert row.shows is not None
    assert row.shows.part is not None
    taken, name = {mark.name for mark in scene.bookmarks}, row.name.replace(",", " ")
    if {f"{name} out", f"{name} in"} & taken:
        name = free_name(name, taken | {mark.removesuffix(" out") for mark in taken})
    outer, inner = endless.endless(name, row.shows.pose, row.shows.part)
    for mark in (outer, inner):
        desk.post(Do(mark))
    going.go_to_bookmark(desk, inner)
    desk.say(
        f"Bookmarked “{outer.name}” and “{inner.name}”: a flight from one to the other goes on without end",
        offer="" if desk.strip == "places" else "places",
    )


ENDLESS_ACTIONS: dict[str, A] = {
    "in_itself": A(
        "Picture in itself", "Layer/Placement", (), "Show the whole picture within itself, half as large each time",
        _place_in_itself, _has_scene,
    ),
    "endless": A(
        "Endless zoom", "Go", (),
        "Bookmark two places, a turn of the picture in itself apart: a film from one to the other loops",
        _endless, _can_zoom,
    ),
}  # fmt: skip
