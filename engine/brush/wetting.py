"""The wet brush of one stroke: what it carries, and the squares of the painting that its dabs have met.

A dab sees the layer as it was before the stroke, with the stroke's own dabs over it as the selection leaves them; what
paper, density and rim make of these is not looked at.
"""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Callable

import numpy as np

from engine.brush import felt
from engine.brush.checks import BrushError
from engine.brush.copies import Copies, Torus, each
from engine.brush.dynamics import most_of
from engine.brush.located import PlacedMask
from engine.brush.print_form import Print
from engine.brush.settings import Brush
from engine.brush.soaking import CARRIED, TIP, soak
from engine.brush.tinted_ink import TintedInk
from engine.brush.tip import ways_of
from engine.brush.wet import Wet
from engine.brush.wet_squares import HALF, SIDE, Manner, Water, fill, squares_met
from engine.numeric.address import Rect, TileKey
from engine.numeric.elementary import log2
from engine.numeric.pigment import LIGHT, PIGMENT, paints

SQUARES_CAP = 1 << 13  # of one stroke: 770 MB
WET_COLUMNS = 1  # of a dab beside its tints: how much of what it covers is paint
_FINE, _FINE_HAIR = 4.0, 2.0  # px: the radius of dabs, and of hairs, in what they see
_LEAST = 2.0**-64  # of a length, in place of 0
_AT_ONCE = 4096  # dabs
_FEW = 16  # squares that there is room for at first
_BY_READ = 4  # squares along what is read at once

See = Callable[[int, Rect], np.ndarray]  # what lies in a rectangle of a level, float32 (4, h, w)
Chosen = Callable[[int, Rect], np.ndarray | float]  # how far it is selected, 0..1


