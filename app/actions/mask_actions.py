"""The actions that make, change and paint on masks."""

from __future__ import annotations

from collections.abc import Callable

from app.actions.action import Action as A
from app.actions.action import active, chosen
from app.desk.desk import Desk
from engine.painting import commands as c
from engine.painting.layering.mask_member import (
    MASK_APPLY,
    MASK_EMPTY,
    MASK_FULL,
    MASK_INVERT,
    MASK_LAY,
    MASK_OFF,
    MASK_ON,
    MaskOp,
)
from engine.studio.requests import Do


def _mask(desk: Desk) -> None:
    desk.post(Do(c.SetLayer(active(desk), mask=True)))


def _add(op: str) -> Callable[[Desk], None]:
    """Adds a mask, of what is selected where it would be full, and paints on it from then on."""

    def add(desk: Desk) -> None:
        name = active(desk)
        desk.masks.coming = name
        desk.post(Do(c.SetLayer(name, mask=True if op == MASK_FULL and desk.selecting.selected else MaskOp(op))))

    return add


def _unmask(desk: Desk) -> None:
    desk.post(Do(c.SetLayer(active(desk), mask=False)))


def _does(op: str) -> Callable[[Desk], None]:
    return lambda desk: desk.post(Do(c.SetLayer(active(desk), mask=MaskOp(op))))


def _can_mask(desk: Desk) -> bool:
    return chosen(desk) and desk.known.active is not None


def _apply(desk: Desk) -> None:
    """Takes off what the mask hides; what a placement shows becomes paint, and where that loses detail the artist does
    that before."""
    row = desk.known.active
    if row is not None and row.shows is not None and row.shows.pose.similarity.quarter is None:
        desk.say(f"“{row.name}” is turned or scaled by parts: make it independent before", True, offer="independent")
    else:
        _does(MASK_APPLY)(desk)


def _can_mask_selected(desk: Desk) -> bool:
    return _can_mask(desk) and desk.selecting.selected


def _can_add(desk: Desk) -> bool:
    return _can_mask(desk) and not is_masked(desk)


def is_masked(desk: Desk) -> bool:
    """Tells whether the active layer or group has a mask."""
    return chosen(desk) and desk.known.active is not None and desk.known.active.masked


def _can_apply(desk: Desk) -> bool:
    row = desk.known.active
    return is_masked(desk) and row is not None and not row.group and not row.locked


def _is_off(desk: Desk) -> bool:
    return desk.known.active is not None and desk.known.active.mask_off


def _is_turned(desk: Desk) -> bool:
    return is_masked(desk) and desk.known.active is not None and desk.known.active.mask_turned


def toggle_off(desk: Desk) -> None:
    """Puts the active layer's mask aside, or takes it up again."""
    _does(MASK_ON if _is_off(desk) else MASK_OFF)(desk)


def painting_mask(desk: Desk) -> bool:
    """Tells whether the mask is painted on."""
    return desk.masks.on(desk.known.active)


def toggle_painting(desk: Desk) -> None:
    """Paints on the active layer's mask from now on, or on its paint again."""
    if painting_mask(desk):
        desk.masks.end(desk.post)
    else:
        desk.masks.begin(desk.post, active(desk))
        desk.say("You paint on the mask now: white shows, black hides")


def _toggle_alone(desk: Desk) -> None:
    if not painting_mask(desk):
        desk.masks.begin(desk.post, active(desk), alone=True)
    else:
        desk.masks.show(desk.post, not desk.masks.alone)


MASK_ACTIONS: dict[str, A] = {
    "mask": A(
        "Mask from selection",
        "Layer/Mask",
        (),
        "Show only what is selected of the layer; no paint is lost",
        _mask,
        _can_mask_selected,
    ),
    "mask_full": A(
        "Add mask",
        "Layer/Mask",
        (),
        "Show what is selected alone, or all: paint black on it to hide",
        _add(MASK_FULL),
        _can_add,
    ),
    "mask_empty": A(
        "Add mask, hiding all",
        "Layer/Mask",
        (),
        "A mask that hides all: paint white on it to show",
        _add(MASK_EMPTY),
        _can_add,
    ),
    "mask_paint": A(
        "Paint on mask",
        "Layer/Mask",
        ("Ctrl+Alt+M",),
        "Brush and fills go to the mask: white shows, black hides",
        toggle_painting,
        is_masked,
        painting_mask,
    ),
    "mask_alone": A(
        "Show mask alone",
        "Layer/Mask",
        (),
        "See the mask in place of the picture",
        _toggle_alone,
        is_masked,
        lambda desk: painting_mask(desk) and desk.masks.alone,
    ),
    "mask_invert": A(
        "Invert mask", "Layer/Mask", (), "Show what it hides, hide what it shows", _does(MASK_INVERT), is_masked
    ),
    "mask_off": A(
        "Mask off",
        "Layer/Mask",
        (),
        "Show the layer as if it had no mask",
        toggle_off,
        is_masked,
        _is_off,
    ),
    "mask_lay": A(
        "Lay mask anew",
        "Layer/Mask",
        (),
        "Make pixels of a mask that was turned or scaled with the layer, to paint on it",
        _does(MASK_LAY),
        _is_turned,
    ),
    "mask_apply": A(
        "Apply mask",
        "Layer/Mask",
        (),
        "Take off the paint that it hides, then the mask",
        _apply,
        _can_apply,
    ),
    "unmask": A("Remove mask", "Layer/Mask", (), "Show all of the layer again", _unmask, is_masked),
}
