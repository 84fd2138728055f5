"""The rim of what is selected, found while nothing more urgent waits, for the window to draw."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from engine.canvas.selecting.occupied import alpha_at
from engine.canvas.selecting.selection import NONE_SAVED, Saved, Selection
from engine.canvas.tile_cache import TileCache
from engine.checks.field_error import FieldError
from engine.checks.owned import Owned
from engine.numeric.address import TILE, Rect
from engine.studio.easel import Easel
from engine.studio.results import frozen
from engine.studio.selecting.ants_records import Ants, AskAnts

MOST_LINES = 1 << 16  # beyond, they would fill the picture
_NONE = frozen(np.empty((0, 4), np.float32))


class AntsFinder(Owned):
    """It belongs to the engine's thread.  It tells anew when the selection is another one than it told last."""

    def __init__(self, easel: Easel) -> None:
        self._easel = easel
        self._asked: AskAnts | None = None
        self._told: tuple[AskAnts | None, Selection | None, Saved] = (None, None, NONE_SAVED)
        self._bounds: Rect | None = None
        self.handlers: dict[type, Callable[[AskAnts], None]] = {AskAnts: self._ask}

    def _ask(self, request: AskAnts) -> None:
        self._asked = request

    @property
    def pending(self) -> int:
        """Tells whether there is something to tell."""
        painting, (asked, selection, saved) = self._easel.session.painting, self._told
        if self._asked is None:
            return 0
        moved = asked is not self._asked and (painting.selection is not None or selection is not None)
        other = painting.selection is not selection or painting.selections is not saved
        return int(moved or other)

    def step(self) -> None:
        """Finds the rim and sends it."""
        painting, asked = self._easel.session.painting, self._asked
        selection = self._told[1]
        assert asked is not None
        self._told = asked, painting.selection, painting.selections
        lines = _NONE
        if painting.selection is not selection:
            self._bounds = None if painting.selection is None else bounds_of(painting.selection)
        if painting.selection is not None:
            lines = rim(painting.selection, asked.level, asked.area, self._easel.session.cache)
        names = tuple(sorted(painting.selections))
        bounded = painting.selection is not None and not painting.selection.inverse
        told = Ants(painting.selection is not None, names, asked.level, asked.area, lines, bounded, self._bounds)
        self._easel.send(told)


def rim(selection: Selection, level: int, area: Rect, cache: TileCache | None = None) -> np.ndarray:
    """Returns the lines along pixels' edges, within a rectangle, that part what is selected at least half from what is
    not: as `Ants` tells them."""
    inside = np.empty((area.height, area.width), np.bool_)
    for key in area.tiles(level):
        part = key.rect.intersect(area)
        inside[part.slices(area)] = selection.chosen(level, key.rect, cache)[part.slices(key.rect)]
    lines = np.concatenate([_along(inside), _along(inside.T)[:, [1, 0, 3, 2]]])[:MOST_LINES]
    return frozen(lines.astype(np.float32))


def bounds_of(selection: Selection) -> Rect | None:
    """Returns the bounds of what is selected at least half at the selection's own level, in pixels of level 0; None
    where it has none, or lies on too many tiles."""
    finest = selection.pyramid.finest
    if selection.inverse or finest is None:
        return None
    level = min(0, finest)
    try:
        coverage = alpha_at(selection.pyramid, level, "select")
    except FieldError:
        return None
    out = Rect(0, 0, 0, 0)
    for key, tile in coverage.tiles.items():
        inside = np.broadcast_to(np.greater_equal(tile, 0.5), (TILE, TILE))
        rows, columns = np.flatnonzero(inside.any(axis=1)), np.flatnonzero(inside.any(axis=0))
        if len(rows):
            x, y = key.rect.x0, key.rect.y0
            here = Rect(x + int(columns[0]), y + int(rows[0]), x + int(columns[-1]) + 1, y + int(rows[-1]) + 1)
            out = out.union(here)
    return None if out.empty else out.zoomed(-level)


def _along(inside: np.ndarray) -> np.ndarray:
    """Returns the lines between rows, int (n, 4), each as long as it goes on."""
    edge = np.zeros((inside.shape[0] + 1, inside.shape[1] + 2), np.int8)
    edge[1:-1, 1:-1] = inside[1:] != inside[:-1]
    steps = np.diff(edge, axis=1)
    rows, first = np.nonzero(steps == 1)
    _, last = np.nonzero(steps == -1)  # row by row, as the firsts
    return np.stack([first, rows, last, rows], axis=1)
