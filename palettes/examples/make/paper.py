"""Torn paper: a printed or dyed face that ends raggedly, the white felt of fibres beneath it, and a slight shadow."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from ground import FINE, Ground, colour, mixed, numbers, over, smooth
from lines import Sheet, curves
from PIL import Image, ImageDraw


@dataclass(frozen=True)
class Stock:
    """`face` and `core` colours; `felt`: how wide the bare core gets; `hair`: fibres per pixel of the rim's area;
    `thin`: how much shines through; `shade`: of the shadow beside it, for which it lies `drop` pixels further in."""

    face: str
    core: str
    felt: float
    grain: float = 0.03
    hair: float = 0.05
    thin: float = 0.0
    shade: float = 0.36
    drop: float = 6.0


def torn(ground: Ground, stock: Stock, print_: np.ndarray | None = None) -> tuple[np.ndarray, np.ndarray]:
    """A torn sheet; `print_`: how much of black ink lies where (0..1)."""
    ragged = 1.1 * ground.noise(1, 60.0, 10.0, 1.3) + 0.6 * ground.noise(2, 9.0, 1.6, 0.9)
    sheet = ground.depth - stock.drop + ragged
    wide = stock.felt * np.clip(0.62 + 0.42 * ground.noise(3, 70.0, 14.0, 1.2), 0.16, 1.6)
    face = sheet - wide + 0.75 * ground.noise(4, 10.0, 1.5, 0.8)
    there = smooth(-0.4, 0.4, sheet)
    topped = smooth(-0.35, 0.35, face)
    felt = ground.noise(5, 7.0, 1.0, 0.8)
    thick = 1.9 * smooth(-0.5, wide.max() * 0.6, sheet) + 0.28 * felt * (1.0 - topped) + 0.55 * topped
    thick += 0.10 * ground.noise(6, 5.0, 1.2, 0.7)
    bright, _ = ground.lit(ground.blurred(thick, 0.35), 0.8)
    flecks = 1.0 + stock.grain * ground.noise(7, 30.0, 1.2, 0.6)
    rgb = mixed(np.broadcast_to(colour(stock.core), (*felt.shape, 3)), stock.face, topped)
    if print_ is not None:
        rgb = mixed(rgb, "#2b2a2c", print_ * topped * 0.86)
    rgb = rgb * (0.45 + 0.55 * bright[..., None]) * flecks[..., None]
    clear = 1.0 - stock.thin * (0.75 + 0.25 * np.tanh(ground.noise(8, 16.0, 1.5, 0.9)))
    clear = (
        np.where(topped > 0.5, clear, np.clip(clear * (0.55 + 0.35 * sheet / 3.0), 0.0, clear)) if stock.thin else 1.0
    )
    hairs = _hairs(ground, stock, sheet)
    shade = ground.blurred(ground.shifted(there, 1.6, 2.0), 1.5)
    below = np.zeros_like(rgb) + colour("#1a1712"), stock.shade * (1.0 - 0.6 * stock.thin) * shade * (1.0 - there)
    return over(over(below, hairs), (rgb, there * clear))


def _hairs(ground: Ground, stock: Stock, sheet: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Single fibres that stick out of the felt."""
    rim = np.argwhere((sheet > -0.2) & (sheet < 1.5))[:, ::-1]
    count = int(len(rim) / FINE**2 * stock.hair * 20.0)
    pick = (numbers(ground.seed + 31, count) * len(rim)).astype(int)
    starts = rim[pick] / FINE
    drawn = Sheet(ground.size)
    angles = numbers(ground.seed + 32, count) * 2.0 * np.pi
    white = colour(stock.core)
    for points, shade in zip(
        curves(ground.seed + 33, starts, angles, 4.2, 2.2), numbers(ground.seed + 34, count), strict=True
    ):
        drawn.line(points, white * (0.9 + 0.12 * shade), 0.34)
    rgb, cover = drawn.laid()
    return rgb, cover * 0.8


