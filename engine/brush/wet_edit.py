"""What a wet stroke makes of a tile: A = 1 - M W, B = M t, M being the coverage, t what the dabs laid, premultiplied by
W, how much of it is paint.

Where some of the load is water, W is below 1, and what lies there shows through.  Mixed as pigment, that is the paint t
mixed with 1 - W of what lies at the very pixel: blue over yellow is green, whatever is drawn below it stays.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from engine.brush.stamp import Stamp
from engine.brush.tinted_ink import TintedInk
from engine.numeric.address import TileKey
from engine.numeric.grid import SNAP, snap
from engine.numeric.kernel import Array, kernel
from engine.numeric.pigment import PIGMENT, from_paint, paints, to_paint
from engine.texture.planes import COLOURS, Planes

if TYPE_CHECKING:
    from engine.brush.covered import Covered

_ALPHA = 3
_ONE = np.float32(1.0)


def _snapped(values: np.ndarray) -> np.ndarray:
    out: np.ndarray = (values + SNAP) - SNAP
    return out


def wet_stamp(edit: Covered, key: TileKey, old: Planes) -> Stamp | None:
    """Returns A and B of a tile under a wet brush; None where nothing changes."""
    tints, ink, wet = (edit.coverage.tints or {}).get(key), edit.ink, edit.brush.wet
    if tints is None or wet is None:
        return None
    assert isinstance(ink, TintedInk)
    covered, places = edit.coverage.on_grid(key), (edit.coverage.places or {}).get(key)
    rough, planes, inks = ink.rough(key, np.array(edit.brush.rgb, np.float32), tints[3:-1], places, covered)
    keep = _ONE - _snapped(covered * tints[-1])
    if not (keep < _ONE).any():
        return None
    add = np.empty((COLOURS + len(planes), *keep.shape), np.float32)
    weight = covered * old.data[_ALPHA] if edit.locked else covered
    add[:_ALPHA] = _snapped(weight * (tints[:_ALPHA] + rough))
    add[_ALPHA] = old.data[_ALPHA] - _snapped(keep * old.data[_ALPHA]) if edit.locked else _ONE - keep
    add[COLOURS:] = _snapped(weight * planes)
    if wet.pigment and wet.dilution > 0.0:
        _glaze(covered, (tints, rough), np.ascontiguousarray(old.rgba), (keep, edit.locked), add, paints())
    add *= keep < _ONE
    return Stamp(keep, add, inks, plain=True)


@kernel
def _glaze(
    covered: Array, laid: tuple[Array, Array], old: Array, kept: tuple[Array, bool], add: Array, told: Array
) -> None:
    """Writes B of colours, premultiplied float32 (3, h, w), where paint and what lies below it mix as pigment."""
    tints, rough = laid
    keep, locked = kept
    n = tints.shape[0]
    load, below = np.empty(PIGMENT), np.empty(PIGMENT)
    for y in range(covered.shape[0]):
        for x in range(covered.shape[1]):
            m, alpha, under = covered[y, x], tints[n - 1, y, x], old[3, y, x]
            rest = (_ONE - alpha) * under
            if keep[y, x] == _ONE or not (alpha > 0.0 and rest > 0.0):
                continue
            lay = alpha * under if locked else alpha
            to_paint(tints[0, y, x] / alpha, tints[1, y, x] / alpha, tints[2, y, x] / alpha, told, load)
            to_paint(old[0, y, x] / under, old[1, y, x] / under, old[2, y, x] / under, told, below)
            for c in range(PIGMENT):
                load[c] = lay * load[c] + rest * below[c]
            mixed = from_paint(load, told)
            for c in range(3):
                aim = np.float32(mixed[c] * (lay + rest)) + (lay * rough[c, y, x] if locked else rough[c, y, x])
                v = old[c, y, x]
                add[c, y, x] = snap(v + m * (aim - v)) - snap(keep[y, x] * v)
