"""Weather and water: a cloud with wisps, old snow that melts at its rim, the shallow sea with its foam."""

from __future__ import annotations

import numpy as np
from ground import Ground, colour, mixed, over, ramp, smooth


def cloud(ground: Ground) -> tuple[np.ndarray, np.ndarray]:
    """Heaped vapour, brighter to the upper left, in wisps at the rim."""
    puffs = ground.noise(1, 40.0, 9.0, 1.5)
    fine = ground.noise(3, 14.0, 2.2, 1.2)
    heap = np.zeros_like(puffs)
    for seed, spacing, high in ((5, 30.0, 7.0), (6, 15.0, 3.6), (7, 8.0, 1.6)):
        wobble = np.stack([ground.noise(seed + k, spacing, 4.0, 1.3) for k in (10, 20)]) * spacing * 0.11
        _, far, _ = ground.cells(ground.dots(seed, spacing, 0.5), wobble)
        heap += high * np.sqrt(np.clip(1.0 - (far / spacing / 0.95) ** 2, 0.0, 1.0))
    height = ground.blurred(heap, 1.5) + 0.8 * puffs + 0.12 * fine + 5.0 * smooth(2.0, 26.0, ground.depth)
    bright, _ = ground.lit(height, 0.6)
    tone = 0.56 + 0.62 * (bright - 1.0) + 0.032 * (heap - heap.mean()) + 0.012 * fine
    rgb = ramp(tone, (0.0, "#5f7596"), (0.33, "#98abc6"), (0.56, "#dbe2ea"), (0.78, "#fffdf6"))
    thick = (
        ground.depth / 24.0
        - 0.12
        + (0.13 * puffs + 0.045 * (heap - heap.mean())) * (1.0 - smooth(20.0, 34.0, ground.depth))
        + 0.06 * fine
    )
    wisps = 0.13 * ground.noise(4, 26.0, 2.2, 1.1)
    alpha = smooth(0.0, 0.75, thick + wisps * (1.0 - smooth(16.0, 30.0, ground.depth)))
    return rgb, alpha * smooth(0.0, 5.0, ground.depth) * (0.955 + 0.02 * np.tanh(puffs))


def snow(ground: Ground) -> tuple[np.ndarray, np.ndarray]:
    """Old snow: soft hollows, a few glints; towards the rim it thins to grey ice and a wet dark line."""
    edge = ground.depth - 5.0 + 1.5 * ground.noise(1, 40.0, 9.0, 1.3) + 0.5 * ground.noise(2, 8.0, 1.8, 0.9)
    bank = edge - 4.0 + 1.2 * ground.noise(3, 16.0, 4.0, 1.1)
    height = (
        3.6 * smooth(-1.0, 9.0, bank) + 0.5 * ground.noise(4, 40.0, 12.0, 1.5) + 0.07 * ground.noise(5, 4.0, 1.2, 0.6)
    )
    bright, _ = ground.lit(ground.blurred(height, 0.35), 0.8)
    rgb = ramp(bright, (0.55, "#7f9cc4"), (0.85, "#c3d4ea"), (1.0, "#edf3fa"), (1.14, "#ffffff"))
    glint = smooth(2.35, 2.9, ground.noise(6, 2.6, 1.2, 0.2))
    rgb = mixed(rgb, "#ffffff", 0.9 * glint)
    ice = 1.0 - smooth(-2.0, 3.0, bank)
    clear = 0.5 + 0.5 * smooth(-1.0, 5.5, edge)
    rgb = mixed(
        rgb,
        ramp(bright + 0.05 * ground.noise(7, 5.0, 1.3), (0.7, "#6f8aa8"), (1.0, "#a8c0d4"), (1.2, "#f4fbff")),
        0.8 * ice,
    )
    there = smooth(-0.5, 0.5, edge)
    wet = smooth(-6.0, 0.5, edge + 0.8 * ground.noise(8, 9.0, 2.0)) ** 1.4 * 0.46 * (1.0 - there)
    shade = ground.blurred(ground.shifted(there, 1.0, 1.4), 1.0) * (1.0 - there) * 0.28
    return over((np.zeros_like(rgb) + colour("#2b2f30"), np.clip(wet + shade, 0.0, 0.7)), (rgb, there * clear))


def sea(ground: Ground) -> tuple[np.ndarray, np.ndarray]:
    """Clear shallow water with the net of light on its bed; lace of foam where it runs out."""
    wobble = np.stack([3.0 * ground.noise(1, 40.0, 9.0, 1.3), 3.0 * ground.noise(2, 40.0, 9.0, 1.3)])
    _, _, net = ground.cells(ground.dots(3, 17.0, 0.25), wobble)
    _, _, finer = ground.cells(ground.dots(4, 10.0, 0.25), wobble * 0.8)
    light = np.exp(-net / 1.5) + 0.45 * np.exp(-finer / 1.1)
    body = 0.46 + 0.07 * ground.noise(5, 50.0, 12.0, 1.3) + 0.30 * ground.blurred(light, 0.45)
    near = 1.0 - smooth(6.0, 26.0, ground.depth)
    rgb = ramp(body, (0.2, "#0b6f86"), (0.5, "#1f9aa8"), (0.7, "#6fcfcb"), (1.0, "#e4fff4"))
    rgb = mixed(rgb, "#bfeee2", 0.28 * near)
    run = ground.depth - 5.0 + 2.0 * ground.noise(6, 40.0, 10.0, 1.3) + 0.4 * ground.noise(7, 6.0, 2.0)
    _, _, lace = ground.cells(ground.dots(8, 5.6, 0.15), 0.9 * wobble[::-1] + 0.8 * ground.noise(9, 7.0, 2.5))
    _, _, bubble = ground.cells(ground.dots(10, 2.6, 0.2))
    wall = 1.0 - smooth(-1.0, 1.6, lace - 2.6 + 0.22 * (run - 2.0) + 0.35 * ground.noise(11, 14.0, 4.0))
    crest = 1.0 - smooth(0.8, 2.6, run + 0.7 * ground.noise(12, 8.0, 2.0))
    foam = np.clip(np.maximum(crest, wall * (1.0 - smooth(9.0, 15.0, run))), 0.0, 1.0)
    froth = 0.90 + 0.10 * smooth(0.0, 0.9, bubble)
    white = np.zeros_like(rgb) + colour("#fbfffd")
    shade = ground.blurred(ground.shifted(foam, 0.8, 1.3), 0.7) * (1.0 - foam)
    rgb = mixed(rgb * (1.0 - 0.34 * shade)[..., None], white * froth[..., None], 0.95 * foam)
    there = smooth(-0.5, 0.5, run)
    damp = 0.30 * smooth(-4.0, 0.0, run) * (1.0 - there)
    clear = 0.72 + 0.18 * smooth(0.0, 22.0, run)
    return over((np.zeros_like(rgb) + colour("#3c3423"), damp), (rgb, there * np.maximum(clear, foam)))


EXAMPLES = {
    "cloud": lambda: (g := Ground(320, 51), *cloud(g)),
    "old-snow": lambda: (g := Ground(300, 52), *snow(g)),
    "sea-foam": lambda: (g := Ground(320, 53), *sea(g)),
}
