"""Parts of a full turn as unit complex numbers, worked out in whole numbers: the same doubles on every machine."""

from __future__ import annotations

import math
from functools import lru_cache

from engine.numeric.exact_constants import pi

_BITS = 160  # of the series: far more than a double shows


@lru_cache(1024)
def turned(part: int, whole: int) -> tuple[float, float]:
    """Returns the cosine and the sine of `part` / `whole` of a full turn; quarters of it are exact."""
    eighths, rest = divmod(8 * (part % whole), whole)  # rest / whole of an eighth beyond so many of them
    quarter, odd = divmod(eighths, 2)
    x, y = _within_eighth(whole - rest, whole)[::-1] if odd else _within_eighth(rest, whole)
    for _ in range(quarter):
        x, y = -y, x
    return x + 0.0, y + 0.0


def _within_eighth(part: int, whole: int) -> tuple[float, float]:
    """Returns the cosine and the sine of `part` / `whole` of an eighth of a turn."""
    angle = pi(_BITS) * part // (4 * whole)
    sums, term, n = [0, 0, 0, 0], 1 << _BITS, 0
    while term:
        sums[n % 4] += term
        n += 1
        term = (term * angle >> _BITS) // n
    return math.ldexp(sums[0] - sums[2], -_BITS), math.ldexp(sums[1] - sums[3], -_BITS)
