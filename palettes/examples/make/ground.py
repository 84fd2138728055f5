"""What every example starts from: a piece of canvas, a smooth blob on it, chance by (seed, place), and colour.

Lengths are in pixels of the finished picture; arrays are `FINE` times as fine; `Ground.finished` averages them.
"""

from __future__ import annotations

import sys
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from scipy import fft, ndimage, spatial

sys.path.insert(0, str(Path(__file__).resolve().parents[3]))

from engine.numeric.hashing import hash_plane

FINE = 3
BITES = 5


def numbers(seed: int, *shape: int) -> np.ndarray:
    """Uniform numbers in 0..1, the same on every machine: float64 `shape`."""
    count = int(np.prod(shape))
    return ((hash_plane(seed, 0, 0, count, 1)[0] >> np.uint64(11)) / 2.0**53).reshape(shape)


def smooth(low: float, high: float, value: np.ndarray) -> np.ndarray:
    """0 below `low`, 1 above `high`, an S between."""
    t = np.clip((value - low) / (high - low), 0.0, 1.0)
    return t * t * (3.0 - 2.0 * t)


def colour(text: str) -> np.ndarray:
    """ "#rrggbb" as float64 (3,) in 0..1."""
    return np.array([int(text[i : i + 2], 16) / 255.0 for i in (1, 3, 5)])


def ramp(value: np.ndarray, *stops: tuple[float, str]) -> np.ndarray:
    """Colours (..., 3) where `value` lies between stops (place, "#rrggbb")."""
    places = [place for place, _ in stops]
    colours = np.array([colour(text) for _, text in stops])
    return np.stack([np.interp(value, places, colours[:, c]) for c in range(3)], axis=-1)


def mixed(a: np.ndarray, b: np.ndarray | str, part: np.ndarray | float) -> np.ndarray:
    """From colours `a` to colours `b` by `part` (0..1, without the channel axis)."""
    b = colour(b) if isinstance(b, str) else b
    part = np.asarray(part)[..., None]
    return a * (1.0 - part) + b * part


def stain(density: np.ndarray, absorbed: tuple[float, float, float]) -> tuple[np.ndarray, np.ndarray]:
    """A transparent stain as straight colour and alpha: over white paper it lets exp(-density absorbed) through.

    The least alpha that can do so: the darkest channel of the colour is 0 there, and other paint shows through.
    """
    through = np.exp(-density[..., None] * np.array(absorbed))
    alpha = 1.0 - through.min(axis=-1)
    rgb = 1.0 - (1.0 - through) / np.maximum(alpha, 1e-6)[..., None]
    return np.clip(rgb, 0.0, 1.0), alpha


def over(below: tuple[np.ndarray, np.ndarray], above: tuple[np.ndarray, np.ndarray]) -> tuple[np.ndarray, np.ndarray]:
    """One straight (colour, alpha) laid over another."""
    (low, low_alpha), (high, high_alpha) = below, above
    alpha = high_alpha + low_alpha * (1.0 - high_alpha)
    part = high_alpha / np.maximum(alpha, 1e-6)
    return mixed(low, high, part), alpha


