"""The actions of the Layer menu."""

from __future__ import annotations

from collections.abc import Callable

from app.actions.action import Action as A
from app.actions.action import active, chosen, paint_chosen, ready
from app.desk.desk import Desk
from app.desk.framing.frame_state import FRAME_TOOL
from app.desk.known import moved_by
from app.desk.moving.floating import laying, lift, set_part_down, takes_part
from app.desk.moving.move_state import TOOL
from app.desk.moving.poses import shifted
from app.desk.stack.many_rows import chosen_rows, free_group_name, group_rows, post_together
from app.desk.stack.new_names import new_layer_name
from engine.canvas.placing.pose import UNMOVED
from engine.checks.roles import AS_HEIGHT, REFERENCE
from engine.painting import commands as c
from engine.studio.requests import Do

_ASIDE = 40  # points of the screen by which what is shown again lies beside itself, down and to the right


def _hidden(desk: Desk) -> bool:
    return ready(desk) and bool(desk.known.hiding)


def _add(desk: Desk) -> None:
    desk.post(Do(c.AddLayer(new_layer_name(desk, "Layer"))))


def _duplicate(desk: Desk) -> None:
    name = active(desk)
    selected = "copy" if paint_chosen(desk) and desk.selecting.selected else None
    copy = new_layer_name(desk, f"{name} copy")
    desk.post(Do(c.DuplicateLayer(name, copy, selected=selected)))
    if not paint_chosen(desk):
        desk.post(Do(c.SelectLayer(copy)))  # as the copy of a layer is chosen by itself


def _cut_out(desk: Desk) -> None:
    name = active(desk)
    desk.post(Do(c.DuplicateLayer(name, new_layer_name(desk, f"{name} cut"), selected="cut")))


def _can_cut_out(desk: Desk) -> bool:
    row = desk.known.active
    return paint_chosen(desk) and row is not None and not row.locked and desk.selecting.selected


def _show_again(desk: Desk) -> None:
    name, aside = active(desk), round(_ASIDE * desk.scale)
    placing = c.Placing(of=name, at=(aside, aside), level=desk.view.shown_level)
    taken = {row.name for row in desk.known.scene.layers} if desk.known.scene else set()
    wanted = f"{name} again"
    again = wanted if wanted not in taken else new_layer_name(desk, wanted)
    desk.post(Do(c.AddPlacement(again, placing)))
    desk.post(Do(c.SelectLayer(again)))  # what is moved next


def _nudges(x: int, y: int) -> Callable[[Desk], None]:
    def do(desk: Desk) -> None:
        row = desk.known.active
        if row is not None and not row.locked and desk.past.looking is None:
            level = desk.view.shown_level
            if not takes_part(desk, row):
                desk.post(Do(c.SetLayer(row.name, placing=moved_by(row, level, x, y))))
            elif desk.hand.tool == TOOL:
                lift(desk, row, shifted(desk.moving.pose(desk.known, row), level, x, y))
            else:
                desk.post(Do(c.SetLayer(row.name, placing=moved_by(row, level, x, y), selected="cut")))
                desk.selecting.carried = shifted(UNMOVED, level, x, y).similarity

    return do


def _floats(desk: Desk) -> bool:
    return ready(desk) and (desk.moving.floating is not None or desk.hand.tool == FRAME_TOOL)


def _set_down(desk: Desk) -> None:
    if desk.hand.tool == FRAME_TOOL:
        desk.hand.use("brush")  # each drag was a step of its own
    set_part_down(desk)


def _samples(desk: Desk) -> bool:
    return ready(desk) and laying(desk) is not None


def _is_reference(desk: Desk) -> bool:
    row = desk.known.active
    return row is not None and row.reference


def _can_be_reference(desk: Desk) -> bool:
    row = desk.known.active
    return ready(desk) and row is not None and not row.group


def _toggle_reference(desk: Desk) -> None:
    desk.post(Do(c.SetLayer(active(desk), role="" if _is_reference(desk) else REFERENCE)))


def _is_height(desk: Desk) -> bool:
    row = desk.known.active
    return row is not None and row.height


def _has_land(desk: Desk) -> bool:
    return ready(desk) and desk.known.scene is not None and any(row.height for row in desk.known.scene.layers)


def _toggle_height(desk: Desk) -> None:
    desk.post(Do(c.SetLayer(active(desk), role="" if _is_height(desk) else AS_HEIGHT)))


