"""How far land may be from its heights at a level: what finer levels still bring.

With A the largest brightness of an ink's amplitudes around a rectangle, and |r_k| the largest brightness that is stored
at a finer level k there,

    |h_n - E..E h_L| <= scale (sum over inks of A hard(ink, L) + sum over k > L of |r_k|)

for every finer level n: E is convex, so that amplitudes grow nowhere on their way down.  Where what an ink adds does
not add up but comes and goes, as at its edges, amplitudes of neighbours D apart leave 4 D more.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from engine.canvas import growth
from engine.canvas.attenuate import effective
from engine.canvas.evaluate import evaluate
from engine.canvas.layers import Layer
from engine.canvas.tile_cache import TileCache
from engine.numeric.address import Rect
from engine.terrain.layer_heights import FINEST_GRID, LUMINANCES, luma
from engine.texture.bounding import bound
from engine.texture.planes import COLOURS
from engine.texture.record import Instance

_ROUND_ABOUT = 3  # pixels around a rectangle that have a part in what lies below it
_STEPS_APART = 4.0  # steps from pixel to pixel within what one pixel is made of
_GRID = 64 * 2.0**-FINEST_GRID  # what rounding at each of its levels comes to


class Remainder(NamedTuple):
    """How far heights may still go: `hard` at every pixel, `rms` over the plane."""

    hard: float
    rms: float


class _Laid(NamedTuple):
    """An ink at a level: its amplitude at most, and how far neighbours are apart; `usual`: the root of its mean square,
    which E, as a mean of neighbours, makes no larger."""

    ink: Instance
    amplitude: float
    apart: float
    usual: float


def layer_bound(
    layer: Layer, ground: float, level: int, rect: Rect, cache: TileCache | None = None
) -> Remainder | None:
    """Returns how far the brightness of a layer, with `ground` where nothing is painted, may go below a level; None
    where nothing is known."""
    around, pyramid = rect.grown(_ROUND_ABOUT), layer.pyramid
    if layer.growth and growth.meets(layer.growth, level, around):
        return None
    # Heights lie on a grid of their own, from level 0 up on the canvas'.
    hard = rms = _GRID + max(0, -level) * float(pyramid.step)
    for laid in _inks(layer, level, around, rect.area, cache):
        found = _of_ink(laid, level, rect)
        if found is None:
            return None
        hard, rms = hard + found.hard, rms + found.rms
    power = 0.0
    for finer in sorted(k for k in pyramid.levels if k > level):
        for stored, inks in _stored(layer, finer, around.zoomed(finer - level), ground):
            found = _of_inks(inks, finer - 1)
            if found is None:
                return None
            hard, rms, power = hard + stored.hard + found.hard, rms + found.rms, power + stored.rms**2
    return Remainder(hard, min(hard, rms + math.sqrt(power)))


def nothing_lies(layer: Layer, level: int, rect: Rect, cache: TileCache | None = None) -> bool:
    """Tells whether a layer is empty around a rectangle, at all finer levels too."""
    around, pyramid = rect.grown(_ROUND_ABOUT), layer.pyramid
    if layer.growth and growth.meets(layer.growth, level, around):
        return False
    if any(pyramid.has_records(k, around.zoomed(k - level)) for k in pyramid.levels if k > level):
        return False
    return not evaluate(pyramid, level, around, cache).data.any()


def _inks(layer: Layer, level: int, around: Rect, area: int, cache: TileCache | None) -> list[_Laid]:
    """The inks around a rectangle of so many pixels, to which all that lies around is counted."""
    planes = evaluate(layer.pyramid, level, around, cache)
    found = []
    for i, ink in enumerate(planes.inks):
        amplitude = luma(np.abs(planes.data[COLOURS + 3 * i : COLOURS + 3 * i + 3]))
        if amplitude.any():
            steps = (np.abs(np.diff(amplitude, axis=axis)) for axis in (0, 1))
            apart = max(float(step.max()) for step in steps) + float(layer.pyramid.step)
            most, usual = float(amplitude.max()), math.sqrt(float((amplitude * amplitude).sum()) / area)
            found.append(_Laid(ink, most, apart, min(most, usual)))
    return found


def _of_ink(laid: _Laid, level: int, rect: Rect | None) -> Remainder | None:
    own = rect if rect is not None and level >= laid.ink.base else None
    found = bound(laid.ink, level, own)
    if found is None:
        return None
    return Remainder(laid.amplitude * found.hard + _STEPS_APART * laid.apart * found.edge, laid.usual * found.rms)


def _of_inks(inks: list[_Laid], level: int) -> Remainder | None:
    hard = rms = 0.0
    for laid in inks:
        found = _of_ink(laid, level, None)
        if found is None:
            return None
        hard, rms = hard + found.hard, rms + found.rms
    return Remainder(hard, rms)


def _stored(layer: Layer, level: int, rect: Rect, ground: float) -> list[tuple[Remainder, list[_Laid]]]:
    """Returns what a level stores in a rectangle: its brightness, and the most of the amplitudes of its inks."""
    most, power, step, laid = 0.0, 0.0, float(layer.pyramid.step), dict[Instance, float]()
    for key, record in layer.pyramid.records(level, rect):
        now = effective(layer.pyramid, key, record)
        data = np.abs(now.data.astype(np.float64)) * step
        bright = luma(data) + abs(ground) * data[COLOURS - 1]
        most, power = max(most, float(bright.max(initial=0.0))), power + float((bright * bright).sum())
        for i, ink in enumerate(now.inks):
            planes = data[COLOURS + 3 * i : COLOURS + 3 * i + 3]
            brightest = sum(
                weight * float(plane.max(initial=0.0)) for weight, plane in zip(LUMINANCES, planes, strict=True)
            )
            laid[ink] = max(laid.get(ink, 0.0), brightest)
    inks = [_Laid(ink, amplitude, 2.0 * amplitude, amplitude) for ink, amplitude in laid.items() if amplitude]
    stored = Remainder(most, min(most, math.sqrt(power / rect.area)))
    return [(stored, inks)] if most or inks else []