def columns(ground: Ground) -> np.ndarray:
    """Lines of small print that say nothing: words of uneven length, letters of two or three strokes."""
    n = ground.size * FINE
    page = Image.new("L", (n, n), 0)
    pen = ImageDraw.Draw(page)
    dice = iter(numbers(ground.seed + 50, 60000).tolist())
    for line in np.arange(2.0, ground.size, 9.0):
        x = -6.0 * next(dice)
        while x < ground.size:
            for _ in range(2 + int(7 * next(dice))):
                x += _letter(pen, x, line, dice)
            x += 3.2
    return np.asarray(page) / 255.0


def _letter(pen: ImageDraw.ImageDraw, x: float, line: float, dice) -> float:
    """One letter on a line whose small letters are 4 pixels high; returns how far the next one is."""
    kind, wide = next(dice), 2.3 + 0.9 * next(dice)
    high = line - 1.8 if kind < 0.25 else line
    foot = line + 5.8 if kind > 0.88 else line + 4.0
    box = [x * FINE, line * FINE, (x + wide) * FINE, (line + 4.0) * FINE]
    stem = [x * FINE, high * FINE, x * FINE, foot * FINE]
    if next(dice) < 0.65:
        pen.ellipse(box, outline=255, width=2)
    else:
        pen.arc(box, 180, 360, fill=255, width=2)
        pen.line([box[2], (line + 2.0) * FINE, box[2], box[3]], 255, 2)
    if next(dice) < 0.75:
        pen.line(stem, 255, 3)
    return wide + 1.5


RAG = Stock("#efe9dc", "#fffdf8", 7.0, 0.018, 0.06)
SUGAR = Stock("#5f86a3", "#f4f1ea", 6.5, 0.045, 0.05)
KRAFT = Stock("#b98d5c", "#ead3ae", 8.0, 0.05, 0.06)
NEWS = Stock("#dcd6c6", "#f4f0e6", 6.0, 0.035, 0.05)
TISSUE = Stock("#d8485f", "#f0a3ab", 5.0, 0.05, 0.08, 0.42)


def _cut(face: str, core: str, felt: float, grain: float, thin: float = 0.0) -> Stock:
    """Paper for collages: evenly torn and without a shadow, for a painter lays that below it."""
    return Stock(face, core, felt, grain, 0.05, thin, 0.0, 1.4)


HEADLINES = _cut("#dcd6c6", "#f6f2e8", 5.0, 0.03)
DYED = {
    "torn-cream-paper": _cut("#efe6d2", "#fffdf6", 6.0, 0.02),
    "torn-night-paper": _cut("#26375a", "#ece9e2", 5.5, 0.05),
    "torn-sea-paper": _cut("#5f86a3", "#f4f1ea", 5.5, 0.045),
    "torn-pine-paper": _cut("#3f5a57", "#e9ebe2", 5.5, 0.05),
    "torn-black-paper": _cut("#2b292d", "#e6e1d8", 5.0, 0.06),
    "torn-ochre-paper": _cut("#dca640", "#f8ecd0", 5.5, 0.04),
    "torn-red-paper": _cut("#bf4f3a", "#f6e3d8", 5.5, 0.045),
    "torn-brown-paper": _cut("#b58a5a", "#ecd8b6", 6.0, 0.05),
    "torn-blue-tissue": _cut("#6fa6c2", "#eef6f8", 8.0, 0.05, 0.45),
    "torn-rose-tissue": _cut("#d8555a", "#f8cfc8", 8.0, 0.05, 0.42),
}

EXAMPLES = {
    "torn-rag-paper": lambda: (g := Ground(300, 21), *torn(g, RAG)),
    "torn-sugar-paper": lambda: (g := Ground(300, 22), *torn(g, SUGAR)),
    "torn-kraft-paper": lambda: (g := Ground(300, 23), *torn(g, KRAFT)),
    "torn-newsprint": lambda: (g := Ground(320, 24), *torn(g, NEWS, columns(g))),
    "torn-tissue": lambda: (g := Ground(300, 25), *torn(g, TISSUE)),
    "torn-headlines": lambda: (g := Ground(320, 60, bites=0.35), *torn(g, HEADLINES, columns(g))),
    **{
        name: lambda k=k, stock=stock: (g := Ground(300, 61 + k, bites=0.35), *torn(g, stock))
        for k, (name, stock) in enumerate(DYED.items())
    },
}