def nearest(x: np.ndarray, y: np.ndarray, dots: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Nearest of `dots` (k, 2) to each place: its index, the distance, how much further the second nearest is."""
    far, which = spatial.cKDTree(dots).query(np.stack([x.ravel(), y.ravel()], axis=-1), k=2)
    return which[:, 0].reshape(x.shape), far[:, 0].reshape(x.shape), (far[:, 1] - far[:, 0]).reshape(x.shape)


@dataclass
class Ground:
    """A square of `size` pixels with a lobed blob on it; `bites`: how deep its hollows are, as a part of the usual.

    `x`, `y`: places; `depth`: how far inside the blob's outline (negative outside); all (n, n) in pixels.
    """

    size: int
    seed: int
    margin: float = 3.0
    bites: float = 1.0
    x: np.ndarray = field(init=False)
    y: np.ndarray = field(init=False)
    depth: np.ndarray = field(init=False)

    def __post_init__(self) -> None:
        n = self.size * FINE
        line = (np.arange(n) + 0.5) / FINE
        self.x, self.y = np.meshgrid(line, line)
        inside = self._blob()
        near = ndimage.distance_transform_edt(inside)
        self.depth = np.where(inside, near - 0.5, 0.5 - ndimage.distance_transform_edt(~inside)) / FINE

    def _blob(self) -> np.ndarray:
        """Convex and hollow in every direction: where strokes meet, hollows are as narrow as these bites."""
        chance = numbers(self.seed, 16)
        middle = self.size / 2.0
        angle = np.arctan2(self.y - middle, self.x - middle)
        wave = 0.05 * np.cos(3.0 * angle + 2.0 * np.pi * chance[0])
        for k in range(BITES):
            aside = angle - 2.0 * np.pi * (k + chance[1] + 0.3 * (chance[2 + k] - 0.5)) / BITES
            aside = np.abs((aside + np.pi) % (2.0 * np.pi) - np.pi)
            wide = 0.19 + 0.08 * chance[8 + k]
            wave -= self.bites * (0.16 + 0.10 * chance[9 + k]) * np.exp(-((aside / wide) ** 2))
        # The blob is stretched a little into the corners of the square.
        square = 1.0 + 0.07 * (1.0 - np.cos(4.0 * angle)) / 2.0
        radius = square * (1.0 + wave)
        far = np.hypot(self.x - middle, self.y - middle)
        return far < radius * (middle - self.margin) / self._reach(radius, angle)

    @staticmethod
    def _reach(radius: np.ndarray, angle: np.ndarray) -> float:
        """How far the outline goes along an axis, so that it just fits."""
        return float((radius * np.maximum(np.abs(np.cos(angle)), np.abs(np.sin(angle)))).max())

    def noise(self, seed: int, longest: float, shortest: float = 1.0, slope: float = 1.0) -> np.ndarray:
        """Noise of mean 0 and deviation 1 with waves of `shortest` to `longest` pixels, amplitude ~ length^slope."""
        n = self.size * FINE
        white = numbers(self.seed * 1009 + seed, n, n) - 0.5
        spectrum = fft.rfft2(white)
        across, down = fft.rfftfreq(n) * FINE, fft.fftfreq(n) * FINE
        waves = np.hypot(across[None, :], down[:, None])
        waves[0, 0] = 1.0
        band = smooth(0.5, 1.0, waves * longest) * (1.0 - smooth(0.9, 1.6, waves * shortest))
        spectrum *= band * waves ** -(slope + 0.5)
        spectrum[0, 0] = 0.0
        made = fft.irfft2(spectrum, (n, n))
        return made / made.std()

    def streaks(self, seed: int, long: float, wide: float, angle: float = 0.0) -> np.ndarray:
        """Noise drawn out along a direction (radians from x): deviation 1."""
        n = self.size * FINE
        spectrum = fft.rfft2(numbers(self.seed * 1013 + seed, n, n) - 0.5)
        across, down = fft.rfftfreq(n)[None, :] * FINE, fft.fftfreq(n)[:, None] * FINE
        along = across * np.cos(angle) + down * np.sin(angle)
        aside = down * np.cos(angle) - across * np.sin(angle)
        made = fft.irfft2(spectrum * np.exp(-((along * long) ** 2 + (aside * wide) ** 2) * 2.0), (n, n))
        made -= made.mean()
        return made / made.std()

    def dots(self, seed: int, spacing: float, order: float = 0.75) -> np.ndarray:
        """Places (k, 2) as x, y about `spacing` apart all over the square and a little beyond; `order` 1 is a grid."""
        count = int(self.size / spacing) + 4
        rows = spacing * 0.9
        j, i = np.mgrid[0 : int(self.size / rows) + 5, 0:count]
        free = (numbers(self.seed * 1019 + seed, 2, *i.shape) - 0.5) * 2.0 * (1.0 - order)
        x = (i - 1.5 + 0.5 * (j % 2) + free[0]) * spacing
        y = (j - 1.5) * rows + free[1] * spacing
        return np.stack([x.ravel(), y.ravel()], axis=-1)

    def cells(self, dots: np.ndarray, wobble: np.ndarray | None = None) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Nearest dot: its index, the distance to it, and how much further the second nearest is (0 on the border)."""
        x, y = (self.x, self.y) if wobble is None else (self.x + wobble[0], self.y + wobble[1])
        return nearest(x, y, dots)

    def blurred(self, values: np.ndarray, radius: float) -> np.ndarray:
        """Gaussian blur of that deviation."""
        return ndimage.gaussian_filter(values, radius * FINE, mode="nearest", truncate=3.0)

    def shifted(self, values: np.ndarray, x: float, y: float) -> np.ndarray:
        """Values moved right and down."""
        return ndimage.shift(values, (y * FINE, x * FINE), order=1, mode="nearest")

    def lit(self, height: np.ndarray, slant: float = 1.0, shine: float = 20.0) -> tuple[np.ndarray, np.ndarray]:
        """Light from the upper left on a relief in pixels: how bright (1 where level), and the gloss (0..1)."""
        down, across = np.gradient(height * slant * FINE)
        length = np.sqrt(across * across + down * down + 1.0)
        light = np.array([-0.45, -0.55, 0.704])
        bright = np.clip((-across * light[0] - down * light[1] + light[2]) / length, 0.0, None) / light[2]
        half = light + np.array([0.0, 0.0, 1.0])
        half /= np.linalg.norm(half)
        gloss = np.clip((-across * half[0] - down * half[1] + half[2]) / length, 0.0, 1.0) ** shine
        return bright, gloss

    def finished(self, rgb: np.ndarray, alpha: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """The picture, uint8 (size, size, 4) of straight alpha, and its region, bool (size, size)."""
        n = self.size
        region = self.depth.reshape(n, FINE, n, FINE).mean(axis=(1, 3)) > 0.0
        alpha = np.clip(alpha, 0.0, 1.0)[..., None]
        laid = np.concatenate([np.clip(rgb, 0.0, 1.0) * alpha, alpha], axis=-1)
        laid = laid.reshape(n, FINE, n, FINE, 4).mean(axis=(1, 3)) * region[..., None]
        laid[..., :3] /= np.maximum(laid[..., 3:], 1e-6)
        picture = np.round(np.clip(laid, 0.0, 1.0) * 255.0).astype(np.uint8)
        picture[picture[..., 3] == 0] = 0
        return picture, region
