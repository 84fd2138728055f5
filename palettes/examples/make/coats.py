"""What runs one way, so that strokes tell it which: thatch and fur; and paper that is burnt far in from its rim."""

from __future__ import annotations

import numpy as np
from ground import Ground, colour, mixed, numbers, ramp, smooth
from lines import Sheet, curves


def _laid(ground: Ground, count: int, inside: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Places (count, 2) of what begins so far inside the blob, how deep each lies there, and chance, (6, count)."""
    chance = numbers(ground.seed + 1, 6, count)
    n = ground.x.shape[0]
    place = chance[:2] * ground.size
    cell = np.clip((place * n / ground.size).astype(int), 0, n - 1)
    depth = ground.depth[cell[1], cell[0]]
    return place.T[depth > inside], depth[depth > inside], chance[2:, depth > inside]


def thatch(ground: Ground) -> tuple[np.ndarray, np.ndarray]:
    """Straw that lies from left to right, layer over layer, each with its shadow; loose ends at the rim."""
    place, _, chance = _laid(ground, 5200, 6.0)
    streak = ground.streaks(3, 30.0, 2.5)
    n = ground.x.shape[0]
    straws = curves(ground.seed + 5, place, 0.2 * (chance[0] - 0.5), 30.0, 0.16)
    sheet = Sheet(ground.size)
    for k in range(len(place)):
        cell = np.clip((place[k] * n / ground.size).astype(int), 0, n - 1)
        tone = 0.5 + 0.22 * streak[cell[1], cell[0]] + 0.5 * (chance[1, k] - 0.5)
        base = mixed(colour("#6b4a22"), "#e7cd8c", float(np.clip(tone, 0.0, 1.0)))
        base = mixed(base, "#8b8f5a" if chance[2, k] < 0.5 else "#b5793c", 0.35 * chance[3, k] ** 2)
        sheet.line(straws[k] + (0.5, 1.1), colour("#2e1d0d"), 1.3)
        sheet.line(straws[k], base * 0.86, 1.5)
        sheet.line(straws[k] - (0.0, 0.35), base * 1.14, 0.5)
    rgb, cover = sheet.laid()
    full = smooth(9.0, 11.0, ground.depth)
    return np.where(cover[..., None] > 0.0, rgb, colour("#2e1d0d")), np.maximum(cover, full)


def fur(ground: Ground) -> tuple[np.ndarray, np.ndarray]:
    """A fox's coat, combed from left to right: tufts of dark roots and pale tips, which stand out at the right."""
    place, depth, chance = _laid(ground, 9000, 7.0)
    order = np.argsort(-place[:, 0] + 26.0 * chance[3])  # tips lie over the roots of those that follow
    hairs = curves(ground.seed + 5, place, 0.55 * _leaning(ground, place) + 0.3 * (chance[0] - 0.5), 19.0, 0.5)
    sheet = Sheet(ground.size)
    for k in order:
        tone = 0.25 + 0.55 * chance[1, k] + 0.2 * float(np.clip(depth[k] / 30.0, 0.0, 1.0))
        base = mixed(colour("#7a3812"), "#d98a3d", float(np.clip(tone, 0.0, 1.0)))
        base = mixed(base, "#3a1a0a", 0.55 * chance[2, k] ** 3)
        sheet.line(hairs[k][:3], base * 0.5, 1.1)
        sheet.line(hairs[k][2:5], base * 0.92, 0.9)
        sheet.line(hairs[k][4:], mixed(base, "#f7e3bd", 0.5), 0.5)
    rgb, cover = sheet.laid()
    full = smooth(10.0, 12.0, ground.depth)
    return np.where(cover[..., None] > 0.0, rgb, colour("#3a1a0a")), np.maximum(cover, full)


def _leaning(ground: Ground, place: np.ndarray) -> np.ndarray:
    """Which way the tuft leans that each of some places belongs to: -1..1, slowly changing along the coat."""
    n = ground.x.shape[0]
    cell = np.clip((place * n / ground.size).astype(int), 0, n - 1)
    return np.clip(0.5 * ground.streaks(8, 16.0, 5.0)[cell[:, 1], cell[:, 0]], -1.0, 1.0)


def burnt(ground: Ground) -> tuple[np.ndarray, np.ndarray]:
    """An old letter that was on fire: charred at the rim, then brown, and singed 40 pixels far into the paper."""
    uneven = ground.depth * (1.0 + 0.16 * ground.noise(3, 40.0, 6.0)) + 1.3 * ground.noise(4, 9.0, 1.0)
    paper = 1.0 + 0.035 * ground.noise(5, 5.0, 0.8) + 0.03 * ground.noise(6, 60.0, 12.0)
    fibres = 0.03 * ground.streaks(7, 7.0, 0.5, 0.4)
    tone = np.clip(uneven, 0.0, 60.0)
    stops = (0.0, "#0d0a08"), (3.5, "#1b120c"), (6.5, "#3f2412"), (11.0, "#74471f"), (18.0, "#a97a3f")
    rgb = ramp(tone, *stops, (27.0, "#cfa96a"), (36.0, "#e3c88f"), (46.0, "#eddcb2"))
    height = smooth(0.0, 9.0, uneven) * 2.2 + 0.25 * ground.noise(9, 6.0, 1.0)
    bright, _ = ground.lit(height, 0.55)
    ash = (smooth(1.5, 2.5, uneven) - smooth(3.0, 4.5, uneven)) * smooth(0.2, 1.2, ground.noise(10, 8.0, 1.5))
    rgb = mixed(rgb * ((paper + fibres) * (0.6 + 0.4 * bright))[..., None], "#8d857b", 0.55 * ash)
    return rgb, smooth(0.3, 1.3, uneven)


EXAMPLES = {
    "thatch": lambda: (g := Ground(150, 71, bites=0.35), *thatch(g)),
    "fur": lambda: (g := Ground(150, 72, bites=0.35), *fur(g)),
    "burnt-paper": lambda: (g := Ground(300, 73, bites=0.8), *burnt(g)),
}
