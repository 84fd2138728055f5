"""How far all rays of a block of a picture pass over land: where each of them need not look for it.

A beam is what lies between four rays from the eye, its corners.  At the same multiple of these its rays lie in a
parallelogram, so that the box around the corners at two multiples holds all of them in between.
"""

from __future__ import annotations

import math

import numpy as np

from engine.numeric.kernel import inner_uncounted
from engine.terrain.caster import CELLS_PER_PIXEL

_NARROWEST, _WIDEST = 0.8, 1.2  # of a pixel's growth along a ray: how samples differ in it
_STEPS = 0.5  # of a beam's width: the shortest


@inner_uncounted
def _overlooks(
    heights: np.ndarray,
    tops: np.ndarray,
    mips: np.ndarray,
    places: np.ndarray,
    box: np.ndarray,
    cone: float,
    a: float,
    b: float,
) -> bool:
    """Tells whether all land in a box (x0, y0, x1, y1), seen from a to b, lies below the box's fifth number.  A window
    does not count where a finer one is seen for certain."""
    n = mips[1, 0]
    for w in range(len(places) - 1, -1, -1):
        s = places[w, 2]
        if w > 0 and a * _NARROWEST * cone > CELLS_PER_PIXEL * s:
            continue
        x0, y0 = (box[0] - places[w, 0]) / s, (box[1] - places[w, 1]) / s
        x1, y1 = (box[2] - places[w, 0]) / s, (box[3] - places[w, 1]) / s
        if x1 < 0.0 or y1 < 0.0 or x0 >= n or y0 >= n:
            continue
        i0, j0 = int(max(x0, 0.0)), int(max(y0, 0.0))
        i1, j1 = int(min(x1, n - 1.0)), int(min(y1, n - 1.0))
        k = 0
        while (i1 >> k) - (i0 >> k) > 1 or (j1 >> k) - (j0 >> k) > 1:
            k += 1
        low = box[4] / s
        first, side = mips[0, k], mips[1, k]
        for j in range(j0 >> k, (j1 >> k) + 1):
            for i in range(i0 >> k, (i1 >> k) + 1):
                if k > 0:
                    most = tops[w, first + j * side + i]
                else:
                    h = heights[w]
                    most = max(max(h[j, i], h[j, i + 1]), max(h[j + 1, i], h[j + 1, i + 1]))
                if most >= low:
                    return False
        seen = w == 0 or b * _WIDEST * cone < 0.99999 * CELLS_PER_PIXEL * s
        if seen and x0 > 0.0 and y0 > 0.0 and x1 < 0.99999 * n and y1 < 0.99999 * n:
            return True
    return True


@inner_uncounted
def clear_until(
    heights: np.ndarray,
    tops: np.ndarray,
    mips: np.ndarray,
    places: np.ndarray,
    o: np.ndarray,
    corners: np.ndarray,
    cone: float,
    highest: float,
    begin: float,
    far: float,
    box: np.ndarray,
) -> float:
    """Returns up to which multiple of its corners (4, 3) no ray of a beam meets land: at least `begin`, until which
    that is known; `far` if it never does before.  No land is higher than `highest`.
    `box` (5,): room to work in."""
    up, longest, width = corners[0, 2], 0.0, 0.0
    for q in range(4):
        up = min(up, corners[q, 2])
        longest = max(longest, corners[q, 0] ** 2 + corners[q, 1] ** 2 + corners[q, 2] ** 2)
        for c in range(3):
            width = max(width, abs(corners[q, c] - corners[0, c]))
    longest = math.sqrt(longest)
    a = begin
    step = max(1.0, 0.25 * a)
    while a < far:
        if up >= 0.0 and o[2] + a * up > highest:
            return far
        b = min(far, a + step)
        for c in range(2):
            low = high = o[c] + a * corners[0, c]
            for q in range(4):
                one, other = o[c] + a * corners[q, c], o[c] + b * corners[q, c]
                low, high = min(low, one, other), max(high, one, other)
            box[c], box[2 + c] = low, high
        box[4] = o[2] + min(a * up, b * up)
        if _overlooks(heights, tops, mips, places, box, cone, a, b * longest):
            a = b
            step *= 2.0
        elif step <= max(1.0, _STEPS * a * width):
            break
        else:
            step *= 0.4
    return a