class Wetting:
    """Gives the dabs of one stroke at `level` the colours that they lay.

    `ink`: the brush's; `see`: the layer before the stroke; `chosen`: None where all is selected; `locked`: under alpha
    lock; `cell`: of a layer that is repeated, pixels of the stroke's level, and how many coarser levels it is whole at.
    """

    def __init__(
        self,
        brush: Brush,
        ink: TintedInk,
        place: tuple[int, tuple[int, int]],
        see: See,
        chosen: Chosen | None = None,
        locked: bool = False,
        copies: Copies | Torus = (),
        cell: tuple[Rect, int] | None = None,
    ) -> None:
        assert brush.wet is not None
        level, origin = place
        self._ink, self._see, self._chosen = ink, see, chosen
        above = _coarser(brush) if cell is None else min(_coarser(brush), cell[1])
        self._level, self._tints = level - above, felt.tints_of(brush)
        corner = [(part >> above) // SIDE for part in origin]
        self._corner = corner[0], corner[1]
        self._manner = _manner(brush, brush.wet, copies, locked, above)
        for axis, part in enumerate(origin):
            self._manner.numbers[4 + axis] = (part - ((corner[axis] * SIDE) << above)) / 2.0**above
        if cell is not None and isinstance(copies, Torus):
            rect = cell[0].zoomed(-above)
            left, top = rect.x0 - corner[0] * SIDE, rect.y0 - corner[1] * SIDE
            self._manner.period[:] = left, top, rect.width, rect.height
        vector = self._manner.size + 1
        buckets = int(self._manner.plan[1]) * len(self._manner.ways)
        self._going = np.zeros((buckets, CARRIED + vector)), np.zeros((len(self._manner.ways), TIP))
        self._scratch = np.empty(vector), np.empty(vector), np.empty(vector - 1)
        self._met = np.empty(_FEW, np.int64)
        self._codes, self._slots = np.empty(0, np.int64), np.empty(0, np.int64)
        self._known: dict[int, int] = {}
        self._slab = np.empty((0, SIDE, SIDE, 2 * vector + 2), np.float32)
        self._laid = 0

    def soaked(self, dabs: np.ndarray) -> np.ndarray:
        """Returns dabs, float64 (m, k) of `copies.copied`, with what each lays in place of its tints: one more column.
        BrushError if the stroke meets too much."""
        together = int(self._manner.plan[0] * self._manner.plan[1])
        portion = max(1, _AT_ONCE // together) * together
        parts = [self._soaked(dabs[start : start + portion]) for start in range(0, len(dabs), portion)]
        return np.concatenate(parts) if parts else np.empty((0, dabs.shape[1] + WET_COLUMNS))

    def _soaked(self, dabs: np.ndarray) -> np.ndarray:
        first = dabs.shape[1] - self._tints
        load = dabs.copy()
        load[:, first : first + 3] = self._ink.mean_under(dabs[:, first:])
        self._meet(load)
        out = np.zeros((len(dabs), self._tints + WET_COLUMNS))
        soak(
            load, self._laid, self._manner, self._going, Water(self._codes, self._slots, self._slab), self._scratch, out
        )
        self._laid += len(dabs)
        return np.concatenate([dabs[:, :first], out], axis=1)

    def _meet(self, dabs: np.ndarray) -> None:
        """Looks at all squares that dabs meet, as far as they are not known."""
        count = squares_met(dabs, self._manner, self._met)
        if count > len(self._met):
            self._met = np.empty(2 * count, np.int64)
            squares_met(dabs, self._manner, self._met)
        met = self._met[:count]
        at = np.searchsorted(self._codes, met)
        new = met[self._codes.take(at, mode="clip") != met] if len(self._codes) else met
        if len(new):
            self._look_at(np.unique(new).tolist())
            self._codes = np.array(sorted(self._known), np.int64)
            self._slots = np.array([self._known[code] for code in self._codes.tolist()], np.int64)

    def _look_at(self, codes: list[int]) -> None:
        total = len(self._known) + len(codes)
        if total > SQUARES_CAP:
            raise BrushError("stroke", f"one that meets {total} squares", f"at most {SQUARES_CAP} under a wet brush")
        if total > len(self._slab):
            larger = np.empty((max(_FEW, 2 * len(self._slab), total), *self._slab.shape[1:]), np.float32)
            larger[: len(self._known)] = self._slab[: len(self._known)]
            self._slab = larger
        near: defaultdict[tuple[int, int], list[tuple[int, int, int]]] = defaultdict(list)
        for code in codes:
            x, y = self._corner[0] + (code & 0xFFFFFFFF) - HALF, self._corner[1] + (code >> 32) - HALF
            near[x // _BY_READ, y // _BY_READ].append((x, y, code))
        for squares in near.values():
            self._read(squares)

    def _read(self, squares: list[tuple[int, int, int]]) -> None:
        """Looks at squares that lie near one another."""
        xs, ys = [x for x, _, _ in squares], [y for _, y, _ in squares]
        rect = Rect(min(xs) * SIDE, min(ys) * SIDE, (max(xs) + 1) * SIDE, (max(ys) + 1) * SIDE)
        seen = self._see(self._level, rect)
        selected = np.ones((rect.height, rect.width), np.float32)
        if self._chosen is not None:
            selected[...] = self._chosen(self._level, rect)
        for x, y, code in squares:
            part = Rect.at(x * SIDE, y * SIDE, SIDE, SIDE).slices(rect)
            slot = self._known[code] = len(self._known)
            own = np.ascontiguousarray(seen[:, *part]), np.ascontiguousarray(selected[part])
            fill(self._slab, slot, *own, self._manner.told, self._scratch[2])


class WetMask(PlacedMask):
    """The coverage of a stroke whose dabs a wet brush colours before they are laid."""

    def __init__(
        self,
        wetting: Wetting,
        place: tuple[int, tuple[int, int]],
        tip: Print,
        copies: Copies | Torus,
        columns: int | None,
    ) -> None:
        super().__init__(place, tip, copies, columns)
        self._wetting = wetting

    def paint(self, dabs: np.ndarray) -> set[TileKey]:
        """As `PlacedMask.paint`."""
        return super().paint(self._wetting.soaked(dabs))


def _coarser(brush: Brush) -> int:
    """Returns how many levels coarser than the stroke's is what its dabs see."""
    widest = brush.radius * most_of(brush.dynamics.get("radius"))
    if brush.shape.bristles:
        widest *= felt.hair_size(brush)
    return max(0, math.ceil(log2(max(widest / (_FINE_HAIR if brush.shape.bristles else _FINE), 1.0))))


def _manner(brush: Brush, wet: Wet, copies: Copies | Torus, locked: bool, above: int) -> Manner:
    turned = felt.is_turned(brush)
    first = len(_BEFORE) + (3 if turned else 0) + (felt.PLACE_COLUMNS if felt.is_placed(brush) else 0)
    return Manner(
        PIGMENT if wet.pigment else LIGHT,
        np.array([log2(max(wet.length, _LEAST)), wet.amount, wet.dilution, 2.0**-above, 0.0, 0.0, felt.fine_of(brush)]),
        np.array([each(copies), max(1, brush.shape.bristles), turned, first, locked], np.int64),
        np.zeros(4, np.int64),
        ways_of(copies.copies if isinstance(copies, Torus) else copies),
        paints(),
    )


_BEFORE = ("x", "y", "radius", "opacity", "flow", "hardness")
