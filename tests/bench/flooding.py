"""The region of like colour that a pixel lies in, against labelling all regions of the same picture."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from bench import Figure, Skipped
from bench.clock import processor
from engine.numeric.flood import Likeness, region

REPEATS, GAP, TOLERANCE = 5, 40, 0.1
# By width and height: times of labelling that a region may take, without gaps closed and with.
SIZES = {(1920, 1080): (2.6, 5.3), (4096, 4096): (4.1, 13.0)}


def measure(small: bool = False) -> Iterator[Figure | Skipped]:
    try:
        from scipy import ndimage
    except ImportError:
        yield Skipped("flood", "scipy is not installed")
        return
    for (width, height), limits in {(200, 150): (1e3, 1e3)}.items() if small else SIZES.items():
        picture = _lines(width, height)
        free = picture[3] <= TOLERANCE
        place = width // 2, height // 2
        works = (
            lambda: region(picture, *place, Likeness(TOLERANCE)),  # noqa: B023
            lambda: region(picture, *place, Likeness(TOLERANCE, GAP)),  # noqa: B023
            lambda: ndimage.label(free),  # noqa: B023
        )
        for work in works:
            work()
        times = [[processor(work) for work in works] for _ in range(1 if small else REPEATS)]
        *own, label = (max(1e-6, min(column)) for column in zip(*times, strict=True))
        for taken, limit, name in zip(own, limits, ("", f", gaps of {GAP} closed"), strict=True):
            found = f"flood {width} x {height}{name}"
            yield Figure(found, taken * 1e3, "ms", "scipy's label of the same", taken / label, limit)


def _lines(width: int, height: int) -> np.ndarray:
    """A picture of soft rings, their middles in its lower half, and a large free region around its middle."""
    random = np.random.default_rng(1)
    y, x = np.mgrid[:height, :width]
    alpha = np.zeros((height, width), np.float32)
    for _ in range(24):
        middle, radius = random.uniform((0.0, 0.6 * height), (width, height)), random.uniform(0.02, 0.25) * height
        far = np.abs(np.hypot(x - middle[0], y - middle[1]) - radius)
        np.maximum(alpha, np.clip(3.0 - far, 0.0, 1.0), out=alpha, casting="same_kind")
    picture = np.zeros((4, height, width), np.float32)
    picture[3] = alpha
    return picture
