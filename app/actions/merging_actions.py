"""Actions that make one layer of several, or empty one; where ink would end as pixels, the artist is asked before."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from app.actions.action import Action as A
from app.actions.action import active, always, asks, chosen, paint_chosen, ready
from app.desk.desk import Desk
from app.desk.filling.pouring import clear_mask
from app.desk.framing.frame_state import FRAME_TOOL
from engine.painting import commands as c
from engine.studio.moving.move_requests import FitFrame
from engine.studio.requests import Do
from engine.studio.results import LayerRow

_PLAIN = "src-over"


def below(desk: Desk) -> LayerRow | None:
    """Returns the row right below the chosen one in its group."""
    row = desk.known.active
    rows = desk.known.scene.layers if desk.known.scene else ()
    if row is None:
        return None
    return next((one for one in rows if one.parent == row.parent and one.position == row.position - 1), None)


def rows_inside(rows: Sequence[LayerRow], name: str) -> list[LayerRow]:
    """Returns what a group of a list holds, at any depth."""
    found, inside = [], {name}
    for row in rows:  # a group before what it holds
        if row.parent in inside:
            inside.add(row.name)
            found.append(row)
    return found


def ends_at(rows: Sequence[LayerRow], plainly: Sequence[LayerRow]) -> int | None:
    """Returns the finest level of merged rows, where their ink cannot stay ink; None where it can.  `plainly`: those
    whose own way of mixing does not count."""
    rows = [row for row in rows if row.visible and not (row.reference or row.height)]
    mixed = any(row.shows is not None or row.clip or row.masked or (row not in plainly and _mixes(row)) for row in rows)
    return max((row.finest for row in rows if row.finest is not None), default=0) if mixed else None


def _mixes(row: LayerRow) -> bool:
    return row.blend != _PLAIN or (row.group and row.opacity < 1)


def _ask(desk: Desk, command: c.Command, rows: Sequence[LayerRow], plainly: Sequence[LayerRow]) -> None:
    level = ends_at(rows, plainly)
    if level is None:
        desk.post(Do(command))
        return
    desk.asked.merge, desk.asked.merge_level = command, level
    desk.asked.show("merge")


def _merge_down(desk: Desk) -> None:
    upper, lower = desk.known.active, below(desk)
    if upper is None or lower is None or desk.known.scene is None:
        return
    rows = desk.known.scene.layers
    inner = [*rows_inside(rows, upper.name), *rows_inside(rows, lower.name)]
    above, onto = replace(upper, clip=upper.clip and not lower.clip), replace(lower, clip=False)
    _ask(desk, c.MergeLayer(upper.name), [above, onto, *inner], [onto])


def _merge_group(desk: Desk) -> None:
    row = desk.known.active
    if row is not None and desk.known.scene is not None:
        name = row.name if row.group else row.parent
        assert name is not None
        _ask(desk, c.FlattenGroup(name), rows_inside(desk.known.scene.layers, name), [])


def _merge_visible(desk: Desk) -> None:
    if desk.known.scene is not None:
        _ask(desk, c.FlattenGroup(None), desk.known.scene.layers, [])


def _clear(desk: Desk) -> None:
    if desk.masks.on(desk.known.active):
        clear_mask(desk)
    else:
        desk.post(Do(c.ClearLayer(active(desk))))


def _can_clear(desk: Desk) -> bool:
    return paint_chosen(desk) or (chosen(desk) and desk.masks.on(desk.known.active))


def _can_adjust(desk: Desk) -> bool:
    row = desk.known.active
    return paint_chosen(desk) and row is not None and not row.locked and not desk.masks.on(row)


def _on_another(desk: Desk) -> bool:
    return chosen(desk) and below(desk) is not None


def _grouped(desk: Desk) -> bool:
    row = desk.known.active
    return chosen(desk) and row is not None and (row.group or row.parent is not None)


def _several(desk: Desk) -> bool:
    return ready(desk) and desk.known.scene is not None and len(desk.known.scene.layers) > 1


def _any(desk: Desk) -> bool:
    return ready(desk) and desk.known.scene is not None and bool(desk.known.scene.layers)


def _clip(desk: Desk) -> None:
    row = desk.known.active
    if row is not None:
        desk.post(Do(c.SetLayer(row.name, clip=not row.clip)))


def _is_clipped(desk: Desk) -> bool:
    return desk.known.active is not None and desk.known.active.clip


def _clear_outside(desk: Desk) -> None:
    desk.post(Do(c.ClearLayer(None, outside=True)))


MERGING_ACTIONS: dict[str, A] = {
    "merge_down": A(
        "Merge down", "Layer/Merge", ("Ctrl+Alt+E",), "Make one layer of this and the one below", _merge_down,
        _on_another,
    ),
    "merge_group": A("Merge group", "Layer/Merge", (), "Make one layer of the group", _merge_group, _grouped),
    "merge_visible": A(
        "Merge visible", "Layer/Merge", (), "Make one layer of all that is seen; hidden layers stay", _merge_visible,
        _several,
    ),
    "clear": A("Clear", "Layer", ("Delete",), "Take off all paint, or what is selected of it", _clear, _can_clear),
    "adjust": A(
        "Adjust colours…", "Layer", ("Ctrl+M",), "Brightness, levels, hue, and all else that changes colours",
        asks("adjust"), _can_adjust,
    ),
    "clip": A(
        "Clip to the layer below", "Layer", ("Ctrl+Alt+G",), "Show it only where the layer below has paint",
        _clip, _on_another, _is_clipped,
    ),
    "frame_tool": A(
        "Edit frame", "View", ("C",), "Drag the handles of the frame: crop, or make room; no paint is lost",
        lambda desk: desk.hand.use(FRAME_TOOL), always, lambda desk: desk.hand.tool == FRAME_TOOL,
    ),
    "crop_to_paint": A(
        "Crop to paint", "View", (), "The frame just holds what is painted and seen; no paint is lost",
        lambda desk: desk.post(FitFrame()), _any,
    ),
    "frame": A("Frame…", "View", (), "Where the picture begins and ends; no paint is lost", asks("frame"), ready),
    "paper": A("Paper…", "View", (), "The colour of the ground under all layers, or none", asks("paper"), ready),
    "clear_outside": A(
        "Delete outside the frame", "Layer", (), "Take off all layers what lies outside the frame", _clear_outside, _any
    ),
}  # fmt: skip
