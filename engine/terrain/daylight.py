"""The light of a picture of land: sun with a soft shadow, sky, haze, still water that mirrors.  The look is in the
numbers here and in `drape`; distances are in pixels of the finest window."""

from __future__ import annotations

import math

import numpy as np

from engine.numeric.kernel import inlined, inner_uncounted, kernel
from engine.terrain.beams import clear_until
from engine.terrain.caster import between, nearest_land

# Of the numbers that a picture is made with.
SUN_X, SUN_Y, SUN_Z, CONE, HAZE, SEA, TOP_HEIGHT, FARTHEST, FROM_SAMPLE, TO_SAMPLE, PIXEL = range(11)
_SUN_RADIUS = 0.018  # radians: larger than the sun's, as haze makes it
_DARKEST = 0.42  # of the sky's light that reaches the deepest hollow
_MELTING = 12000.0  # an eighth of the farthest, the window's half, is seen by a twentieth
NEAR = 1  # level of the mipmap with which rays begin near land
_COARSE, _FINE, _FINEST = 8, 4, 2  # pixels of a side of the squares whose rays begin together
_MANY = 4  # samples of a pixel from which the finest are worth their time
_UNSEEN = 1e-4  # of the light
_TURN = 6.283185307179586


@inner_uncounted
def _sky(d: np.ndarray, sun: np.ndarray, out: np.ndarray) -> None:
    up = max(d[2], 0.0)
    k = math.exp(-4.5 * up)
    near = max(0.0, d[0] * sun[0] + d[1] * sun[1] + d[2] * sun[2])
    glow = 0.16 * near**6 + 0.5 * near**64
    out[0] = 0.17 + 0.55 * k + glow
    out[1] = 0.31 + 0.42 * k + 0.74 * glow
    out[2] = 0.62 + 0.18 * k + 0.42 * glow


@inlined
def _clamped(x: float, n: int) -> float:
    return min(max(x, 0.0), n - 0.001)


@inlined
def _at(h: np.ndarray, x: float, y: float, n: int) -> float:
    return between(h, _clamped(x, n), _clamped(y, n))


@inlined
def _slope(h: np.ndarray, x: float, y: float, wide: float) -> tuple[float, float]:
    """How steep land is at (x, y) of a window, to the right and down; `wide`: cells of it that a pixel of the picture
    covers."""
    n = len(h) - 1
    r = max(0.6, 0.6 * wide)
    gx = (_at(h, x + r, y, n) - _at(h, x - r, y, n)) / (2.0 * r)
    gy = (_at(h, x, y + r, n) - _at(h, x, y - r, n)) / (2.0 * r)
    return gx, gy


@inlined
def _facing(gx: float, gy: float, light: np.ndarray) -> float:
    """How much sun ground of a slope gets: 0 or less where it faces away."""
    return float((light[2] - gx * light[0] - gy * light[1]) / math.sqrt(1.0 + gx * gx + gy * gy))


@inner_uncounted
def _ground(
    h: np.ndarray,
    colours: np.ndarray,
    x: float,
    y: float,
    wide: float,
    gx: float,
    gy: float,
    lit: float,
    out: np.ndarray,
) -> None:
    """Colour of ground of a slope at (x, y) of a window, `lit` by the sun; `wide`: as above."""
    n = len(h) - 1
    nz = 1.0 / math.sqrt(1.0 + gx * gx + gy * gy)
    here = _at(h, x, y, n)
    open_sky = 1.0
    for ring in range(2):
        q = max(3.0, 2.0 * wide) * (1.0 if ring == 0 else 4.0)
        around = _at(h, x + q, y, n) + _at(h, x - q, y, n) + _at(h, x, y + q, n) + _at(h, x, y - q, n)
        open_sky -= 0.55 * max(0.0, 0.25 * around - here) / q
    open_sky = max(_DARKEST, open_sky)
    up = 0.5 + 0.5 * nz
    i, j = int(_clamped(x, n)), int(_clamped(y, n))
    u, v = _clamped(x, n) - i, _clamped(y, n) - j
    for c in range(3):
        top = colours[j, i, c] * (1.0 - u) + colours[j, i + 1, c] * u
        low = colours[j + 1, i, c] * (1.0 - u) + colours[j + 1, i + 1, c] * u
        root = (top + v * (low - top)) * (1.0 / 255.0)
        warm = 3.3 if c == 0 else (2.65 if c == 1 else 1.85)
        sky = 0.34 if c == 0 else (0.46 if c == 1 else 0.70)
        bounce = 0.22 if c == 0 else (0.18 if c == 1 else 0.13)
        out[c] = root * root * (warm * lit + open_sky * (sky * up + bounce * (1.0 - up)))


