"""How far each pixel in sight is not selected, for the quick mask; with the stroke that is being painted on it."""

from __future__ import annotations

import numpy as np

from engine.brush import copies, prints, relief
from engine.brush.checks import BrushError
from engine.brush.dabs import Stroker, stroke_key
from engine.brush.mask import Coverage, StrokeMask
from engine.canvas.selecting.selection import Selection
from engine.checks.owned import Owned
from engine.numeric.address import Rect
from engine.painting.points import rounded
from engine.painting.value import Painting
from engine.studio import requests as q
from engine.studio.easel import Easel
from engine.studio.results import frozen
from engine.studio.selecting.tint_records import AskTint, MaskBegin, MaskEnd, MaskPoints, Tint

EMPTY = Rect(0, 0, 0, 0)


class MaskStroke:
    """A stroke on the mask, as far as it is painted: what `select` with that stroke would cover."""

    def __init__(self, painting: Painting, begin: MaskBegin) -> None:
        brush, level, seed = begin.brush, begin.level, painting.seed
        textures = painting.known_textures
        self.on, self.takes, self.level = painting.selection, begin.takes, level
        pattern = prints.for_copies(prints.resolve(brush, textures, level, seed), begin.copies)
        self._mask = StrokeMask(level, begin.origin, tip=pattern, each=copies.each(begin.copies))
        self._copies, self._stroker = begin.copies, Stroker(brush, stroke_key(seed, level, begin.origin))
        self._thinning = relief.resolve(brush, textures, level, (seed, seed))

    def add(self, points: np.ndarray) -> Rect:
        """Lays more points; returns the pixels that may have changed."""
        out = EMPTY
        for dabs in copies.copied(self._stroker.add(rounded(points)), self._copies):
            for key in self._mask.paint(dabs):
                out = out.union(key.rect)
        return out

    def coverage(self) -> Coverage:
        """Returns what is covered so far."""
        return self._thinning.over(self._mask.coverage())


class TintFinder(Owned):
    """It belongs to the engine's thread."""

    def __init__(self, easel: Easel) -> None:
        self._easel = easel
        self._asked: AskTint | None = None
        self._told: tuple[AskTint | None, Selection | None] = (None, None)
        self._live: MaskStroke | None = None
        self._fresh = EMPTY  # what the stroke has changed since, in pixels of its level
        self.handlers: q.Handlers = {
            AskTint: self._ask,
            MaskBegin: self._begin,
            MaskPoints: self._points,
            MaskEnd: self._end,
        }

    def _ask(self, request: AskTint) -> None:
        self._asked = None if request.area is None else request
        if self._asked is None:
            self._live, self._told = None, (None, None)

    def _begin(self, request: MaskBegin) -> None:
        self._live = MaskStroke(self._easel.session.painting, request)

    def _points(self, request: MaskPoints) -> None:
        if self._live is not None:
            try:
                self._fresh = self._fresh.union(self._live.add(request.points))
            except BrushError:  # it meets too many tiles, which the command will tell
                self._drop()

    def _end(self, _request: MaskEnd) -> None:
        self._drop()

    def _drop(self) -> None:
        """Forgets the stroke; where nothing came of it, the mask is told anew."""
        if self._live is not None and self._live.on is self._easel.session.painting.selection:
            self._told = (None, None)
        self._live, self._fresh = None, EMPTY

    @property
    def pending(self) -> int:
        """Tells whether there is something to tell."""
        if self._asked is None:
            return 0
        other = self._told[0] is not self._asked or self._told[1] is not self._easel.session.painting.selection
        return int(other or not self._fresh.empty)

    def step(self) -> None:
        """Sends all that is asked for, if that is new, else what the stroke has changed."""
        asked, selection = self._asked, self._easel.session.painting.selection
        assert asked is not None
        assert asked.area is not None
        part = asked.area
        if self._told[0] is asked and self._told[1] is selection:
            part = part.intersect(self._fresh)
        self._told, self._fresh = (asked, selection), EMPTY
        if part.empty:
            return
        live = self._live
        if live is not None and (live.on is not selection or live.level != asked.level):
            live = None  # it is selected by now, or its pixels are not those that are shown
        alpha = self._alpha(selection, live, asked.level, part)
        at = Rect.at(part.x0 - asked.area.x0, part.y0 - asked.area.y0, part.width, part.height)
        self._easel.send(Tint(asked.level, asked.area, at, frozen(alpha)))

    def _alpha(self, selection: Selection | None, live: MaskStroke | None, level: int, area: Rect) -> np.ndarray:
        """Returns how far the pixels of a rectangle are not selected: uint8 (h, w).  Where nothing in particular is,
        none is: what is painted will be all."""
        out = np.empty((area.height, area.width), np.uint8)
        covered = None if live is None else live.coverage()
        for key in area.tiles(level):
            chosen = 0.0 if selection is None else selection.part(level, key.rect, self._easel.session.cache)
            laid = None if covered is None or key not in covered.tiles else covered.tiles[key]
            if laid is not None and live is not None:
                chosen = chosen * (1.0 - laid) if live.takes else chosen + (1.0 - chosen) * laid
            part = key.rect.intersect(area)
            left = np.broadcast_to(255.0 - 255.0 * np.asarray(chosen, np.float32), (key.rect.height, key.rect.width))
            out[part.slices(area)] = np.rint(left[part.slices(key.rect)])
        return out
