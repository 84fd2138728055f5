"""What a pen told as points of a stroke, by a kernel: each batch of a moving pen goes through it."""

from __future__ import annotations

import numpy as np

from engine.numeric.kernel import Array, kernel
from engine.numeric.stand_in import or_interpreted
from engine.painting.points import ALWAYS, DEFAULTS, HIGHEST, LOWEST, REACH


def fitted(given: np.ndarray) -> tuple[np.ndarray, int]:
    """Returns what a pen told, float64 (n, 2..7), as points (n, 6..7): within their columns' bounds, without those that
    are no points (not finite, or too far away), and how many these were."""
    table = np.empty((len(given), max(given.shape[1], ALWAYS)))
    told = np.ascontiguousarray(given).view()
    told.flags.writeable = False  # whatever is given: so the kernel is compiled once
    if _fill(told, DEFAULTS, LOWEST, HIGHEST, table):
        return table, 0
    table[:, 3:] = np.nan_to_num(table[:, 3:], nan=0.0, posinf=0.0, neginf=0.0)
    good = np.isfinite(table[:, :3]).all(axis=1) & (np.abs(table[:, :2]) <= REACH).all(axis=1)
    return np.clip(table[good], LOWEST[: table.shape[1]], HIGHEST[: table.shape[1]]), int((~good).sum())


@or_interpreted()
@kernel
def _fill(given: Array, defaults: Array, lowest: Array, highest: Array, out: Array) -> bool:
    """Writes points (n, 2..7) into `out` (n, 6..7), with defaults for what is left out and without negative zeros;
    returns whether all are within their columns' bounds."""
    good = True
    for i in range(out.shape[0]):
        for j in range(out.shape[1]):
            value = (given[i, j] if j < given.shape[1] else defaults[j]) + 0.0
            out[i, j] = value
            good = good and lowest[j] <= value and value <= highest[j]
    return good
