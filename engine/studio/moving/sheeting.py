"""The sheets by which the window draws what is dragged: below it, itself, and above it."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from engine.canvas.composite import composite
from engine.canvas.layers import Group, Layer
from engine.canvas.node_checks import LayerError
from engine.canvas.placing.composite_steps import Planned
from engine.canvas.reading import kept_planes, layer_planes
from engine.checks.owned import Owned
from engine.numeric.address import Rect
from engine.numeric.colour import to_premul8
from engine.painting.rendering import piece_reader
from engine.studio.easel import Easel
from engine.studio.moving.around import stacks_around
from engine.studio.moving.sheet_records import AskSheets, AskShown, CarriedSheet, CarriedSheets, DropSheets, Shown
from engine.studio.requests import SCREEN_TILE, Handlers
from engine.studio.results import frozen

_MOST = 1 << 24  # pixels of a sheet


class Sheeting(Owned):
    """Makes sheets tile by tile, while no tile of the screen is wanted.  It belongs to the engine's thread."""

    def __init__(self, easel: Easel) -> None:
        self._easel = easel
        self._making: Iterator[None] | None = None
        self._shown: list[int] = []
        self.handlers: Handlers = {
            AskSheets: self._ask,
            DropSheets: self._drop,
            AskShown: lambda request: self._shown.append(request.number),
        }

    @property
    def pending(self) -> int:
        """Pieces of open work."""
        return len(self._shown) + (self._making is not None)

    def step(self) -> None:
        """Does the next one."""
        if self._shown:
            self._easel.send(Shown(self._shown.pop(0)))
            return
        assert self._making is not None
        making, self._making = self._making, None  # what fails is not tried again
        if next(making, self) is not self:
            self._making = making

    def _ask(self, request: AskSheets) -> None:
        self._making = self._made(request)

    def _drop(self, _request: DropSheets) -> None:
        self._making = None

    def _made(self, request: AskSheets) -> Iterator[None]:
        try:
            found = stacks_around(self._easel.session.painting.root, request.name)
        except LayerError:  # it is gone meanwhile
            found = None
        if found is None or max(request.rect.area, request.around.area) > _MOST:
            self._easel.send(CarriedSheets(request.number, request.level, None))
            return
        below, moved, above = found
        made: list[CarriedSheet] = []
        for root, rect in ((moved, request.around), (below, request.rect), (above, request.rect)):
            out = np.zeros((rect.height, rect.width, 4), np.uint8)
            yield from self._laid(root, request.level, rect, out)
            made.append(_sheet(rect, out))
        self._easel.send(CarriedSheets(request.number, request.level, (made[1], made[0], made[2])))

    def _laid(self, root: Group, level: int, rect: Rect, out: np.ndarray) -> Iterator[None]:
        """Makes a sheet piece by piece; nothing is to be made of a root that shows nothing."""
        planned, cache = Planned.of(root), self._easel.session.cache

        def read(layer: Layer, level: int, rect: Rect) -> np.ndarray | None:
            return layer_planes(layer, level, rect, cache)

        def placed(layer: Layer, level: int, rect: Rect) -> np.ndarray | None:
            return kept_planes(layer, level, rect, cache)

        if not planned.steps:
            return
        side = SCREEN_TILE
        for y in range(rect.y0 // side * side, rect.y1, side):
            for x in range(rect.x0 // side * side, rect.x1, side):
                part = Rect.at(x, y, side, side).intersect(rect)
                picture = composite(planned, level, part, piece_reader(level, part, read, placed))
                out[part.slices(rect)] = to_premul8(picture)
                yield


def _sheet(rect: Rect, pixels: np.ndarray) -> CarriedSheet:
    """Returns what of a rectangle is not empty."""
    alpha = pixels[..., 3]
    rows, columns = (np.flatnonzero(alpha.any(axis=axis)).tolist() for axis in (1, 0))
    if not rows:
        return CarriedSheet(rect, None)
    inner = Rect(rect.x0 + columns[0], rect.y0 + rows[0], rect.x0 + columns[-1] + 1, rect.y0 + rows[-1] + 1)
    return CarriedSheet(inner, frozen(np.ascontiguousarray(pixels[inner.slices(rect)])))
