"""The rim of what is selected, found while nothing more urgent waits, for the window to draw."""

from __future__ import annotations

import numpy as np

from engine.canvas.selecting.occupied import alpha_at
from engine.canvas.selecting.selection import NONE_SAVED, Selection
from engine.canvas.tile_cache import TileCache
from engine.checks.field_error import FieldError
from engine.checks.owned import Owned
from engine.numeric.address import Rect
from engine.painting.select_commands import Select
from engine.painting.value import Painting, Refusal
from engine.session.selecting import selected
from engine.studio import requests as q
from engine.studio.easel import Easel
from engine.studio.results import frozen
from engine.studio.selecting.ants_records import Ants, AskAnts, Measure, PreviewSelection
from engine.studio.selecting.measure import chosen_bounds, measured

MOST_LINES = 1 << 16  # beyond, they would fill the picture
_NONE = frozen(np.empty((0, 4), np.float32))


class AntsFinder(Owned):
    """It belongs to the engine's thread.  It tells anew when the selection is another one than it told last."""

    def __init__(self, easel: Easel) -> None:
        self._easel = easel
        self._asked: AskAnts | None = None
        self._wanted: Select | None = None
        self._told: tuple[object, ...] = (None, None, None, NONE_SAVED)
        self._measured: tuple[Selection | None, Rect | None, Measure | None] = (None, None, None)
        self.handlers: q.Handlers = {AskAnts: self._ask, PreviewSelection: self._preview}

    def _ask(self, request: AskAnts) -> None:
        self._asked = request

    def _preview(self, request: PreviewSelection) -> None:
        self._wanted = request.command

    @property
    def pending(self) -> int:
        """Tells whether there is something to tell."""
        painting = self._easel.session.painting
        asked, wanted, selection, saved = self._told
        if self._asked is None:
            return 0
        moved = asked is not self._asked and (painting.selection is not None or selection is not None)
        other = painting.selection is not selection or painting.selections is not saved
        return int(moved or other or wanted is not self._wanted)

    def step(self) -> None:
        """Finds the rim and sends it."""
        painting, asked = self._easel.session.painting, self._asked
        assert asked is not None
        self._told = asked, self._wanted, painting.selection, painting.selections
        shown = self._shown(painting)
        if shown is not self._measured[0] or shown is None:
            self._measured = (None, None, None) if shown is None else (shown, bounds_of(shown), measured(shown))
        lines = _NONE if shown is None else rim(shown, asked.level, asked.area, self._easel.session.cache)
        known = shown is not None and not shown.inverse, *self._measured[1:]
        names = tuple(sorted(painting.selections))
        self._easel.send(Ants(painting.selection is not None, names, asked.level, asked.area, lines, *known))

    def _shown(self, painting: Painting) -> Selection | None:
        """Returns what is selected, or would be by the command that is tried out; nothing, if that cannot be."""
        if self._wanted is None:
            return painting.selection
        try:
            return selected(painting, self._wanted).selection
        except (Refusal, FieldError):
            return None


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
    out = chosen_bounds(coverage)
    return None if out.empty else out.zoomed(-level)


def _along(inside: np.ndarray) -> np.ndarray:
    """Returns the lines between rows, int (n, 4), each as long as it goes on."""
    edge = np.zeros((inside.shape[0] + 1, inside.shape[1] + 2), np.int8)
    edge[1:-1, 1:-1] = inside[1:] != inside[:-1]
    steps = np.diff(edge, axis=1)
    rows, first = np.nonzero(steps == 1)
    _, last = np.nonzero(steps == -1)  # row by row, as the firsts
    return np.stack([first, rows, last, rows], axis=1)
