"""Colours along the principal axes of an example's, where they are not correlated (Heeger & Bergen 1995, section 3.5).

Grey, RGB or RGBA alike: as many axes are kept as the colours really have, so a grey picture given as RGB has one and
a picture of one colour has none.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from engine.numeric.arithmetic import LIBRARY
from engine.numeric.array_functions import array_functions
from engine.numeric.kernel import kernel
from engine.numeric.symmetric import eigenvectors, pseudo_inverse

LEAST = 1e-5  # standard deviation, colours being 0..1, of an axis that is one
_BLOCK = 1 << 18  # pixels whose products are summed in float64 at a time


@dataclass(frozen=True, slots=True, eq=False)
class ColourAxes:
    """`axes` (C, R): each column one axis times the standard deviation along it, the longest first, pointing to the
    brighter side; `back` (R, C) undoes it; `mean`, `low`, `high` (C,): of the example's colours.  All float32.
    `arithmetic`: in which they were found, and are used."""

    mean: np.ndarray
    axes: np.ndarray
    back: np.ndarray
    low: np.ndarray
    high: np.ndarray
    arithmetic: int = LIBRARY

    @property
    def count(self) -> int:
        """Counts the axes."""
        out: int = self.axes.shape[1]
        return out

    def planes(self, colours: np.ndarray) -> np.ndarray:
        """Colours (C, ...) along the axes: float32 (R, ...), of the example with mean 0 and covariance 1."""
        if self.arithmetic == LIBRARY:
            return combined(self.back, colours, -self.back.astype(np.float64) @ self.mean)
        parts = self.back.astype(np.float64) * self.mean
        return combined(self.back, colours, -sum((part for part in parts.T), np.zeros(self.count)))

    def colours(self, planes: np.ndarray) -> np.ndarray:
        """Returns the colours (C, ...) of planes (R, ...), kept within the example's range: float32."""
        out = self.unclipped(planes)
        for plane, low, high in zip(out, self.low, self.high, strict=True):
            np.clip(plane, low, high, out=plane)
        return out

    def unclipped(self, planes: np.ndarray) -> np.ndarray:
        """Gives the colours (C, h, w) of planes (R, h, w) along the axes, wherever they lie."""
        return combined(self.axes, planes, self.mean)


def axes_of(colours: np.ndarray, arithmetic: int = LIBRARY) -> ColourAxes:
    """Returns the axes of pictures (C, ...), float32 in 0..1."""
    flat = colours.reshape(colours.shape[0], -1)
    mean = array_functions(arithmetic).mean(flat, axis=1, dtype=np.float64)
    variances, vectors = (_principal if arithmetic == LIBRARY else _principal_everywhere)(flat, mean)
    spreads = np.sqrt(np.maximum(variances, 0.0))
    kept = spreads > LEAST
    spreads, vectors = spreads[kept], vectors[:, kept]
    vectors = vectors * np.where(_brightness(vectors) < 0.0, -1.0, 1.0)
    return ColourAxes(
        mean.astype(np.float32),
        (vectors * spreads).astype(np.float32),
        (vectors / spreads).T.astype(np.float32),
        flat.min(axis=1),
        flat.max(axis=1),
        arithmetic,
    )


