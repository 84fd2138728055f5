"""The points of a stroke: a table of what the pen told, checked and written row by row."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from engine.checks.field_error import FieldError
from engine.checks.values import described

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
    ("rotation", 0.0, -1e9, 1e9),
)
ALWAYS = 6  # of these, which all points have; a rotation only those of a pen that tells it
DEFAULTS = np.array([column[1] for column in POINT_COLUMNS])
_TAILS = {n: tuple(DEFAULTS.tolist()[n:]) for n in range(2, 8)}
_NUMERIC = {int, float}
_DECIMALS = (3, 3, 4, 2, 2, 4, 2)
LOWEST = np.array([column[2] for column in POINT_COLUMNS])
HIGHEST = np.array([column[3] for column in POINT_COLUMNS])


def points_array(rows: Any, place: str) -> np.ndarray:
    """Returns a list of lists of 2 to 7 numbers as float64 (n, 6), or (n, 7) where any tells a rotation, read-only;
    what is left out has its default."""
    if not isinstance(rows, list) or not 1 <= len(rows) <= POINTS_CAP:
        found = f"{len(rows)} points" if isinstance(rows, list) else described(rows)
        raise FieldError(place, found, f"a list of 1 to {POINTS_CAP} points")
    for i, row in enumerate(rows):
        if type(row) is not list or not 2 <= len(row) <= 7 or not _NUMERIC.issuperset(map(type, row)):
            names = ", ".join(column[0] for column in POINT_COLUMNS)
            raise FieldError(f"{place}[{i}]", described(row), f"2 to 7 numbers [{names}]")
    try:
        columns = max(ALWAYS, *map(len, rows))
        table = np.array([(*row, *_TAILS[len(row)]) for row in rows], np.float64)
        return checked_points(np.ascontiguousarray(table[:, :columns]), place)
    except OverflowError:
        i = next(i for i, row in enumerate(rows) if any(abs(value) > 1e300 for value in row))
        raise FieldError(f"{place}[{i}]", described(rows[i]), "numbers near the origin") from None


def checked_points(table: np.ndarray, place: str) -> np.ndarray:
    """Returns the points themselves, read-only, if all are within their columns' bounds; else FieldError for the
    first."""
    columns = table.shape[1]
    good = (table >= LOWEST[:columns]) & (table <= HIGHEST[:columns])
    if not good.all():
        i, column = (int(v) for v in np.argwhere(~good)[0])
        name, _, lo, hi = POINT_COLUMNS[column]
        raise FieldError(f"{place}[{i}][{column}]", f"{table[i, column]:g}", f"{name} from {lo:g} to {hi:g}")
    table += 0.0  # no negative zeros
    table.flags.writeable = False
    return table


def rounded(points: np.ndarray) -> np.ndarray:
    """Returns what a pen told, rounded to far finer than it can tell, so that it is short as text."""
    out = np.array(points, np.float64)
    for column, decimals in enumerate(_DECIMALS[: out.shape[1]]):
        out[:, column] = np.round(out[:, column], decimals)
    return out


def points_json(points: np.ndarray) -> list[list[float]]:
    """Returns rows without their trailing defaults, whole numbers without a point; the first of those that tell
    rotations is whole."""
    columns = points.shape[1]
    kept = np.where(points != DEFAULTS[:columns], np.arange(1, columns + 1), 2).max(axis=1)
    if columns > ALWAYS:
        kept[0] = columns
    return [[plain(v) for v in row[:n]] for row, n in zip(points.tolist(), kept.tolist(), strict=True)]


def like_first(parts: Sequence[np.ndarray]) -> np.ndarray:
    """Returns points told in parts, float64 (n, 6..7) each, as one table with the columns of the first."""
    columns = parts[0].shape[1]
    return np.concatenate([_with_columns(part, columns) for part in parts])


def _with_columns(points: np.ndarray, columns: int) -> np.ndarray:
    if points.shape[1] == columns:
        return points
    out = np.zeros((len(points), columns))
    kept = min(columns, points.shape[1])
    out[:, :kept] = points[:, :kept]
    return out


def plain(value: float) -> float:
    """Gives a whole number as an int, so that JSON writes it without a point."""
    return int(value) if float(value).is_integer() and abs(value) < 1e15 else value
