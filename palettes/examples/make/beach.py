"""Shingle that the sea has sorted: fine at the left, coarse at the right, so that a map tells their size."""

from __future__ import annotations

import numpy as np
from ground import Ground, colour, mixed, numbers, ramp, smooth
from scipy import spatial

FINEST, COARSEST = 2.6, 11.0  # radii, pixels
_TRIED = 60000
_NEAR = 24  # stones that one may lie on


def _stones(ground: Ground) -> tuple[np.ndarray, np.ndarray]:
    """Places (k, 2) and radii (k,) of stones that hardly overlap, the largest laid first at each place."""
    chance = numbers(ground.seed + 1, 4, _TRIED)
    place = (chance[:2] * 1.1 - 0.05) * ground.size
    along = np.clip(place[0] / ground.size, 0.0, 1.0)
    radius = FINEST * (COARSEST / FINEST) ** along * (0.75 + 0.5 * chance[2])
    order = np.argsort(-radius * (0.55 + 0.45 * chance[3]))
    kept: list[int] = []
    cells: dict[tuple[int, int], list[int]] = {}
    for k in order:
        x, y = place[:, k]
        i, j = int(x // 16), int(y // 16)
        near = [n for a in (-2, -1, 0, 1, 2) for b in (-2, -1, 0, 1, 2) for n in cells.get((i + a, j + b), ())]
        apart = np.hypot(place[0, near] - x, place[1, near] - y) if near else np.ones(0)
        if not near or (apart > 0.8 * (radius[near] + radius[k])).all():
            kept.append(k)
            cells.setdefault((i, j), []).append(k)
    return place.T[kept], radius[kept]


def shingle(ground: Ground) -> tuple[np.ndarray, np.ndarray]:
    """Rounded stones of slate, quartz and rust; wet, dark sand between them, and pale, dry sand along the rim."""
    place, radius = _stones(ground)
    bend = np.stack([1.1 * ground.noise(2, 26.0, 7.0), 1.1 * ground.noise(3, 26.0, 7.0)])
    at = np.stack([(ground.x + bend[0]).ravel(), (ground.y + bend[1]).ravel()], axis=-1)
    far, which = spatial.cKDTree(place).query(at, k=_NEAR)
    part = far / radius[which]
    first = part.argmin(axis=1)[:, None]
    stone = np.take_along_axis(which, first, 1)[:, 0].reshape(ground.x.shape)
    part = np.take_along_axis(part, first, 1)[:, 0].reshape(ground.x.shape)
    dome = np.sqrt(np.clip(1.0 - part**2, 0.0, 1.0))
    bright, gloss = ground.lit(0.55 * dome * radius[stone], 1.0, 30.0)
    chance = numbers(ground.seed + 7, 3, len(place))[:, stone]
    rgb = ramp(chance[0], (0.0, "#4a5058"), (0.45, "#7d7a73"), (0.7, "#a89c86"), (0.86, "#8a5a40"), (1.0, "#ded8cb"))
    rgb = rgb * (0.88 + 0.24 * chance[1])[..., None] * (1.0 + 0.05 * ground.noise(8, 3.0, 0.8))[..., None]
    rgb = rgb * np.clip(0.35 + 0.65 * bright, 0.0, 1.3)[..., None] + 0.16 * gloss[..., None]
    sand = mixed(colour("#2d2822"), "#4d4336", np.clip(0.5 + 0.3 * ground.noise(9, 2.0, 0.7), 0.0, 1.0))
    rgb = mixed(sand, rgb, 1.0 - smooth(0.9, 1.0, part))
    dry = mixed(colour("#d9c8a0"), "#b79f73", np.clip(0.5 + 0.35 * ground.noise(10, 3.0, 0.7), 0.0, 1.0))
    reach = 9.0 + 1.6 * ground.noise(11, 30.0, 5.0)
    rgb = mixed(rgb, dry, 1.0 - smooth(-1.5, 1.5, ground.depth - reach))
    grains = ground.depth - 1.6 + 0.9 * ground.noise(12, 3.0, 0.9)
    return rgb, smooth(-0.5, 0.5, grains)


EXAMPLES = {"shingle": lambda: (g := Ground(320, 74, bites=0.5), *shingle(g))}
