"""Outlines, and how to fill them with touches of a round brush.

Places are (x, y) in pixels of the picture.  A touch is a list of (x, y, radius): the pen's pressure is the radius.
"""

from __future__ import annotations

import math
import random
from collections.abc import Sequence
from itertools import pairwise

import numpy as np
from scipy import ndimage

Spot = tuple[float, float]
Touch = list[tuple[float, float, float]]

RIM = 5.0  # radius of the touch that draws an outline
_FILLING = (40.0, 16.0, 7.0, 4.0, 2.5)  # radii of the touches inside it


def curve(points: Sequence[Spot], steps: int = 8, closed: bool = False) -> list[Spot]:
    """A Catmull-Rom curve through points, `steps` to each span."""
    ends = [points[-1], *points, points[0], points[1]] if closed else [points[0], *points, points[-1]]
    out = []
    for a, b, c, d in zip(ends, ends[1:], ends[2:], ends[3:], strict=False):
        for t in (k / steps for k in range(steps)):
            out.append(
                tuple(
                    0.5 * (2 * q + (r - p) * t + (2 * p - 5 * q + 4 * r - s) * t * t + (3 * q - p - 3 * r + s) * t**3)
                    for p, q, r, s in zip(a, b, c, d, strict=True)
                )
            )
    return out if closed else [*out, tuple(points[-1])]


def ellipse(x: float, y: float, a: float, b: float, turn: float = 0.0, count: int = 72) -> list[Spot]:
    c, s = math.cos(turn), math.sin(turn)
    angles = (2.0 * math.pi * k / count for k in range(count))
    round_ = ((a * math.cos(t), b * math.sin(t)) for t in angles)
    return [(x + u * c - v * s, y + u * s + v * c) for u, v in round_]


def box(left: float, top: float, right: float, bottom: float) -> list[Spot]:
    return [(left, top), (right, top), (right, bottom), (left, bottom)]


def ribbon(path: Sequence[Spot], start: float, end: float | None = None) -> list[Spot]:
    """The outline of a band along a path, half as wide as given at its start and at its end, with round ends."""
    n = len(path) - 1
    ends = [path[0], *path, path[-1]]
    left, right, half = [], [], start
    for k, (a, p, b) in enumerate(zip(ends, path, ends[2:], strict=False)):
        far = math.hypot(b[0] - a[0], b[1] - a[1]) or 1.0
        nx, ny = (a[1] - b[1]) / far, (b[0] - a[0]) / far
        half = start + ((start if end is None else end) - start) * k / n
        left.append((p[0] + nx * half, p[1] + ny * half))
        right.append((p[0] - nx * half, p[1] - ny * half))
    return [*left, *_cap(left[-1], right[-1]), *right[::-1], *_cap(right[0], left[0])]


def _cap(start: Spot, end: Spot) -> list[Spot]:
    """Half a turn from start to end, to the left of the way there."""
    x, y = (start[0] + end[0]) / 2.0, (start[1] + end[1]) / 2.0
    u, v = start[0] - x, start[1] - y
    turns = (math.pi * k / 8 for k in range(1, 8))
    return [(x + u * math.cos(t) + v * math.sin(t), y - u * math.sin(t) + v * math.cos(t)) for t in turns]


