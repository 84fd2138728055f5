"""Colours of the ground: the picture draped over it, or, where that is the height itself, what would lie there by
height, slope and moisture.  Linear light, 0..1.  The look is one table."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from engine.canvas import layers
from engine.canvas.composite import composite
from engine.canvas.layers import Group
from engine.canvas.reading import layer_planes
from engine.numeric.address import Rect
from engine.painting.grown import settled_root
from engine.painting.rendering import folded_layers
from engine.terrain.plane import ALPHA, COMPOSITE, DEEP, Land

_OVERVIEW = 192  # pixels of the longer side of what is looked at to know how high the land is
_STRIP = 256  # rows whose colours are worked out at a time
_FARTHEST = 30  # rows away that have a part in a colour: the filters' reach, and a neighbour
_ROCK, _DARK_ROCK = (0.205, 0.175, 0.148), (0.115, 0.102, 0.095)
_GRASS, _DRY_GRASS = (0.052, 0.098, 0.030), (0.120, 0.125, 0.058)
_SAND, _SNOW = (0.32, 0.26, 0.17), (0.84, 0.87, 0.92)
_TREELINE, _SNOWLINE, _BEACH = 0.46, 0.64, 0.035  # parts of the way from the lowest to the highest


@dataclass(frozen=True)
class Cover:
    """What lies on the land: the picture of `root`, or what grows there if that is None or shows nothing; `low`,
    `high`: between which heights the land lies, in pixels of level 0."""

    root: Group | None
    low: float
    high: float

    def colours(self, level: int, rect: Rect, heights: np.ndarray, base: float = 0.0) -> np.ndarray:
        """Returns linear colours (h, w, 3) float32 of a rectangle.  `heights` (h, w), float32, in pixels of the level,
        above `base`, which is in pixels of level 0."""
        if self.root is None:
            return self._grown(level, heights, base)
        planes = composite(self.root, level, rect, layer_planes)
        alpha, out = planes[3], np.empty((*heights.shape, 3), np.float32)
        whole = bool((alpha >= 1.0).all())
        for rows in _strips(len(heights)):
            seen = np.moveaxis(linear(planes[:3, rows] / np.maximum(alpha[rows], 1e-6)), 0, 2)
            if not whole:
                bare = self._strip(level, heights, rows, base)
                seen = bare + alpha[rows, :, None] * (seen - bare)
            out[rows] = seen
        return out

    def _grown(self, level: int, heights: np.ndarray, base: float) -> np.ndarray:
        """Returns what grows there."""
        out = np.empty((*heights.shape, 3), np.float32)
        for rows in _strips(len(heights)):
            out[rows] = self._strip(level, heights, rows, base)
        return out

    def _strip(self, level: int, heights: np.ndarray, rows: slice, base: float) -> np.ndarray:
        """Returns what grows in some rows of a rectangle."""
        first = max(0, rows.start - _FARTHEST)
        part = self._bare(level, heights[first : rows.stop + _FARTHEST], base)
        return part[rows.start - first : rows.stop - first]

    def _bare(self, level: int, heights: np.ndarray, base: float) -> np.ndarray:
        from scipy.ndimage import gaussian_filter  # here: it takes its time to load

        h = heights.astype(np.float32)
        near, wide = gaussian_filter(h, 1.2, mode="nearest"), gaussian_filter(h, 7.0, mode="nearest")
        part = (np.ldexp(h.astype(np.float64), -level) + base - self.low) / max(self.high - self.low, 1e-9)
        part = np.clip(part, -0.5, 1.5).astype(np.float32)
        level_near, level_wide = _upright(near), _upright(wide)
        hollow = np.tanh(0.5 * (wide - h))  # 0 on what is even, 1 in a gully, -1 on a ridge
        return _materials(part, 0.35 * level_near + 0.65 * level_wide, level_near, hollow)


def _strips(rows: int) -> Iterator[slice]:
    """Yields the rows that are worked out at a time: what comes and goes meanwhile is ten times as much as they are."""
    return (slice(y, min(y + _STRIP, rows)) for y in range(0, rows, _STRIP))


def _upright(heights: np.ndarray) -> np.ndarray:
    """Returns the upward part of the normals: 1 where the ground is even."""
    if min(heights.shape) < 2:
        return np.ones_like(heights)
    down, across = np.gradient(heights)
    out: np.ndarray = 1.0 / np.sqrt(1.0 + down * down + across * across)
    return out


def _between(values: np.ndarray, low: float, high: float) -> np.ndarray:
    """Returns how far values are from low to high, 0..1, smoothly."""
    t = np.clip((values - low) / (high - low), 0.0, 1.0)
    out: np.ndarray = t * t * (3.0 - 2.0 * t)
    return out


def _mixed(under: np.ndarray, over: tuple[float, ...], part: np.ndarray) -> np.ndarray:
    out: np.ndarray = under + part[:, :, None] * (np.asarray(over, np.float32) - under)
    return out


def _materials(part: np.ndarray, upright: np.ndarray, near: np.ndarray, hollow: np.ndarray) -> np.ndarray:
    """Returns the colours by height (0..1 of the land's), slope and how hollow it is."""
    tone = np.clip(0.5 + 0.35 * np.sin(31.0 * part + 3.0 * hollow) - 0.3 * hollow + 0.5 * (near - upright), 0.0, 1.0)
    dark = np.asarray(_DARK_ROCK, np.float32)
    out = dark + tone[:, :, None] * (np.asarray(_ROCK, np.float32) - dark)
    moist = 0.10 * hollow
    grows = _between(_TREELINE + moist - part, 0.0, 0.22) * _between(upright + 0.5 * moist, 0.70, 0.88)
    dry = np.clip(0.10 + 1.5 * part - 0.9 * hollow, 0.0, 1.0)
    grass = np.asarray(_GRASS, np.float32) + dry[:, :, None] * (np.subtract(_DRY_GRASS, _GRASS).astype(np.float32))
    out = out + (0.92 * grows)[:, :, None] * (grass - out)
    out = _mixed(out, _SAND, _between(_BEACH - part, 0.0, 0.02) * _between(upright, 0.80, 0.94))
    lies = _between(part + 0.10 * hollow - _SNOWLINE, -0.05, 0.07) * _between(upright + 0.08 * hollow, 0.52, 0.74)
    return _mixed(out, _SNOW, lies).astype(np.float32)


def linear(encoded: np.ndarray) -> np.ndarray:
    """Returns linear light of sRGB-encoded values, in float32."""
    v = np.clip(encoded, 0.0, None).astype(np.float32)
    out: np.ndarray = np.where(v <= 0.04045, v / 12.92, ((v + 0.055) / 1.055) ** 2.4).astype(np.float32)
    return out


def cover_of(land: Land, wet: bool) -> Cover:
    """Returns what lies on a land: the picture without what the heights are of, if that is a layer.  `wet`: there is a
    sea, from which heights count."""
    frame, level = land.painting.frame, 0
    while max(frame.width, frame.height) > _OVERVIEW and level > -DEEP:
        frame, level = frame.zoomed(-1), level - 1
    heights = land.height(level, frame)
    low, high = (float(v) for v in np.percentile(heights, (0.5, 99.8)))
    return Cover(draped_root(land), 0.0 if wet else low, high)


def draped_root(land: Land) -> Group | None:
    """Returns the picture that lies on a land; None where nothing does."""
    root = None
    if land.source not in (COMPOSITE, ALPHA):
        rest = layers.remove(land.painting.root, land.source)
        shown = layers.pictured(replace(rest, paper=None) if rest.paper else rest)
        root = folded_layers(settled_root(shown)) if any(True for _ in layers.layers(shown)) else None
    return root