def _principal(flat: np.ndarray, mean: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Returns the variances of colours (C, n) along their principal axes, the largest first, and these as columns."""
    covariance = np.zeros((len(flat), len(flat)))
    for start in range(0, flat.shape[1], _BLOCK):
        block = flat[:, start : start + _BLOCK].astype(np.float64) - mean[:, None]
        covariance += np.einsum("ip,jp->ij", block, block)
    variances, vectors = np.linalg.eigh(covariance / flat.shape[1])
    return variances[::-1], vectors[:, ::-1]


def _principal_everywhere(flat: np.ndarray, mean: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """As `_principal`, the same on every processor."""
    covariance = np.zeros((len(flat), len(flat)))
    _add_products(np.ascontiguousarray(flat, np.float32), mean, covariance)
    return eigenvectors(covariance / flat.shape[1])


def aligned(axes: ColourAxes, like: ColourAxes) -> ColourAxes:
    """Returns the same axes, those turned round that point away from the axes of the same rank of `like`.

    Both are axes of the same colours; a way from one to the other that turns none round keeps bright spots bright.
    """
    wide, deep = max(axes.mean.size, like.mean.size), max(axes.count, like.count)
    away = (_padded(axes, wide, deep)[1] * _padded(like, wide, deep)[1]).sum(axis=0)[: axes.count] < 0.0
    sides = np.where(away, -1.0, 1.0).astype(np.float32)
    return replace(axes, axes=axes.axes * sides, back=axes.back * sides[:, None])


def blended(a: ColourAxes, b: ColourAxes, weight: float) -> ColourAxes:
    """Axes between two: at `weight` 0 those of a, at 1 those of b.

    Where one has fewer axes, or fewer channels, the other's shrink to nothing on the way; grey becomes RGB, and what
    has no alpha is opaque.
    """
    wide, deep = max(a.mean.size, b.mean.size), max(a.count, b.count)
    first, second = _padded(a, wide, deep), _padded(b, wide, deep)
    mean, axes, low, high = (
        ((1.0 - weight) * x + weight * y).astype(np.float32) for x, y in zip(first, second, strict=True)
    )
    inverse = np.linalg.pinv if a.arithmetic == LIBRARY else pseudo_inverse
    return ColourAxes(mean, axes, inverse(axes).astype(np.float32), low, high, a.arithmetic)


def like(axes: ColourAxes, other: ColourAxes) -> ColourAxes:
    """Returns the same axes of colours with no fewer channels and axes than another's: `blended` at weight 0."""
    return blended(axes, other, 0.0)


def counted(axes: ColourAxes, count: int) -> ColourAxes:
    """Returns the longest `count` axes; what is missing has no length."""
    short = max(0, count - axes.count)
    columns = np.pad(axes.axes[:, :count], ((0, 0), (0, short)))
    return replace(axes, axes=columns, back=np.pad(axes.back[:count], ((0, short), (0, 0))))


def _padded(given: ColourAxes, wide: int, deep: int) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Returns mean, axes, low and high of colours of more channels: grey becomes RGB, what has no alpha is opaque."""
    mean, axes, low, high = given.mean, given.axes, given.low, given.high
    if mean.size == 1 < wide:
        mean, low, high = (np.repeat(values, 3) for values in (mean, low, high))
        axes = np.repeat(axes, 3, axis=0)
    if mean.size == 3 < wide:
        mean, low, high = (np.append(values, np.float32(1.0)) for values in (mean, low, high))
        axes = np.vstack([axes, np.zeros((1, axes.shape[1]), np.float32)])
    return mean, np.hstack([axes, np.zeros((wide, deep - axes.shape[1]), np.float32)]), low, high


def _brightness(vectors: np.ndarray) -> np.ndarray:
    """Tells which side of an axis is the brighter one; where neither is, the redder, the greener."""
    slightly = 1.0 + 1e-6 * np.arange(len(vectors), 0, -1)
    out: np.ndarray = (vectors * slightly[:, None]).sum(axis=0)
    return out


def combined(matrix: np.ndarray, planes: np.ndarray, offset: np.ndarray) -> np.ndarray:
    """matrix (m, n) times planes (n, ...) plus offset (m,): float32 (m, ...), in the same order on any machine."""
    out = np.empty((matrix.shape[0], *planes.shape[1:]), np.float32)
    count = math.prod(planes.shape[1:])
    flat = np.ascontiguousarray(planes, np.float32).reshape(len(planes), count)
    _combine(matrix.astype(np.float32), flat, offset.astype(np.float32), out.reshape(len(matrix), count))
    return out


@kernel
def _combine(matrix: np.ndarray, planes: np.ndarray, offset: np.ndarray, out: np.ndarray) -> None:
    for m in range(matrix.shape[0]):
        row = out[m]
        row[:] = offset[m]
        for n in range(matrix.shape[1]):
            line, factor = planes[n], matrix[m, n]
            for i in range(row.size):
                row[i] += factor * line[i]


@kernel
def _add_products(flat: np.ndarray, mean: np.ndarray, out: np.ndarray) -> None:
    """out (C, C) += the sums of the products of colours (C, n), less their mean (C,)."""
    count = flat.shape[0]
    apart = np.empty(count)
    for p in range(flat.shape[1]):
        for i in range(count):
            apart[i] = np.float64(flat[i, p]) - mean[i]
            for j in range(i + 1):
                out[i, j] += apart[i] * apart[j]
    for i in range(count):
        for j in range(i):
            out[j, i] = out[i, j]
