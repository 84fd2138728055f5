"""The symmetry that strokes are painted with: a guide of the painting, at any angle, whatever the view."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

from app.canvas.view import Place, View, place_of_pixel
from app.desk.desk import Desk
from app.desk.guides.guide_state import Own
from app.desk.guides.present import is_told, present_guides
from engine.brush.copies import NO_COPIES, Copies, symmetric
from engine.painting.guiding.guides import Guide
from engine.painting.stroke_copies import FURTHEST, fits
from engine.studio.requests import Do

SYMMETRY = "Symmetry"
MOST_PARTS = 24  # parts that the slider offers
_SLANT = 0.01  # of an axis that counts as neither level nor upright
_ARM = 160.0  # points of the screen from the centre to the point on the axis
_NEAR = 1 << 28  # px: a centre farther from a stroke gives it no copies


@dataclass(frozen=True, slots=True)
class Way:
    """A row of the ways of symmetry: what a guide of that way has.  `axis`: the direction of its axis at first."""

    title: str
    hint: str
    mirror: bool
    counts: bool = False
    axis: tuple[float, float] = (0.0, -1.0)
    count: int = 1


WAYS: dict[str, Way] = {
    "off": Way("Off", "Strokes are painted once", False),
    "mirror": Way("Mirror", "Left and right of an upright axis", True),
    "level": Way("Mirror, level", "Above and below a level axis", True, axis=(1.0, 0.0)),
    "slanted": Way("Mirror, slanted", "Across an axis of any angle", True, axis=(math.sqrt(0.5), -math.sqrt(0.5))),
    "both": Way("Both mirrors", "In all four corners", True, count=2),
    "radial": Way("Radial", "Turned about the centre", False, counts=True, count=6),
    "kaleidoscope": Way("Kaleidoscope", "Turned about the centre, and mirrored", True, counts=True, count=6),
}


def guide_of(desk: Desk) -> Guide | None:
    """Returns the painting's symmetry, as it is being moved if it is; None if it has none."""
    return next((guide for guide in present_guides(desk) if guide.kind == "symmetry"), None)


def way_of(guide: Guide | None) -> str:
    """Returns which row of WAYS a guide is of."""
    if guide is None or guide.off:
        return "off"
    if not guide.mirror:
        return "radial"
    if guide.count > 2:
        return "kaleidoscope"
    if guide.count == 2:
        return "both"
    (x0, y0), (x1, y1) = guide.points
    across, down = abs(x1 - x0), abs(y1 - y0)
    if min(across, down) > _SLANT * max(across, down):
        return "slanted"
    return "level" if across > down else "mirror"


def set_symmetry(desk: Desk, guide: Guide) -> None:
    """Makes a guide the symmetry: a step of the painting, which counts as none where the hand takes steps back."""
    desk.guides.own = Own(guide, _serial(desk))
    desk.post(Do(guide))


def keep(desk: Desk) -> None:
    """Keeps the symmetry as it is, while steps are taken back or done again."""
    guide = guide_of(desk)
    if guide is not None:
        desk.guides.own = Own(guide, _serial(desk), kept=True)


def restore(desk: Desk) -> None:
    """Makes the symmetry that was kept the painting's again, where that has another by now: before a stroke."""
    own, scene = desk.guides.own, desk.known.scene
    if own is None or not own.kept or scene is None or own.serial != scene.serial:
        return
    if not is_told(own.guide, scene.guides):
        set_symmetry(desk, own.guide)


def _serial(desk: Desk) -> int:
    return desk.known.scene.serial if desk.known.scene is not None else 0


def choose(desk: Desk, name: str) -> None:
    """Paints with another symmetry from now on: about the centre that there is, else about the middle."""
    guide, way = guide_of(desk), WAYS[name]
    if name == "off":
        if guide is not None and not guide.off:
            set_symmetry(desk, replace(guide, off=True))
        return
    same = guide is not None and way_of(replace(guide, off=False)) == name
    if guide is not None and same:
        set_symmetry(desk, replace(guide, off=False))
        return
    found = guide or lying(desk.view, first_centre(desk), (0.0, 0.0))
    count = guide.count if guide is not None and way.counts and guide.count > 2 else way.count
    x, y = found.points[0]
    length = math.dist(*found.points)
    end = (x + way.axis[0] * length, y + way.axis[1] * length)
    set_symmetry(desk, replace(found, points=((x, y), end), count=count, mirror=way.mirror, off=False))