@inlined
def _hazy(out: np.ndarray, t: float, d: np.ndarray, light: np.ndarray, haze: float) -> None:
    part = 1.0 - math.exp(-t / haze)
    near = max(0.0, d[0] * light[0] + d[1] * light[1] + d[2] * light[2]) ** 5
    out[0] += part * (0.60 + 0.26 * near - out[0])
    out[1] += part * (0.69 + 0.14 * near - out[1])
    out[2] += part * (0.82 - out[2])


@inlined
def _melted(out: np.ndarray, t: float, d: np.ndarray, numbers: np.ndarray, sky: np.ndarray) -> None:
    """Lets the land become the sky where the coarsest window ends, which would be an edge else."""
    part = _MELTING * (t / numbers[FARTHEST]) ** 4
    if part < _UNSEEN:
        return
    part = 1.0 - math.exp(-part)
    _sky(d, numbers[:3], sky)
    for c in range(3):
        out[c] += part * (sky[c] - out[c])


@inlined
def _random(px: int, py: int, k: int) -> int:
    """A number of 0..2^20 - 1 by pixel and sample: two of ten bits, which the samples of a pixel spread evenly over the
    sun (the R2 sequence, from a place of the pixel's own): a shadow's rim has less grain than by chance."""
    v = (px * 73856093) ^ (py * 19349663)
    v = ((v ^ (v >> 13)) * 1274126177) & 0x7FFFFFFF
    v = ((v ^ (v >> 15)) * 668265263) & 0x7FFFFFFF
    v ^= v >> 11
    return ((v + 773 * k) & 1023) | ((((v >> 10) + 583 * k) & 1023) << 10)


@inner_uncounted
def _sunlit(
    heights: np.ndarray,
    tops: np.ndarray,
    mips: np.ndarray,
    places: np.ndarray,
    p: np.ndarray,
    numbers: np.ndarray,
    start: float,
    dice: int,
    to: np.ndarray,
) -> float:
    """Whether a place sees a point of the sun: 1 or 0."""
    light = numbers[:3]
    angle, radius = _TURN * (dice & 1023) / 1024.0, _SUN_RADIUS * math.sqrt(((dice >> 10) & 1023) / 1023.0)
    across, along = radius * math.cos(angle), radius * math.sin(angle)
    flat = max(1e-6, math.sqrt(light[0] * light[0] + light[1] * light[1]))
    to[0] = light[0] + (across * light[1] - along * light[2] * light[0]) / flat
    to[1] = light[1] - (across * light[0] + along * light[2] * light[1]) / flat
    to[2] = light[2] + along * flat
    if to[2] <= 0.0:
        return 0.0
    far = min(numbers[FARTHEST], max(0.0, (numbers[TOP_HEIGHT] - p[2]) / to[2]))
    hidden, _ = nearest_land(heights, tops, mips, places, p, to, start, far, 0.25 * numbers[CONE], NEAR)
    return 0.0 if hidden >= 0.0 else 1.0


