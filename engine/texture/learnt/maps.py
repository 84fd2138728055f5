"""What was learnt of a picture: linear maps from the neighbourhood of a pixel, and from noise, to what its four finer
pixels differ by.

There is a pair of maps for each kind of neighbourhood: how steep it is, and which way.  All numbers are multiples of
2^-12, maps_fitted once and kept beside the picture, as one: three numbers a pixel.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from itertools import pairwise

import numpy as np

from engine.numeric.grid import Q
from engine.texture.image import ImageSource

HEADINGS, STEEPS = 8, 4  # directions and slopes that are told apart
NEIGHBOURHOODS = (HEADINGS + 1) * STEEPS  # with neighbourhoods that have no direction
TAPPED = 5  # pixels of a neighbourhood each way
TAPS = TAPPED * TAPPED
NOISY = 9  # pixels whose noise counts, three numbers each
LANES = 4  # room for three differences: across, down, and crosswise
MAP_STEP = np.float32(2.0**-12)

_MOST = (1 << 15) - 1
_MIDDLE = 1 << 15
_VERSION = 1
_SIDE = 64  # pixels across the picture that they are kept as


@dataclass(frozen=True, eq=False, slots=True)
class Maps:
    """For C channels of colour (the last of 4 is alpha) and R axes.

    `axes`: (R, C), unit vectors; `edges` (STEEPS - 1,): the slopes between kinds, as `kinds.kinds_of` has them, and how
    strong noise is in the first octave and in the second: `loud` (2,).  For each kind and axis, `sharp` (..., TAPS,
    LANES): from what neighbours differ by from the pixel; `rough` (..., 3 NOISY, LANES): from noise of variance 1.  All
    float32.
    """

    axes: np.ndarray
    edges: np.ndarray
    loud: np.ndarray
    sharp: np.ndarray
    rough: np.ndarray

    @property
    def channels(self) -> int:
        """Counts the channels of colour."""
        count: int = self.axes.shape[1]
        return count


def nothing_learnt(axes: np.ndarray) -> Maps:
    """Returns maps along axes by which four finer pixels are the one that they lie in."""
    lanes = (NEIGHBOURHOODS, len(axes))
    sharp, rough = np.zeros((*lanes, TAPS, LANES), np.float32), np.zeros((*lanes, 3 * NOISY, LANES), np.float32)
    return Maps(axes, np.zeros(STEEPS - 1, np.float32), np.zeros(2, np.float32), sharp, rough)


def rounded(values: np.ndarray) -> np.ndarray:
    """Returns the nearest multiples of 2^-12 that are kept: float32."""
    out: np.ndarray = (np.clip(np.rint(values / float(MAP_STEP)), -_MOST, _MOST) * float(MAP_STEP)).astype(np.float32)
    return out


def as_picture(name: str, maps: Maps) -> ImageSource:
    """Returns maps as the picture that files have."""
    axes, channels = maps.axes.shape
    numbers = (maps.axes, maps.edges, maps.loud, maps.sharp[..., :3], maps.rough[..., :3])
    steps = [np.rint(part.reshape(-1) / MAP_STEP).astype(np.int64) for part in numbers]
    flat = np.concatenate([[_VERSION, axes, channels], *steps])
    height = -(-flat.size // (3 * _SIDE))
    data = np.ones((4, height, _SIDE), np.float32)
    data[:3] = np.float32(Q * _MIDDLE)
    data[:3].reshape(-1)[: flat.size] = (flat + _MIDDLE) * np.float32(Q)
    return ImageSource.of(name, data)


@lru_cache(maxsize=16)
def maps_of(source: ImageSource) -> Maps | None:
    """Returns the maps that a picture holds; None if it is none of these."""
    if not source.there or source.width != _SIDE:
        return None
    flat = np.rint(source.planes(source.whole)[:3].reshape(-1) / np.float32(Q)).astype(np.int64) - _MIDDLE
    version, axes, channels = flat[:3].tolist() if flat.size > 3 else (0, 0, 0)
    if version != _VERSION or channels not in (1, 3, 4) or not 0 <= axes <= channels:
        return None
    shapes = [
        (axes, channels),
        (STEEPS - 1,),
        (2,),
        (NEIGHBOURHOODS, axes, TAPS, 3),
        (NEIGHBOURHOODS, axes, 3 * NOISY, 3),
    ]
    ends = np.cumsum([3, *(int(np.prod(shape)) for shape in shapes)]).tolist()
    if flat.size < ends[-1]:
        return None
    parts = [flat[a:b].astype(np.float32) * MAP_STEP for (a, b) in pairwise(ends)]
    own = [part.reshape(shape) for part, shape in zip(parts, shapes, strict=True)]
    return Maps(*own[:3], *(_in_lanes(part) for part in own[3:]))


def _in_lanes(values: np.ndarray) -> np.ndarray:
    out = np.zeros((*values.shape[:-1], LANES), np.float32)
    out[..., :3] = values
    return out
