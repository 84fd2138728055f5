"""The stroke in progress that places things: a centre line so far, and what a generator makes of it."""

from __future__ import annotations

import numpy as np

from engine.brush import copies as copying
from engine.brush.generated_edit import Generating, generators_of
from engine.brush.mask import TILES_CAP, Coverage
from engine.brush.stamp import Edit
from engine.checks.values import described
from engine.numeric.address import Rect
from engine.numeric.hashing import MASK32, fold_key
from engine.painting.value import Refusal
from engine.strokes.mask_painting import insist_on_paint
from engine.strokes.paint_stroke import LiveStroke
from engine.texture.expression.placing.centre_line import simplified
from engine.texture.expression.placing.generated import LaidStroke

_NOWHERE = Rect(0, 0, 0, 0)
_X, _Y, _RADIUS = range(3)


class GeneratedStroke(LiveStroke):
    """A stroke that places things; otherwise as `LiveStroke`."""

    def _begin(self) -> None:
        insist_on_paint(self.layer, "stroke")
        if isinstance(self.copies, copying.Torus):
            raise Refusal("stroke: found a layer that repeats, expected one that does not: things are placed but once")
        super()._begin()
        self._by = generators_of(self.brush, self.before.known_textures, self.level, self.own)
        self._seed = fold_key(self.chance) & MASK32 >> 8
        self._dabs: list[np.ndarray] = []
        self._laid: tuple[LaidStroke, ...] = ()

    def lay(self, points: np.ndarray) -> Rect:
        """Takes more points; returns what of the level they may have changed."""
        if not len(points):
            return _NOWHERE
        self._dabs.append(self._stroker.walk(points))
        made = self._made()
        dirty = _changed(self._laid, made, self.level)  # first: where it lacks a kernel, the stroke is as it was
        self._laid = made
        self._keep(points)
        self._edit = None
        if not dirty.empty and self.layer.growth:
            self._flatten(self._all_dabs())
        if dirty.width * dirty.height > TILES_CAP << 14:
            raise Refusal(f"stroke: found {described(dirty.width)} pixels of things, expected fewer: zoom out")
        return dirty

    def _all_dabs(self) -> np.ndarray:
        rest = [self._stroker.rest()] if self._stroker.waits else []
        return np.concatenate([*self._dabs, *rest])

    def _made(self) -> tuple[LaidStroke, ...]:
        """Returns what every generator makes of the line so far, and of each of its copies."""
        dabs, unit = self._all_dabs(), 2.0 * self.brush.radius
        found = []
        for n, one in enumerate(copying.one_by_one(dabs, self.copies)):
            if not len(one):
                continue
            x, y = (int(np.floor(one[0, axis])) for axis in (_X, _Y))
            places = zip(
                ((one[:, _X] - x) / unit).tolist(), ((one[:, _Y] - y) / unit).tolist(),
                (one[:, _RADIUS] / self.brush.radius).tolist(), strict=True,
            )  # fmt: skip
            line, start = simplified(list(places)), (self.origin[0] + x, self.origin[1] + y)
            for by in self._by:
                found.append(LaidStroke(self.level, by.text, unit, self._seed + n, start, line, by.values))
        return tuple(found)

    @property
    def rect(self) -> Rect:
        """Returns a rectangle of pixels of the level outside which nothing changes."""
        whole = _NOWHERE
        for laid in self._laid:
            whole = whole.union(laid.rect(self.level))
        return whole if whole.empty else whole.grown(4)

    @property
    def edit(self) -> Edit:
        """Returns the edit of the layer that the points so far make."""
        if self._edit is None:
            rect = self.rect
            covered = Coverage(self.level, dict.fromkeys(rect.tiles(self.level), 1.0), rect)
            if self.limit is not None:
                covered = self.limit.over(covered)
            self._edit = Generating(covered, self.brush, self._ink, self.layer.alpha_locked, None, laid=self._laid)
        return self._edit


def _changed(before: tuple[LaidStroke, ...], now: tuple[LaidStroke, ...], level: int) -> Rect:
    """Returns the pixels in which two states of a stroke may differ."""
    whole = _NOWHERE
    for n, laid in enumerate(now):
        old = before[n] if n < len(before) else None
        whole = whole.union(laid.changed(old, level))
    return whole if whole.empty else whole.grown(4)
