"""Rulers, ellipses, vanishing points and grids over the canvas: thin lines at any zoom, and their handles."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from fractions import Fraction
from itertools import pairwise

from imgui_bundle import ImVec2, imgui

from app import theme, trace
from app.desk.colours import RGB, from_hex
from app.desk.desk import Desk
from app.desk.guides.guide_sight import Sight, clipped, handles, oval_on_screen, seen_point, sight_of
from app.desk.guides.present import assistants
from app.desk.guides.snap_curves import PERSPECTIVES, Line, Pair, cell_place, exact, line_along, near, side
from engine.painting.guiding.guides import Guide

Stretch = tuple[Pair, Pair, float]  # from, to, how strong
GUIDE_COLOURS: tuple[RGB, ...] = (
    (0.25, 0.55, 1.0),
    (1.0, 0.45, 0.3),
    (0.3, 0.8, 0.45),
)  # of vanishing points in turn
_DENSE = 10.0  # px of the screen: grid lines nearer to each other are left out
_STRONG = 4  # every so many lines of a grid is stronger
_RAYS, _LEAST = 24, 12  # rays around a vanishing point; at least so many are in sight of one far away
_FAINT, _RULE = 0.34, 0.9
_MOST = 1024  # lines of one grid
_SIDES = 24  # of a handle's circle


def draw_assistants(desk: Desk) -> None:
    """Draws them above the canvas and below the panels."""
    editing = desk.hand.tool == "guides"
    if not (desk.guides.shown or editing):
        return
    sight = sight_of(desk.view)
    for guide in assistants(desk):
        rgb = None if guide.colour is None else from_hex(guide.colour)
        for number, lines in enumerate(_LINES[guide.kind](sight, guide)):
            for start, end, strong in lines:
                _line(desk, start, end, strong, rgb or GUIDE_COLOURS[number])
    for guide in assistants(desk) if editing else ():
        for number, at in enumerate(handles(desk, guide)):
            _handle(desk, at, guide, number)


Lines = Iterator[Iterator[Stretch]]  # by colour


def _ruler(sight: Sight, guide: Guide) -> Lines:
    ends = [near(exact(guide, n, sight.level, sight.origin)) for n in (0, 1)]
    found = _whole(sight, line_along(exact(guide, 0, sight.level, sight.origin), side(guide, 1)))
    if found is None:
        return
    start, end = found
    first, last = (_kept(sight.to_screen(place), found) for place in ends)
    yield iter([(start, end, 0.3 * _FAINT), (first, last, _RULE)])


def _kept(place: Pair, stretch: tuple[Pair, Pair]) -> Pair:
    """Returns the point of a stretch that is nearest to one on its line."""
    (x0, y0), (x1, y1) = stretch
    dx, dy = x1 - x0, y1 - y0
    part = ((place[0] - x0) * dx + (place[1] - y0) * dy) / (dx * dx + dy * dy or 1.0)
    part = max(0.0, min(1.0, part))
    return x0 + part * dx, y0 + part * dy


def _parallel(sight: Sight, guide: Guide) -> Lines:
    """The line through its points, and faint ones beside it."""
    line = line_along(exact(guide, 0, sight.level, sight.origin), side(guide, 1))
    yield _beside(sight, line)


def _beside(sight: Sight, line: Line) -> Iterator[Stretch]:
    apart = 96.0 / sight.view.scale(sight.level)
    x, y = sight.to_level(sight.view.width / 2, sight.view.height / 2)
    away = (line.x - x) * -line.dy + (line.y - y) * line.dx
    many = math.ceil(math.hypot(sight.view.width, sight.view.height) / 192.0)
    begin = round(-away / apart)
    for k in range(begin - many, begin + many + 1):
        by = k * apart
        found = _whole(sight, Line(line.x - line.dy * by, line.y + line.dx * by, line.dx, line.dy))
        if found is not None:
            yield *found, _RULE if k == 0 else _FAINT


def _ellipse(sight: Sight, guide: Guide) -> Lines:
    found = oval_on_screen(sight, guide)
    if isinstance(found, Line):
        ends = _whole(sight, found)
        yield iter(() if ends is None else [(*ends, _RULE)])
    else:
        yield ((start, end, _RULE) for start, end in pairwise(found))


def _grid(sight: Sight, guide: Guide) -> Lines:
    scale = math.ldexp(1.0, max(-1000, min(900, sight.level - guide.level)))
    sides = [(x * scale, y * scale) for x, y in (side(guide, 1), side(guide, 2))]
    place = cell_place(guide, sight.level, sight.origin)
    yield (
        stretch
        for along, over, begin in ((0, 1, place[1]), (1, 0, place[0]))
        for stretch in _rows(sight, sides[along], sides[over], begin)
    )


def _rows(sight: Sight, along: Pair, over: Pair, begin: Fraction) -> Iterator[Stretch]:
    """Yields the lines of a grid that run along a side of its cells; `begin`: where the middle lies, in cells."""
    zoom, length = sight.view.scale(sight.level), math.hypot(*along)
    apart = abs(along[0] * over[1] - along[1] * over[0]) / length * zoom
    if not math.isfinite(apart) or not length or apart <= 0.0:
        return
    every = 1 << max(0, math.ceil(math.log2(_DENSE / apart))) if apart < _DENSE else 1
    many = min(_MOST // 2, math.ceil(math.hypot(sight.view.width, sight.view.height) / 2 / (apart * every)) + 1)
    middle = math.floor(begin / every)
    for k in range(middle - many, middle + many + 1):
        by = float(k * every - begin)
        found = _whole(sight, Line(over[0] * by, over[1] * by, along[0] / length, along[1] / length))
        if found is not None:
            yield *found, _FAINT if k % _STRONG else 0.6


def _perspective(sight: Sight, guide: Guide) -> Lines:
    points = 1 if guide.kind == "perspective-1" else len(guide.points)
    for number in range(points):
        rays = _rays(sight, seen_point(sight, guide, number), sight.way(side(guide, 1)))
        yield _with_horizon(sight, guide, rays) if number == 0 else rays


def _with_horizon(sight: Sight, guide: Guide, rays: Iterator[Stretch]) -> Iterator[Stretch]:
    yield from rays
    found = _whole(sight, line_along(exact(guide, 0, sight.level, sight.origin), side(guide, 1)))
    if found is not None:
        yield *found, _RULE


def _rays(sight: Sight, point: Pair, horizon: Pair) -> Iterator[Stretch]:
    """Yields lines from a vanishing point, denser by twos where it is so far away that few would be in sight."""
    wide, tall = sight.view.width, sight.view.height
    begin, many, first = math.atan2(horizon[1], horizon[0]), _RAYS, 0
    last = many - 1
    if not (0 <= point[0] <= wide and 0 <= point[1] <= tall):
        middle = math.atan2(tall / 2 - point[1], wide / 2 - point[0])
        corners = [(x, y) for x in (0, wide) for y in (0, tall)]
        spread = [math.remainder(math.atan2(y - point[1], x - point[0]) - middle, math.tau) for x, y in corners]
        angle = max(spread) - min(spread)
        while many * angle < _LEAST * math.tau and many < 1 << 48:
            many *= 2
        first = math.floor((middle + min(spread) - begin) / math.tau * many)
        last = math.ceil((middle + max(spread) - begin) / math.tau * many)
    for k in range(first, last + 1):
        turn = begin + k * math.tau / many
        found = clipped((point, (math.cos(turn), math.sin(turn))), (wide, tall), 0.0)
        if found is not None:
            yield *found, _FAINT


_LINES: dict[str, Callable[[Sight, Guide], Lines]] = {
    **dict.fromkeys(PERSPECTIVES, _perspective),
    "ruler": _ruler,
    "parallel": _parallel,
    "ellipse": _ellipse,
    "grid": _grid,
}


def _whole(sight: Sight, line: Line) -> tuple[Pair, Pair] | None:
    """Returns the part of a line that is in sight."""
    start = sight.to_screen((line.x, line.y))
    return clipped((start, sight.way((line.dx, line.dy))), (sight.view.width, sight.view.height))


def _line(desk: Desk, start: Pair, end: Pair, strong: float, rgb: RGB) -> None:
    painter = imgui.get_background_draw_list()
    painter.add_line(ImVec2(*start), ImVec2(*end), theme.packed(rgb, strong), 1.0 * desk.scale)


def _handle(desk: Desk, at: Pair, guide: Guide, number: int) -> None:
    painter, radius = imgui.get_background_draw_list(), (6.0 if number == 0 else 5.0) * desk.scale
    lit = guide.name == desk.guides.chosen
    painter.add_circle_filled(ImVec2(*at), radius, theme.packed((0.0, 0.0, 0.0), 0.55), _SIDES)
    ring = theme.packed(theme.look.accent if lit else (1.0, 1.0, 1.0), 0.95)
    painter.add_circle(ImVec2(*at), radius, ring, _SIDES, 1.8 * desk.scale)
    box = (round(at[0] - radius), round(at[1] - radius), round(at[0] + radius), round(at[1] + radius))
    trace.note_place("canvas", f"{guide.name} point {number + 1}", box)
