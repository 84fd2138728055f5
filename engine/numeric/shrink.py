"""Making pictures smaller: exact area means to any size.

Neither library at hand fits.  Pillow's box filter takes or leaves whole source pixels by their centres, so it is not an
area mean unless the ratio is whole.  skimage.transform.resize_local_mean is one (the tests compare with it), but it
multiplies by dense matrices: 88 ms where this takes 3 (1920x1080 to 256x144), and a quarter of a second to import.
"""

from __future__ import annotations

import numpy as np

from engine.numeric.kernel import kernel


def fitted_size(width: int, height: int, limit: int) -> tuple[int, int]:
    """Returns the largest size of the same shape within `limit` x `limit`, never larger than the original, at least
    1 x 1."""
    longest = max(width, height, limit)
    return max(1, round(width * limit / longest)), max(1, round(height * limit / longest))


def box_reduce(planes: np.ndarray, width: int, height: int) -> np.ndarray:
    """Returns the mean of `planes` (k, h, w) over each of height x width equal rectangles: float32 (k, height, width).

    Source pixels that lie across a border count by the area on each side (premultiplied planes stay so).  ValueError:
    the wanted size is not within 1..w, 1..h.
    """
    count, h, w = planes.shape
    if not (1 <= width <= w and 1 <= height <= h):
        raise ValueError(f"resample: found a target of {width}x{height}, expected 1x1 to {w}x{h}")
    source = np.ascontiguousarray(planes, np.float32).view()
    source.setflags(write=False)
    out = np.empty((count, height, width), np.float32)
    _reduce(source, out)
    return out


@kernel
def _reduce(planes: np.ndarray, out: np.ndarray) -> None:
    """Overlaps are counted in units of 1/width and 1/height of a pixel, so weights are integers and nothing rounds
    before the last division (values on the grid, 2^37 pixels or fewer)."""
    _, h, w = planes.shape
    k, height, width = out.shape
    line = np.empty(w, np.float64)
    for c in range(k):
        for i in range(height):
            line[:] = 0.0
            top, bottom = i * h, (i + 1) * h
            for y in range(top // height, (bottom + height - 1) // height):
                weight = np.float64(min(bottom, (y + 1) * height) - max(top, y * height))
                row = planes[c, y]
                for x in range(w):
                    line[x] += weight * row[x]
            for j in range(width):
                left, right = j * w, (j + 1) * w
                total = 0.0
                for x in range(left // width, (right + width - 1) // width):
                    total += (min(right, (x + 1) * width) - max(left, x * width)) * line[x]
                out[c, i, j] = total / (np.float64(h) * w)
