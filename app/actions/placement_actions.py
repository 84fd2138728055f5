"""The actions of the Layer menu about placements, and about where what is chosen lies."""

from __future__ import annotations

from collections.abc import Callable

from app.actions.action import Action as A
from app.actions.action import ready
from app.desk.desk import Desk
from app.desk.moving import held_box
from app.desk.moving.box import spot
from app.desk.moving.poses import mirrored
from app.desk.moving.setting_down import set_down
from app.desk.stack.chosen_layer import choose_layer
from engine.studio.moving.move_requests import AskBake
from engine.studio.results import Shows


def _shows(desk: Desk) -> Shows | None:
    row = desk.known.active
    return None if row is None else row.shows


def _leads(desk: Desk) -> bool:
    shows = _shows(desk)
    return ready(desk) and shows is not None and shows.name is not None


def _shows_any(desk: Desk) -> bool:
    row = desk.known.active
    return ready(desk) and row is not None and row.shows is not None and not row.locked


def _movable(desk: Desk) -> bool:
    row = desk.known.active
    return ready(desk) and row is not None and not row.locked and desk.past.looking is None


def _go_to_source(desk: Desk) -> None:
    shows = _shows(desk)
    if shows is not None and shows.name is not None:
        choose_layer(desk, shows.name)


def _make_independent(desk: Desk) -> None:
    row = desk.known.active
    if row is not None:
        desk.post(AskBake(row.name))


def _mirrors(across: bool) -> Callable[[Desk], None]:
    def mirror(desk: Desk) -> None:
        row = desk.known.active
        held = None if row is None else held_box.part(desk, row)
        if row is not None and held is not None:
            pose = desk.moving.pose(desk.known, row)
            set_down(desk, row, mirrored(pose, spot(held, pose, 0, 0), across))

    return lambda desk: desk.moving.sure(desk.known, lambda: mirror(desk))


PLACEMENT_ACTIONS: dict[str, A] = {
    "source": A("Go to source", "Layer/Placement", (), "Choose what it shows, to paint on that", _go_to_source, _leads),
    "independent": A(
        "Make independent", "Layer/Placement", (),
        "Bake: paint of its own of what it shows; turned by parts, ink becomes pixels",
        _make_independent, _shows_any,
    ),
    "mirror_layer": A(
        "Mirror left to right", "Layer/Move", (), "Swap left and right of the layer, about its middle", _mirrors(False),
        _movable,
    ),
    "mirror_layer_down": A(
        "Mirror top to bottom", "Layer/Move", (), "Swap top and bottom of the layer, about its middle", _mirrors(True),
        _movable,
    ),
}  # fmt: skip
