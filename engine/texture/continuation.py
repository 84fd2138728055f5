"""Finer detail for a picture that has no finer pixels: noise matched, subband by subband, to its finest subbands.

Heeger & Bergen 1995, section 3.3, goes from a picture's pyramid to noise of the same size; here the noise is an octave
finer than the picture.  Its subbands have the distributions of the picture's finest ones (those of the level that is
finest among the levels that are not blurred away), along the same axes of colour, weaker by the slope by which the
picture's subbands weaken from level to level.

An octave is laid over what is there, expanded once more.  With e(f) the response of expand, which lets little pass
near its end, the octave has the part 1 - e^2 of the power: both together have the picture's spectrum carried on, and
no step where it ends.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from engine.numeric import histograms, steerable
from engine.numeric.address import Rect
from engine.numeric.arithmetic import LIBRARY
from engine.numeric.array_functions import array_functions
from engine.numeric.colour_axes import ColourAxes, combined
from engine.numeric.functions import functions
from engine.numeric.memo import remembered
from engine.numeric.steerable import Place
from engine.texture import sample
from engine.texture.image import ImageSource
from engine.texture.matching import Pattern, Shape, analysed, noise

OCTAVE_SIDE = 256  # pixels of an octave's tile each way
LOOKED_AT = 1024  # pixels of a picture each way that are looked at
# Slopes, amplitude of an octave to that of the one before.  Octaves that are as strong as one another, as those of
# 1/f noise, would add up to ever more contrast.
STEEPEST, EVENEST = 0.1, 0.85

_SHAPE = Shape("steerable", 4, 4)
_OCTAVES = 3  # of a tile: below them, an octave has no part
_ITERATIONS = 4
_BLURRED = 0.25  # of what the slope foretells: a level below is not looked at
_LOUDEST = 0.35  # slope beyond which the lower octaves of a tile are not raised any more
_QUANTILES = 4096
_USUAL = 0.5  # where a picture is too small to measure a slope


@dataclass(frozen=True, eq=False, slots=True)
class Octave:
    """`tile`: float32 (1 or 3 colours and alpha, 256, 256), periodic, of mean zero, in units of S, as strong as the
    octave at the end of the picture's own pixels would be; `slope`: of the picture's subbands, amplitude per octave,
    0.1..0.85."""

    tile: np.ndarray
    slope: float


@remembered
def octave_of(source: ImageSource, arithmetic: int = LIBRARY) -> Octave:
    """Returns what continues a picture."""
    count = 3 if sample.coloured(source) else 1
    # What is opaque is looked at without its alpha: another channel would be another sum of float32 numbers.
    channels = [*range(count), *([] if source.opaque else [3])]
    looked_at = source.whole.intersect(Rect(0, 0, LOOKED_AT, LOOKED_AT))
    picture = np.ascontiguousarray(source.planes(looked_at)[channels])
    pattern = analysed(picture, replace(_SHAPE, arithmetic=arithmetic))
    if not pattern.shape.levels or not pattern.bands:
        return Octave(np.zeros((count + 1, OCTAVE_SIDE, OCTAVE_SIDE), np.float32), _USUAL)
    finest, slope = measured(pattern)
    axes = pattern.colours
    assert isinstance(axes, ColourAxes)
    planes = _filtered(_noise(pattern, finest, slope), arithmetic)
    if arithmetic == LIBRARY:
        tile = 2.0 * np.einsum("cr,rhw->chw", axes.axes, planes)
    else:
        tile = np.float32(2.0) * combined(axes.axes, planes, np.zeros(len(axes.axes)))
    tile -= array_functions(arithmetic).mean(tile, axis=(1, 2), keepdims=True)
    tile = np.concatenate([tile, np.zeros((count + 1 - len(tile), OCTAVE_SIDE, OCTAVE_SIDE))]).astype(np.float32)
    tile.flags.writeable = False
    return Octave(tile, slope)


def slope_of(picture: np.ndarray, arithmetic: int) -> tuple[int, float]:
    """Returns the finest level of a picture (C, h, w) that is not blurred away, and the slope from there on."""
    pattern = analysed(picture, replace(_SHAPE, arithmetic=arithmetic))
    return measured(pattern) if pattern.shape.levels and pattern.bands else (0, _USUAL)


def measured(pattern: Pattern) -> tuple[int, float]:
    """Returns the finest level that is not blurred away, and the slope from there on: amplitude per octave."""
    strengths, arithmetic = _strengths(pattern), pattern.shape.arithmetic
    for finest in range(min(2, len(strengths) - 2)):
        slope = _slope(strengths[finest + 1 :], arithmetic)
        if strengths[finest] >= _BLURRED * slope * strengths[finest + 1]:
            return finest, _slope(strengths[finest:], arithmetic)
    finest = max(0, min(2, len(strengths) - 2))
    return finest, _slope(strengths[finest:], arithmetic)


def _strengths(pattern: Pattern) -> list[float]:
    """Returns the standard deviation of each level's subbands together, colours being 0..1, from the finest."""
    axes, shape = pattern.colours, pattern.shape
    mean = array_functions(shape.arithmetic).mean
    assert isinstance(axes, ColourAxes)
    lengths = np.square(axes.axes, dtype=np.float64).sum(axis=0)
    return [
        math.sqrt(
            sum(
                float(length) * float(mean(np.square(bands[Place(level, k)], dtype=np.float64)))
                for length, bands in zip(lengths, pattern.bands, strict=True)
                for k in range(shape.orientations)
            )
        )
        for level in range(shape.levels)
    ]


