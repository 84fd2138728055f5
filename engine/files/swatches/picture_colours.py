"""The colours of a picture that stand for all of them: clustered in OkLab, the rare but different ones, too.

The clusters begin as far from one another as they can, k-means then moves each to the mean of its colours (Lloyd 1982);
OkLab after Ottosson 2020.
"""

from __future__ import annotations

import numpy as np

from engine.files.swatches.colour_list import ColourList, NamedColour
from engine.numeric.kernel import Array

MOST_SHADES = 24  # colours of a palette that is made
_SAMPLES = 1 << 18  # pixels that are looked at, about
_BITS = 5  # of a channel: so finely colours are told apart before they are clustered
_ROUNDS = 10
_APART = 0.03  # distance in OkLab below which two clusters are one
_TO_CONES = np.array(
    (
        (0.4122214708, 0.5363325363, 0.0514459929),
        (0.2119034982, 0.6806995451, 0.1073969566),
        (0.0883024619, 0.2817188376, 0.6299787005),
    )
)
_TO_LAB = np.array(
    (
        (0.2104542553, 0.7936177850, -0.0040720468),
        (1.9779984951, -2.4285922050, 0.4505937099),
        (0.0259040371, 0.7827717662, -0.8086757660),
    )
)


def picture_palette(pixels: Array, name: str, paper: tuple[float, float, float] | None = None) -> ColourList:
    """Returns a palette of at most MOST_SHADES colours, dark to light, of RGBA (h, w, 4), uint8 or uint16, alpha not
    premultiplied.  What is not opaque is seen on `paper`, or left out; nothing opaque gives no colour."""
    colours, counts = _told_apart(pixels, paper)
    if not len(colours):
        return ColourList(name, ())
    places = _lab(colours)
    own = _clustered(places, counts)
    found = []
    for cluster in range(int(own.max()) + 1):
        here = own == cluster
        if here.any():
            found.append(np.average(colours[here], axis=0, weights=counts[here]))
    found.sort(key=lambda rgb: float(_lab(rgb[None])[0, 0]))
    return ColourList(name, tuple(NamedColour((float(r), float(g), float(b))) for r, g, b in found))


def _told_apart(pixels: Array, paper: tuple[float, float, float] | None) -> tuple[Array, Array]:
    """Returns the mean colour of each cell of the cube that any pixel lies in, (n, 3), and how many do, (n,)."""
    step = max(1, int((pixels.shape[0] * pixels.shape[1] / _SAMPLES) ** 0.5))
    some = pixels[::step, ::step].reshape(-1, 4).astype(np.float64) / np.iinfo(pixels.dtype).max
    if paper is None:
        rgb = some[some[:, 3] > 0.5, :3]
    else:
        rgb = some[:, :3] * some[:, 3:] + np.array(paper) * (1.0 - some[:, 3:])
    cells = np.minimum(rgb * (1 << _BITS), (1 << _BITS) - 1).astype(np.int64)
    keys = (cells[:, 0] << 2 * _BITS) + (cells[:, 1] << _BITS) + cells[:, 2]
    _, where, counts = np.unique(keys, return_inverse=True, return_counts=True)
    sums = [np.bincount(where.reshape(-1), rgb[:, channel], len(counts)) for channel in range(3)]
    return np.stack(sums, 1) / np.maximum(counts, 1)[:, None], counts.astype(np.float64)


def _clustered(places: Array, counts: Array) -> Array:
    """Returns to which cluster each place belongs, (n,)."""
    weights = np.cbrt(counts)  # a small flower counts beside a large meadow
    middles = [places[np.argmax(counts)]]
    distances = np.sum((places - middles[0]) ** 2, 1)
    while len(middles) < MOST_SHADES:
        farthest = int(np.argmax(distances * weights))
        if distances[farthest] < _APART**2:
            break
        middles.append(places[farthest])
        distances = np.minimum(distances, np.sum((places - middles[-1]) ** 2, 1))
    found, own = np.array(middles), np.zeros(len(places), np.int64)
    for _ in range(_ROUNDS):
        own = np.argmin(np.stack([np.sum((places - middle) ** 2, 1) for middle in found]), 0)
        for cluster in range(len(found)):
            here = own == cluster
            if here.any():
                found[cluster] = np.average(places[here], axis=0, weights=counts[here])
    return own


def _lab(rgb: Array) -> Array:
    linear = np.where(rgb <= 0.04045, rgb / 12.92, ((rgb + 0.055) / 1.055) ** 2.4)
    return np.asarray(np.cbrt(linear @ _TO_CONES.T) @ _TO_LAB.T)
