"""A texture of another maker at whatever places a written one asks for it, as samples of whatever width see it.

The texture is bound to level 0, at which its period has so many pixels.  A sample is the mean over a square, of what
pixels of the last level hold that are no wider; where it is a pixel of a level, it is that pixel.  From afar a texture
is its own mean.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from engine.numeric.address import TILE, Rect
from engine.numeric.memo import remembered
from engine.numeric.pyramid import reduce
from engine.texture.expression.kept_squares import from_squares
from engine.texture.image import Image, ImageSource
from engine.texture.procedural import Sawtooth, Squares, Stripes
from engine.texture.record import Instance

UNIT_PIXELS, PICTURED_PIXELS = (
    16,
    64,
)  # pixels of a period at level 0; of a picture's width
_FINEST = 34  # a sample of 2^-34 periods is the finest one
_FARTHEST, _FARTHEST_TILED = -3, -7  # levels, beyond which there is the mean alone
_FAR = 2.0**24  # periods
_STEPS = 4096.0  # from a pixel to the next
_SHARES = 256.0  # of a pixel, by which samples are wider than it
_BLENDED = 1.75  # pixels of a level from which on a sample is seen by the next coarser one, too
_PIECE = 16  # pixels along the side of what is drawn of a square in which few pixels are asked for
_WASTE, _FEW = 24, 1 << 10  # pixels that are drawn for one that is asked for, where they are not few
_WHOLE = 1 << 16


@dataclass(frozen=True, slots=True)
class Elsewhere:
    """`made`: bound to level 0; `unit`: pixels that its period has there."""

    made: Instance
    unit: int = UNIT_PIXELS

    @property
    def channels(self) -> int:
        """Gives 4 where it has colours, red, green, blue times alpha, and alpha; else 1."""
        inner = innermost(self.made)
        plain = isinstance(inner, Image) or getattr(self.made, "coloured", getattr(inner, "shows_colours", False))
        return 4 if plain or getattr(self.made, "cover", None) is not None else 1

    @property
    def is_mean(self) -> bool:
        """Tells whether each level is the mean of the next finer one."""
        return isinstance(self.made, Image | Stripes | Sawtooth | Squares)

    @property
    def tiled(self) -> int:
        """Gives its height in pixels of level 0 where it is a picture that is tiled, else 0."""
        made = innermost(self.made)
        source: ImageSource | None = getattr(made, "shown", None) if hasattr(made, "native") else None
        source = source if isinstance(source, ImageSource) else getattr(made, "source", None)
        if source is None or not source.there or hasattr(made, "density"):
            return 0
        return max(1, round(self.unit * source.height / source.width))

    def seen(self, u: np.ndarray, v: np.ndarray, width: np.ndarray) -> np.ndarray:
        """Returns what samples at places, in periods, of some widths show: float64 (channels, n)."""
        u, v = (np.clip(np.nan_to_num(place, nan=0.0), -_FAR, _FAR) for place in (u, v))
        wide = np.where(width == width, width, _FAR) * self.unit  # pixels of level 0
        part, coarser = np.frexp(np.clip(wide, 2.0**-_FINEST * self.unit, _FAR))
        pixels, level = np.rint(2.0 * part * _SHARES) / _SHARES, 1 - coarser
        share = np.maximum((pixels - _BLENDED) / (2.0 - _BLENDED), 0.0)
        out = np.zeros((self.channels, u.size))
        for at in np.unique(level).tolist():
            for above, weights in ((0, 1.0 - share), (1, share)):
                some = np.flatnonzero((level == at) & (weights > 0.0))
                if some.size:
                    box = pixels[some] / (1 + above)
                    out[:, some] += weights[some] * self._within(int(at) - above, u[some], v[some], box)
        return out

    def _within(self, level: int, u: np.ndarray, v: np.ndarray, box: np.ndarray) -> np.ndarray:
        """Returns the means over squares at places of a level, so many pixels wide, fewer than two or two: float64
        (channels, n)."""
        if level < (_FARTHEST_TILED if self.tiled else _FARTHEST):
            return np.repeat(_mean(self)[:, None], u.size, axis=1)
        (x, across), (y, down) = (_overlaps(place * np.ldexp(float(self.unit), level), box) for place in (u, v))
        if level < 0 and self.tiled:
            planes = _folded(self, level)
            _, high, wide = planes.shape
            at = [
                ((y + k) % high * wide)[None] + [(x + n) % wide for n in range(len(across))] for k in range(len(down))
            ]
            return _summed(planes.reshape(self.channels, -1), at, across, down)
        flat, first, row = self._gathered(level, x, y, (len(across), len(down)))
        at = [(first + k * row)[None] + np.arange(len(across))[:, None] for k in range(len(down))]
        return _summed(flat, at, across, down)

    def _gathered(
        self, level: int, x: np.ndarray, y: np.ndarray, size: tuple[int, int]
    ) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Returns pixels of a level, float32 (channels, m), and where among them those from each place on are, so many
        across and down: the first of them, and how many a row has."""
        parts, first, row, count = list[np.ndarray](), np.empty(x.size, np.int64), np.empty(x.size, np.int64), 0
        for rect, which in _pieces(x, y, size):
            parts.append(from_squares(_drawn, (self, level), self.channels, rect).reshape(self.channels, -1))
            first[which] = count + (y[which] - rect.y0) * rect.width + (x[which] - rect.x0)
            row[which] = rect.width
            count += rect.area
        return (parts[0] if len(parts) == 1 else np.concatenate(parts, axis=1)), first, row


