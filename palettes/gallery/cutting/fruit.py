"""The orange: segments on a sphere of pith, half its peel still on it, the other half a spiral that hangs down."""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import pairwise

from cutting.board import Board
from cutting.shapes import Spot, Touch, curve, ellipse, torn

X, Y, R = 420.0, 330.0, 222.0
SEGMENTS, FIRST = 10, 0.12
_POLE = (0.16, -0.80, 0.578)  # where the segments meet: towards the viewer
DARK, WARM = "#8a3a14", "#c8702c"
SHADE = {"mode": "raster", "op": "multiply"}
RIND = {"mode": "raster", "op": {"formula": "min(pic, colour) - pic"}}  # white becomes rind, rind stays
LIGHT = {"mode": "raster", "op": "screen"}


def _unit(v: Sequence[float]) -> tuple[float, ...]:
    far = math.sqrt(sum(c * c for c in v))
    return tuple(c / far for c in v)


def _cross(a: Sequence[float], b: Sequence[float]) -> tuple[float, ...]:
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


FADING = {"dynamics": {"radius": [[0, 0.5], [1, 1]], "opacity": "pressure"}}

_N = _unit(_POLE)
_U = _unit(_cross((0.0, 1.0, 0.0), _N))
_V = _cross(_N, _U)


def place(theta: float, phi: float, swell: float = 1.0) -> tuple[float, float, float]:
    """Where the place at that angle from the pole, and around it, lies in the picture, and its height toward us."""
    c, s = math.cos(theta), math.sin(theta)
    x, y, z = (c * n + s * (math.cos(phi) * u + math.sin(phi) * v) for n, u, v in zip(_N, _U, _V, strict=True))
    if z < 0.0:  # behind the outline: on it
        far = math.hypot(x, y)
        x, y = x / far, y / far
    return X + R * swell * x, Y + R * swell * y, z


def _meridian(phi: float, aside: float, start: float = 0.10, end: float = 2.2) -> list[tuple[float, float, float]]:
    """A line from near the pole down, that keeps `aside` pixels from the half plane `phi`."""
    out = []
    for k in range(25):
        theta = start + (end - start) * k / 24
        off = math.asin(max(-1.0, min(1.0, aside / (R * max(math.sin(theta), 0.04)))))
        out.append(place(theta, phi + off, 0.985))
        if out[-1][2] < 0.0:
            break
    return out


def _seams() -> list[float]:
    return [FIRST + 2.0 * math.pi * k / SEGMENTS for k in range(SEGMENTS + 1)]


def flesh(board: Board) -> None:
    """Pith, the segments on it, and the light on them."""
    board.layer("Flesh")
    board.grow("orange-pith", [ellipse(X, Y, R, R, count=120)])
    for k, (a, b) in enumerate(pairwise(_seams())):
        left, right = _meridian(a, 2.2), _meridian(b, -2.2)
        if max(z for _, _, z in (*left, *right)) > 0.0 and (outline := _seen(left, right)):
            board.grow("orange-segment", [outline], depth=1 + k, seed=k + 1)
    core = place(0.0, 0.0)
    board.grow("torn-cream-paper", [torn(ellipse(core[0], core[1], 17, 13), 5, 3.0, 4.0)], depth=40)
    for a, b in pairwise(_seams()):
        _rounded(board, a, (a + b) / 2.0)
    _lit(board, X, Y, R)
    board.soft([(x, y + 2.0) for x, y in _cut_edge()], 34, "#8a4a24", 0.75, flow=0.2, **SHADE)
    ring = ellipse(X, Y, 0.98 * R + 9.0, 0.98 * R + 9.0, count=120)
    _trim(board, [*ring, ring[0]])


def _seen(left: Touch, right: Touch) -> list[Spot]:
    """The outline of a segment, along the sphere's own where it goes on behind; empty where next to nothing is seen."""
    outline = [(x, y) for x, y, _ in left]
    if left[-1][2] < 0.0 and right[-1][2] < 0.0:
        start, end = (math.atan2(side[-1][1] - Y, side[-1][0] - X) for side in (left, right))
        turn = (end - start + math.pi) % (2.0 * math.pi) - math.pi
        outline += [_round(X, Y, R * 0.985, start + turn * k / 12) for k in range(1, 12)]
    outline += [(x, y) for x, y, _ in reversed(right)]
    area = sum(ax * by - bx * ay for (ax, ay), (bx, by) in zip(outline, [*outline[1:], outline[0]], strict=True)) / 2
    return outline if abs(area) > 500.0 else []


