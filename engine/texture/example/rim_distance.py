"""How far inside a region its pixels lie, up to a width: by steps of 3 to the side and 4 aslant (Borgefors 1986,
"Distance transformations in digital images"), so that it is the same in whatever rectangle it is looked at."""

from __future__ import annotations

import numpy as np

from engine.numeric.kernel import Int, uncounted

_BINS = 32  # steps that are told apart: what lies deeper changes less often as a region grows


@uncounted
def rim_distance(mask: np.ndarray, width: Int, n: Int, out: np.ndarray) -> None:
    """Writes how far from the nearest pixel outside each of a mask, uint8 (h, w), lies: uint8 (h, w), 0 outside, to
    255 from `width` pixels of level 0 on; the mask is one of level `n`.

    Right up to `width` pixels from the edges: beyond these nothing is outside.
    """
    height, wide = mask.shape
    far = np.int32(min(254, max(3, (3 * width) >> n)))
    for turn in range(2):
        for i in range(height):
            y = i if turn == 0 else height - 1 - i
            back = -1 if turn == 0 else 1
            for j in range(wide):
                x = j if turn == 0 else wide - 1 - j
                if mask[y, x] == 0:
                    out[y, x] = 0
                    continue
                least = far if turn == 0 else np.int32(out[y, x])
                if 0 <= x + back < wide:
                    least = min(least, np.int32(out[y, x + back]) + 3)
                if 0 <= y + back < height:
                    least = min(least, np.int32(out[y + back, x]) + 3)
                    if x > 0:
                        least = min(least, np.int32(out[y + back, x - 1]) + 4)
                    if x + 1 < wide:
                        least = min(least, np.int32(out[y + back, x + 1]) + 4)
                out[y, x] = least
    for y in range(height):
        for x in range(wide):
            step = np.int32(out[y, x]) * _BINS // far
            out[y, x] = min(255, step * (256 // _BINS))