def _slope(strengths: list[float], arithmetic: int) -> float:
    """Returns how steep a line through their logarithms is."""
    if len(strengths) < 2 or min(strengths) <= 0.0:
        return _USUAL
    own = functions(arithmetic)
    if arithmetic == LIBRARY:
        fall = float(np.polyfit(np.arange(len(strengths)), np.log2(strengths), 1)[0])
    else:
        places = [k - (len(strengths) - 1) / 2.0 for k in range(len(strengths))]
        fall = sum(x * own.log2(y) for x, y in zip(places, strengths, strict=True)) / sum(x * x for x in places)
    out: float = round(min(max(own.two_to(-fall), STEEPEST), EVENEST), 4)
    return out


def _noise(pattern: Pattern, finest: int, slope: float) -> np.ndarray:
    """Returns planes (R, 256, 256) along the axes, whose subbands are distributed as the finest ones of the pattern;
    those of lower octaves stronger, as the slope tells."""
    arithmetic = pattern.shape.arithmetic
    made = steerable.filters(OCTAVE_SIDE, OCTAVE_SIDE, _OCTAVES, _SHAPE.orientations, arithmetic)
    rise, power = max(slope, _LOUDEST), functions(arithmetic).power
    rest = _rest(made, rise)

    def wanted(axis: int, place: Place) -> np.ndarray:
        bands = pattern.bands[axis]
        if place.level < 0 and not finest:
            return bands[place]
        ordered = bands[Place(finest, max(place.orientation, 0))]
        return ordered * np.float32(power(slope, finest) * (rest if place.level < 0 else power(rise, -place.level)))

    targets = {
        place: [histograms.quantiles(wanted(axis, place), _QUANTILES) for axis in range(len(pattern.bands))]
        for place in steerable.places(_OCTAVES, _SHAPE.orientations)[:-1]
    }

    def change(place: Place, values: np.ndarray) -> None:
        for axis, plane in enumerate(values):
            if place.level == _OCTAVES:
                plane[:] = 0.0
            else:
                histograms.match(plane, targets[place][axis])

    planes = noise(len(pattern.bands), (OCTAVE_SIDE, OCTAVE_SIDE), 0)
    for _ in range(_ITERATIONS):
        planes = steerable.finished(steerable.changed(planes, made, change))
    return planes


def _rest(made: steerable.Filters, slope: float) -> float:
    """Tells how strong the high-pass residue is to one subband of the finest level, in noise of that slope."""
    own, v, u = (
        array_functions(made.arithmetic),
        np.fft.fftfreq(OCTAVE_SIDE)[:, None],
        np.fft.rfftfreq(OCTAVE_SIDE)[None],
    )
    f = np.maximum(own.distance(u, v), 1.0 / OCTAVE_SIDE)
    power = own.powers(f, -2.0 * (1.0 - own.single.log2(slope)))
    high = float(own.total(np.square(made.high) * power))
    return math.sqrt(high / float(own.total(np.square(made.bands[0]) * power) / made.orientations))


def _filtered(planes: np.ndarray, arithmetic: int) -> np.ndarray:
    """Without what expand lets pass of a coarser level: the part 1 - e^2 of the power stays."""
    rows, columns = (_response(f, arithmetic) for f in (np.fft.fftfreq(OCTAVE_SIDE), np.fft.rfftfreq(OCTAVE_SIDE)))
    e = rows[:, None] * columns[None]
    part = np.sqrt(np.maximum(1.0 - e * e, 0.0)).astype(np.float32)
    spectrum = array_functions(arithmetic).turned(steerable.spectrum(planes, arithmetic), part)
    return steerable.image(spectrum, (OCTAVE_SIDE, OCTAVE_SIDE), True, arithmetic)


def _response(f: np.ndarray, arithmetic: int) -> np.ndarray:
    """Of expand (1, 3, 3, 1)/4 along an axis, f in cycles per pixel of the finer level."""
    cosine = array_functions(arithmetic).cos(np.pi * f)
    return cosine**3 if arithmetic == LIBRARY else cosine * cosine * cosine
