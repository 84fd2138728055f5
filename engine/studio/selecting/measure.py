"""How large a selection is, and how soft its rim: told from its pixels alone, however it came about."""

from __future__ import annotations

import numpy as np

from engine.brush.mask import Coverage
from engine.canvas.selecting.occupied import alpha_at
from engine.canvas.selecting.selection import Selection
from engine.checks.field_error import FieldError
from engine.numeric.address import TILE, Rect
from engine.studio.selecting.ants_records import Measure

_SHARP = 2.0  # px of feather that a rim may seem to have which was drawn without
_FEATHER = 2.0 / (2.0 * np.pi) ** 0.5  # px of feather, by the steepest step of its rim from pixel to pixel


def measured(selection: Selection) -> Measure | None:
    """Returns the size of a selection at its own level, or at level 0 where that is finer, and how soft its rim is
    at its own, below which any is; None where nothing is selected at least half, or it lies on too many tiles."""
    finest = selection.pyramid.finest
    if finest is None:
        return None
    level = max(0, finest)
    try:
        coverage = alpha_at(selection.pyramid, level, "select")
    except FieldError:
        return None
    bounds = chosen_bounds(coverage)
    own = coverage if level == finest else alpha_at(selection.pyramid, finest, "select")
    return None if bounds.empty else Measure(level, bounds, softness(own) << (level - finest))


def chosen_bounds(coverage: Coverage) -> Rect:
    """Returns the bounds of what is covered at least half, in pixels of the coverage's level; empty for none."""
    out = Rect(0, 0, 0, 0)
    for key, tile in coverage.tiles.items():
        inside = np.broadcast_to(np.greater_equal(tile, 0.5), (TILE, TILE))
        rows, columns = np.flatnonzero(inside.any(axis=1)), np.flatnonzero(inside.any(axis=0))
        if len(rows):
            x, y = key.rect.x0, key.rect.y0
            here = Rect(x + int(columns[0]), y + int(rows[0]), x + int(columns[-1]) + 1, y + int(rows[-1]) + 1)
            out = out.union(here)
    return out


def softness(coverage: Coverage) -> int:
    """Returns the feather, in whole pixels, that would make a straight rim as steep as the rim mostly is; 0 for one
    that is sharp."""
    steps = [_steps(tile) for tile in coverage.tiles.values() if isinstance(tile, np.ndarray)]
    found = np.concatenate(steps) if steps else np.empty(0)
    if not len(found):
        return 0
    feather = _FEATHER / float(np.median(found))
    return round(feather) if feather >= _SHARP else 0


def _steps(tile: np.ndarray) -> np.ndarray:
    """Returns how much the rim rises from pixel to pixel, across it, where it goes through a half."""
    across, down = np.diff(tile[:-1], axis=1), np.diff(tile[:, :-1], axis=0)
    through = ((tile[:-1, :-1] < 0.5) != (tile[:-1, 1:] < 0.5)) | ((tile[:-1, :-1] < 0.5) != (tile[1:, :-1] < 0.5))
    found: np.ndarray = np.hypot(across, down)[through]
    return found
