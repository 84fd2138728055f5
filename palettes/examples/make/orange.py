"""A peeled orange: the pitted rind with its white pith along the tear, and the pulp with its skin."""

from __future__ import annotations

import numpy as np
from ground import Ground, colour, mixed, nearest, numbers, over, ramp, smooth


def peel(ground: Ground, drop: float = 4.0, white: float = 9.5, dark: float = 0.40) -> tuple[np.ndarray, np.ndarray]:
    """Glossy rind; pith of uneven width, about `white`, at the rim; a slight shadow, for which it lies further in."""
    edge = ground.depth - drop + 0.9 * ground.noise(1, 40.0, 9.0, 1.2) + 0.3 * ground.noise(2, 6.0, 1.5, 0.9)
    wide = white * np.clip(0.72 + 0.42 * ground.noise(3, 80.0, 16.0, 1.2), 0.25, 1.7)
    rind = edge - wide + 0.6 * ground.noise(4, 14.0, 3.0, 1.0)
    there, skin = smooth(-0.5, 0.5, edge), smooth(-0.5, 0.5, rind)
    dots = ground.dots(5, 6.4, 0.6)
    which, far, _ = ground.cells(dots)
    size = (1.2 + 0.9 * numbers(ground.seed + 6, len(dots)))[which]
    pits = -0.42 * np.exp(-((far / size) ** 2) * 1.3)
    height = ground.blurred(pits, 0.35) + 0.2 * ground.noise(7, 30.0, 10.0, 1.3) + 0.012 * ground.noise(8, 3.0, 1.2)
    height += 1.1 * smooth(0.0, 4.0, rind)
    bright, gloss = ground.lit(height, 1.0, 26.0)
    rgb = ramp(
        0.5 + 0.16 * ground.noise(9, 45.0, 8.0, 1.2) + 0.5 * pits, (0.0, "#e06a06"), (0.5, "#f48a10"), (1.0, "#fba52a")
    )
    rgb = rgb * (0.30 + 0.70 * bright)[..., None] + 0.34 * gloss[..., None] * colour("#fff2cf")
    pulpy = 1.2 * smooth(-0.5, 5.0, edge) + 0.30 * ground.noise(10, 8.0, 1.6, 0.9) + 0.25 * smooth(0.0, -3.0, rind)
    pale, _ = ground.lit(ground.blurred(pulpy, 0.4), 0.75)
    pith = mixed(np.zeros_like(rgb) + colour("#fdf3dc"), "#f6cf8a", 0.85 * np.exp(-np.clip(-rind, 0.0, 99.0) / 1.6))
    pith = pith * (0.55 + 0.45 * pale)[..., None]
    shade = ground.blurred(ground.shifted(there, 1.5, 2.0), 1.4)
    below = np.zeros_like(rgb) + colour("#3a2208"), dark * shade * (1.0 - there)
    return over(below, (mixed(pith, rgb, skin), there))


def pulp(ground: Ground) -> tuple[np.ndarray, np.ndarray]:
    """Juice sacs that glow from inside, in segments' thin skins; a pale skin at the rim."""
    wobble = np.stack([1.5 * ground.noise(1, 40.0, 12.0, 1.3), 1.5 * ground.noise(2, 40.0, 12.0, 1.3)])
    # Sacs lie aslant, twice as long as wide: cells of a squeezed plane.
    turn = 0.9
    stretch = np.array([[np.cos(turn), -np.sin(turn)], [np.sin(turn), np.cos(turn)]]) @ np.diag([0.46, 1.0])
    stretch = stretch @ np.array([[np.cos(turn), np.sin(turn)], [-np.sin(turn), np.cos(turn)]])
    dots = ground.dots(3, 9.0, 0.45)
    middle = ground.size / 2
    x, y = ground.x + wobble[0] - middle, ground.y + wobble[1] - middle
    (xx, xy), (yx, yy) = stretch
    which, far, border = nearest(xx * x + xy * y + middle, yx * x + yy * y + middle, dots)
    sac = smooth(0.0, 5.5, border)
    tone = numbers(ground.seed + 4, len(dots))[which]
    edge = ground.depth - 2.5 + 0.7 * ground.noise(5, 30.0, 8.0, 1.2)
    skin = 3.4 * np.clip(1.0 + 0.35 * ground.noise(6, 50.0, 10.0, 1.2), 0.4, 2.0)
    rounded = 1.5 * np.sqrt(np.clip(border, 0.0, 7.0) / 7.0) * smooth(skin.max() * 0.3, skin.max() + 3.0, edge)
    bright, gloss = ground.lit(ground.blurred(rounded, 0.6) + 0.10 * ground.noise(7, 8.0, 3.0), 0.9, 70.0)
    glow = 0.28 + 0.45 * sac + 0.22 * (tone - 0.5) - 0.05 * far / 4.0 + 0.05 * ground.noise(8, 5.0, 1.3)
    rgb = ramp(glow, (0.0, "#b94a02"), (0.35, "#ef7d06"), (0.65, "#fb9d1c"), (1.0, "#ffcf5e"))
    rgb = rgb * (0.62 + 0.38 * bright)[..., None] + 0.5 * gloss[..., None] * sac[..., None] * colour("#fff3d0")
    membrane = 1.0 - smooth(-1.2, 1.2, edge - skin + 0.4 * ground.noise(9, 7.0, 1.5))
    pale = ramp(edge / skin, (0.0, "#fff6df"), (0.5, "#ffe9b8"), (1.0, "#f9b545"))
    veins = 1.0 + 0.05 * ground.noise(10, 9.0, 1.5, 0.9)
    rgb = mixed(rgb, pale * veins[..., None], 0.93 * membrane)
    return rgb, smooth(-0.5, 0.5, edge) * (0.97 - 0.12 * membrane)


