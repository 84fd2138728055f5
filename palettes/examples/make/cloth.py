"""Cloth and thread: felt with a fuzzy rim, and filling stitches inside a satin-stitched border."""

from __future__ import annotations

import numpy as np
from ground import FINE, Ground, colour, mixed, numbers, over, ramp, smooth
from lines import Sheet, curves
from scipy import spatial
from skimage.measure import find_contours


def felt(ground: Ground) -> tuple[np.ndarray, np.ndarray]:
    """Matted wool, hair over hair; at the rim single hairs stick out."""
    count = 26000
    chance = numbers(ground.seed + 1, 5, count)
    place = chance[:2] * ground.size
    cell = np.clip((place * FINE).astype(int), 0, ground.x.shape[0] - 1)
    depth = ground.depth[cell[1], cell[0]]
    hairs = curves(ground.seed + 2, place.T, chance[2] * 2.0 * np.pi, 10.0, 3.4)
    body, fuzz = Sheet(ground.size), Sheet(ground.size)
    for k in np.flatnonzero(depth > 6.5):
        high = k / count
        base = ramp(
            np.asarray(0.2 + 0.42 * high + 0.38 * chance[3, k]), (0.0, "#54101c"), (0.5, "#a81f33"), (1.0, "#e2596a")
        )
        base = mixed(base, "#f3b9a8", 0.6) if chance[4, k] < 0.012 else base
        target = body if depth[k] > 10.0 else fuzz
        target.line(hairs[k], base, 0.62 if depth[k] > 10.0 else 0.34)
    rgb, cover = body.laid()
    rgb = np.where(cover[..., None] > 0.0, rgb, colour("#4a0d18"))
    matted = smooth(8.5, 12.0, ground.depth + 1.2 * ground.noise(3, 12.0, 2.5))
    height = 0.55 * ground.noise(4, 20.0, 3.0, 1.2) + 3.0 * smooth(6.0, 16.0, ground.depth)
    bright, _ = ground.lit(ground.blurred(height, 0.6), 0.6)
    rgb = rgb * (0.3 + 0.7 * bright)[..., None]
    hair_rgb, hair = fuzz.laid()
    alpha = np.maximum(matted, 0.0) * np.maximum(cover, smooth(10.0, 12.0, ground.depth))
    shade = ground.blurred(ground.shifted(matted, 1.2, 1.6), 1.6) * 0.34 * smooth(0.0, 4.0, ground.depth)
    below = np.zeros_like(rgb) + colour("#1f0709"), shade * (1.0 - alpha)
    return over(over(below, (np.where(hair[..., None] > 0, hair_rgb, colour("#a81f33")), 0.75 * hair)), (rgb, alpha))


def embroidery(ground: Ground) -> tuple[np.ndarray, np.ndarray]:
    """Rows of filling stitches; a border of satin stitches across the rim in a second thread."""
    wide, long = 2.5, 13.0
    y = ground.y + 0.3 * ground.noise(1, 40.0, 12.0)
    row = np.floor(y / wide).astype(int)
    shift = numbers(ground.seed + 2, 400)[row % 400] * 2.0 + (row % 3) * long / 3.0
    along = ground.x + shift + 0.3 * ground.noise(3, 30.0, 10.0)
    stitch = np.floor(along / long).astype(int)
    across = 2.0 * (y / wide - row) - 1.0
    end = np.abs(2.0 * (along / long - stitch) - 1.0)
    tone = numbers(ground.seed + 4, 97, 97)[row % 97, stitch % 97]
    height = 1.0 * np.sqrt(np.clip(1.0 - across**2, 0.0, 1.0)) * (1.0 - 0.75 * smooth(0.8, 1.0, end))
    twist = np.sin((along * 2.1 + y * 2.6) * 1.25)
    bright, gloss = ground.lit(ground.blurred(height, 0.3), 0.8, 9.0)
    fill = ramp(0.35 + 0.3 * tone + 0.10 * twist, (0.0, "#0c2f4f"), (0.5, "#1f5f8c"), (1.0, "#5fa3c4"))
    fill = fill * (0.30 + 0.70 * bright)[..., None] + 0.16 * (gloss * height)[..., None]
    border, cover, shade = _border(ground)
    rgb = mixed(fill * (1.0 - 0.55 * shade * (1.0 - cover))[..., None], border, cover)
    there = np.maximum(cover, smooth(6.0, 7.0, ground.depth))
    dark = ground.blurred(ground.shifted(there, 1.0, 1.4), 1.1) * (1.0 - there) * 0.42
    return over((np.zeros_like(rgb) + colour("#14100a"), dark), (rgb, there))


def _border(ground: Ground) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Satin stitches: colours, cover and the shade they throw inwards."""
    line = max(find_contours(ground.depth, 8.0), key=len)
    gone = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(line, axis=0).T))]) / FINE
    _, near = spatial.cKDTree(line).query(np.argwhere(np.ones_like(ground.depth, bool)))
    count = round(gone[-1] / 2.3)
    place = gone[near].reshape(ground.depth.shape) * count / gone[-1] + 0.16 * (ground.depth - 8.0)
    thread = np.floor(place).astype(int) % count
    chance = numbers(ground.seed + 9, 3, count)
    outer, inner = 2.4 + 1.2 * chance[0][thread], 12.6 + 1.8 * chance[1][thread]
    across = 2.0 * (place - np.floor(place)) - 1.0
    half = 2.0 * (ground.depth - outer) / (inner - outer) - 1.0
    cover = smooth(-0.45, 0.45, ground.depth - outer) * smooth(-0.45, 0.45, inner - ground.depth)
    height = 1.1 * np.sqrt(np.clip(1.0 - across**2, 0.0, 1.0)) + 2.2 * np.sqrt(np.clip(1.0 - half**2, 0.0, 1.0))
    bright, gloss = ground.lit(ground.blurred(height * cover, 0.3), 0.75, 10.0)
    twist = np.sin(place * 6.0 + ground.depth * 2.2)
    rgb = ramp(0.4 + 0.25 * chance[2][thread] + 0.07 * twist, (0.0, "#8a5412"), (0.5, "#d79a2b"), (1.0, "#f7d67c"))
    rgb = rgb * (0.32 + 0.68 * bright)[..., None] + 0.22 * gloss[..., None]
    return rgb, cover, ground.blurred(ground.shifted(cover, 1.2, 1.6), 1.0)


EXAMPLES = {
    "felt": lambda: (g := Ground(300, 71), *felt(g)),
    "embroidery": lambda: (g := Ground(300, 72), *embroidery(g)),
}
