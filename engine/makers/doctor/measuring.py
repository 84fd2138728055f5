"""What kind of texture a picture is: even grain, a pattern that repeats, one with a direction, or nothing that is the
same all over.

Pictures are float32 (C, h, w) in 0..1, grey, RGB or premultiplied RGBA; angles are in degrees counted from the x axis
towards the y axis, 0..180.
"""

from __future__ import annotations

import itertools
import math
from dataclasses import dataclass

import numpy as np

from engine.numeric.analysis import autocorrelation
from engine.numeric.arithmetic import EVERYWHERE
from engine.numeric.real_fourier import irfft2, rfft2
from engine.texture.matching import noise
from engine.texture.structure.statistics import bands_measured

_WEIGHTS = np.array([0.2126, 0.7152, 0.0722], np.float32)
_LOOKED_AT = 256  # pixels along the sides of what is looked at
_SCALES = 3  # whose bands are compared with the next one's
_CHANCE = 2.0  # over the shorter side: by how much small pictures seem to have a structure
_BLOCKS = 3  # parts along each side, whose means and deviations are compared
_AROUND = 3  # pixels around a top of the autocorrelation that are all lower
_PEAK = 0.36  # of the autocorrelation above the valley before it: what repeats
_TWICE = 0.12  # the same at twice the distance
_ALIKE = 0.85  # of the best one: tops that count
_NEAREST = 4  # pixels: a shorter period is grain
_DIRECTED = 0.4  # of the gradient's strength that lies along one direction
_UNEVEN = 0.12  # of the variance that lies in the means of blocks
_PATCHY = 0.3  # by which the deviations of blocks differ, in parts of their mean
_FLAT = 1e-4  # deviation of a picture of one colour


@dataclass(frozen=True, slots=True)
class Period:
    """How far apart copies lie in pixels, in which direction, and how like one another they are, 0..1."""

    length: float
    angle: float
    strength: float


@dataclass(frozen=True, slots=True)
class Grain:
    """What is measured of a picture.

    `flat`: it is of one colour; `structure`: how much coarse things tell of fine ones that chance would not, 0 for even
    grain, 0.3 for pebbles; `periods`: none, one or two; `angle`: along which things lie, None if along none;
    `directed`: how much, 0..1; `uneven`: the part of the variance that lies in the means of its blocks, 0..1;
    `patchy`: by how much the deviations of blocks differ, in parts of their mean.
    """

    flat: bool
    structure: float
    periods: tuple[Period, ...]
    angle: float | None
    directed: float
    uneven: float
    patchy: float

    @property
    def inhomogeneous(self) -> bool:
        """Tells whether one part of it is unlike another."""
        return self.uneven > _UNEVEN or self.patchy > _PATCHY