def toggle(desk: Desk) -> None:
    """Switches it off, or on again as it was; a mirror where there was none."""
    guide = guide_of(desk)
    if guide is None:
        choose(desk, "mirror")
    else:
        set_symmetry(desk, replace(guide, off=not guide.off))


def set_count(desk: Desk, count: int) -> None:
    """Turns strokes by other parts of a full turn."""
    guide = guide_of(desk)
    if guide is not None and guide.count != count:
        set_symmetry(desk, replace(guide, count=max(2, min(MOST_PARTS, count))))


def bring_here(desk: Desk) -> None:
    """Brings the centre into the middle of what is seen."""
    guide = guide_of(desk)
    if guide is not None:
        here = lying(desk.view, desk.view.to_canvas(*desk.middle()), direction(guide))
        set_symmetry(desk, replace(guide, level=here.level, at=here.at, points=here.points))


def first_centre(desk: Desk) -> Place:
    """Returns the middle of the frame where it is in sight, else that of what is seen."""
    frame = desk.known.frame
    centre = Place(frame.x0 + frame.x1, frame.y0 + frame.y1, 1)
    x, y = desk.view.to_screen(centre)
    x0, y0, x1, y1 = desk.free_area()
    return centre if x0 <= x <= x1 and y0 <= y <= y1 else desk.view.to_canvas(*desk.middle())


def lying(view: View, centre: Place, way: tuple[float, float]) -> Guide:
    """Returns a symmetry about a place, on the canvas at the level that is shown, its axis in a direction;
    upright where that is (0, 0)."""
    level = view.shown_level
    at = centre.pixel(level)
    x, y = centre.offset(level, *at)
    length = math.hypot(*way)
    dx, dy = (way[0] / length, way[1] / length) if length else (0.0, -1.0)
    arm = min(_ARM / view.scale(level), 4096.0)
    return Guide(SYMMETRY, "symmetry", level, at, ((x, y), (x + dx * arm, y + dy * arm)))


def direction(guide: Guide) -> tuple[float, float]:
    """Returns the direction of its axis on the canvas."""
    (x0, y0), (x1, y1) = guide.points[:2]
    return x1 - x0, y1 - y0


def centre_of(guide: Guide) -> Place:
    """Returns where its first point lies."""
    return place_of_pixel(guide.level, *guide.at).moved(*guide.points[0], guide.level)


def copies_at(desk: Desk, level: int, origin: tuple[int, int]) -> Copies:
    """Returns the copies of a stroke at a level, from an origin."""
    guide = guide_of(desk)
    if guide is None or guide.off:
        return NO_COPIES
    x, y = centre_of(guide).offset(level, *origin)
    if max(abs(x), abs(y)) > min(_NEAR, FURTHEST / 4):
        desk.say("The centre of the symmetry is too far away to paint by", offer="symmetry_here")
        return NO_COPIES
    found = symmetric((x, y), guide.count, direction(guide) if guide.mirror else None)
    return tuple(copy for copy in found if fits(copy))


def axes(guide: Guide) -> list[tuple[float, float]]:
    """Returns the directions of its lines from the centre: both ways along each axis, or along each part's edge."""
    x, y = direction(guide)
    length = math.hypot(x, y)
    turn, parts = (math.pi / guide.count, 2 * guide.count) if guide.mirror else (math.tau / guide.count, guide.count)
    begin = math.atan2(y, x)
    return [(math.cos(begin + k * turn), math.sin(begin + k * turn)) for k in range(parts)] if length else []


def handles(desk: Desk, guide: Guide) -> list[tuple[float, float]]:
    """Returns where its handles are on the screen: the centre, and the end of its axis, as far away at any zoom."""
    x, y = desk.view.to_screen(centre_of(guide))
    a, b, c, d = desk.view.matrix()
    dx, dy = direction(guide)
    arm = _ARM * desk.scale / math.hypot(dx, dy)
    return [(x, y), (x + (a * dx + b * dy) * arm, y + (c * dx + d * dy) * arm)]


def pressed(desk: Desk, guide: Guide, x: float, y: float, reach: float) -> int | None:
    """Returns which handle a press is on; None for none."""
    found = [(math.dist(at, (x, y)), n) for n, at in enumerate(handles(desk, guide))]
    distance, nearest = min(found)
    return nearest if distance <= reach else None


def on_screen(view: View, guide: Guide) -> Copies:
    """Returns the copies about a centre at (0, 0) as they are seen on the screen."""
    a, b, c, d = view.matrix()
    dx, dy = direction(guide)
    axis = (a * dx + b * dy, c * dx + d * dy)
    return symmetric((0.0, 0.0), guide.count, axis if guide.mirror else None)