def _round(x: float, y: float, radius: float, angle: float) -> Spot:
    return x + radius * math.cos(angle), y + radius * math.sin(angle)


def _rounded(board: Board, seam: float, middle: float) -> None:
    """A segment swells between its seams."""
    seen = [(x, y, min(1.0, 0.25 + z)) for x, y, z in _meridian(seam, 0.0, 0.05, 2.0) if z > 0.05]
    if len(seen) > 3:
        board.soft(seen, 24, "#d98e44", 0.6, flow=0.12, **SHADE)
        board.soft([(x, y, 1.0) for x, y, _ in seen], 6, "#5e5a4c", 0.75, flow=0.3, **LIGHT)
    top = [(x, y, min(1.0, 0.2 + z)) for x, y, z in _meridian(middle, 0.0, 0.3, 1.7) if z > 0.15]
    if len(top) > 3:
        board.soft(top, 22, "#5a3a18", 0.55, flow=0.1, **LIGHT)


def _lit(board: Board, x: float, y: float, r: float) -> None:
    """Light from above on the left; a sphere turns away from it below on the right."""
    for far, radius, colour, opacity in (
        *((0.98, 0.3, DARK, 0.95), (0.86, 0.42, "#a8561e", 0.85), (0.62, 0.55, "#d08a4a", 0.75)),
    ):
        arc = [(*_round(x, y, r * far, t), p) for t, p in _sweep(-1.0, 2.6)]
        board.soft(arc, radius * r, colour, opacity, flow=0.2, **SHADE, **FADING)
    board.soft(ellipse(x, y, r * 1.02, r * 1.02), 0.12 * r, "#b5662c", 0.55, flow=0.15, **SHADE)
    spot = [(x - 0.38 * r, y - 0.43 * r), (x - 0.32 * r, y - 0.49 * r)]
    board.soft(spot, 0.5 * r, "#7a5a30", 0.75, flow=0.25, **LIGHT)


def _trim(board: Board, path: Sequence[Spot], radius: float = 9.0) -> None:
    """Cut off what was grown too far, rim and all: by then it is paint, so that no other rim grows."""
    board.soft(path, radius, "#000000", 1.0, mode="erase", hardness=0.85)


def _sweep(start: float, end: float) -> list[tuple[float, float]]:
    """Angles between, and how much of the brush at each: most in the middle."""
    return [(start + (end - start) * k / 24, max(0.02, math.sin(math.pi * k / 24))) for k in range(25)]


def _cut_edge() -> list[Spot]:
    """Where the peel ends on the sphere, from the left to the right: it has been cut in a slant."""
    out = []
    for k in range(41):
        phi = math.pi * (1.0 - k / 40)
        theta = 1.22 + 0.30 * (k / 40) + 0.03 * math.sin(9.0 * phi)
        x, y, z = place(theta, phi, 1.02)
        if z > -0.05:
            out.append((x, y))
    return sorted(out)


def _cap(beyond: float) -> list[Spot]:
    """The peel that is still on the sphere, and as far beyond the sphere's outline as that."""
    edge = _cut_edge()
    start, end = _limits()
    below = [_round(X, Y, 1.03 * R + beyond, start + (end - start) * k / 40) for k in range(41)]
    return [*edge, *below]


def _limits() -> tuple[float, float]:
    """From which angle to which the sphere's outline is peel: from the right over the foot to the left."""
    left, *_, right = _cut_edge()
    start, end = (math.atan2(y - Y, x - X) for x, y in (right, left))
    return start, end + (2.0 * math.pi if end < start else 0.0)


