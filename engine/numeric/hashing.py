"""Random numbers that depend on a seed and a place, never on order.

A place is an unbounded pair of integers.  Everything of it above 32 bits is folded, in Python, into a 64-bit key;
per pixel only the low 32 bits of each coordinate are mixed in, by the splitmix64 finaliser (Steele, Lea & Flood 2014,
"Fast splittable pseudorandom number generators", variant 13 of Stafford).  It is a bijection, so within one key no two
places collide.
"""

from __future__ import annotations

import numpy as np

from engine.numeric.kernel import inlined, kernel

MASK32 = (1 << 32) - 1
MASK64 = (1 << 64) - 1

_GOLDEN = 0x9E3779B97F4A7C15
_FIRST = np.uint64(0xBF58476D1CE4E5B9)
_SECOND = np.uint64(0x94D049BB133111EB)
_WHOLE_FIRST, _WHOLE_SECOND = int(_FIRST), int(_SECOND)


@inlined
def mix64(h: np.uint64) -> np.uint64:
    """Returns the splitmix64 finaliser: a bijection of uint64 in which every input bit sways every output bit."""
    h = (h ^ (h >> np.uint64(30))) * _FIRST
    h = (h ^ (h >> np.uint64(27))) * _SECOND
    return h ^ (h >> np.uint64(31))


@inlined
def place64(key: np.uint64, x: np.uint64, y: np.uint64) -> np.uint64:
    """Returns the hash at the place whose low 32 bits are `x` and `y` (uint64 below 2^32), under a uint64 `key`."""
    return mix64(((y << np.uint64(32)) | x) ^ key)


def mixed(h: int) -> int:
    """`mix64` on a Python integer in [0, 2^64)."""
    h = ((h ^ (h >> 30)) * _WHOLE_FIRST) & MASK64
    h = ((h ^ (h >> 27)) * _WHOLE_SECOND) & MASK64
    return h ^ (h >> 31)


def fold_key(*numbers: int) -> int:
    """Returns a 64-bit key from integers of any size and sign; different lists give unrelated keys.

    Each number enters as its two's complement in 64-bit limbs, as many as it needs, after their count, so that no
    list of numbers spells another.
    """
    key = mixed(len(numbers) + _GOLDEN)
    for number in numbers:
        count = number.bit_length() // 64 + 1
        key = mixed((key ^ count) + _GOLDEN & MASK64)
        for _ in range(count):
            key = mixed((key ^ (number & MASK64)) + _GOLDEN & MASK64)
            number >>= 64
    return key


def hash_plane(key: int, x0: int, y0: int, width: int, height: int) -> np.ndarray:
    """uint64 (height, width): `place64` over a rectangle at any unbounded origin, high bits folded into `key`."""
    out = np.empty((height, width), np.uint64)
    for hy in range(y0 >> 32, ((y0 + height - 1) >> 32) + 1):
        j0, j1 = _run(y0, hy, height)
        for hx in range(x0 >> 32, ((x0 + width - 1) >> 32) + 1):
            i0, i1 = _run(x0, hx, width)
            folded = np.uint64(fold_key(key, hx, hy))
            low = np.uint64((x0 + i0) & MASK32), np.uint64((y0 + j0) & MASK32)
            _fill_hash(out[j0:j1], i0, i1, folded, *low)
    return out


def uniform(key: int, count: int) -> np.ndarray:
    """Numbers evenly in [0, 1): float64 (count,)."""
    out: np.ndarray = (hash_plane(key, 0, 0, count, 1)[0] >> np.uint64(11)) * 2.0**-53
    return out


def _run(origin: int, high: int, size: int) -> tuple[int, int]:
    """Returns the indices i in [0, size) for which (origin + i) >> 32 == high, as a half-open range."""
    return max(0, (high << 32) - origin), min(size, ((high + 1) << 32) - origin)


@kernel
def _fill_hash(out: np.ndarray, first: int, last: int, key: np.uint64, x: np.uint64, y: np.uint64) -> None:
    for j in range(out.shape[0]):
        row = out[j, first:last]
        for i in range(row.size):
            row[i] = place64(key, x + np.uint64(i), y + np.uint64(j))
