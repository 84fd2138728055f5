"""What the window holds to draw by itself what is dragged: at once, wherever it is, until the engine has shown it."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

from app.canvas.sheet_pass import ABOVE, BELOW, MOVED, Quad, SheetPlan
from app.canvas.view import View, dyadic_place
from app.desk.known import Known
from engine.canvas.placing.pose import Pose
from engine.numeric.address import Rect
from engine.numeric.similarity import Dyadic
from engine.studio.moving.sheet_records import AskSheets, AskShown, CarriedSheets, DropSheets, Shown
from engine.studio.requests import Request
from engine.studio.results import LayerRow, Scene

_REST = 0.15  # seconds that the view stays before they are asked for
_AROUND = 4  # part of the sides of what is seen that is asked for beyond them of what is moved


class Asked(NamedTuple):
    """Of what they are, and how that is seen: `pose` is where it is shown."""

    scene: Scene | None
    name: str
    view: View
    pose: Pose


class Carried(NamedTuple):
    """Where what is dragged is seen: `pose`, of the sheets' own place `place`; `twice`: there, too."""

    pose: Pose
    place: Dyadic
    twice: bool


@dataclass(slots=True)
class SheetState:
    """`held`: the newest that came; `carried`: where what they show is dragged to, None while nothing is."""

    held: CarriedSheets | None = None
    carried: Carried | None = None
    _number: int = 0
    _asked: Asked | None = None
    _next: tuple[Asked, float] | None = None  # what will be asked for, and since when it is the same
    _ending: int | None = None

    def wants(
        self, post: Callable[[Request], None], known: Known, row: LayerRow | None, view: View, now: float
    ) -> None:
        """Asks for those of a row once the view rests; `row`: None where none are wanted."""
        if self.carried is not None:
            if self._asked is not None and self._asked.view != view:
                self.forget()
            return
        if row is None or not row.visible:
            if self._asked is not None:
                self.forget()
                post(DropSheets())
            return
        wanted = Asked(known.scene, row.name, view, Pose() if row.shows is None else row.shows.pose)
        if self._same(self._asked, wanted):
            return
        if self._next is None or not self._same(self._next[0], wanted):
            self._next = wanted, now
        elif now - self._next[1] >= _REST:
            self._asked, self._next, self.held = wanted, None, None
            self._number += 1
            level = view.shown_level
            rect = view.visible(level)
            across, down = rect.width // _AROUND, rect.height // _AROUND
            around = Rect(rect.x0 - across, rect.y0 - down, rect.x1 + across, rect.y1 + down)
            post(AskSheets(self._number, row.name, level, rect, around))

    @staticmethod
    def _same(one: Asked | None, other: Asked) -> bool:
        return one is not None and one.scene is other.scene and one[1:] == other[1:]

    def forget(self) -> None:
        """Lets go of them."""
        self.held = self.carried = self._asked = self._next = self._ending = None

    def begin(self) -> None:
        """Another drag begins: what the last one left is what the engine shows of it."""
        self.carried = self._ending = None

    def come(self, sheets: CarriedSheets) -> None:
        """Takes them over."""
        if sheets.number == self._number and self._asked is not None:
            self.held = sheets

    def carry(self, known: Known, row: LayerRow, view: View, carried: Carried) -> bool:
        """Shows what is dragged elsewhere; False if that cannot be done."""
        asked, held = self._asked, self.held
        if asked is None or held is None or held.sheets is None or self._ending is not None:
            return False
        if (asked.name, asked.view) != (row.name, view) or asked.scene is not known.scene:
            return False
        self.carried = carried
        return True

    def end(self, post: Callable[[Request], None]) -> None:
        """What is dragged was let go: it is seen so until the engine has shown what came of it."""
        if self.carried is not None:
            self._number += 1
            self._ending = self._number
            post(AskShown(self._ending))

    def shown(self, shown: Shown) -> None:
        """The engine has."""
        if shown.number == self._ending:
            self.forget()

    def plan(self) -> SheetPlan | None:
        """Returns where they lie on the screen, the lowest first; None while nothing is dragged."""
        if self.carried is None or self.held is None or self.held.sheets is None or self._asked is None:
            return None
        view, level, (below, moved, above) = self._asked.view, self.held.level, self.held.sheets
        matrix = view.matrix()
        lying = [_quad(view, level, n, sheet.rect) for n, sheet in enumerate((below, moved, above))]
        corner, turn = _turned(self._asked, self.carried, level, moved.rect)
        sides = ((turn.real, turn.imag), (-turn.imag, turn.real))
        if self._asked.pose.mirror != self.carried.pose.mirror:
            sides = sides[0], (-sides[1][0], -sides[1][1])
        if turn == 1 and sides[1] == (0.0, 1.0):
            corner = _on_pixels(view, corner)
        scale = view.scale(level)
        x, y = (
            _by(matrix, side, scale * long)
            for side, long in zip(sides, (moved.rect.width, moved.rect.height), strict=True)
        )
        copy = (lying[MOVED],) if self.carried.twice else ()
        return SheetPlan(self.held, (lying[BELOW], *copy, Quad(MOVED, corner, x, y), lying[ABOVE]))


def _turned(asked: Asked, carried: Carried, level: int, rect: Rect) -> tuple[tuple[float, float], complex]:
    """Returns where the corner of a rectangle is seen, and what a step to the right becomes."""
    was, now = asked.pose.similarity, carried.pose.similarity
    mirrored = was.mirror != now.mirror
    (before, down), (after, by) = _factor(was.c), _factor(now.c)
    before = before.conjugate() if mirrored else before
    turn = after / before * math.ldexp(1.0, max(-900, min(900, down - by)))
    at, to = dyadic_place(was(carried.place)), dyadic_place(now(carried.place))
    x, y = at.offset(level, rect.x0, rect.y0)
    away = turn * complex(-x, y if mirrored else -y)
    middle = asked.view.to_screen(to)
    step = _by(asked.view.matrix(), (away.real, away.imag), asked.view.scale(level))
    return (middle[0] + step[0], middle[1] + step[1]), turn


def _quad(view: View, level: int, number: int, rect: Rect) -> Quad:
    matrix, scale = view.matrix(), view.scale(level)
    corner = _on_pixels(view, view.pixel_to_screen(level, rect.x0, rect.y0))
    return Quad(number, corner, _by(matrix, (1, 0), scale * rect.width), _by(matrix, (0, 1), scale * rect.height))


def _by(matrix: tuple[float, float, float, float], vector: tuple[float, float], scale: float) -> tuple[float, float]:
    a, b, c, d = matrix
    x, y = vector
    return (a * x + b * y) * scale, (c * x + d * y) * scale


def _on_pixels(view: View, corner: tuple[float, float]) -> tuple[float, float]:
    """Returns a corner as that of a tile is seen: at a whole zoom, on a pixel of the screen."""
    exact = not view.fraction and not view.angle
    return (float(round(corner[0])), float(round(corner[1]))) if exact else corner


def _factor(number: Dyadic) -> tuple[complex, int]:
    """Returns a number as (c, e), c 2^-e, to 64 bits."""
    drop = max(0, max(abs(number.x), abs(number.y)).bit_length() - 64)
    return complex(number.x >> drop, number.y >> drop), number.e - drop