def unit_of(made: Instance) -> int:
    """Returns the pixels of level 0 that the period of a texture has, bound to that."""
    return PICTURED_PIXELS if isinstance(getattr(innermost(made), "source", None), ImageSource) else UNIT_PIXELS


def innermost(made: Instance) -> Instance:
    """Returns the texture that others are made of: one without curves."""
    while (inner := getattr(made, "inner", None)) is not None:
        made = inner
    return made


def _overlaps(place: np.ndarray, wide: np.ndarray) -> tuple[np.ndarray, list[np.ndarray]]:
    """Returns the first of the pixels that something about a place meets, int64, and how much of it each holds: of
    three at most."""
    first = place - 0.5 * wide
    whole = np.floor(first)
    start = np.rint((first - whole) * _STEPS) / _STEPS
    end = start + wide
    parts = [np.maximum(np.minimum(end, k + 1.0) - np.maximum(start, float(k)), 0.0) / wide for k in range(3)]
    while not parts[-1].any():
        parts.pop()
    return whole.astype(np.int64), parts


def _summed(flat: np.ndarray, at: list[np.ndarray], across: list[np.ndarray], down: list[np.ndarray]) -> np.ndarray:
    """Returns the weighed sums of pixels, (channels, m), those of each row `at` some places: float64 (channels, n)."""
    out = np.zeros((len(flat), across[0].size))
    for places, rows in zip(at, down, strict=True):
        for place, columns in zip(places, across, strict=True):
            out += (rows * columns) * flat[:, place]
    return out


def _pieces(x: np.ndarray, y: np.ndarray, size: tuple[int, int]) -> Iterator[tuple[Rect, np.ndarray]]:
    """Yields rectangles in which so many pixels from some places on lie, and for which places that is."""
    for rect, which in _grouped(x, y, TILE, size):
        if rect.area <= max(_FEW, _WASTE * which.size):
            yield rect, which
            continue
        for piece, some in _grouped(x[which], y[which], _PIECE, size):
            yield piece, which[some]


def _grouped(x: np.ndarray, y: np.ndarray, side: int, size: tuple[int, int]) -> list[tuple[Rect, np.ndarray]]:
    """Returns what places of each square of some pixels ask for: the rectangle, and which places."""
    across, down = x // side, y // side
    order, first = np.arange(x.size), np.zeros(1, np.int64)
    if not ((across == across[0]).all() and (down == down[0]).all()):
        order = np.lexsort((across, down))
        changes = (np.diff(across[order]) != 0) | (np.diff(down[order]) != 0)
        first = np.concatenate([first, np.flatnonzero(changes) + 1])
    ends = [one.reduceat(place[order], first).tolist() for one in (np.minimum, np.maximum) for place in (x, y)]
    last = [*first[1:].tolist(), x.size]
    return [
        (Rect(left, top, right + size[0], bottom + size[1]), order[start:end])
        for left, top, right, bottom, start, end in zip(*ends, first.tolist(), last, strict=True)
    ]


@remembered
def _folded(one: Elsewhere, level: int) -> np.ndarray:
    """Returns all that there is of a level above 0 of something that is tiled: float32 (channels, h, w)."""
    return _drawn(one, level, Rect.at(0, 0, max(1, one.unit >> -level), one.tiled))


def _drawn(one: Elsewhere, level: int, rect: Rect) -> np.ndarray:
    """Returns a level of it over a rectangle: float32 (1 or 4, h, w) of 0..1."""
    if level < 0:
        return reduce(_drawn(one, level + 1, rect.zoomed(1)))
    seen, count = one.made.appearance(level, rect), one.channels
    if len(seen) == 4:
        return seen
    half = np.float32(0.5)
    seen = seen * half + half
    return seen if count == 1 else np.concatenate([np.broadcast_to(seen, (3, *seen.shape[1:])), np.ones_like(seen[:1])])


@lru_cache(256)
def _mean(one: Elsewhere) -> np.ndarray:
    """Returns the mean of all of it, or of much: float64 (channels,); of whole numbers, so that it is the same on all
    machines."""
    size = (one.unit, one.tiled) if one.tiled else (TILE, TILE)
    planes = _drawn(one, 0, Rect.at(0, 0, *size)).astype(np.float64)
    total = np.rint(planes * _WHOLE).astype(np.int64).reshape(len(planes), -1)
    found: np.ndarray = total.sum(axis=1) / (float(_WHOLE) * total.shape[1])
    return found