def torn(outline: Sequence[Spot], seed: int, by: float = 3.0, step: float = 9.0) -> list[Spot]:
    """The outline as fingers tear it: it wanders by about `by` pixels, slowly, and a little quickly."""
    chance = random.Random(seed)
    places = _even(outline, step)
    n = len(places)
    wander = np.zeros(n)
    for waves, part in ((max(2, n // 22), 1.0), (max(3, n // 8), 0.6), (max(4, n // 3), 0.3)):
        for k in range(1, waves + 1):
            if k > waves // 2:
                phase = chance.uniform(0.0, 2.0 * math.pi)
                turn = 2.0 * math.pi * k / n * np.arange(n) + phase
                wander += part * np.sin(turn) / math.sqrt(max(1, waves / 2))
    return [
        (x + by * w * nx, y + by * w * ny)
        for (x, y), (nx, ny), w in zip(places, _normals(places), wander.tolist(), strict=True)
    ]


def _even(outline: Sequence[Spot], step: float) -> list[Spot]:
    """The closed outline in steps of about that length."""
    out = []
    for (ax, ay), (bx, by) in zip(outline, [*outline[1:], outline[0]], strict=True):
        count = max(1, round(math.hypot(bx - ax, by - ay) / step))
        out += [(ax + (bx - ax) * k / count, ay + (by - ay) * k / count) for k in range(count)]
    return out


def _normals(places: Sequence[Spot]) -> list[Spot]:
    out = []
    for (ax, ay), (bx, by) in zip([places[-1], *places[:-1]], [*places[1:], places[0]], strict=True):
        far = math.hypot(bx - ax, by - ay) or 1.0
        out.append(((by - ay) / far, (ax - bx) / far))
    return out


def mask(outlines: Sequence[Sequence[Spot]], size: tuple[int, int], scale: int = 1) -> np.ndarray:
    """Which pixels (h, w) of the picture have their centre within one of the outlines (even-odd for each)."""
    w, h = size[0] * scale, size[1] * scale
    out = np.zeros((h, w), bool)
    for outline in outlines:
        flips = np.zeros((h, w + 1), np.int32)
        for (ax, ay), (bx, by) in zip(outline, [*outline[1:], outline[0]], strict=True):
            if ay == by:
                continue
            low, high = sorted((ay * scale, by * scale))
            rows = np.arange(max(0, math.ceil(low - 0.5)), min(h, math.ceil(high - 0.5)))
            cross = (ax + ((rows + 0.5) / scale - ay) / (by - ay) * (bx - ax)) * scale
            np.add.at(flips, (rows, np.clip(np.ceil(cross - 0.5), 0, w).astype(int)), 1)
        out |= np.cumsum(flips, axis=1)[:, :w] % 2 == 1
    return out


def filling(outline: Sequence[Spot], size: tuple[int, int]) -> list[Touch]:
    """Touches that together cover the outline's pixels and next to nothing else: a line along it, then rows."""
    inside = mask([outline], size)
    depth = ndimage.distance_transform_edt(np.pad(inside, 1))[1:-1, 1:-1]
    rim = _along(outline, depth)
    left = inside.copy()
    cover(left, rim, False)
    touches = [rim] if len(rim) > 1 else []
    for radius in _FILLING:
        touches += _rows(left, depth, radius)
    return touches + _dots(left, depth)


def _along(outline: Sequence[Spot], depth: np.ndarray) -> Touch:
    """Just inside the outline, as thick as there is room, `RIM` at most."""
    places = _even(outline, 6.0)
    area = sum(ax * by - bx * ay for (ax, ay), (bx, by) in zip(places, [*places[1:], places[0]], strict=True))
    side = -1.0 if area > 0 else 1.0
    touch: Touch = []
    h, w = depth.shape
    for (x, y), (nx, ny) in zip(places, _normals(places), strict=True):
        for radius in (RIM, 4.0, 3.0, 2.0, 1.2):
            a, b = x + side * nx * radius, y + side * ny * radius
            if 0 <= a < w and 0 <= b < h and depth[int(b), int(a)] >= radius - 0.8:
                touch.append((a, b, radius))
                break
    return [*touch, touch[0]] if touch else []


def _rows(left: np.ndarray, depth: np.ndarray, radius: float) -> list[Touch]:
    """Rows of touches of one radius, where they fit and something is left to cover; `left` loses what they cover."""
    fits = depth >= radius + 0.3
    touches = []
    rows = np.flatnonzero(fits.any(axis=1))
    step = max(1, round(radius * (1.1 if radius > 6 else 0.7)))
    for y in sorted({*rows[::step].tolist(), *rows[-1:].tolist()}):
        near = left[max(0, y - int(radius)) : y + int(radius) + 1].any(axis=0)
        runs = ndimage.label(fits[y] & near)[0]
        for (run,) in ndimage.find_objects(runs):
            touches.append(
                [(run.start + 0.5, y + 0.5, radius), (max(run.stop - 1, run.start + 1) + 0.5, y + 0.5, radius)]
            )
            cover(left, touches[-1], False)
    return touches


def _dots(left: np.ndarray, depth: np.ndarray) -> list[Touch]:
    """What rows have missed inside would be holes with rims."""
    touches = []
    while (open_ := np.argwhere(left & (depth > 1.6))).size:
        y, x = open_[0].tolist()
        radius = min(4.0, float(depth[y, x]) - 0.4)
        touches.append([(x + 0.5, y + 0.5, radius), (x + 1.0, y + 0.5, radius)])
        cover(left, touches[-1], False)
    return touches


def cover(seen: np.ndarray, touch: Touch, value: bool = True) -> None:
    """Set the pixels that a touch surely covers."""
    for (ax, ay, ar), (bx, by, br) in pairwise(touch):
        left, right = max(0, math.floor(min(ax - ar, bx - br))), math.ceil(max(ax + ar, bx + br))
        above, below = max(0, math.floor(min(ay - ar, by - br))), math.ceil(max(ay + ar, by + br))
        part = seen[above : max(0, below), left : max(0, right)]
        y, x = np.mgrid[above : above + part.shape[0], left : left + part.shape[1]] + 0.5
        long = (bx - ax) ** 2 + (by - ay) ** 2 or 1.0
        t = np.clip(((x - ax) * (bx - ax) + (y - ay) * (by - ay)) / long, 0.0, 1.0)
        part[(x - ax - t * (bx - ax)) ** 2 + (y - ay - t * (by - ay)) ** 2 <= (ar + t * (br - ar) - 0.35) ** 2] = value
