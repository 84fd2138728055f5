"""Drawing: lettering ink from a bristle brush that runs dry at its ends, and soft pastel on rough paper."""

from __future__ import annotations

import numpy as np
from ground import Ground, mixed, ramp, smooth


def ink(ground: Ground) -> tuple[np.ndarray, np.ndarray]:
    """Black ink brushed from side to side: crisp above and below, split by the bristles at the ends."""
    down, across = np.gradient(ground.blurred(ground.depth, 5.0))
    ends = (across / (np.hypot(down, across) + 1e-9)) ** 2
    bristles = 0.75 * ground.streaks(1, 60.0, 1.1) + 0.7 * ground.streaks(2, 90.0, 3.2)
    relief = 0.7 * ground.noise(3, 5.0, 1.3, 0.8) + 0.3 * ground.noise(4, 12.0, 4.0)
    reach = 5.0 + 27.0 * ground.blurred(ends, 3.0) * (1.0 + 0.25 * ground.noise(5, 40.0, 12.0))
    wet = 3.4 * ground.depth / np.maximum(reach, 3.0) - 1.5
    wet += (0.2 + 0.75 * ends) * bristles - (0.35 + 0.55 * ends) * np.clip(relief, -1.2, 2.5)
    alpha = smooth(-0.25, 0.45, wet) * smooth(0.0, 2.0, ground.depth)
    pool = np.exp(-(((wet - 0.9) / 0.7) ** 2))
    tone = 0.42 + 0.11 * bristles + 0.08 * relief - 0.22 * pool + 0.08 * ground.noise(6, 30.0, 10.0)
    rgb = ramp(tone, (0.0, "#08080c"), (0.45, "#17171d"), (0.8, "#2c2c35"), (1.0, "#43434c"))
    return rgb, alpha * (0.94 + 0.05 * np.tanh(relief))


def pastel(ground: Ground) -> tuple[np.ndarray, np.ndarray]:
    """Soft pastel: rubbed into the grain inside, a firm broken contour, dust beyond it."""
    relief = 0.8 * ground.noise(1, 5.5, 1.7, 0.9) + 0.35 * ground.noise(2, 14.0, 5.0, 1.0)
    hatch = ground.streaks(3, 26.0, 1.7, -0.9)
    edge = ground.depth - 8.0 + 1.3 * ground.noise(4, 50.0, 12.0, 1.3)
    contour = np.exp(-(((edge - 2.2) / 2.3) ** 2))
    body = smooth(-0.8, 1.5, edge)
    press = -1.6 + 2.35 * body + 1.5 * contour + 0.38 * hatch * body
    cover = smooth(-0.45, 0.75, press + relief)
    rubbed = 0.36 * smooth(0.0, 5.0, edge)
    dust = 0.30 * smooth(-8.0, 0.0, edge) * smooth(1.2, 2.2, ground.noise(5, 3.0, 1.2, 0.4)) * (1.0 - body)
    alpha = np.clip(np.maximum(cover * (0.80 + 0.18 * contour), rubbed) + dust, 0.0, 1.0)
    tone = 0.5 + 0.17 * relief + 0.10 * hatch + 0.10 * contour
    rgb = ramp(tone, (0.0, "#b5482f"), (0.5, "#e4745a"), (1.0, "#f7a98e"))
    return mixed(rgb, "#b03a2a", 0.5 * contour), alpha * smooth(0.0, 1.5, ground.depth)


EXAMPLES = {
    "brush-ink": lambda: (g := Ground(320, 81), *ink(g)),
    "pastel": lambda: (g := Ground(300, 82), *pastel(g)),
}
