"""The points of a stroke: a table of what the pen told, checked and written row by row."""

from __future__ import annotations

from typing import Any

import numpy as np

from engine.brush import samples
from engine.brush.checks import BrushError
from engine.painting.strictjson import FormatError

POINTS_CAP = 1_000_000  # of one stroke
REACH = float(1 << 24)  # pixels from a stroke's origin to its points

# Columns of a stroke's points: name, default, lowest and highest value.
POINT_COLUMNS = (
    ("x", 0.0, -REACH, REACH),
    ("y", 0.0, -REACH, REACH),
    ("pressure", 1.0, 0.0, 1.0),
    ("tilt_x", 0.0, -90.0, 90.0),
    ("tilt_y", 0.0, -90.0, 90.0),
    ("t", 0.0, -1e9, 1e9),
)
_DEFAULTS = np.array([column[1] for column in POINT_COLUMNS])
_LOWEST = np.array([column[2] for column in POINT_COLUMNS])
_HIGHEST = np.array([column[3] for column in POINT_COLUMNS])


def points_array(rows: Any, place: str) -> np.ndarray:
    """A list of lists of 2 to 6 numbers as float64 (n, 6), read-only; what is left out has its default."""
    if isinstance(rows, list) and len(rows) > POINTS_CAP:
        raise FormatError(place, f"{len(rows)} points", f"at most {POINTS_CAP}")
    try:
        return checked_points(samples.from_json(rows, place), place)
    except BrushError as error:
        raise FormatError(error.place, error.found, error.expected) from None


def checked_points(table: np.ndarray, place: str) -> np.ndarray:
    """The points themselves, read-only, if all are within their columns' bounds; else FormatError for the first."""
    good = (table >= _LOWEST) & (table <= _HIGHEST)
    if not good.all():
        i, column = (int(v) for v in np.argwhere(~good)[0])
        name, _, lo, hi = POINT_COLUMNS[column]
        raise FormatError(f"{place}[{i}][{column}]", f"{table[i, column]:g}", f"{name} from {lo:g} to {hi:g}")
    table += 0.0  # no negative zeros
    table.flags.writeable = False
    return table


def points_json(points: np.ndarray) -> list[list[float]]:
    """Rows without their trailing defaults, whole numbers without a point."""
    kept = np.where(points != _DEFAULTS, np.arange(1, 7), 2).max(axis=1)
    return [[plain(v) for v in row[:n]] for row, n in zip(points.tolist(), kept.tolist(), strict=True)]


def plain(value: float) -> float:
    return int(value) if value.is_integer() and abs(value) < 1e15 else value
