"""The picture for the clipboard, made strip by strip while nothing else waits."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

import numpy as np

from engine.canvas.composite import composite
from engine.canvas.layers import pictured
from engine.canvas.reading import layer_planes
from engine.checks.owned import Owned
from engine.numeric.address import Rect
from engine.numeric.colour import to_rgba8
from engine.studio import requests as q
from engine.studio import results
from engine.studio.copy_records import Copied, CopyPicture
from engine.studio.easel import Easel

_MOST = 1 << 24  # pixels; of a larger rectangle a coarser level is copied
_STRIP = 128  # rows made in one step


class Copyist(Owned):
    """It belongs to the engine's thread.  A newer request drops the older."""

    def __init__(self, easel: Easel) -> None:
        self._easel = easel
        self._work: Iterator[Copied | None] | None = None
        self.handlers: q.Handlers = {CopyPicture: self._ask}

    @property
    def pending(self) -> bool:
        """Tells whether there is something left to copy."""
        return self._work is not None

    def step(self) -> None:
        """Makes the next strip; sends the picture after the last."""
        found = None if self._work is None else next(self._work)
        if found is not None:
            self._work = None
            self._easel.send(found)

    def _ask(self, request: CopyPicture) -> None:
        level, area = request.level, request.area
        while area.area > _MOST:
            level, area = level - 1, area.zoomed(-1)
        self._work = self._copied(level, area, request.about)

    def _copied(self, level: int, area: Rect, about: str) -> Iterator[Copied | None]:
        session = self._easel.session
        root = pictured(session.painting.root)
        pixels = np.empty((area.height, area.width, 4), np.uint8)
        for top in range(0, area.height, _STRIP):
            strip = Rect(area.x0, area.y0 + top, area.x1, min(area.y0 + top + _STRIP, area.y1))
            planes = composite(root, level, strip, partial(layer_planes, cache=session.cache))
            pixels[top : top + _STRIP] = to_rgba8(planes)
            yield None
        yield Copied(results.frozen(pixels), about)
