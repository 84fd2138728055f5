"""Stone: gravel in a rim of moss, a brick wall in worn plaster, crusted lava with a glowing rim."""

from __future__ import annotations

import numpy as np
from ground import FINE, Ground, colour, mixed, numbers, over, ramp, smooth
from scipy import ndimage
from skimage import data


def mossy_gravel(ground: Ground) -> tuple[np.ndarray, np.ndarray]:
    """Gravel (the photograph of scikit-image, CC0 by CC0Textures.com) with cushions of moss along the rim."""
    photo = data.gravel() / 255.0
    n = ground.size * FINE
    stones = ndimage.map_coordinates(
        photo, np.meshgrid(*[np.arange(n) / FINE * 1.15 + 8.0] * 2, indexing="ij"), order=3
    )
    stones = np.clip((stones - 0.05) * 1.25, 0.0, 1.0)
    warm = 0.5 + 0.22 * ground.noise(1, 30.0, 9.0, 1.2)
    rgb = ramp(stones, (0.0, "#15130f"), (0.35, "#5c554b"), (0.7, "#a59d8f"), (1.0, "#efe9dc"))
    rgb = mixed(rgb, rgb * np.array([1.08, 0.96, 0.84]), np.clip(warm, 0.0, 1.0))
    reach = 18.5 + 2.6 * ground.noise(2, 60.0, 12.0, 1.2)
    near = ground.depth + 2.4 * ground.noise(3, 12.0, 3.0, 1.0) + 7.0 * (stones - 0.45)
    moss = 1.0 - smooth(-1.2, 1.2, near - reach)
    dots = ground.dots(4, 9.0, 0.4)
    which, _, border = ground.cells(dots, np.stack([ground.noise(5, 7.0, 2.0), ground.noise(6, 7.0, 2.0)]))
    cushion = np.sqrt(np.clip(border, 0.0, 8.0) / 8.0)
    height = (2.6 * cushion + 0.38 * ground.noise(7, 3.2, 1.3, 0.5)) * moss + 1.3 * ground.blurred(moss, 1.2)
    bright, _ = ground.lit(ground.blurred(height, 0.3), 0.8)
    tone = (
        0.33
        + 0.44 * cushion
        + 0.12 * ground.noise(8, 2.4, 1.0, 0.4)
        + 0.2 * (numbers(ground.seed + 9, len(dots))[which] - 0.5)
    )
    green = (
        ramp(tone, (0.0, "#16230a"), (0.35, "#3f5c16"), (0.65, "#79942a"), (1.0, "#c3cc62"))
        * (0.4 + 0.6 * bright)[..., None]
    )
    shade = ground.blurred(ground.shifted(moss, 1.2, 1.5), 1.3) * (1.0 - moss)
    rgb = mixed(rgb * (1.0 - 0.55 * shade)[..., None], green, moss)
    edge = ground.depth - 3.5 + 1.5 * (cushion - 0.5) * 2.0 + 0.5 * ground.noise(10, 4.0, 1.3, 0.7)
    there = smooth(-0.5, 0.5, edge)
    dark = ground.blurred(ground.shifted(there, 0.9, 1.2), 1.0) * (1.0 - there) * 0.35
    return over((np.zeros_like(rgb) + colour("#0c1006"), dark), (rgb, there))


