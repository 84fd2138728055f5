"""Crusts: rust where paint has flaked away, and a slice of bread."""

from __future__ import annotations

import numpy as np
from ground import FINE, Ground, colour, mixed, numbers, over, ramp, smooth
from scipy import ndimage


def rust(ground: Ground) -> tuple[np.ndarray, np.ndarray]:
    """Rusted iron; along the rim what is left of the paint, in curling chips over pale primer."""
    wobble = np.stack([1.3 * ground.noise(1, 26.0, 4.0, 1.2), 1.3 * ground.noise(2, 26.0, 4.0, 1.2)])
    dots = ground.dots(3, 11.0, 0.3)
    which, _, border = ground.cells(dots, wobble)
    at = np.clip((dots * FINE).astype(int), 0, ground.x.shape[0] - 1)
    stuck = 15.0 + 9.0 * (numbers(ground.seed + 4, len(dots)) - 0.5)
    chips = (ground.depth[at[:, 1], at[:, 0]] < stuck)[which] & ((border > 0.5) | (ground.depth < 5.0))
    rim = ndimage.distance_transform_edt(chips) / FINE
    off = ndimage.distance_transform_edt(~chips) / FINE
    scale = 0.6 * ground.noise(5, 22.0, 3.0, 1.1) + 0.5 * ground.noise(6, 4.0, 1.3, 0.7)
    pits = smooth(0.9, 1.9, ground.noise(7, 7.0, 2.0, 0.9))
    height = np.where(chips, 1.3 + 1.0 * np.exp(-rim / 1.8) + 0.05 * scale, 0.45 * scale - 1.0 * pits)
    bright, gloss = ground.lit(ground.blurred(height, 0.4), 0.62, 24.0)
    iron = ramp(
        0.48 + 0.15 * scale + 0.10 * ground.noise(8, 40.0, 9.0),
        (0.0, "#3a1a10"),
        (0.35, "#7c3413"),
        (0.6, "#b2571c"),
        (0.85, "#d98a3d"),
    )
    iron = mixed(iron, "#2a1812", 0.7 * pits) * (0.35 + 0.65 * bright)[..., None]
    shade = ground.blurred(ground.shifted(chips.astype(float), 1.3, 1.7), 0.8) * ~chips
    iron = iron * (1.0 - 0.6 * shade)[..., None]
    iron = mixed(iron, "#cfc7b4", 0.55 * np.exp(-off / 0.9) * ~chips)
    stains = smooth(0.3, 2.2, ground.noise(9, 12.0, 2.0, 1.0)) * np.exp(-rim / 2.5)
    paint = ramp(0.5 + 0.10 * ground.noise(10, 18.0, 2.0, 1.1), (0.0, "#2c6f70"), (0.5, "#4a9a93"), (1.0, "#83c0b2"))
    paint = mixed(paint, "#8a4a1c", 0.55 * stains) * (0.35 + 0.65 * bright)[..., None] + 0.10 * gloss[..., None]
    rgb = np.where(chips[..., None], paint, iron)
    return rgb, smooth(0.0, 4.0, ground.depth + 0.8 * ground.noise(11, 6.0, 1.5))


def bread(ground: Ground) -> tuple[np.ndarray, np.ndarray]:
    """A slice: the open crumb inside, a baked crust around it."""
    wobble = np.stack([1.3 * ground.noise(1, 18.0, 3.0, 1.1), 1.3 * ground.noise(2, 18.0, 3.0, 1.1)])
    edge = ground.depth - 3.0 + 0.8 * ground.noise(3, 30.0, 7.0, 1.2) + 0.2 * ground.noise(4, 4.0, 1.3)
    open_ = smooth(7.0, 16.0, edge)
    height = np.zeros_like(edge)
    for seed, spacing, deep, share in ((5, 15.0, 2.6, 0.5), (6, 8.0, 1.7, 0.55), (7, 4.2, 0.8, 0.6)):
        dots = ground.dots(seed, spacing, 0.25)
        which, far, _ = ground.cells(dots, wobble * spacing / 14.0)
        chance = numbers(ground.seed + seed, 2, len(dots))
        size = np.where(chance[0] < share, spacing * (0.20 + 0.28 * chance[1]), 0.0)[which]
        hole = 1.0 - smooth(0.6, 1.1, far / np.maximum(size, 1e-3))
        height -= deep * hole * np.where(spacing > 5.0, 0.15 + 0.85 * open_, 1.0)
    height = ground.blurred(height, 0.6)
    bright, _ = ground.lit(height + 0.05 * ground.noise(8, 4.0, 1.6, 0.8), 0.5)
    tone = 0.84 + 0.14 * height + 0.05 * ground.noise(9, 24.0, 3.0, 1.0)
    crumb = ramp(tone, (0.25, "#a87a45"), (0.55, "#d9b981"), (0.8, "#f3e3bd"), (1.0, "#fdf6e0"))
    wide = 8.0 * np.clip(1.0 + 0.25 * ground.noise(10, 50.0, 12.0), 0.5, 1.6)
    baked = np.clip(edge / wide + 0.10 * ground.noise(11, 7.0, 1.5, 0.9), 0.0, 2.0)
    crust = ramp(baked, (0.0, "#5a2b0f"), (0.35, "#96501c"), (0.7, "#c98a3f"), (1.0, "#e6bf7c"))
    rgb = mixed(crust, crumb, smooth(0.75, 1.55, baked)) * (0.52 + 0.48 * bright)[..., None]
    there = smooth(-0.5, 0.5, edge)
    dark = ground.blurred(ground.shifted(there, 1.3, 1.8), 1.3) * (1.0 - there) * 0.40
    return over((np.zeros_like(rgb) + colour("#241505"), dark), (rgb, there))


EXAMPLES = {
    "rust-and-paint": lambda: (g := Ground(320, 91), *rust(g)),
    "bread": lambda: (g := Ground(300, 92), *bread(g)),
}
