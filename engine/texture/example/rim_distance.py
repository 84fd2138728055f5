"""How far inside a region its pixels lie, up to a width: by steps of 3 to the side and 4 aslant (Borgefors 1986,
"Distance transformations in digital images"), so that it is the same in whatever rectangle it is looked at."""

from __future__ import annotations

import numpy as np

from engine.numeric.kernel import Int, inner_uncounted, uncounted

_BINS = 32  # steps that are told apart: what lies deeper changes less often as a region grows


def rim_distance(mask: np.ndarray, width: int, n: int, out: np.ndarray) -> None:
    """Writes how far from the nearest pixel outside each of a mask, uint8 (h, w), lies: uint8 (h, w), 0 outside, to
    255 from `width` pixels of level 0 on; the mask is one of level `n`.

    Right up to `width` pixels from the edges: beyond these nothing is outside.
    """
    far = min(254, max(3, (3 * width) >> n))
    rows = np.full((2, mask.shape[1] + 2), far, np.int16)  # with a pixel more at each end, to which nothing is near
    steps = np.minimum(np.arange(far + 1) * _BINS // far * (256 // _BINS), 255).astype(np.uint8)
    _go_over(mask, np.int16(far), rows, steps, out)


@uncounted
def _go_over(mask: np.ndarray, far: Int, rows: np.ndarray, steps: np.ndarray, out: np.ndarray) -> None:
    height, wide = mask.shape
    for i in range(height):
        before, now = rows[i & 1], rows[1 - (i & 1)]
        _nearer(before, now, far)
        inside, row = mask[i], out[i]
        least = far
        for x in range(wide):
            least = min(now[x + 1], np.int16(least + 3)) if inside[x] else np.int16(0)
            now[x + 1] = least
            row[x] = least
    rows[:] = far
    for i in range(height):
        before, now = rows[i & 1], rows[1 - (i & 1)]
        _nearer(before, now, far)
        row = out[height - 1 - i]
        least = far
        for j in range(wide):
            x = wide - 1 - j
            least = min(min(now[x + 1], np.int16(least + 3)), np.int16(row[x]))
            now[x + 1] = least
        for x in range(wide):
            row[x] = steps[now[x + 1]]


@inner_uncounted
def _nearer(before: np.ndarray, now: np.ndarray, far: Int) -> None:
    """Writes how far pixels of a row are by the row before, and no farther than `far`."""
    for x in range(1, before.size - 1):
        aslant = np.int16(min(before[x - 1], before[x + 1]) + 1)
        now[x] = min(np.int16(min(before[x], aslant) + 3), far)
