"""Rulers, ellipses, vanishing points and grids as the window makes and changes them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from fractions import Fraction
from typing import NamedTuple

from app.desk.desk import Desk
from app.desk.guides.guide_state import Held
from app.desk.guides.present import present_guides
from app.desk.guides.reshaping import CELL, fresh, guide_at
from app.desk.naming import free_name
from engine.painting.guiding.guides import Guide, RemoveGuide
from engine.studio.requests import Do


class Assistant(NamedTuple):
    """A row of the kinds of guides that strokes are drawn onto."""

    title: str
    hint: str


ASSISTANTS: dict[str, Assistant] = {
    "ruler": Assistant("Ruler", "Strokes along it become straight"),
    "parallel": Assistant("Parallel ruler", "Strokes in its direction become straight, wherever they are"),
    "ellipse": Assistant("Ellipse ruler", "Strokes along it become an ellipse or a circle"),
    "grid": Assistant("Grid", "Strokes along its lines are drawn onto them"),
    "perspective-1": Assistant("One-point perspective", "Lines into the depth meet in one point on the horizon"),
    "perspective-2": Assistant("Two-point perspective", "Lines meet in two points on the horizon; others are upright"),
    "perspective-3": Assistant("Three-point perspective", "Lines meet in three points, as seen from above or below"),
}


def chosen_guide(desk: Desk) -> Guide | None:
    """Returns the guide whose numbers are shown."""
    return next((guide for guide in present_guides(desk) if guide.name == desk.guides.chosen), None)


def add_guide(desk: Desk, kind: str) -> None:
    """Adds a guide in the middle of what is seen, and takes up the tool that moves its points."""
    x0, y0, x1, y1 = desk.free_area()
    level, scale = desk.view.shown_level, desk.view.scale(desk.view.shown_level)
    origin = desk.view.to_canvas(*desk.middle()).pixel(level)
    a, b, c, d = desk.view.matrix()
    if kind == "grid":  # as the canvas lies, and on its pixels
        (a, b, c, d), origin = (1.0, 0.0, 0.0, 1.0), (origin[0] & ~(CELL - 1), origin[1] & ~(CELL - 1))
    points = [
        (Fraction(round((a * x + c * y) / scale)), Fraction(round((b * x + d * y) / scale)))
        for x, y in fresh(kind, (x1 - x0, y1 - y0))
    ]
    name = free_name(ASSISTANTS[kind].title, {guide.name for guide in present_guides(desk)})
    made = guide_at(Guide(name, kind, level, (0, 0), ((0.0, 0.0),) * len(points)), points, level, origin)
    if made is None:
        desk.say("This is too deep for a guide", bad=True)
        return
    desk.guides.shown = True
    desk.hand.use("guides")
    set_guide(desk, made)


def adds(kind: str) -> Callable[[Desk], None]:
    """Returns what adds a guide of a kind."""
    return lambda desk: add_guide(desk, kind)


def set_guide(desk: Desk, guide: Guide) -> None:
    """Makes a guide become another, or a new one: one step."""
    if guide in present_guides(desk):
        return
    serial = desk.known.scene.serial if desk.known.scene is not None else 0
    desk.guides.chosen, desk.guides.held = guide.name, Held(guide, serial)
    desk.post(Do(guide))


def remove_it(desk: Desk) -> None:
    """Takes the guide that is chosen away."""
    guide = chosen_guide(desk)
    if guide is not None:
        desk.guides.chosen, desk.guides.held = "", None
        desk.post(Do(RemoveGuide(guide.name)))


def toggle_snaps(desk: Desk) -> None:
    """Draws strokes onto guides, or freely."""
    desk.guides.snaps = not desk.guides.snaps


def toggle_shown(desk: Desk) -> None:
    """Shows the guides, or hides them; they work all the same."""
    desk.guides.shown = not desk.guides.shown
    if not desk.guides.shown and desk.hand.tool == "guides":
        desk.hand.use("brush")


def show_all(desk: Desk) -> None:
    """Brings all hidden guides back."""
    for guide in present_guides(desk):
        if guide.off and guide.kind != "symmetry":
            desk.post(Do(replace(guide, off=False)))