def _band(start: float, end: float, count: int = 28) -> tuple[list[Spot], list[Spot]]:
    """Upper and lower edge of the spiral between two angles, in half turns: even ones begin its front, at the left."""
    upper, lower = [], []
    for k in range(count + 1):
        turn = start + (end - start) * k / count
        t, narrow = math.pi * turn, max(0.0, (turn - 3.9) / 1.15)
        radius = 112.0 - 9.0 * turn
        half = 39.0 - 2.0 * turn - 25.0 * min(1.0, narrow) ** 1.3
        x, y = 566.0 + 8.0 * turn, 497.0 + 74.0 * turn
        tilt = 0.14 * radius * math.sin(t)
        upper.append((x - radius * 1.05 * math.cos(t), y + tilt - half))
        lower.append((x - radius * 0.90 * math.cos(t), y + 1.15 * tilt + half))
    return upper, lower


def _across(turn: float) -> list[Spot]:
    """From the upper to the lower edge of the spiral."""
    return [edge[0] for edge in _band(turn, turn + 0.01, 1)]


def _strip(start: float, end: float, ahead: float = 0.0, beyond: float = 0.0) -> list[Spot]:
    """The spiral between two angles, prolonged straight at its left and right ends by that much."""
    upper, lower = _band(start, end)
    first = [(edge[0][0] - ahead, edge[0][1]) for edge in (lower, upper)] if ahead else []
    last = [(edge[-1][0] + beyond, edge[-1][1]) for edge in (upper, lower)] if beyond else []
    return [*upper, *last, *reversed(lower), *first]


def _between(start: float, end: float, part: float) -> Touch:
    """A line along the spiral, at a part of the way from its upper to its lower edge."""
    upper, lower = _band(start, end)
    return [(a + (c - a) * part, b + (d - b) * part, 1.0) for (a, b), (c, d) in zip(upper, lower, strict=True)]


def inside_of_peel(board: Board) -> None:
    """The far side of the spiral, where its white inside is seen; the near side shades it."""
    for k in (1, 3):
        board.layer(f"Inside {k}")
        board.grow("orange-pith", [_strip(k + 0.02, k + 0.98)], seed=k)
        for at, radius, opacity in ((0.0, 46, 0.75), (0.25, 30, 0.5)):
            board.soft(_between(k, k + 1, at), radius, "#b08858", opacity, flow=0.15, **SHADE)
        for at, radius, opacity in ((k + 0.06, 34, 0.8), (k + 0.94, 26, 0.5)):
            board.soft(_across(at), radius, "#a8764a", opacity, flow=0.2, **SHADE)


def peel(board: Board) -> None:
    """The peel that is still on the orange goes on into the spiral's near side."""
    for k in (4, 2, 0):
        board.layer(f"Peel {k}" if k else "Peel")
        ahead, beyond = 14.0 if k else 0.0, 14.0 if k < 4 else 0.0
        strip = _strip(k, k + 1, ahead, beyond)
        board.grow("orange-rind", [strip] if k else [_cap(14.0), strip], seed=k + 1)
        if k == 0:
            _lit(board, X, Y, R)
            sheen = [(*_round(X, Y, 0.82 * R, t), p) for t, p in _sweep(2.1, 3.2)]
            board.soft(sheen, 44, "#6a4a20", 0.6, flow=0.08, **LIGHT, **FADING)
        _turned(board, k, k + 1.0)
        if k == 0:
            start, end = _limits()
            for low, high in ((start - 0.2, math.radians(48)), (math.radians(74), end + 0.2)):
                _trim(board, [_round(X, Y, 1.03 * R + 9.0, low + (high - low) * t / 40) for t in range(41)])
        for at, aside in (*(((k, -9.0),) if ahead else ()), *(((k + 1, 9.0),) if beyond else ())):
            (x, y), (u, v) = _across(at)
            _trim(board, [(x + aside, y - 12.0), (x + aside, y), (u + aside, v), (u + aside, v + 12.0)])


def _turned(board: Board, start: float, end: float) -> None:
    """The near side is lit at the left and turns away at its ends, where its rims are no longer seen."""
    turns = [*([start] if start else []), *([end] if end < 5.0 else [])]
    for at in turns:
        board.soft(_across(at), 34, "#ec9420", 0.9, flow=0.3, **RIND)
    away = ((end - 0.05, 44, DARK, 0.8), (end - 0.20, 50, "#c06a28", 0.6), (end, 18, "#d0701c", 0.9))
    near = ((start + 0.02, 26, "#b0581c", 0.85),)
    for at, radius, colour, opacity in (*(away if end < 5.0 else ()), *(near if start else ())):
        board.soft(_across(at), radius, colour, opacity, flow=0.25, **SHADE)
    board.soft(_between(start + 0.2, end, 0.95), 20, "#dcae78", 0.5, flow=0.15, **SHADE)
    bright = _between(start + 0.22, start + 0.5, 0.32) if start else _between(0.55, 0.78, 0.32)
    swelling = [(x, y, 0.3 + 0.7 * math.sin(math.pi * k / 28)) for k, (x, y, _) in enumerate(bright)]
    board.soft(swelling, 24, "#7a5a30", 0.6, flow=0.12, **LIGHT)


