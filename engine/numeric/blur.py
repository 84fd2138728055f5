"""Blurs under a Gaussian window, summed in order: the same bits on every processor."""

from __future__ import annotations

import numpy as np

from engine.numeric.elementary import exp, mapped
from engine.numeric.kernel import kernel

_REACH = 4.0  # standard deviations, beyond which nothing is looked at


def blurred(mask: np.ndarray, sigma: float) -> np.ndarray:
    """Returns a mask, bool (h, w), as 0 and 1 under a Gaussian of a standard deviation in pixels: float64 (h, w).

    Outside, there is nothing.
    """
    return softened(mask, sigma)


def softened(values: np.ndarray, sigma: float) -> np.ndarray:
    """Returns any values, (h, w), under such a Gaussian, as `blurred`."""
    reach = int(_REACH * sigma + 0.5)
    weights = mapped(exp, np.square(np.arange(-reach, reach + 1) / sigma) * -0.5)
    half = np.ascontiguousarray(values.T, np.float64)
    for _ in range(2):
        out = np.zeros_like(half)
        _blur(half, weights / _total(weights), out)
        half = np.ascontiguousarray(out.T)
    return np.ascontiguousarray(half.T)


@kernel
def _total(weights: np.ndarray) -> float:
    total = 0.0
    for weight in weights:
        total += weight
    return total


@kernel
def _blur(values: np.ndarray, weights: np.ndarray, out: np.ndarray) -> None:
    """out (h, w) += values (h, w) under weights (2 r + 1,) down the columns."""
    reach = weights.size // 2
    for y in range(values.shape[0]):
        row = out[y]
        for k in range(max(0, y - reach), min(values.shape[0], y + reach + 1)):
            line, weight = values[k], weights[k - y + reach]
            for x in range(row.size):
                row[x] += line[x] * weight
