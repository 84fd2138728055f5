"""The box around what is moved, as it lies on the screen, and which of its handles is where."""

from __future__ import annotations

import math
from dataclasses import dataclass

from app.canvas.view import View, dyadic_place
from engine.canvas.placing.pose import Pose, SourcePart
from engine.numeric.similarity import Dyadic

Point = tuple[float, float]  # of the screen
Area = tuple[float, float, float, float]  # of it: left, top, right, bottom
_ANYWHERE: Area = (-1e9, -1e9, 1e9, 1e9)
# By name: where each handle lies on the box, across and down, in halves of its sides from its middle.
SCALES: dict[str, tuple[int, int]] = {
    "top left": (-1, -1), "top": (0, -1), "top right": (1, -1), "right": (1, 0),
    "bottom right": (1, 1), "bottom": (0, 1), "bottom left": (-1, 1), "left": (-1, 0),
}  # fmt: skip
CORNERS = tuple(name for name, (x, y) in SCALES.items() if x and y)
TURN, INSIDE = "turn", "inside"
_LEAST = 14.0  # points from the box's middle to its sides, as it is drawn: less, and its handles lay on one another
_SIDES = 26.0  # the same, below which there are handles at the corners alone
_STEM = 26.0  # points from the box to the handle that turns
_RIM, _TOP = 14.0, 50.0  # points from the rim of what is free that handles stay away; from above, where its bar is
GRASP = 9.0  # points around a handle that take hold of it
_AROUND = 30.0  # points outside a corner that turn the box
_FAR = 1e7  # pixels: what is farther lies there


@dataclass(frozen=True, slots=True)
class Box:
    """`middle`, and from it to the middles of the right and of the lower side, in pixels of the screen; `scale`: pixels
    a point; `area`: the part of the screen within which its handles are kept."""

    middle: Point
    right: Point
    down: Point
    scale: float
    area: Area = _ANYWHERE

    def at(self, x: float, y: float) -> Point:
        """Returns a place of it: -1 to 1 across and down."""
        (mx, my), (ax, ay), (bx, by) = self.middle, self.right, self.down
        return mx + x * ax + y * bx, my + x * ay + y * by

    @property
    def corners(self) -> tuple[Point, Point, Point, Point]:
        """Gives its corners, one after another."""
        return self.at(-1, -1), self.at(1, -1), self.at(1, 1), self.at(-1, 1)

    @property
    def handles(self) -> dict[str, Point]:
        """Gives the handles that scale, by their names: no more than there is room for."""
        sides = {"top", "bottom"} if _long(self.right) < _SIDES * self.scale else set()
        sides |= {"left", "right"} if _long(self.down) < _SIDES * self.scale else set()
        return {name: self._kept(self.at(*place), 0.0) for name, place in SCALES.items() if name not in sides}

    @property
    def turner(self) -> Point:
        """Gives the handle that turns: above the top side, or below it where that is beyond what is free."""
        x, y = self.at(0, -1)
        by = _STEM * self.scale / max(_long(self.down), 1e-9)
        return self._kept((x - by * self.down[0], y - by * self.down[1]), _STEM)

    def _kept(self, point: Point, inwards: float) -> Point:
        """Returns where a handle is taken hold of: on its way from the middle of what is seen of the box, as far out as
        is free, and so many points less."""
        rim, top = (_RIM + inwards) * self.scale, (_TOP + inwards) * self.scale
        x0, y0, x1, y1 = self.area
        low, high = (x0 + rim, y0 + top), (x1 - rim, y1 - rim)
        if all(a <= v <= b for a, v, b in zip(low, point, high, strict=True)):
            return point
        u, v = self._told((x0 + x1) / 2, (y0 + y1) / 2)
        from_ = self.at(min(max(u, -1.0), 1.0), min(max(v, -1.0), 1.0))
        if not all(a <= v <= b for a, v, b in zip(low, from_, high, strict=True)):
            return point  # nothing of the box is seen, or next to nothing
        part = 1.0
        for begin, end, least, most in zip(from_, point, low, high, strict=True):
            if end != begin:
                part = min(part, ((most if end > begin else least) - begin) / (end - begin))
        return from_[0] + part * (point[0] - from_[0]), from_[1] + part * (point[1] - from_[1])

    def holds(self, x: float, y: float) -> bool:
        """Tells whether a point of the screen lies within."""
        u, v = self._told(x, y)
        return abs(u) <= 1 and abs(v) <= 1

    def grip(self, x: float, y: float) -> str:
        """Returns what a press at a point of the screen takes hold of: a handle, INSIDE, TURN, or "" for nothing."""
        near = GRASP * self.scale
        found = [(math.dist((x, y), at), name) for name, at in (*self.handles.items(), (TURN, self.turner))]
        least, name = min(found)
        if least <= near:
            return name
        if self.holds(x, y):
            return INSIDE
        corner = min(math.dist((x, y), self.at(*SCALES[name])) for name in CORNERS)
        return TURN if corner <= _AROUND * self.scale else ""

    def _told(self, x: float, y: float) -> Point:
        """Returns where a point of the screen lies on it, as `at` takes it."""
        dx, dy = x - self.middle[0], y - self.middle[1]
        (ax, ay), (bx, by) = self.right, self.down
        return (dx * ax + dy * ay) / (ax * ax + ay * ay), (dx * bx + dy * by) / (bx * bx + by * by)


def _long(vector: Point) -> float:
    return math.hypot(*vector)


def spot(part: SourcePart, pose: Pose, x: int, y: int) -> Dyadic:
    """Returns where a place of a part of a source is shown; -1 to 1 across and down, as of a Box."""
    rect = part.rect
    across = (rect.x0 + rect.x1) + x * rect.width, (rect.y0 + rect.y1) + y * rect.height
    return pose.similarity(Dyadic.of(*across, part.level + 1))


def opposite(part: SourcePart, pose: Pose, handle: str) -> Dyadic:
    """Returns what stays where it is when a handle is dragged."""
    x, y = SCALES[handle]
    return spot(part, pose, -x, -y)


def box_of(view: View, scale: float, part: SourcePart, pose: Pose, area: Area | None = None) -> Box | None:
    """Returns the box of what shows a part of a source, with its handles within an area of the screen; None if that is
    too far away to be drawn."""
    middle = view.to_screen(dyadic_place(spot(part, pose, 0, 0)))
    sides = [view.to_screen(dyadic_place(spot(part, pose, x, y))) for x, y in ((1, 0), (0, 1), (-1, 0), (0, -1))]
    if max(map(abs, (*middle, *(v for side in sides for v in side)))) > _FAR:
        return None
    (ax, ay), (bx, by) = ((sides[i][0] - sides[i + 2][0], sides[i][1] - sides[i + 2][1]) for i in (0, 1))
    sides_of = _longer((ax / 2, ay / 2), (scale, 0.0)), _longer((bx / 2, by / 2), (0.0, scale))
    return Box(middle, *sides_of, scale, _ANYWHERE if area is None else area)


def _longer(vector: Point, least: Point) -> Point:
    """Returns a vector no shorter than a box can be drawn with; along `least`, a point long, where it has no length."""
    long = _long(vector)
    if long < 1e-6:
        return _LEAST * least[0], _LEAST * least[1]
    by = max(1.0, _LEAST * _long(least) / long)
    return vector[0] * by, vector[1] * by
