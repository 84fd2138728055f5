"""The guides of the painting, as they are while one of them is moved."""

from __future__ import annotations

from dataclasses import replace

from immutables import Map

from app.desk.desk import Desk
from engine.painting.guiding.guides import Guide


def present_guides(desk: Desk) -> tuple[Guide, ...]:
    """Returns the painting's guides, with the symmetry as the hand has it, and the one in hand as it is by now."""
    held, own, scene = desk.guides.held, desk.guides.own, desk.known.scene
    guides = scene.guides if scene is not None else ()
    if own is not None and scene is not None and not own.kept and is_told(own.guide, guides):
        desk.guides.own = own = None
    if own is not None and (scene is None or own.serial == scene.serial):
        guides = _with(own.guide, guides)
    if held is not None and (scene is None or held.serial != scene.serial or is_told(held.guide, guides)):
        desk.guides.held = held = None
    return guides if held is None else _with(held.guide, guides)


def _with(one: Guide, guides: tuple[Guide, ...]) -> tuple[Guide, ...]:
    if all(guide.name != one.name for guide in guides):
        return (*guides, one)
    return tuple(one if guide.name == one.name else guide for guide in guides)


def is_told(guide: Guide, guides: tuple[Guide, ...]) -> bool:
    """Tells whether a guide is among others, whatever members they have besides, such as when they were made."""
    plain = replace(guide, extra=Map())
    return any(replace(other, extra=Map()) == plain for other in guides if other.name == guide.name)


def assistants(desk: Desk) -> tuple[Guide, ...]:
    """Returns those that are drawn by, not turned off: all but symmetry."""
    return tuple(guide for guide in present_guides(desk) if guide.kind != "symmetry" and not guide.off)