def whole(board: Board) -> None:
    """Another orange, further back, that nobody has peeled."""
    x, y, r = 812.0, 402.0, 116.0
    board.layer("Shadow of the whole one", blend="multiply")
    for a, b, radius, part in ((96.0, 6.0, 46, 0.7), (26.0, 1.0, 24, 0.7)):
        oval = ellipse(x + (56.0 if radius > 30 else 6.0), y + r - 2.0, a, b, count=36)
        board.soft([*oval, oval[0]], radius, "#33241e", part, flow=0.06)
    board.layer("Whole orange")
    board.grow("orange-rind", [ellipse(x, y, r + 20.0, r + 18.0, count=90)], seed=31, level=1)
    _lit(board, x, y, r)
    for far, radius, colour in ((0.8, 0.7, "#a05420"), (1.0, 0.4, "#7a3414")):
        arc = [(*_round(x, y, r * far, t), p) for t, p in _sweep(-0.9, 2.5)]
        board.soft(arc, radius * r, colour, 0.8, flow=0.06, **SHADE, **FADING)
    navel = place(0.0, 0.0)
    at = (x + (navel[0] - X) * r / R, y + (navel[1] - Y) * r / R)
    board.soft([at, (at[0] + 1.0, at[1])], 26, "#a8661e", 0.7, flow=0.15, **SHADE)
    star = [(at[0] + 7.0 * math.cos(t), at[1] + 3.4 * math.sin(t)) for t in (0.0, 2.5, 5.0, 1.2, 3.7, 6.28)]
    board.soft(star, 3.4, "#5a5a26", 0.9, hardness=0.5)
    ring = ellipse(x, y, r + 15.0, r + 13.5, count=90)
    _trim(board, [*ring, ring[0]], 15.0)


def shadow(board: Board) -> None:
    """Of the spiral, on the cloth behind it."""
    board.layer("Shadow of the peel", blend="multiply")
    for start, end in ((1.0, 2.0), (2.0, 3.0), (3.0, 4.0), (4.0, 5.0)):
        path = [(x + 44, y + 26) for x, y, _ in _between(start, end, 0.5)]
        board.soft([p for p in path if p[1] > 640], 44 if start < 4 else 30, "#2c2a30", 0.6, flow=0.05)


def wedges(board: Board) -> None:
    """Two segments that lie on the cloth."""
    for k, (x, y, turn, size) in enumerate(((786.0, 584.0, -0.16, 1.0), (882.0, 602.0, 0.3, 0.85))):
        c, s = math.cos(turn), math.sin(turn)
        shape = [(-82, 8), (-60, -26), (-20, -46), (24, -46), (62, -26), (82, 8), (56, 22), (0, 28), (-56, 22)]
        outline = [(x + size * (a * c - b * s), y + size * (a * s + b * c)) for a, b in curve(shape, 6, closed=True)]
        board.layer(f"Shadow {k}", blend="multiply")
        board.soft([(a + 10, b + 5) for a, b in outline if b > y], 30, "#3c2a24", 0.75, flow=0.06)
        board.layer(f"Wedge {k}")
        board.grow("orange-segment", [outline], seed=21 + k)
        low = [(x + size * (a * c - b * s), y + size * (a * s + b * c)) for a, b in curve(shape[4:], 6)]
        board.soft(low, 26, "#a8561e", 0.75, flow=0.15, **SHADE)
        high = [(x + size * (a * c - b * s), y + size * (a * s + b * c)) for a, b in ((-40, -20), (0, -28), (36, -22))]
        board.soft(high, 18, "#6a4a28", 0.6, flow=0.15, **LIGHT)