def _remove(desk: Desk) -> None:
    post_together(desk, [c.RemoveLayer(row.name) for row in chosen_rows(desk)])


def _add_group(desk: Desk) -> None:
    if desk.stack.many:
        group_rows(desk, free_group_name(desk))
    else:
        desk.post(Do(c.AddLayer(free_group_name(desk), kind="group")))


def _show(desk: Desk) -> None:
    for name in desk.known.hiding:
        desk.post(Do(c.SetLayer(name, visible=True)))


def _moves(by: int) -> Callable[[Desk], None]:
    def do(desk: Desk) -> None:
        row = next((r for r in desk.known.scene.layers if r.name == active(desk)), None) if desk.known.scene else None
        if row is not None and row.position + by >= 0:
            desk.post(Do(c.MoveLayer(row.name, row.position + by)))

    return do


def _show_only(desk: Desk) -> None:
    desk.stack.toggle(desk.post, active(desk))


def _show_all(desk: Desk) -> None:
    if desk.stack.only is not None:
        desk.stack.toggle(desk.post, desk.stack.only)


def _sees_one(desk: Desk) -> bool:
    return desk.stack.only is not None


def _is_shown_only(desk: Desk) -> bool:
    row = desk.known.active
    return row is not None and desk.stack.only == row.name


_NUDGE = "Move the layer by a pixel of what you see"
LAYER_ACTIONS: dict[str, A] = {
    "add_layer": A("New layer", "Layer", ("Ctrl+Shift+N",), "Add a layer above", _add, ready),
    "add_group": A(
        "New group", "Layer", ("Ctrl+G",), "Add a group above; around the layers that are chosen, where several are",
        _add_group, ready,
    ),
    "duplicate": A("Duplicate", "Layer", ("Ctrl+J",), "Copy the layer, or what is selected of it", _duplicate, chosen),
    "cut_out": A(
        "Cut to a new layer", "Layer", ("Ctrl+Shift+J",), "Lay what is selected on a layer of its own", _cut_out,
        _can_cut_out,
    ),
    "show_again": A(
        "Show again", "Layer/Placement", (), "Show the layer once more: what is painted on it shows there", _show_again,
        chosen,
    ),
    "reference": A(
        "Reference",
        "Layer",
        (),
        "To look at while you paint: no export and no film shows it",
        _toggle_reference,
        _can_be_reference,
        _is_reference,
    ),
    "height": A(
        "Height",
        "Layer",
        (),
        "Its brightness is how high the land lies; no export shows it",
        _toggle_height,
        _can_be_reference,
        _is_height,
    ),
    "erode": A(
        "Erode…", "Layer", (), "Let rain cut gullies into the land in view",
        lambda desk: desk.asked.show("erode"), _has_land,
    ),
    "show_only": A(
        "Show only this", "Layer", (), "Look at the layer alone; the painting stays what it is", _show_only, chosen,
        _is_shown_only,
    ),
    "show_all": A("Show all", "Layer", (), "Look at the whole painting again", _show_all, _sees_one),
    "raise": A("Move up", "Layer/Move", ("Ctrl+PageUp",), "Move the layer up", _moves(1), chosen),
    "lower": A("Move down", "Layer/Move", ("Ctrl+PageDown",), "Move the layer down", _moves(-1), chosen),
    "remove": A("Delete", "Layer", ("Shift+Delete",), "Delete the layer, or all that are chosen", _remove, chosen),
    "left": A("Nudge left", "Layer/Move", ("Left",), _NUDGE, _nudges(-1, 0), chosen),
    "right": A("Nudge right", "Layer/Move", ("Right",), _NUDGE, _nudges(1, 0), chosen),
    "up": A("Nudge up", "Layer/Move", ("Up",), _NUDGE, _nudges(0, -1), chosen),
    "down": A("Nudge down", "Layer/Move", ("Down",), _NUDGE, _nudges(0, 1), chosen),
    "set_down": A(
        "Set down", "Layer/Move", ("Enter",),
        "Lay what you moved of the layer where it is now (Escape takes it back), or end with the frame",
        _set_down, _floats,
    ),
    "set_above": A(
        "Set down above", "Layer/Move", (),
        "Lay what you turned or scaled of the layer above it: no pixel of it is made anew, and its ink stays ink",
        lambda desk: set_part_down(desk, above=True), _samples,
    ),
    "show_layer": A("Show layer", "Layer", (), "Show the layer, and the groups around it", _show, _hidden),
}  # fmt: skip