def brick(ground: Ground) -> tuple[np.ndarray, np.ndarray]:
    """Bricks laid in stretcher bond, where the plaster has come off; the plaster's broken edge is the rim."""
    x = ground.x + 0.7 * ground.noise(1, 30.0, 6.0, 1.2)
    y = ground.y + 0.5 * ground.noise(2, 30.0, 6.0, 1.2)
    wide, high, joint = 27.0, 11.0, 1.9
    row = np.floor(y / high).astype(int)
    along = x + (row % 2) * wide / 2.0
    column = np.floor(along / wide).astype(int)
    inset = (
        np.minimum(np.minimum(along % wide, wide - along % wide), np.minimum(y % high, high - y % high)) - joint / 2.0
    )
    inset += 0.35 * ground.noise(3, 6.0, 1.5, 0.9)
    face = smooth(-0.4, 0.7, inset)
    tone = numbers(ground.seed + 4, 64, 64)[row % 64, column % 64]
    height = 1.0 * smooth(-0.6, 2.2, inset) + 0.16 * ground.noise(5, 9.0, 1.3, 0.7)
    burnt = ramp(tone, (0.0, "#7a3526"), (0.4, "#9c4a33"), (0.8, "#b5603f"), (1.0, "#c98a63"))
    burnt = burnt * (1.0 + 0.10 * ground.noise(6, 12.0, 1.2, 0.7))[..., None]
    mortar = np.zeros_like(burnt) + colour("#a89c8a")
    wall = mixed(mortar * (1.0 + 0.07 * ground.noise(7, 4.0, 1.2, 0.6))[..., None], burnt, face)
    broken = 12.0 + 4.0 * ground.noise(8, 60.0, 9.0, 1.2) + 0.9 * ground.noise(9, 9.0, 1.6, 0.9)
    coat = 1.0 - smooth(-0.5, 0.5, ground.depth - broken - 2.0 * (1.0 - face))
    scratch = 1.0 - smooth(-0.5, 0.5, ground.depth - broken - 4.5 - 1.4 * ground.noise(10, 12.0, 3.0))
    height = (
        height
        + 1.0 * ground.blurred(scratch, 0.35)
        + 1.9 * ground.blurred(coat, 0.3)
        + 0.12 * coat * ground.noise(11, 14.0, 1.5, 0.9)
    )
    bright, _ = ground.lit(ground.blurred(height, 0.3), 0.75)
    below = mixed(
        wall, np.zeros_like(wall) + colour("#b9ab94") * (1.0 + 0.05 * ground.noise(12, 5.0, 1.2))[..., None], scratch
    )
    shade = ground.blurred(ground.shifted(coat, 1.4, 1.8), 1.0) * (1.0 - coat)
    below = below * (1.0 - 0.55 * shade)[..., None]
    plaster = ramp(0.55 + 0.12 * ground.noise(13, 40.0, 2.0, 1.0), (0.0, "#cfc3a9"), (1.0, "#f3ead6"))
    rgb = mixed(below, plaster, coat) * (0.42 + 0.58 * bright)[..., None]
    return rgb, smooth(0.0, 5.0, ground.depth + 1.2 * ground.noise(14, 9.0, 1.5, 0.9))


def lava(ground: Ground) -> tuple[np.ndarray, np.ndarray]:
    """Plates of black crust with fire in the cracks; at the rim the flow is still hot."""
    wobble = np.stack([1.7 * ground.noise(1, 26.0, 4.0, 1.2), 1.7 * ground.noise(2, 26.0, 4.0, 1.2)])
    dots = ground.dots(3, 22.0, 0.55)
    which, _, border = ground.cells(dots, wobble)
    _, _, minor = ground.cells(ground.dots(4, 9.0, 0.3), wobble)
    tone = numbers(ground.seed + 5, len(dots))[which]
    gap = border - 0.7 + 0.35 * ground.noise(6, 9.0, 2.0)
    edge = ground.depth - 3.0 + 0.9 * ground.noise(7, 26.0, 5.0, 1.2)
    crust = smooth(0.0, 1.6, gap) * smooth(0.0, 2.6, edge - 8.5 + 2.6 * ground.noise(8, 24.0, 4.0, 1.1))
    height = 2.2 * smooth(0.0, 6.0, gap) + 0.35 * smooth(0.0, 1.6, minor) + 0.30 * ground.noise(9, 8.0, 1.2, 0.8)
    bright, gloss = ground.lit(height, 0.7, 18.0)
    stone = ramp(0.25 + 0.3 * tone + 0.1 * ground.noise(10, 5.0, 1.2, 0.7), (0.0, "#17120f"), (1.0, "#55483f"))
    stone = stone * (0.35 + 0.75 * bright)[..., None] + 0.16 * gloss[..., None]
    heat = 0.50 + 0.26 * np.exp(-np.clip(gap, 0.0, 99.0) / 1.2) - 0.28 * crust + 0.09 * ground.noise(11, 12.0, 2.0, 1.0)
    cooled = smooth(0.0, 7.0, edge)
    heat = heat * (0.30 + 0.70 * cooled) + 0.30 * np.exp(-(((edge - 6.0) / 2.6) ** 2))
    fire = ramp(
        heat,
        (0.0, "#1d0602"),
        (0.3, "#7d1304"),
        (0.5, "#d93a06"),
        (0.72, "#ff8a14"),
        (0.9, "#ffd75a"),
        (1.05, "#fff6c8"),
    )
    glow = ground.blurred((1.0 - crust) * smooth(0.0, 4.0, edge), 2.2) * 0.42
    rgb = mixed(fire, stone + glow[..., None] * colour("#ff5a10"), crust)
    halo = smooth(-3.5, 3.0, edge) ** 2 * 0.5
    return over((np.zeros_like(rgb) + colour("#a51a04"), halo), (rgb, smooth(-0.6, 0.6, edge)))


EXAMPLES = {
    "mossy-gravel": lambda: (g := Ground(300, 41), *mossy_gravel(g)),
    "brick-in-plaster": lambda: (g := Ground(320, 42), *brick(g)),
    "lava": lambda: (g := Ground(300, 43), *lava(g)),
}
