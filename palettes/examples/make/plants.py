"""Plants: a clump of leaves, and turf whose blades hang over its rim."""

from __future__ import annotations

import numpy as np
from ground import Ground, colour, mixed, numbers, over, smooth
from lines import Sheet, curves


def _outline(x: float, y: float, angle: float, length: float, width: float) -> np.ndarray:
    """A pointed leaf that starts at a place: (k, 2)."""
    t = np.linspace(0.0, 1.0, 13)
    side = np.sin(np.pi * t**0.8) ** 0.9 * width / 2.0
    along = np.concatenate([t, t[::-1]]) * length
    aside = np.concatenate([side, -side[::-1]])
    c, s = np.cos(angle), np.sin(angle)
    return np.stack([x + along * c - aside * s, y + along * s + aside * c], axis=-1)


def _outward(ground: Ground) -> tuple[np.ndarray, np.ndarray]:
    """The direction out of the blob, (n, n) twice."""
    down, across = np.gradient(ground.blurred(ground.depth, 4.0))
    length = np.hypot(down, across) + 1e-9
    return -across / length, -down / length


def leaves(ground: Ground) -> tuple[np.ndarray, np.ndarray]:
    """Pointed leaves over one another, dark between; along the rim they point outwards and catch the light."""
    count = 3400
    chance = numbers(ground.seed + 1, 7, count)
    n = ground.x.shape[0]
    place = chance[:2] * ground.size
    cell = np.clip((place * n / ground.size).astype(int), 0, n - 1)
    depth = ground.depth[cell[1], cell[0]]
    out_x, out_y = (v[cell[1], cell[0]] for v in _outward(ground))
    sheet = Sheet(ground.size)
    light = np.array([-0.63, -0.77])
    for k in np.argsort(chance[6]):
        if depth[k] < 12.5:
            continue
        rim = depth[k] < 20.0
        angle = chance[2, k] * 2.0 * np.pi
        if rim:
            angle = np.arctan2(out_y[k], out_x[k]) + (chance[2, k] - 0.5) * 1.9
        length, width = 10.0 + 6.0 * chance[3, k], 4.6 + 2.2 * chance[4, k]
        high = chance[6, k]
        base = mixed(colour("#16280f"), "#5f8f2b", 0.25 + 0.75 * high)
        base = mixed(
            base, "#b9cc5e" if chance[5, k] < 0.7 else "#3f7a55", 0.45 * chance[5, k] * high + (0.22 if rim else 0.0)
        )
        facing = np.array([np.cos(angle), np.sin(angle)]) @ light
        side = np.array([-np.sin(angle), np.cos(angle)]) @ light
        x, y = place[:, k]
        sheet.shape(_outline(x + 0.7, y + 1.0, angle, length, width + 0.7), colour("#0d1808"))
        whole = _outline(x, y, angle, length, width)
        half = len(whole) // 2
        sheet.shape(whole, base * (1.0 + 0.14 * facing - 0.17 * side))
        sheet.shape(whole[:half], base * (1.0 + 0.14 * facing + 0.19 * side))
        tip = np.array([x + np.cos(angle) * length * 0.92, y + np.sin(angle) * length * 0.92])
        sheet.line(np.array([[x, y], tip]), base * 1.28 + 0.03, 0.34)
    rgb, cover = sheet.laid()
    rgb = np.where(cover[..., None] > 0.0, rgb, colour("#0f1a0a"))
    full = smooth(18.0, 21.0, ground.depth)
    return rgb * (1.0 + 0.04 * ground.noise(3, 4.0, 1.2))[..., None], np.maximum(cover, full)


def turf(ground: Ground) -> tuple[np.ndarray, np.ndarray]:
    """Short grass seen from above; at the rim the blades hang out over bare soil."""
    count = 15000
    chance = numbers(ground.seed + 1, 6, count)
    n = ground.x.shape[0]
    place = chance[:2] * ground.size
    cell = np.clip((place * n / ground.size).astype(int), 0, n - 1)
    depth = ground.depth[cell[1], cell[0]]
    out_x, out_y = (v[cell[1], cell[0]] for v in _outward(ground))
    keep = depth > 9.0
    part = np.clip((17.0 - depth) / 6.0, 0.0, 1.0)
    free = chance[2] * 2.0 * np.pi
    aim_x = np.cos(free) * (1.0 - part) + out_x * part * 1.2
    aim_y = np.sin(free) * (1.0 - part) + out_y * part * 1.2 + 0.25
    blades = curves(ground.seed + 5, place.T, np.arctan2(aim_y, aim_x), 10.0, 1.5)
    sheet = Sheet(ground.size)
    dead = numbers(ground.seed + 6, count) < 0.07
    for k in np.flatnonzero(keep):
        high = k / count
        base = mixed(colour("#1c3009"), "#6fa02c", 0.15 + 0.85 * high * (0.55 + 0.45 * chance[3, k]))
        base = mixed(base, "#c8d46a", 0.45 * chance[4, k] ** 2 * high + 0.25 * part[k] * chance[3, k])
        base = mixed(base, "#b79c55", 0.7) if dead[k] else base
        sheet.line(blades[k][:5], base * 0.84, 1.25)
        sheet.line(blades[k][2:], base * 1.08, 0.7)
    rgb, cover = sheet.laid()
    earth = colour("#1a2008") * (1.0 + 0.2 * ground.noise(7, 5.0, 1.2))[..., None]
    full = smooth(13.0, 15.0, ground.depth)
    rgb = np.where(cover[..., None] > 0.0, rgb, earth)
    alpha = np.maximum(cover, full)
    shade = ground.blurred(ground.shifted(alpha, 1.0, 1.8), 1.2) * smooth(0.0, 3.0, ground.depth)
    return over((np.zeros_like(rgb) + colour("#1e1608"), 0.42 * shade * (1.0 - alpha)), (rgb, alpha))


EXAMPLES = {
    "leaves": lambda: (g := Ground(320, 61), *leaves(g)),
    "turf": lambda: (g := Ground(300, 62), *turf(g)),
}