@inner_uncounted
def _water(
    heights: np.ndarray,
    tops: np.ndarray,
    mips: np.ndarray,
    places: np.ndarray,
    colours: np.ndarray,
    p: np.ndarray,
    d: np.ndarray,
    numbers: np.ndarray,
    t: float,
    s: float,
    vis: float,
    out: np.ndarray,
    other: np.ndarray,
    to: np.ndarray,
) -> None:
    """What still water at a place shows: what it mirrors, itself, and the sun."""
    light, cone, pixel = numbers[:3], numbers[CONE], numbers[PIXEL]
    to[0], to[1], to[2] = d[0], d[1], max(1e-4, -d[2])
    far = min(numbers[FARTHEST], max(0.0, (numbers[TOP_HEIGHT] - p[2]) / to[2]))
    t2, w = nearest_land(heights, tops, mips, places, p, to, 0.05 * s, far, cone, NEAR)
    if w < 0:
        _sky(to, light, other)
    else:
        s2 = places[w, 2]
        x, y = (p[0] + t2 * to[0] - places[w, 0]) / s2, (p[1] + t2 * to[1] - places[w, 1]) / s2
        wide = pixel * (t + t2) / s2
        gx, gy = _slope(heights[w], x, y, wide)
        _ground(heights[w], colours[w], x, y, wide, gx, gy, max(0.0, _facing(gx, gy, light)), other)
        _hazy(other, t2, to, light, numbers[HAZE])
    mirrors = min(1.0, 0.08 + 1.1 * (1.0 - to[2]) ** 5 + 0.25 * (1.0 - to[2]))
    glint = 2.0 * vis * max(0.0, to[0] * light[0] + to[1] * light[1] + to[2] * light[2]) ** 400
    depth = (1.0 - mirrors) * (0.55 + 0.45 * vis)
    out[0] = mirrors * other[0] + 0.022 * depth + glint
    out[1] = mirrors * other[1] + 0.066 * depth + 0.85 * glint
    out[2] = mirrors * other[2] + 0.082 * depth + 0.6 * glint


@inner_uncounted
def _seen(
    heights: np.ndarray,
    tops: np.ndarray,
    mips: np.ndarray,
    places: np.ndarray,
    colours: np.ndarray,
    o: np.ndarray,
    d: np.ndarray,
    numbers: np.ndarray,
    start: float,
    dice: int,
    out: np.ndarray,
    room: np.ndarray,
) -> None:
    """The light that a ray brings; there is no land before `start`."""
    light, cone, haze, sea = numbers[:3], numbers[CONE], numbers[HAZE], numbers[SEA]
    far = numbers[FARTHEST]
    p, to, other = room[0], room[1], room[2]
    if o[2] > numbers[TOP_HEIGHT] and d[2] < 0.0:
        start = max(start, (numbers[TOP_HEIGHT] - o[2]) / d[2])
    if d[2] > 0.0:
        far = min(far, max(0.0, (numbers[TOP_HEIGHT] - o[2]) / d[2]))
    narrow = cone * (0.8 + 0.4 * ((dice >> 3) & 255) / 255.0)
    t, w = nearest_land(heights, tops, mips, places, o, d, start, far, narrow, NEAR)
    if w < 0:
        _sky(d, light, out)
        return
    s = places[w, 2]
    wide = numbers[PIXEL] * t / s
    for c in range(3):
        p[c] = o[c] + t * d[c]
    water = p[2] <= sea + 1e-3 * s
    p[2] += 0.02 * s * max(1.0, wide)
    off = 0.05 * s * max(1.0, wide)
    if water:
        vis = _sunlit(heights, tops, mips, places, p, numbers, off, dice, to)
        _water(heights, tops, mips, places, colours, p, d, numbers, t, s, vis, out, other, to)
    else:
        x, y = (p[0] - places[w, 0]) / s, (p[1] - places[w, 1]) / s
        gx, gy = _slope(heights[w], x, y, wide)
        lit = _facing(gx, gy, light)
        lit = lit * _sunlit(heights, tops, mips, places, p, numbers, off, dice, to) if lit > 0.0 else 0.0
        _ground(heights[w], colours[w], x, y, wide, gx, gy, lit, out)
    _hazy(out, t, d, light, haze)
    _melted(out, t, d, numbers, other)


