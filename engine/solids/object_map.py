"""A flat texture wrapped around an object: Lewis' object maps (1984, section 6.2).

What goes around the upright axis repeats a whole number of times, and so does what goes around the tube of a torus: a
texture that tiles has no seam there.  On a ball it ends in the two poles; elsewhere it goes up with the height.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from engine.numeric.pyramid import reduce

_RING = 0.66  # of a torus, from its middle to that of its tube, as `objects.torus` has it
_AROUND = 2.0 * np.pi
_COARSEST = 4  # pixels of a side: a smaller one is not halved
Ways = Callable[[np.ndarray], tuple[np.ndarray, np.ndarray, float, float]]


def _ball(at: np.ndarray) -> tuple[np.ndarray, np.ndarray, float, float]:
    """Returns how far places lie around and up, in parts of the whole, and how long these are."""
    far = np.sqrt((at * at).sum(axis=1))
    up = np.arccos(np.clip(-at[:, 2] / np.maximum(far, 1e-12), -1.0, 1.0)) / np.pi
    return _turn(at[:, 1], at[:, 0]), up, _AROUND, np.pi


def _ring(at: np.ndarray) -> tuple[np.ndarray, np.ndarray, float, float]:
    out = np.hypot(at[:, 0], at[:, 1]) - _RING
    return _turn(at[:, 1], at[:, 0]), _turn(at[:, 2], out), _AROUND * _RING, _AROUND * (1.0 - _RING)


def _column(at: np.ndarray) -> tuple[np.ndarray, np.ndarray, float, float]:
    return _turn(at[:, 1], at[:, 0]), 0.5 * (at[:, 2] + 1.0), 0.5 * _AROUND, 2.0


def _turn(y: np.ndarray, x: np.ndarray) -> np.ndarray:
    out: np.ndarray = np.arctan2(y, x) / _AROUND + 0.5
    return out


WRAPPED: dict[str, Ways] = {"sphere": _ball, "torus": _ring}


@dataclass(frozen=True, eq=False)
class ObjectMap:
    """A texture that tiles, float32 (h, w, 3), 0..1, on an object of a name, whose places are told as those of a solid
    of a `scale`; as often around it as comes nearest to a texture's width for each 1 / `often` of its length."""

    levels: tuple[np.ndarray, ...]
    name: str
    scale: float
    often: float
    gloss: float = 0.3

    @classmethod
    def of(cls, picture: np.ndarray, name: str, scale: float, often: float | None = None) -> ObjectMap:
        """Wraps a picture, float32 (3, h, w), or (1, h, w) of greys; `often` is the scale, if nothing is said."""
        levels = [np.broadcast_to(picture, (3, *picture.shape[1:]))]
        while min(levels[-1].shape[1:]) >= 2 * _COARSEST and not (levels[-1].shape[1] % 2 or levels[-1].shape[2] % 2):
            levels.append(reduce(levels[-1]))
        return cls(tuple(np.moveaxis(level, 0, 2) for level in levels), name, scale, scale if often is None else often)

    def colours(self, points: np.ndarray, finest: float) -> np.ndarray:
        """Returns the texture's colours at points (N, 3), as `Lookup.colours`."""
        across, up, wide, high = WRAPPED.get(self.name, _column)((points - 0.5) / self.scale)
        height, width = self.levels[0].shape[:2]
        around = max(1, round(wide * self.often))
        upwards = max(1, round(high * self.often * width / height))
        seen = finest * width * (self.often / self.scale)
        level = min(len(self.levels) - 1, max(0, int(np.log2(max(seen, 1.0)))))
        return _between(self.levels[level], across * around, (1.0 - up) * upwards)


def _between(texture: np.ndarray, across: np.ndarray, up: np.ndarray) -> np.ndarray:
    """Returns colours (N, 3) between the pixels of a texture, at places in its widths and heights."""
    height, width = texture.shape[:2]
    x, y = across * width - 0.5, up * height - 0.5
    i, j = np.floor(x).astype(np.int64), np.floor(y).astype(np.int64)
    u, v = (x - i)[:, None], (y - j)[:, None]
    a, b = texture[j % height, i % width], texture[j % height, (i + 1) % width]
    c, d = texture[(j + 1) % height, i % width], texture[(j + 1) % height, (i + 1) % width]
    top, low = a + u * (b - a), c + u * (d - c)
    out: np.ndarray = top + v * (low - top)
    return out
