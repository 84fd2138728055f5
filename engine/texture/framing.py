"""What is large in a cube of texture, on planes that are looked at as pictures: beyond their edges are mirror images.

So an example is analysed, and so is any plane that is cut out.  Planes whose coarse subbands are those of an example as
tiles, which go on at their other end, need not have them as pictures: most of the few samples are near an edge.
"""

from __future__ import annotations

from concurrent.futures import Executor

import numpy as np

from engine.numeric import histograms, steerable
from engine.numeric.steerable import Place, finished
from engine.texture.matching import Bands, Shape

_FIRST = 2  # the finest level


class Framing:
    """What turns a cube of `side`, again and again, towards planes across its axes that are such pictures of the
    example's coarse subbands."""

    def __init__(self, side: int, shape: Shape) -> None:
        self._first = min(_FIRST, shape.levels)
        self._small = -(-side >> self._first)  # samples that such subbands need along an axis
        self._filters = steerable.filters(
            2 * self._small, 2 * self._small, shape.levels - self._first, shape.orientations
        )
        places = np.arange(self._small)
        self._lowest = np.where(places < -(-self._small // 2), places, places - self._small) % side
        self._every = np.arange(side)
        seen = np.zeros((side,) * 3, np.float32)
        for axis in range(3):
            seen[self._places(axis)] += np.float32(1.0)
        self._share = np.float32(1.0) / np.maximum(seen, np.float32(1.0))

    def turn(self, cube: np.ndarray, bands: Bands, centred: bool, threads: Executor | None = None) -> None:
        """Moves a cube (n, n, n), in place, towards the example's `bands`; `centred`: pictures have their edges in the
        middle of the cube instead of along its faces."""
        from scipy.fft import fftn, ifftn

        spectrum = fftn(cube)
        shift = self._small // 2 if centred else 0

        def change(axis: int) -> np.ndarray:
            return self._changed(spectrum[self._places(axis)], axis, bands, shift)

        whole = np.zeros_like(spectrum)
        for axis, found in enumerate(map(change, range(3)) if threads is None else threads.map(change, range(3))):
            whole[self._places(axis)] += found
        whole *= self._share
        cube += ifftn(whole, overwrite_x=True).real

    def _places(self, axis: int) -> tuple[np.ndarray, ...]:
        """The frequencies of the cube that planes across an axis see as low."""
        return np.ix_(*(self._every if k == axis else self._lowest for k in range(3)))

    def _changed(self, low: np.ndarray, axis: int, bands: Bands, shift: int) -> np.ndarray:
        """What is to be added to these frequencies."""
        from scipy.fft import fftn, ifftn

        count = self._small
        scale = np.float32((count / len(self._every)) ** 2)
        planes = np.moveaxis(ifftn(low).real * scale, axis, 0)
        planes = np.ascontiguousarray(np.roll(planes, (shift, shift), (1, 2)))

        def change(place: Place, values: np.ndarray) -> None:
            if place.level >= 0:
                histograms.match_rows(values, bands[Place(place.level + self._first, place.orientation)])

        mirrored = np.pad(planes, ((0, 0), (0, count), (0, count)), mode="symmetric")
        planes = finished(steerable.changed(mirrored, self._filters, change))[:, :count, :count] - planes
        planes = np.roll(planes, (-shift, -shift), (1, 2))
        return fftn(np.moveaxis(planes, 0, axis)) * (np.float32(1.0) / scale)
