"""Films into a picture that contains itself: the last frame is the first.

Where the way ends a turn deeper than it began, both ends show the same, but not by the same pixels: one is read as it
is, the other sampled, turned and at other levels.  So the film begins with what the deeper end shows and fades to what
lies there: every frame is sharp, nothing jumps, and as it ends on the same view, it may begin again.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

from engine.canvas import layers
from engine.canvas.layers import Group
from engine.canvas.placing.loops import placements
from engine.canvas.placing.placement import Placement
from engine.film.aim import SUBPIXEL, Aim, shifted
from engine.film.leg import levels_between
from engine.numeric.similarity import Dyadic

FADED = 0.25  # levels of zoom over which it fades
_MOST = 4096  # turns between both ends
_SURE, _FINEST = 192, 4200  # bits of c, and of t below level 0, that are kept of many turns
_NEAR, _LIKE = 1.0, 0.01  # pixels, and levels or radians, by which ends may differ that show the same
Other = tuple[Aim, float]  # another view that shows the same as a frame's own, and how much it counts


def others(aims: Sequence[Aim], root: Group) -> dict[int, Other]:
    """Returns what frames show besides their own views, by their numbers; nothing where both ends do not show the
    same."""
    start, end = aims[0], aims[-1]
    if _turned(root, start, end):
        frames, outer, inner = range(len(aims)), start, end
    elif _turned(root, end, start):
        frames, outer, inner = range(len(aims) - 1, -1, -1), end, start
    else:
        return {}
    found = {}
    for i in frames:
        away = abs(levels_between(outer, aims[i])) / FADED
        if away >= 1.0:
            break
        found[i] = carried(aims[i], outer, inner), 1.0 - away * away * (3.0 - 2.0 * away)
    return found


def carried(aim: Aim, first: Aim, other: Aim) -> Aim:
    """Returns the view that lies to another one as a view does to the first, of which it is near."""
    level = max(aim.level, first.level)
    across, down = (
        shifted(b, level - aim.level) - shifted(a, level - first.level) for a, b in ((first.x, aim.x), (first.y, aim.y))
    )
    zoom = 2.0 ** (first.level + first.fraction - level - SUBPIXEL)
    x, y = _upright(across * zoom, down * zoom, first)
    cos, sin = math.cos(other.turn), math.sin(other.turn)
    x, y = cos * x + sin * y, cos * y - sin * x
    moved = other.moved(-x if other.mirrored else x, y)
    near = moved.at(moved.level, moved.fraction + levels_between(first, aim))
    mirrored = aim.mirrored if first.mirrored == other.mirrored else 1.0 - aim.mirrored
    return replace(near, turn=other.turn + aim.turn - first.turn, mirrored=mirrored)


def _upright(x: float, y: float, aim: Aim) -> tuple[float, float]:
    """Returns a way on the canvas as one on a view's picture."""
    x = -x if aim.mirrored else x
    cos, sin = math.cos(aim.turn), math.sin(aim.turn)
    return cos * x - sin * y, sin * x + cos * y


def _turned(root: Group, outer: Aim, inner: Aim) -> bool:
    """Tells whether a view is another one some turns deeper."""
    return any(_deeper(one, outer, inner) for one in placements(root) if one.visible and _in_itself(root, one))


def _in_itself(root: Group, one: Placement) -> bool:
    if one.of is None:
        return True
    around = layers.ancestors(root, one.name)
    return any(group.id == one.of and group.visible for group in around)


def _deeper(one: Placement, outer: Aim, inner: Aim) -> bool:
    f = one.pose.similarity
    turns = round(levels_between(outer, inner) / -f.log_scale)
    if not 1 <= turns <= _MOST:
        return False
    whole = f
    for _ in range(turns - 1):
        whole = f.then(whole).cut(_SURE, _FINEST)
    if abs(levels_between(outer, inner) + whole.log_scale) > _LIKE:
        return False
    there = whole(Dyadic.of(outer.x, outer.y, outer.level + SUBPIXEL))
    bits = inner.level + SUBPIXEL - there.e
    far = max(abs(shifted(there.x, bits) - inner.x), abs(shifted(there.y, bits) - inner.y))
    if far > _NEAR * 2.0 ** (SUBPIXEL - inner.fraction):
        return False
    mirrored = 1.0 - outer.mirrored if whole.mirror else outer.mirrored
    c = -whole.c if whole.mirror else whole.c
    angle = math.atan2(_float(c.y, c), _float(c.x, c))
    turn = outer.turn + (angle if mirrored else -angle)  # first a view is turned, then mirrored
    return mirrored == inner.mirrored and abs(math.remainder(turn - inner.turn, math.tau)) <= _LIKE


def _float(value: int, of: Dyadic) -> float:
    bits = max(abs(of.x), abs(of.y)).bit_length()
    return value / (1 << bits)
