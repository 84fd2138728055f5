"""Raster-ops that lay paint or take it away, each by name: A = 1 - w, w being the stroke's weight."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from engine.brush import coat, tones
from engine.brush.mixture import ONES
from engine.brush.operand import ALPHA, Operand, Operating, planes_of
from engine.brush.stamp import Stamp
from engine.numeric.address import TILE, Rect
from engine.numeric.functions import functions
from engine.texture.planes import COLOURS
from engine.texture.record import Instance

_SPAN = 4  # px to each side over which the texture's slope is taken

_Kernel = Callable[[Operating, Operand], Stamp | None]


def _toward(edit: Operating, at: Operand) -> Stamp | None:
    """Returns the brush's colour, laid through its textures."""
    keep = np.empty_like(ONES)
    if not coat.keep_of(at.weight, keep):
        return None
    inks = edit.mixture.inks
    add = np.empty((COLOURS + 3 * len(inks), TILE, TILE), np.float32)
    coat.wash(coat.weigh(keep, at.old.data[ALPHA], edit.locked, add[ALPHA]), edit.colour, add[:ALPHA])
    if inks:
        below = np.ascontiguousarray(at.old.data)
        where, gains = planes_of(at.old.inks, inks), edit.mixture.gains(inks)
        tones.spray(keep, at.free, edit.colour, below, where, gains, add)
    return Stamp(keep, add, inks)


def _clone(edit: Operating, at: Operand) -> Stamp | None:
    """Returns what lies on a layer some way off."""
    assert edit.scene.source is not None
    dx, dy = edit.op.parameters["offset"]
    rect = at.key.rect
    found = edit.scene.source(Rect(rect.x0 + dx, rect.y0 + dy, rect.x1 + dx, rect.y1 + dy))
    return _laid(edit, at, found.data.copy(), found.inks)


def _displace(edit: Operating, at: Operand) -> Stamp | None:
    """Returns what lies around, moved along an angle or down the slopes of the texture."""
    assert edit.read is not None
    distance, angle = edit.op.parameters["distance"], math.radians(edit.op.parameters["angle"])
    own = functions(edit.scene.arithmetic)
    along, aside = distance * own.cos(angle), distance * own.sin(angle)
    if edit.op.by_texture:
        t = edit.mixture.over(at.key.rect.grown(_SPAN))
        middle = slice(_SPAN, -_SPAN)
        slopes = t[middle, : -2 * _SPAN] - t[middle, 2 * _SPAN :], t[: -2 * _SPAN, middle] - t[2 * _SPAN :, middle]
        right = along * slopes[0] - aside * slopes[1]
        down = aside * slopes[0] + along * slopes[1]
    else:
        right, down = np.full_like(ONES, along), np.full_like(ONES, aside)
    reach = 2 * (math.ceil(distance * math.sqrt(2.0)) // 2 + 2)
    around = np.ascontiguousarray(edit.read(at.key.rect.grown(reach)).data[:COLOURS])
    paint = np.empty((COLOURS, TILE, TILE), np.float32)
    tones.moved(around, (-right).astype(np.float32), (-down).astype(np.float32), paint)
    return _laid(edit, at, paint)


def _predict(edit: Operating, at: Operand) -> Stamp | None:
    """Returns what is painted around, continued."""
    return None if edit.foretold is None else _laid(edit, at, edit.foretold.over(at.key.rect))


def _erase(edit: Operating, at: Operand) -> Stamp | None:
    """Nothing: paint is taken away through the textures."""
    keep = np.empty_like(ONES)
    if edit.locked or not coat.keep_of(at.weight, keep):
        return None
    return Stamp(keep, np.zeros((COLOURS, TILE, TILE), np.float32), plain=True)


def _laid(edit: Operating, at: Operand, paint: np.ndarray, inks: tuple[Instance, ...] = ()) -> Stamp | None:
    """Returns a = 1 - w, B = w times `paint`, premultiplied float32 (4 + 3n, 128, 128), which is used up; under
    alpha lock, its straight colour times the alpha that lies there, and w times its alpha."""
    keep, weight = np.empty_like(ONES), at.weight
    if edit.locked:
        weight = weight * paint[ALPHA]
        np.divide(paint, paint[ALPHA].copy(), out=paint, where=paint[ALPHA] > 0.0)
    if not coat.keep_of(weight, keep):
        return None
    add = np.empty_like(paint)
    kept = coat.weigh(keep, at.old.data[ALPHA], edit.locked, add[ALPHA])
    coat.glaze(kept, paint[:ALPHA], add[:ALPHA])
    coat.glaze(kept, paint[COLOURS:], add[COLOURS:])
    if not edit.locked:
        coat.glaze(kept, paint[ALPHA : ALPHA + 1], add[ALPHA : ALPHA + 1])
    return Stamp(keep, add, inks, plain=True)


KERNELS: dict[str, _Kernel] = {
    "toward": _toward,
    "clone": _clone,
    "displace": _displace,
    "predict": _predict,
    "erase": _erase,
}