@inner_uncounted
def beam_corners(eye: np.ndarray, left: int, top: int, side: int, corners: np.ndarray) -> None:
    """The corners of what pixels of a square see."""
    for q in range(4):
        x, y = left - 0.5 + side * (q & 1), top - 0.5 + side * (q >> 1)
        for c in range(3):
            corners[q, c] = eye[3, c] + x * eye[1, c] - y * eye[2, c]


@inner_uncounted
def _square(
    place: np.ndarray,
    side: int,
    begin: float,
    eye: np.ndarray,
    numbers: np.ndarray,
    heights: np.ndarray,
    tops: np.ndarray,
    mips: np.ndarray,
    places: np.ndarray,
    colours: np.ndarray,
    room: np.ndarray,
    out: np.ndarray,
) -> None:
    """Adds the light of a square or what is in it of the picture; its rays begin at a multiple of theirs."""
    d, light = room[3], room[4]
    for py in range(place[1], min(place[1] + side, place[3])):
        for px in range(place[0], min(place[0] + side, place[2])):
            for k in range(int(numbers[FROM_SAMPLE]), int(numbers[TO_SAMPLE])):
                x = px + (0.5 + 0.7548776662466927 * k) % 1.0 - 0.5
                y = 0.5 - py - (0.5 + 0.5698402909980532 * k) % 1.0
                size = 0.0
                for c in range(3):
                    d[c] = eye[3, c] + x * eye[1, c] + y * eye[2, c]
                    size += d[c] * d[c]
                size = math.sqrt(size)
                for c in range(3):
                    d[c] /= size
                start, dice = begin * size, _random(px, py, k)
                if begin >= numbers[FARTHEST]:
                    _sky(d, numbers[:3], light)
                else:
                    _seen(heights, tops, mips, places, colours, eye[0], d, numbers, start, dice, light, room)
                for c in range(3):
                    out[py, px, c] += light[c]


@kernel
def picture_block(
    heights: np.ndarray,
    tops: np.ndarray,
    mips: np.ndarray,
    places: np.ndarray,
    colours: np.ndarray,
    eye: np.ndarray,
    numbers: np.ndarray,
    place: np.ndarray,
    out: np.ndarray,
) -> None:
    """A block of a picture, `place` int64 (4,): left, top, right, bottom; adds linear light to it in `out` (h, w, 3)
    float32, the whole picture.

    `eye` (4, 3): where it is; per pixel right and up; to the middle of the corner pixel 0, 0.  `numbers`: as the names
    above say; samples FROM_SAMPLE to TO_SAMPLE - 1 are added.  `colours` uint8 (windows, n + 1, n + 1, 3): roots of
    linear ones.
    """
    corners, part, room, box = np.empty((4, 3)), place.copy(), np.empty((5, 3)), np.empty(5)
    cone, highest, far = numbers[CONE], numbers[TOP_HEIGHT], numbers[FARTHEST]
    fine = _FINEST if numbers[TO_SAMPLE] - numbers[FROM_SAMPLE] >= _MANY else _FINE
    for top in range(place[1], place[3], _COARSE):
        for left in range(place[0], place[2], _COARSE):
            beam_corners(eye, left, top, _COARSE, corners)
            begin = clear_until(heights, tops, mips, places, eye[0], corners, cone, highest, 0.0, far, box)
            for part[1] in range(top, min(top + _COARSE, place[3]), fine):
                for part[0] in range(left, min(left + _COARSE, place[2]), fine):
                    beam_corners(eye, part[0], part[1], fine, corners)
                    near = clear_until(heights, tops, mips, places, eye[0], corners, cone, highest, begin, far, box)
                    _square(part, fine, near, eye, numbers, heights, tops, mips, places, colours, room, out)
