"""How far a texture may go from where it is, below a level: what a height, a mesh or a picture of land promises.

A bound at level L is of |S_n - E..E S_L|, n being any finer level: `hard` holds for every pixel, `rms` is what it comes
to over the plane.  E is convex, so that neither grows on its way down:

* octaves that last add up, each to what its noise can be at most: for rock 3 g 2^(-H (d + 1)) / (1 - 2^-H), d being the
  depth of L, with rms g 2^(-H (d + 1)) / sqrt(1 - 4^-H);
* an edge that is sharp at every depth is off by what lies between both its sides, wherever one looks from;
* pictures add nothing past their pixels;
* a curve makes the most of it that its slope can, and what E and a bend of the curve do differently: where neighbours
  are up to D apart, a bend by s of slope leaves 3/8 s D, and D halves with every level but for what that adds.

Octaves that are renewed are raised anew at every level: for these nothing can be promised.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import lru_cache, singledispatch
from typing import NamedTuple

import numpy as np

from engine.numeric import shaping
from engine.numeric.address import Rect
from engine.numeric.arithmetic import EVERYWHERE
from engine.numeric.functions import functions
from engine.numeric.memo import remembered
from engine.numeric.wave import UNIT
from engine.texture.expression.placing.generated import Generated
from engine.texture.expression.written_ink import Expression
from engine.texture.gradient import Gradient
from engine.texture.image import Cover, Image, picture_pyramid
from engine.texture.learnt.inks import LearntImage, LearntMatched
from engine.texture.placed import PlacedInk
from engine.texture.procedural import Sawtooth, Squares, Stripes, White
from engine.texture.record import Instance
from engine.texture.rock import Rock
from engine.texture.shaped import FADED, Shaped, unshaped
from engine.texture.spectral import Sparse, Tiled

_NOISE = 3.0  # a pixel of rock's noise at most, its variance being 1
_NEAR_EDGE = 8.0  # pixels across an edge in which E differs from it, whatever its angle
_ROUNDED = 1.0 + 1e-5  # for sums of float32
_BEND = 0.375  # of a pixel and its neighbours under E: 2 (3/4) (1/4) on each axis, half of it on either side
_AWAY = 4.5  # pixels, at most, between a pixel and what E makes it of, and the widths of both


class Bound(NamedTuple):
    """`hard`: at every pixel; `rms`: over the plane; `edge`: what one level may add where levels do not add up, as at
    an edge, whose amplitude must be the same all around for `hard` to hold; else 0."""

    hard: float
    rms: float
    edge: float = 0.0


NO_MORE = Bound(0.0, 0.0)


@singledispatch
def bound(made: Instance, level: int, rect: Rect | None = None) -> Bound | None:
    """Returns how far a texture may go from where it is at a level; None where nothing is known.

    `rect`: that holds there, and may be less than all over.
    """
    raise TypeError(f"found {type(made).__name__}, expected a texture")


@bound.register
def _white(made: White, level: int, rect: Rect | None = None) -> Bound:
    return NO_MORE


@bound.register(Stripes)
@bound.register(Sawtooth)
@bound.register(Squares)
def _edges(made: Stripes | Sawtooth | Squares, level: int, rect: Rect | None = None) -> Bound:
    waves = made.edges(made.wave(max(level, made.base)))
    part = min(1.0, sum(_NEAR_EDGE * UNIT / cell for _, cell in waves))
    return Bound(2.0, 2.0 * math.sqrt(part), 2.0)


@bound.register
def _rock(made: Rock, level: int, rect: Rect | None = None) -> Bound | None:
    if made.renew or made.roughness <= 0.0:
        return None
    newest = float(made.changes(max(level, made.base) + 1)[0]) * _ROUNDED
    fall = functions(EVERYWHERE).two_to(-made.roughness)
    return Bound(_NOISE * newest / (1.0 - fall), newest / math.sqrt(1.0 - fall * fall))


@bound.register
def _gradient(made: Gradient, level: int, rect: Rect | None = None) -> Bound:
    if made.shape == "angular":
        return Bound(1.0, 1.0, 1.0)
    own = np.array(
        [[place, *(int(colour[i : i + 2] or "ff", 16) for i in (1, 3, 5, 7))] for place, colour in made.ramp]
    )
    steepest = float(np.max(np.abs(np.diff(own[:, 1:], axis=0)) / np.diff(own[:, :1], axis=0))) * 2.0 / 255.0
    x, y = made.end[0] - made.start[0], made.end[1] - made.start[1]
    finer = max(-1000, min(1000, made.level - max(level, made.base)))
    most = min(1.0, math.ldexp(_AWAY * steepest / math.sqrt(x * x + y * y), finer))
    return Bound(most, most, most)


@bound.register(Expression)
@bound.register(Generated)
def _written(made: Expression | Generated, level: int, rect: Rect | None = None) -> Bound | None:
    return None  # whatever somebody wrote


@bound.register(Image)
@bound.register(Cover)
def _picture(made: Image | Cover, level: int, rect: Rect | None = None) -> Bound:
    steps = _picture_steps(made) if made.refinements else ()
    return Bound(*_summed(steps[max(0, level - made.base) :]))


@remembered
def _picture_steps(made: Image | Cover) -> tuple[tuple[float, float], ...]:
    """Returns (most, rms) of what each of a picture's levels adds, the coarsest first."""
    sizes = [plane.shape[1:] for plane in picture_pyramid(made.source, made.period)[1:]]
    found = (made.bandpass(made.base + 1 + n, Rect(0, 0, width, height)) for n, (height, width) in enumerate(sizes))
    return tuple((0.0, 0.0) if planes is None else _sizes(planes) for planes in found)


