"""Going to places: where one is, and the ways from there, each a flight that can be gone back."""

from __future__ import annotations

from dataclasses import replace

from app.canvas.standpoint import Size, Standpoint, standpoint_at
from app.canvas.view import place_of_pixel
from app.desk.desk import Desk
from app.desk.places.typed_place import place_text, typed_standpoint
from engine.checks.field_error import FieldError
from engine.painting.places import LEVEL_LIMIT, Bookmark
from engine.studio.results import Spot

_COARSER = 4  # levels: the nearest paint is looked at from here, if it is no coarser than that
_SCREENS = 4  # and no farther away


def here(desk: Desk) -> Standpoint:
    """Returns where one is: what lies in the middle of what no panel covers."""
    return Standpoint.of(desk.view, *desk.middle())


def free_size(desk: Desk) -> Size:
    """Returns width and height of what no panel covers, framebuffer pixels."""
    x0, y0, x1, y1 = desk.free_area()
    return max(x1 - x0, 1.0), max(y1 - y0, 1.0)


def watch(desk: Desk, now: float) -> None:
    """Takes in where one is; called in every frame."""
    if not desk.glide.moving:
        desk.places.trail.watch(here(desk), now, min(free_size(desk)))


def go(desk: Desk, there: Standpoint) -> None:
    """Flies there; both ends can be gone back to."""
    desk.places.trail.leap(here(desk), there, min(free_size(desk)))
    _fly(desk, there)


def _fly(desk: Desk, there: Standpoint) -> None:
    desk.view = desk.glide.travel(desk.view, there, *desk.middle())


def step(desk: Desk, by: int) -> None:
    """Goes back (`by` -1) or forward (1) through where one has been."""
    there = desk.places.trail.step(here(desk), by, min(free_size(desk)))
    if there is not None:
        _fly(desk, there)


def go_to_bookmark(desk: Desk, bookmark: Bookmark) -> None:
    """Flies to a bookmark; into the land, if it was made there."""
    if bookmark.outlook is not None:
        desk.land.stand(bookmark.outlook)
        return
    desk.land.on = False
    go(desk, standpoint_at(bookmark, free_size(desk)))


def bookmark_here(desk: Desk, name: str) -> Bookmark | None:
    """Returns the view as a bookmark; None, and says why, where that is too deep."""
    there = here(desk)
    if abs(there.level) >= LEVEL_LIMIT:
        desk.say(f"Bookmarks lie on levels from -{LEVEL_LIMIT} to {LEVEL_LIMIT}", bad=True)
        return None
    return replace(there.bookmark(name, free_size(desk)), outlook=desk.land.outlook_here())


def go_to_spot(desk: Desk, spot: Spot) -> None:
    """Flies to paint of the map: all of it is seen, at its own level or a coarser one."""
    (wide, tall), rect = free_size(desk), spot.rect
    if rect.width <= wide and rect.height <= tall:
        place = place_of_pixel(spot.level + 1, rect.x0 + rect.x1, rect.y0 + rect.y1)
        zoom = spot.level, 0.0
    else:
        seen = Bookmark("", spot.level, (rect.x0, rect.y0), (rect.width, rect.height))
        there = standpoint_at(seen, (wide, tall))
        place, zoom = there.place, (there.level, there.fraction)
    go(desk, Standpoint(place, *zoom, desk.view.angle, desk.view.mirrored))


def go_to_nearest(desk: Desk) -> None:
    """Flies to the nearest paint, at its level; across, if it is near enough to be seen from this one."""
    sought = desk.places.sought
    if sought is None or sought.nearest is None:
        return
    level, x, y = sought.nearest
    place = place_of_pixel(level + 1, 2 * x + 1, 2 * y + 1)  # the middle of the pixel
    now = here(desk)
    zoom = (level, 0.0)
    if 0 <= now.level - level <= _COARSER:
        px, py = place.offset(now.level, *now.place.pixel(now.level))
        if max(abs(px), abs(py)) * 2.0**now.fraction <= _SCREENS * max(free_size(desk)):
            zoom = now.level, now.fraction
    go(desk, Standpoint(place, *zoom, now.angle, now.mirrored))


def typed_text(desk: Desk) -> str:
    """Returns the place in the middle as text, which can be copied and typed again."""
    return place_text(here(desk), desk.view.shown_level)


def go_to_typed(desk: Desk, text: str) -> str:
    """Flies to a place that was typed; returns what is wrong with it, empty if nothing is."""
    try:
        there = typed_standpoint(text, here(desk), desk.view.shown_level, free_size(desk))
    except FieldError as error:
        return f"Expected {error.expected}"
    go(desk, there)
    return ""
