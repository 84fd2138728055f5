"""Patterns changed by hand: the histogram of a subband stretched or bent, axes of colour longer or shorter.

Heeger & Bergen 1995, section 6: each parameter of the representation may have its slider.  What is changed is what a
texture is matched to, so a louder subband sounds louder in the whole texture, and stays in its place.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from engine.numeric import histograms, shaping
from engine.numeric.colour_axes import ColourAxes
from engine.numeric.curves import Shape
from engine.numeric.steerable import Place
from engine.texture.matching import Bands, Pattern
from engine.texture.mixing import SplitColours

GAIN_CAP = 8.0


@dataclass(frozen=True, slots=True)
class Band:
    """A change of the subbands of a level, or of the one of an `orientation`: values times `gain`; their sizes, the
    largest being 1, through the curve `shaping` first.  Level -1 is the high-pass residue, `levels` the low-pass."""

    level: int
    orientation: int | None = None
    gain: float = 1.0
    shaping: Shape | None = None

    @property
    def idle(self) -> bool:
        """Tells whether the change leaves a subband as it is."""
        return self.gain == 1.0 and shaping.is_identity(self.shaping)

    def of(self, place: Place) -> bool:
        """Tells whether the change is about the subband at `place`."""
        return place.level == self.level and self.orientation in (None, place.orientation)


def adjusted(pattern: Pattern, bands: Sequence[Band], axes: Sequence[float] = ()) -> Pattern:
    """The pattern with such changes; `axes`: factors of the axes of colour, the longest first.

    Where subbands are changed, the histogram of the pixels, which would take most of it back, is not matched.
    """
    changes = [band for band in bands if not band.idle]
    if changes:
        pattern = replace(pattern, pixels=None, bands=tuple(_bent(own, changes) for own in pattern.bands))
    if any(factor != 1.0 for factor in axes):
        pattern = replace(pattern, colours=_stretched(pattern.colours, axes))
    return pattern


def _bent(bands: Bands, changes: Sequence[Band]) -> Bands:
    found = dict(bands)
    for place in found:
        for change in changes:
            if change.of(place):
                found[place] = _through(found[place], change)
    return found


def _through(ordered: np.ndarray, change: Band) -> np.ndarray:
    """Sorted values changed, and sorted again; about their mean."""
    mean = np.float32(ordered.mean(dtype=np.float64))
    values = ordered - mean
    largest = np.float32(np.abs(values).max())
    if not shaping.is_identity(change.shaping) and largest > 0.0:
        assert change.shaping is not None
        sizes = shaping.shape(np.abs(values) / largest, shaping.table(change.shaping))
        values = np.sign(values) * sizes * largest
    return histograms.sorted_values(values * np.float32(change.gain) + mean)


def _stretched(colours: object, factors: Sequence[float]) -> ColourAxes | SplitColours:
    if isinstance(colours, SplitColours):
        fine, coarse = (_longer(own, factors) for own in (colours.fine, colours.coarse))
        return replace(colours, fine=fine, coarse=coarse)
    assert isinstance(colours, ColourAxes)
    return _longer(colours, factors)


def _longer(axes: ColourAxes, factors: Sequence[float]) -> ColourAxes:
    """Axes of other lengths; the range of colours grows with them, up to 0..1."""
    given = np.ones(axes.count, np.float32)
    given[: len(factors)] = factors[: axes.count]
    wide = np.float32(max(1.0, float(given.max(initial=1.0))))
    low, high = (np.clip(axes.mean + (end - axes.mean) * wide, 0.0, 1.0) for end in (axes.low, axes.high))
    back = axes.back / np.maximum(given, np.float32(1e-6))[:, None]
    return replace(axes, axes=axes.axes * given, back=back, low=low, high=high)