def pith(ground: Ground) -> tuple[np.ndarray, np.ndarray]:
    """The inside of the peel: spongy and white, with the rind cut through along its rim."""
    edge = ground.depth - 1.2 + 0.6 * ground.noise(1, 40.0, 6.0, 1.2)
    there = smooth(-0.5, 0.5, edge)
    height = 0.20 * ground.noise(2, 16.0, 3.0, 1.1) + 0.09 * ground.noise(3, 4.0, 1.4, 0.8)
    height += 1.3 * smooth(0.0, 7.0, edge)
    bright, _ = ground.lit(ground.blurred(height, 0.4), 0.8)
    rgb = ramp(0.5 + 0.16 * ground.noise(4, 30.0, 4.0, 1.1), (0.0, "#f0d9a8"), (0.5, "#f8ead0"), (1.0, "#fff8ea"))
    rgb = rgb * (0.5 + 0.5 * bright)[..., None]
    zest = 1.0 - smooth(1.6, 3.6, edge + 0.5 * ground.noise(5, 9.0, 2.0, 1.0))
    return mixed(rgb, "#ef8d18", 0.9 * zest), there


def segment(ground: Ground) -> tuple[np.ndarray, np.ndarray]:
    """Sacs seen through the skin of a segment, with threads of pith on it, which is thickest at the rim."""
    dots = ground.dots(1, 11.0, 0.35)
    wobble = np.stack([2.0 * ground.noise(2, 30.0, 8.0, 1.3), 2.0 * ground.noise(3, 30.0, 8.0, 1.3)])
    which, _, border = ground.cells(dots, wobble)
    sac = smooth(0.0, 6.0, border)
    tone = numbers(ground.seed + 4, len(dots))[which] - 0.5
    glow = 0.42 + 0.26 * (sac - 0.6) + 0.14 * tone + 0.07 * ground.noise(5, 24.0, 5.0, 1.2)
    rgb = ramp(glow, (0.0, "#e07a12"), (0.4, "#f9a02c"), (0.7, "#ffc05c"), (1.0, "#ffe0a0"))
    edge = ground.depth - 1.0 + 0.5 * ground.noise(6, 30.0, 8.0, 1.2)
    bright, gloss = ground.lit(ground.blurred(1.1 * sac, 1.2) + 1.8 * smooth(-1.0, 12.0, edge), 0.6, 60.0)
    threads = np.exp(-((ground.noise(7, 46.0, 7.0, 1.2) / 0.11) ** 2)) * smooth(-0.6, 0.9, ground.noise(8, 40.0, 14.0))
    rgb = rgb * (0.62 + 0.38 * bright)[..., None] + 0.25 * gloss[..., None] * sac[..., None] * colour("#fff3d0")
    skin = 3.6 * np.clip(1.0 + 0.3 * ground.noise(9, 40.0, 8.0, 1.2), 0.5, 1.7)
    white = np.clip(0.9 * (1.0 - smooth(-0.3, 1.0, (edge - skin) / 2.4)) + 0.4 * threads, 0.0, 0.93)
    return mixed(rgb, colour("#fff0cf") * (0.7 + 0.3 * bright)[..., None], white), smooth(-0.5, 0.5, edge)


EXAMPLES = {
    "orange-peel": lambda: (g := Ground(280, 31), *peel(g)),
    "orange-pulp": lambda: (g := Ground(280, 32), *pulp(g)),
    "orange-rind": lambda: (g := Ground(280, 33, bites=0.35), *peel(g, 1.2, 10.0, 0.0)),
    "orange-pith": lambda: (g := Ground(280, 34, bites=0.35), *pith(g)),
    "orange-segment": lambda: (g := Ground(280, 35, bites=0.35), *segment(g)),
}
