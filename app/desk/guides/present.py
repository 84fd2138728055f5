"""The guides of the painting, as they are while one of them is moved."""

from __future__ import annotations

from dataclasses import replace

from immutables import Map

from app.desk.desk import Desk
from engine.painting.guiding.guides import Guide


def present_guides(desk: Desk) -> tuple[Guide, ...]:
    """Returns the painting's guides, with the one in hand as it is by now."""
    held, scene = desk.guides.held, desk.known.scene
    guides = scene.guides if scene is not None else ()
    if held is not None and (scene is None or held.serial != scene.serial or _told(held.guide, guides)):
        desk.guides.held = held = None
    if held is None:
        return guides
    if all(guide.name != held.guide.name for guide in guides):
        return (*guides, held.guide)
    return tuple(held.guide if guide.name == held.guide.name else guide for guide in guides)


def _told(guide: Guide, guides: tuple[Guide, ...]) -> bool:
    """Tells whether a guide is among others, whatever members they have besides, such as when they were made."""
    plain = replace(guide, extra=Map())
    return any(replace(other, extra=Map()) == plain for other in guides if other.name == guide.name)


def assistants(desk: Desk) -> tuple[Guide, ...]:
    """Returns those that are drawn by, not turned off: all but symmetry."""
    return tuple(guide for guide in present_guides(desk) if guide.kind != "symmetry" and not guide.off)
