"""Constants of the elementary functions, worked out in whole numbers and cut into parts whose products are exact.

A constant is a whole number of units of 2^-BITS, or of 2^-`bits` where that is given.
"""

from __future__ import annotations

import math

import numpy as np

BITS = 240  # enough for the sum of some floats
_FAR = 1200  # for the largest angles
_PART = (1 << 26) - 1


def parts(value: int, *widths: int, bits: int = BITS) -> tuple[float, ...]:
    """Cuts a constant into floats whose sum it is: each has so many bits; a width of 53 rounds to the nearest float."""
    found = []
    for width in widths:
        cut = max(abs(value).bit_length() - width, 0)
        part = (value + (1 << cut >> 1)) >> cut if width == 53 else value >> cut
        found.append(math.ldexp(part, cut - bits))
        value -= part << cut
    return tuple(found)


def arctangent(numerator: int, denominator: int, bits: int = BITS) -> int:
    """Returns atan(numerator / denominator) of 0..1, by Euler's series, to a unit."""
    across, whole = numerator * numerator, numerator * numerator + denominator * denominator
    term = (numerator * denominator << bits + 64) // whole
    total, n = 0, 0
    while term:
        total += term
        n += 1
        term = term * (2 * n * across) // ((2 * n + 1) * whole)
    return total >> 64


def pi(bits: int = BITS) -> int:
    """Returns pi, by Machin's formula, to some units."""
    return 16 * arctangent(1, 5, bits) - 4 * arctangent(1, 239, bits)


def logarithm_of_2() -> int:
    """Returns ln 2, as 2 artanh(1/3), to a unit."""
    total, power, n = 0, (2 << BITS + 64) // 3, 1
    while power:
        total += power // n
        power, n = power // 9, n + 2
    return total >> 64


def remainders(first: int, last: int) -> np.ndarray:
    """Returns 2^e modulo 2 pi for e = first, ..., last, each in four parts of 26 bits: float64 (n, 4)."""
    turn, rows = 2 * pi(_FAR), []
    left = (1 << _FAR + first) % turn
    for _ in range(first, last + 1):
        top = left >> _FAR - 101
        rows.append((top >> 78, top >> 52 & _PART, top >> 26 & _PART, top & _PART))
        left = 2 * left - turn if 2 * left >= turn else 2 * left
    return np.array(rows, np.float64) * [math.ldexp(1.0, -23 - 26 * n) for n in range(4)]


def arctangents(steps: int) -> np.ndarray:
    """Returns atan(i / steps) for i = 0, ..., steps as the sum of two floats: float64 (steps + 1, 2)."""
    return np.array([parts(arctangent(i, steps), 53, 53) for i in range(steps + 1)])