def grain_of(picture: np.ndarray) -> Grain:
    """Measures the middle of a picture."""
    grey = grey_of(picture)
    top, left = (max(0, (n - _LOOKED_AT) // 2) for n in grey.shape)
    grey = np.ascontiguousarray(grey[top : top + _LOOKED_AT, left : left + _LOOKED_AT])
    if float(grey.std()) < _FLAT:
        return Grain(True, 0.0, (), None, 0.0, 0.0, 0.0)
    directed, angle = _direction(grey)
    uneven, patchy = _evenness(grey)
    along = angle if directed > _DIRECTED else None
    return Grain(False, _structure(grey), _periods(grey), along, directed, uneven, patchy)


def grey_of(picture: np.ndarray) -> np.ndarray:
    """Returns how bright a picture is: float32 (h, w).  What is transparent takes the mean of the rest."""
    rgb = picture[:3] if len(picture) > 2 else np.repeat(picture[:1], 3, axis=0)
    out: np.ndarray = np.tensordot(_WEIGHTS, rgb, 1)
    if len(picture) == 4:
        covered = max(float(picture[3].mean(dtype=np.float64)), 1e-6)
        out = out + (1.0 - picture[3]) * np.float32(out.mean(dtype=np.float64) / covered)
    return np.ascontiguousarray(out, np.float32)


def _structure(grey: np.ndarray) -> float:
    """Tells how much more bands go together from scale to scale, in size and in phase, than they do in a picture with
    the same spectrum and the same values, and phases by chance."""
    values = ((grey - grey.mean(dtype=np.float64)) / grey.std(dtype=np.float64)).astype(np.float32)
    half, by_chance = rfft2(values[None]), rfft2(noise(1, values.shape, 1))
    turned = half * 0.0
    np.divide(np.abs(half) * by_chance, np.abs(by_chance), out=turned, where=np.abs(by_chance) > 1e-9)
    likewise = irfft2(turned.astype(np.complex64), values.shape)[0]
    likewise.flat[np.argsort(likewise, axis=None)] = np.sort(values, axis=None)
    chance = _CHANCE / float(min(values.shape))
    return max(0.0, _together(values) - _together(likewise) - chance)


def _together(values: np.ndarray) -> float:
    """Returns how far the bands of a picture (h, w) go together with those of the next coarser scale: the mean
    correlation of their sizes, and that of their phases."""
    found = bands_measured(values[None], _SCALES)
    sizes, phases = [0.0], [0.0]
    for fine, coarse in itertools.pairwise(found):
        own, others = (np.sqrt(np.maximum(np.diag(one.together), 1e-12)) for one in (fine, coarse))
        sizes.append(float((np.diag(fine.under) / (own * others)).mean()))
        own, others = (np.sqrt(np.maximum(np.diag(one.real), 1e-12)) for one in (fine, coarse))
        count = len(own)
        both = np.hypot(np.diag(fine.turned[:, :count]), np.diag(fine.turned[:, count:]))
        phases.append(float((both / (own * others * math.sqrt(2.0))).mean()))
    return (sum(sizes) + sum(phases)) / max(len(found) - 1, 1)


def _periods(grey: np.ndarray) -> tuple[Period, ...]:
    """Returns the nearest displacement at which a picture is like itself, and the nearest that lies across it."""
    found = autocorrelation(grey, EVERYWHERE)
    middle = grey.shape[0] // 2, grey.shape[1] // 2
    reach = min(grey.shape) // 3
    tops = sorted(_tops(found, middle, reach), key=lambda top: top[0])
    if not tops:
        return ()
    best = max(strength for *_, strength in tops)
    tops = [top for top in tops if top[3] > _ALIKE * best]
    first = _period(tops[0])
    others = (_period(top) for top in tops[1:])
    across = next((other for other in others if 25.0 < abs(other.angle - first.angle) % 180.0 < 155.0), None)
    return (first,) if across is None else (first, across)


def _period(top: tuple[float, int, int, float]) -> Period:
    length, dy, dx, strength = top
    return Period(length, math.degrees(math.atan2(dy, dx)) % 180.0, min(strength, 1.0))


def _tops(found: np.ndarray, middle: tuple[int, int], reach: int) -> list[tuple[float, int, int, float]]:
    """Returns displacements of one half plane at which the autocorrelation has a top that stands out, and does so again
    at twice the distance: (length, dy, dx, strength)."""
    (cy, cx), out = middle, []
    for dy in range(reach + 1):
        for dx in range(-reach if dy else _NEAREST, reach + 1):
            length = math.hypot(dy, dx)
            if not _NEAREST <= length <= reach:
                continue
            value = found[cy + dy, cx + dx]
            if value < _PEAK / 2 or value < _around(found, cy + dy, cx + dx, _AROUND):
                continue
            steps = np.arange(1, math.ceil(length)) / length
            between = found[cy + np.rint(steps * dy).astype(np.int64), cx + np.rint(steps * dx).astype(np.int64)]
            strength = float(value - between.min(initial=1.0))
            if strength > _PEAK and _again(found, middle, (dy, dx), float(between.min(initial=1.0))):
                out.append((length, dy, dx, strength))
    return out


def _again(found: np.ndarray, middle: tuple[int, int], step: tuple[int, int], valley: float) -> bool:
    y, x = middle[0] + 2 * step[0], middle[1] + 2 * step[1]
    if not (2 <= y < found.shape[0] - 2 and 2 <= x < found.shape[1] - 2):
        return True  # beyond the picture
    return _around(found, y, x, 2) - valley > _TWICE


def _around(found: np.ndarray, y: int, x: int, far: int) -> float:
    return float(found[max(y - far, 0) : y + far + 1, max(x - far, 0) : x + far + 1].max())


def _direction(grey: np.ndarray) -> tuple[float, float]:
    """Returns how much of the gradient lies along one direction, 0..1, and the angle across that: along which things
    lie (the structure tensor, Bigun & Granlund 1987)."""
    if min(grey.shape) < 3:
        return 0.0, 0.0
    gx = (grey[1:-1, 2:] - grey[1:-1, :-2]).astype(np.float64)
    gy = (grey[2:, 1:-1] - grey[:-2, 1:-1]).astype(np.float64)
    xx, yy, xy = float((gx * gx).sum()), float((gy * gy).sum()), float((gx * gy).sum())
    strength = math.hypot(xx - yy, 2.0 * xy) / max(xx + yy, 1e-12)
    return strength, (math.degrees(0.5 * math.atan2(2.0 * xy, xx - yy)) + 90.0) % 180.0


def _evenness(grey: np.ndarray) -> tuple[float, float]:
    """Returns the part of the variance that lies in the means of parts of a picture, and how much their deviations
    differ; less what chance does, which is as one over the size of the parts: four times as much in parts of half the
    length."""
    if min(grey.shape) < 4 * _BLOCKS:
        return 0.0, 0.0
    (means, spreads), (finer_means, finer_spreads) = _parted(grey, _BLOCKS), _parted(grey, 2 * _BLOCKS)
    return max(4.0 * means - finer_means, 0.0) / 3.0, math.sqrt(max(4.0 * spreads - finer_spreads, 0.0) / 3.0)


def _parted(grey: np.ndarray, count: int) -> tuple[float, float]:
    """Returns the variance of the means of so many parts along each side, in parts of the picture's, and that of their
    deviations, in parts of their mean squared."""
    height, width = (n // count for n in grey.shape)
    parts = grey[: count * height, : count * width].reshape(count, height, count, width)
    means = parts.mean(axis=(1, 3), dtype=np.float64)
    spreads = parts.std(axis=(1, 3), dtype=np.float64)
    whole, middle = float(grey.var(dtype=np.float64)), float(spreads.mean())
    return float(means.var()) / max(whole, 1e-12), float(spreads.var()) / max(middle * middle, 1e-12)
