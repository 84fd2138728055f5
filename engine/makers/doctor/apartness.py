"""How like an example a texture is: by joint statistics, and by whether its patches could be the example's."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from engine.makers.doctor.measuring import grey_of
from engine.numeric.pyramid import reduce
from engine.texture.structure.copied import copied_part, nearest_patches
from engine.texture.structure.statistics import bands_measured, unlike

_SCALES = 3
_KINDS = 4  # of statistics at each
_COARSER = 2  # octaves above its finest in which patches are looked at, besides


@dataclass(frozen=True, slots=True)
class Likeness:
    """`statistics`: how far joint statistics are off, in parts of the example's; `patches`: how far patches are from
    the nearest of the example's, in parts of its variance; `copied`: the part of them that are the example's."""

    statistics: float
    patches: float
    copied: float

    @property
    def apart(self) -> float:
        """Gives one number for how far off a texture is, copies not counted."""
        return self.statistics + self.patches


def likeness(example: np.ndarray, texture: np.ndarray) -> Iterator[Likeness | None]:
    """Yields None after each piece of work, and last how like an example (C, h, w) a texture (C', h, w) is."""
    one, other = grey_of(example), grey_of(texture)
    deviation = max(float(one.std(dtype=np.float64)), 1e-6)
    far = unlike(*(bands_measured(_planes(plane, deviation), _SCALES) for plane in (other, one)))
    yield None
    patches, copied, count = 0.0, 0.0, 0
    for octave in range(_COARSER + 1):
        if octave:
            one, other = (reduce(_even(plane)[None])[0] for plane in (one, other))
        best = np.zeros(0, np.float32)
        for found in nearest_patches(one[None], other[None]):
            best = best if found is None else found
            yield None
        if best.size:
            patches += float(best.mean(dtype=np.float64)) / max(float(one.var(dtype=np.float64)), 1e-9)
            count += 1
        copied = copied if octave else copied_part(one[None], best)
    yield Likeness(far / (_SCALES * _KINDS), patches / max(count, 1), copied)


def _planes(grey: np.ndarray, deviation: float) -> np.ndarray:
    out: np.ndarray = ((grey - grey.mean(dtype=np.float64)) / deviation).astype(np.float32)[None]
    return out


def _even(plane: np.ndarray) -> np.ndarray:
    """Returns a plane of even sides, of two pixels at least."""
    height, width = plane.shape
    plane = np.pad(plane, ((0, max(0, 2 - height)), (0, max(0, 2 - width))), mode="edge")
    return np.ascontiguousarray(plane[: plane.shape[0] // 2 * 2, : plane.shape[1] // 2 * 2])
