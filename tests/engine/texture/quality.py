"""How alike two textures are, as far as the histograms of their subbands tell."""

from __future__ import annotations

import numpy as np

from engine.numeric import histograms
from engine.numeric.colour_axes import ColourAxes
from engine.texture.matching import Pattern, Shape, analysed

LEAST = 1e-4  # subbands of a smaller standard deviation, the axis's being 1, say nothing


def unlikeness(picture: np.ndarray, example: np.ndarray, shape: Shape | None = None) -> float:
    """The mean over subbands and channels of the 1-Wasserstein distance between the histograms of two pictures
    (C, h, w), each in units of the example's standard deviation there.

    0 for the example itself; the distance of noise of the example's own histogram is what there is to be closed.
    """
    shape = (shape or Shape()).within(picture.shape[1:], example.shape[1:])
    axes = channels_of(example)
    return _mean_distance(analysed(picture, shape, axes), analysed(example, shape, axes))


def _mean_distance(found: Pattern, wanted: Pattern) -> float:
    distances = []
    for own, bands in zip(found.bands, wanted.bands, strict=True):
        for place, ordered in bands.items():
            spread = float(ordered.std(dtype=np.float64))
            if spread > LEAST:
                distances.append(histograms.distance(own[place], ordered) / spread)
    return float(np.mean(distances)) if distances else 0.0


def channels_of(picture: np.ndarray) -> ColourAxes:
    """The channels themselves as axes."""
    count = len(picture)
    whole = np.eye(count, dtype=np.float32)
    return ColourAxes(np.zeros(count, np.float32), whole, whole, np.zeros(count), np.ones(count))


def noise_like(axes: ColourAxes, values: tuple[np.ndarray, ...], white: np.ndarray) -> np.ndarray:
    """White planes (R, h, w) given the histograms `values` and the colours of an example: (C, h, w)."""
    planes = white.copy()
    for plane, ordered in zip(planes, values, strict=True):
        histograms.match(plane, ordered)
    return axes.colours(planes)
