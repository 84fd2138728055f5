"""Pen samples: the columns of their table, and what becomes of hostile ones."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from engine.brush.checks import BrushError

# x, y in pixels of the stroke's level from its origin; pressure 0..1; tilt_x, tilt_y in degrees; t in seconds;
# and, where a pen tells it, the rotation of its barrel in degrees.
COLUMNS, MOST_COLUMNS = 6, 7
_REACH = 2.0**31  # px from the stroke's origin
_DEFAULTS = (0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0)


def cleaned(points: np.ndarray | Sequence[Sequence[float]]) -> tuple[np.ndarray, int]:
    """Returns points (n, 2..7) made fit to paint with: float64 (m, 6..7), and how many were dropped.

    A point whose x, y or pressure is not a number, or whose x or y is infinite, is dropped; pressure is clamped to
    0..1; a tilt, time or rotation that is not finite becomes 0.  BrushError if a point is more than 2^31 px from the
    origin.
    """
    given = np.asarray(points, np.float64)
    if given.ndim != 2 or not 2 <= given.shape[1] <= MOST_COLUMNS:
        raise BrushError("points", f"an array of shape {given.shape}", "(n, 2 to 7)")
    columns = max(given.shape[1], COLUMNS)
    table = np.empty((len(given), columns))
    table[:, : given.shape[1]] = given
    table[:, given.shape[1] :] = _DEFAULTS[given.shape[1] : columns]
    whole = np.isfinite(table)
    if not whole.all():
        good = whole[:, 0] & whole[:, 1] & ~np.isnan(table[:, 2])
        table[:, 3:][~whole[:, 3:]] = 0.0
        table = table[good]
    if len(table) and np.abs(table[:, :2]).max() > _REACH:
        row, column = np.argwhere(np.abs(table[:, :2]) > _REACH)[0]
        raise BrushError(f"point {row}, {'xy'[column]}", f"{table[row, column]:g}", "at most 2^31 px from the origin")
    np.clip(table[:, 2], 0.0, 1.0, out=table[:, 2])
    return table, len(given) - len(table)