def _sizes(planes: np.ndarray) -> tuple[float, float]:
    """Returns the largest absolute value of planes (c, h, w), and the rms of the strongest of them."""
    if not planes.size:
        return 0.0, 0.0
    power = np.square(planes, dtype=np.float64).mean(axis=(1, 2))
    return float(np.abs(planes).max()), math.sqrt(float(power.max()))


def _summed(steps: Sequence[tuple[float, float]]) -> tuple[float, float]:
    return sum(most for most, _ in steps) * _ROUNDED, sum(spread for _, spread in steps) * _ROUNDED


@bound.register
def _tiled(made: Tiled, level: int, rect: Rect | None = None) -> Bound | None:
    if not made.shown.there:
        return NO_MORE
    if getattr(made, "cover", None) is not None or made.kind.endswith("-cover"):
        return None  # alpha is sent through a curve that changes with the level
    beyond = _octaves(made, level, *_sizes(made.octave))
    if beyond is None or level >= made.native:
        return beyond
    hard, rms = _summed(_tile_steps(made)[max(0, level - made.base) :])
    return Bound(beyond.hard + hard, beyond.rms + rms)


@bound.register
def _learnt_image(made: LearntImage, level: int, rect: Rect | None = None) -> Bound:
    gone = level - made.base >= made.refinements + made.learning.there
    return NO_MORE if gone else Bound(1.0, 1.0)


@bound.register
def _learnt_matched(made: LearntMatched, level: int, rect: Rect | None = None) -> Bound | None:
    last = made.native + made.learning.there
    beyond = _tiled(made, max(level, last), rect)
    if beyond is None or level >= last:
        return beyond
    return Bound(beyond.hard + 2.0, beyond.rms + 2.0)


@lru_cache(maxsize=64)
def _tile_steps(made: Tiled) -> tuple[tuple[float, float], ...]:
    """As `_picture_steps`, of a sample."""
    whole = made.size
    levels = range(made.base + 1, made.native + 1)
    found = (made.bandpass(level, Rect(0, 0, *whole).zoomed(level - made.native)) for level in levels)
    return tuple((0.0, 0.0) if planes is None else _sizes(planes) for planes in found)


@bound.register
def _sparse(made: Sparse, level: int, rect: Rect | None = None) -> Bound | None:
    if not made.shown.there:
        return NO_MORE
    beyond = _octaves(made, level, *made.loudness(made.native + 1))
    if beyond is None or level >= made.native:
        return beyond
    own, here = (made.loudness(one) for one in (made.native, max(level, made.base)))
    most, spread = own[0] + here[0], own[1] + here[1]
    return Bound(beyond.hard + most, beyond.rms + spread, most)


def _octaves(made: Tiled | Sparse, level: int, most: float, spread: float) -> Bound | None:
    """Returns what self-similar octaves come to beyond the native level, each being `most` and `spread` before its
    weight."""
    depth = max(0, level - made.native)
    weight = made.newest(depth + 1)
    if not weight:
        return NO_MORE
    if made.raised or made.roughness >= 1.0:
        return None
    total = weight / (1.0 - made.roughness) * _ROUNDED
    return Bound(most * total, spread * total)


@bound.register
def _placed(made: PlacedInk, level: int, rect: Rect | None = None) -> Bound | None:
    return bound(made.inner, max(level, made.base) + made.levels)


@bound.register
def _shaped(made: Shaped, level: int, rect: Rect | None = None) -> Bound | None:
    inner, own = bound(made.inner, level, rect), unshaped(made)
    level = max(level, made.base)
    if isinstance(own, Image):
        gone = level - made.base >= own.refinements + FADED
        return NO_MORE if gone else Bound(1.0, 1.0, 1.0)
    if inner is None:
        return None
    curve = shaping.table(made.curve).astype(np.float64)
    if isinstance(own, White):
        return NO_MORE
    if inner.edge:
        most = 2.0 * float(np.ptp(curve))
        return Bound(most, min(most, inner.rms), most)
    slopes = np.concatenate([[0.0], np.diff(curve) * shaping.STEPS, [0.0]])  # beyond its ends it is level
    steepest, bend = float(np.abs(slopes).max()), float(np.ptp(slopes))
    apart = _apart(made.inner, level, rect)
    if apart is None:
        return None
    most, spread = apart
    return Bound(
        steepest * inner.hard + _BEND * bend * (2.0 * most + 4.0 * inner.hard),
        steepest * inner.rms + _BEND * bend * (2.0 * spread + 4.0 * inner.rms),
    )


def _apart(made: Instance, level: int, rect: Rect | None) -> tuple[float, float] | None:
    """Returns how far neighbours are apart at a level, at most and by rms; None where that is not known."""
    if rect is not None:
        seen = made.appearance(level, rect.grown(2)).astype(np.float64)
        steps = [np.abs(np.diff(seen, axis=axis)) for axis in (1, 2)]
        return max(float(step.max()) for step in steps), max(math.sqrt(float(np.square(step).mean())) for step in steps)
    if not isinstance(made, Rock):
        return None
    weights = made.weights(level).astype(np.float64)
    halves = np.ldexp(1.0, -np.arange(len(weights)))
    return float((2.0 * _NOISE * weights * halves).sum()), math.sqrt(float(np.square(2.0 * weights * halves).sum()))
