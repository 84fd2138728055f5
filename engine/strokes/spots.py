"""The coverage of a few pixels by many plain strokes, all at once: those whose dabs have no pattern, and which nothing
thins.  The same as `StrokeMask` gives, without its tiles."""

from __future__ import annotations

from collections.abc import Sequence
from typing import cast

import numpy as np

from engine.brush import dabs as walking
from engine.brush import discs as dots
from engine.brush.discs import CX, CY, RATE, ROUT, lay_spot
from engine.brush.dynamics import DYNAMIC, knots_of, response
from engine.brush.settings import Brush
from engine.numeric.address import TILE, Rect
from engine.numeric.grid import SNAP
from engine.numeric.kernel import Array, Real, kernel
from engine.numeric.stand_in import Kernel, or_interpreted
from engine.painting.commands import Stroke

_DABS = 256  # dabs of a stroke that there is room for at first

_walk, _as_discs = (cast(Kernel, declared).compiled for declared in (walking.walk_points, dots.as_discs))


def is_plain(brush: Brush) -> bool:
    """Tells whether the coverage of a brush's strokes follows from its dabs alone."""
    thinned = brush.tip or brush.density or brush.grain or brush.edge or brush.extent
    return not (thinned or brush.row.grows or (brush.row.uses_op and brush.ink))


def covered(strokes: Sequence[Stroke], coarser: int, rect: Rect) -> np.ndarray:
    """Returns the coverage of `rect` by each of some strokes of one level: float32 (n, h, w) on the grid.

    `rect`: of the level that is so much coarser than the strokes', at which their dabs are laid smaller.
    """
    tables, which = _tables([stroke.brush for stroke in strokes])
    ends = np.cumsum([len(stroke.points) for stroke in strokes])
    points = np.concatenate([stroke.points for stroke in strokes])
    points.flags.writeable = False
    values = np.array([[getattr(stroke.brush, name) for name in DYNAMIC] for stroke in strokes], np.float64)
    moved, corners = np.empty((len(strokes), 4)), np.empty((len(strokes), 2), np.int64)
    for n, stroke in enumerate(strokes):
        for axis, start in enumerate((rect.x0, rect.y0)):
            origin = stroke.origin[axis]
            corner = origin >> coarser
            moved[n, axis], moved[n, 2 + axis] = origin - (corner << coarser), corner % TILE
            corners[n, axis] = start - corner // TILE * TILE
    out = np.zeros((len(strokes), rect.height, rect.width), np.float32)
    _cover(points, ends, values, which, *tables, moved, corners, 2.0**-coarser, out)
    out += SNAP
    out -= SNAP
    return out


def _tables(brushes: Sequence[Brush]) -> tuple[tuple[Array, Array, Array, Array, Array], Array]:
    """Returns what the pressure makes of brushes (`Response`, but for their own values), and which row is whose."""
    known: dict[object, int] = {}
    kinds: list[Brush] = []
    which = np.empty(len(brushes), np.int64)
    for n, brush in enumerate(brushes):
        key = tuple(knots_of(brush.dynamics.get(name)) for name in DYNAMIC) if brush.dynamics else ()
        if key not in known:
            known[key] = len(kinds)
            kinds.append(brush)
        which[n] = known[key]
    found = [response(brush) for brush in kinds]
    width = max(one.inputs.shape[1] for one in found)
    inputs, outputs = (np.zeros((len(found), len(DYNAMIC), width)) for _ in range(2))
    for n, one in enumerate(found):
        inputs[n, :, : one.inputs.shape[1]], outputs[n, :, : one.inputs.shape[1]] = one.inputs, one.outputs
    counts = np.array([one.counts for one in found])
    return (found[0].lo, found[0].hi, inputs, outputs, counts), which


@or_interpreted()
@kernel
def _cover(
    points: Array,
    ends: Array,
    values: Array,
    which: Array,
    lo: Array,
    hi: Array,
    inputs: Array,
    outputs: Array,
    counts: Array,
    moved: Array,
    corners: Array,
    scale: Real,
    out: Array,
) -> None:
    """Walks along each stroke, whose points end at `ends`, and lays its dabs on its pixels of `out` (n, h, w).

    `moved`: what is added to dabs before they are scaled, and after; `corners`: of the pixels, from the same tile.
    """
    dabs, bounds, state = np.empty((_DABS, walking.DAB)), np.zeros(5), np.empty(6)
    for n in range(ends.shape[0]):
        part, row = points[ends[n - 1] if n else 0 : ends[n]], which[n]
        state[:] = 0.0
        count = _walk(part, state, values[n], lo, hi, inputs[row], outputs[row], counts[row], dabs)
        if count > dabs.shape[0]:
            dabs = np.empty((2 * count, walking.DAB))
            state[:] = 0.0
            _walk(part, state, values[n], lo, hi, inputs[row], outputs[row], counts[row], dabs)
        laid = dabs[:count]
        if scale != 1.0:
            for i in range(count):
                laid[i, 0] = (laid[i, 0] + moved[n, 0]) * scale
                laid[i, 1] = (laid[i, 1] + moved[n, 1]) * scale
                laid[i, 2] *= scale
        spots = _as_discs(laid, moved[n, 2], moved[n, 3], bounds)
        left, top = corners[n, 0], corners[n, 1]
        for i in range(count):
            x, y, reach = spots[i, CX], spots[i, CY], spots[i, ROUT]
            met = x + reach > left and x - reach < left + out.shape[2] and spots[i, RATE] > 0.0
            if met and y + reach > top and y - reach < top + out.shape[1]:
                lay_spot(out[n], spots[i], left, top)
