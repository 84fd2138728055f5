"""Mixtures of two textures (Heeger & Bergen 1995, section 5): patterns to be matched like those of a single example."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from engine.numeric import colour_axes, histograms, laplacian, steerable
from engine.numeric.colour_axes import ColourAxes, aligned, axes_of
from engine.texture.matching import Bands, Pattern, Shape, analysed, filters_for

_NOTHING = np.zeros(1, np.float32)  # the values of an axis that an example has not


@dataclass(frozen=True, slots=True)
class Mix:
    """`weight` 0..1: how much of the second example; `split`: subbands of levels below it are the second's."""

    weight: float = 0.5
    split: int = 2


@dataclass(frozen=True, slots=True, eq=False)
class SplitColours:
    """Fine detail in the colours of one example, the rest in those of another: subbands of levels below `split` are
    fine."""

    fine: ColourAxes
    coarse: ColourAxes
    shape: Shape
    split: int

    @property
    def count(self) -> int:
        """Counts the axes of colour of both examples together."""
        return max(self.fine.count, self.coarse.count)

    def colours(self, planes: np.ndarray) -> np.ndarray:
        """Returns the colours (C, h, w) of planes (R, h, w), within the range of the two examples' together:
        float32."""
        fine, coarse = (colour_axes.like(own, other) for own, other in self._both())
        rest = coarsened(planes, self.shape, self.split)
        out = coarse.unclipped(rest) + fine.unclipped(planes - rest) - fine.mean.reshape(-1, 1, 1)
        low, high = np.minimum(fine.low, coarse.low), np.maximum(fine.high, coarse.high)
        result: np.ndarray = np.clip(out, low.reshape(-1, 1, 1), high.reshape(-1, 1, 1))
        return result

    def _both(self) -> tuple[tuple[ColourAxes, ColourAxes], tuple[ColourAxes, ColourAxes]]:
        return (self.fine, self.coarse), (self.coarse, self.fine)


def coarsened(planes: np.ndarray, shape: Shape, split: int) -> np.ndarray:
    """Returns planes (R, h, w) without their subbands of levels below `split`."""
    if shape.kind == "laplacian":
        pyramid = laplacian.build(planes, shape.levels)
        return laplacian.collapse([np.zeros_like(b) if k < split else b for k, b in enumerate(pyramid)])
    made = filters_for(planes, shape)

    def change(place: steerable.Place, values: np.ndarray) -> None:
        if place.level < split:
            values[:] = 0.0

    return steerable.finished(steerable.changed(planes, made, change))


def palette(first: np.ndarray, second: np.ndarray, shape: Shape, mix: Mix) -> Pattern:
    """Returns the colours of the first example with the pattern of the second (figure 6)."""
    pattern = analysed(second, shape)
    assert isinstance(pattern.colours, ColourAxes)
    return replace(
        pattern,
        colours=colour_axes.counted(aligned(axes_of(first, shape.arithmetic), pattern.colours), pattern.colours.count),
    )


def bands(first: np.ndarray, second: np.ndarray, shape: Shape, mix: Mix) -> Pattern:
    """Returns the low frequencies of the first example under the high ones of the second, each in its own colours."""
    coarse, fine = _both(first, second, shape)
    split = mix.split
    if split > coarse.shape.levels or split < 0:  # the mean colour goes with the coarsest subband
        return fine if split > 0 else coarse
    colours = SplitColours(_axes(fine), _axes(coarse), coarse.shape, split)
    joined = tuple(
        {place: _band(fine if place.level < split else coarse, axis, place) for place in coarse.shape.places()}
        for axis in range(colours.count)
    )
    return Pattern(colours, coarse.shape, None, joined)


def average(first: np.ndarray, second: np.ndarray, shape: Shape, mix: Mix) -> Pattern:
    """Between the two: values of the same rank, in each histogram, and colours are averaged by the weight."""
    a, b = _both(first, second, shape)
    colours = colour_axes.blended(_axes(a), _axes(b), mix.weight)
    count = range(colours.count)
    pixels = tuple(histograms.blended(_pixels(a, k), _pixels(b, k), mix.weight) for k in count)
    joined: tuple[Bands, ...] = tuple(
        {p: histograms.blended(_band(a, k, p), _band(b, k, p), mix.weight) for p in a.shape.places()} for k in count
    )
    return Pattern(colours, a.shape, pixels, joined)


def _both(first: np.ndarray, second: np.ndarray, shape: Shape) -> tuple[Pattern, Pattern]:
    """Returns the patterns of both, along axes that point to the same sides."""
    shape = shape.within(first.shape[1:], second.shape[1:])
    own = axes_of(first, shape.arithmetic)
    return analysed(first, shape, own), analysed(second, shape, aligned(axes_of(second, shape.arithmetic), own))


def _axes(pattern: Pattern) -> ColourAxes:
    assert isinstance(pattern.colours, ColourAxes)
    return pattern.colours


def _pixels(pattern: Pattern, axis: int) -> np.ndarray:
    assert pattern.pixels is not None
    return pattern.pixels[axis] if axis < len(pattern.pixels) else _NOTHING


def _band(pattern: Pattern, axis: int, place: steerable.Place) -> np.ndarray:
    return pattern.bands[axis][place] if axis < len(pattern.bands) else _NOTHING


Mixer = Callable[[np.ndarray, np.ndarray, Shape, Mix], Pattern]
MIXES: dict[str, Mixer] = {"palette": palette, "bands": bands, "average": average}
