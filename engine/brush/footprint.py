"""The pixels that a stroke takes: those that one of its dabs covers at least half.

What is grown from an example has no half-covered pixels.  A pixel is in or out, whatever opacity and flow are; radius,
hardness, tip and spacing, and what pressure makes of them, tell which.  Each dab counts for itself, so that a stroke
and its pieces take the same pixels where their dabs are the same.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from engine.brush import discs as kernels
from engine.brush.checks import BrushError
from engine.brush.copies import NO_COPIES, Copies, Torus, one_by_one
from engine.brush.dabs import Stroker
from engine.brush.discs import CEILING, CX, CY, RIN2, ROUT
from engine.brush.print_form import Print
from engine.brush.prints import for_copies, plain
from engine.brush.settings import Brush
from engine.numeric.address import TILE, Rect
from engine.numeric.kernel import inner, kernel

WIDEST = 2048.0  # px: radius of a dab
TILES_CAP = 1 << 12  # of one stroke
_SIDE = 64  # pixels along these
_TOGETHER = 1 << 18  # pixels of a rectangle whose dabs are laid at once, or twice those of the widest dab
_HALF = 0.5


class Footprint:
    """Grows with a stroke from `origin`, on pixels that are `finer` levels finer than its own (coarser, if negative).

    `within`: the only pixels that matter; without it, a stroke that takes too many of them is refused.  `chance`: what
    its random numbers hang on (`dabs.stroke_key`).
    """

    def __init__(
        self,
        brush: Brush,
        origin: tuple[int, int],
        finer: int = 0,
        tip: Print | None = None,
        within: Rect | None = None,
        copies: Copies | Torus = NO_COPIES,
        chance: int = 0,
    ) -> None:
        dynamics = brush.dynamics
        for name in ("opacity", "flow"):
            dynamics = dynamics.delete(name) if name in dynamics else dynamics
        self._brush = replace(brush, opacity=1.0, flow=1.0, dynamics=dynamics)
        self._stroker, self._copies = Stroker(self._brush, chance), copies
        self._scale, self._tip = 2.0**finer, for_copies(plain(brush) if tip is None else tip, copies)
        self._around = copies.each // (1 + len(copies.copies)) if isinstance(copies, Torus) else 1
        places = [value << finer if finer >= 0 else value >> -finer for value in origin]
        self._origin = places[0], places[1]
        left_over = (value & ((1 << -finer) - 1) if finer < 0 else 0 for value in origin)
        self._shift = tuple(left_over)
        self._tiles: set[tuple[int, int]] = set()
        self._laid = 0
        self._within = None if within is None else _moved(within, -self._origin[0], -self._origin[1])

    def lay(self, points: np.ndarray) -> Iterator[tuple[Rect, np.ndarray]]:
        """More points, float64 (n, 6), known to be good: rectangles and what is taken of them, bool (h, w), each made
        when it is asked for.

        BrushError, at once, if the stroke becomes too large; the points may not be laid again then.
        """
        return self._lay(self._stroker.walk(points))

    def whole(self, points: np.ndarray) -> Iterator[tuple[Rect, np.ndarray]]:
        """As `lay`, of all points of a stroke."""
        return self._lay(self._stroker.whole(points))

    def rest(self) -> Iterator[tuple[Rect, np.ndarray]]:
        """As `lay`, of what waits for the stroke to go anywhere: once, as it ends."""
        return self._lay(self._stroker.rest())

    def _lay(self, dabs: np.ndarray) -> Iterator[tuple[Rect, np.ndarray]]:
        if self._within is None:
            for part in one_by_one(dabs, self._copies):
                self._count(*self._met(part))
        laid = self._laid
        self._laid += len(dabs)
        return self._taken(dabs, laid)

    def _met(self, dabs: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Returns dabs as discs on the pixels that are taken, and the pixels that each may meet."""
        dabs = dabs.copy()
        dabs[:, 0] = (dabs[:, 0] + self._shift[0]) * self._scale
        dabs[:, 1] = (dabs[:, 1] + self._shift[1]) * self._scale
        dabs[:, 2] *= self._scale
        discs = kernels.as_discs(dabs, 0.0, 0.0, kernels.no_bounds())
        if self._tip is None:
            discs = discs[discs[:, CEILING] >= _HALF]  # a pen that hardly touches lays very many dabs that take nothing
        return discs, _boxes(discs)

    def _taken(self, dabs: np.ndarray, laid: int) -> Iterator[tuple[Rect, np.ndarray]]:
        """Yields what dabs take; `laid` of the stroke's lie before them."""
        for number, part in enumerate(one_by_one(dabs, self._copies)):
            discs, boxes = self._met(part)
            tip = None if self._tip is None else self._tip.of_copy(number // self._around)
            for first, last, around in _groups(boxes):
                box = around if self._within is None else around.intersect(self._within)
                if box.empty:
                    continue
                mask = np.zeros((box.height, box.width), np.bool_)
                if tip is None:
                    _take(mask, discs[first:last], float(box.x0), float(box.y0))
                else:
                    _stamp(tip, mask, (discs, range(first, last), laid), box)
                yield _moved(box, *self._origin), mask

    def _count(self, discs: np.ndarray, boxes: np.ndarray) -> None:
        widest = float(discs[:, ROUT].max()) - 0.5 if len(discs) else 0.0
        if widest > WIDEST:
            raise BrushError("brush.radius", f"{widest:g} px on the example's level", f"at most {WIDEST:g} px there")
        for x0, y0, x1, y1 in (boxes // _SIDE).tolist():
            self._tiles.update((y, x) for y in range(y0, y1 + 1) for x in range(x0, x1 + 1))
            if len(self._tiles) > TILES_CAP:
                raise BrushError(
                    "stroke", f"one that meets {len(self._tiles)} squares of {_SIDE} px", f"at most {TILES_CAP}"
                )


def _stamp(tip: Print, mask: np.ndarray, dabs: tuple[np.ndarray, range, int], box: Rect) -> None:
    """Dabs in the shape of the tip's pattern, each for itself: discs, which of them, how many were laid before them."""
    discs, which, laid = dabs
    for index in which:
        x0, y0, x1, y1 = (int(v) for v in _boxes(discs[index : index + 1])[0])
        for y in range(y0, y1, TILE):
            for x in range(x0, x1, TILE):
                whole = Rect.at(x, y, TILE, TILE)
                place = whole.intersect(box)
                if place.empty:
                    continue
                tile = np.zeros((TILE, TILE), np.float32)
                tip.lay(tile, discs, np.array([index]), (laid, 1), (x, y))
                mask[place.slices(box)] |= tile[place.slices(whole)] >= _HALF


def _moved(rect: Rect, x: int, y: int) -> Rect:
    return Rect(rect.x0 + x, rect.y0 + y, rect.x1 + x, rect.y1 + y)


def _boxes(discs: np.ndarray) -> np.ndarray:
    """Returns the pixels that discs may meet: int64 (n, 4), x0, y0, x1, y1."""
    out = np.empty((len(discs), 4), np.int64)
    outer = discs[:, ROUT]
    for column, centre in ((0, discs[:, CX]), (1, discs[:, CY])):
        out[:, column], out[:, column + 2] = np.floor(centre - outer), np.ceil(centre + outer)
    return out


def _groups(boxes: np.ndarray) -> Iterator[tuple[int, int, Rect]]:
    """Runs of dabs that lie near one another, and the rectangle around each."""
    first, around = 0, Rect(0, 0, 0, 0)
    most = max(_TOGETHER, 2 * max((Rect(*row).area for row in boxes.tolist()), default=0))
    for i, row in enumerate(boxes.tolist()):
        more = around.union(Rect(*row))
        if i > first and more.area > most:
            yield first, i, around
            first, more = i, Rect(*row)
        around = more
    if len(boxes) > first:
        yield first, len(boxes), around


@inner
def _half(ceiling: float) -> float:
    """Returns the u at which a dab of that ceiling covers half: ceiling (1 - u)^2 (1 + 2u) = 1/2; 1/2 but for the
    tiniest."""
    low, high = 0.0, 0.5
    while ceiling < 1.0 and high - low > 1e-9:
        u = 0.5 * (low + high)
        if ceiling * (1.0 - u) * (1.0 - u) * (1.0 + 2.0 * u) < 0.5:
            high = u
        else:
            low = u
    return high


@kernel
def _take(mask: np.ndarray, discs: np.ndarray, left: float, top: float) -> None:
    """Marks the pixels of a mask, bool (h, w), that a disc covers at least half."""
    for k in range(discs.shape[0]):
        disc = discs[k]
        cx, cy = disc[CX] - left, disc[CY] - top
        limit = disc[RIN2] + _half(disc[CEILING]) * (disc[ROUT] * disc[ROUT] - disc[RIN2])
        reach = math.sqrt(limit)
        for y in range(max(0, math.ceil(cy - reach - 0.5)), min(mask.shape[0], math.floor(cy + reach - 0.5) + 1)):
            dy2 = (y + 0.5 - cy) * (y + 0.5 - cy)
            half = math.sqrt(max(0.0, limit - dy2))
            for x in range(max(0, math.ceil(cx - half - 0.5)), min(mask.shape[1], math.floor(cx + half - 0.5) + 1)):
                mask[y, x] = True
