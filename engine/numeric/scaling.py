"""Integers of any size times 2 to any real power: places of a real level, exact at any depth."""

from __future__ import annotations

import math

_GUARD = 80  # bits more than a result needs


def scaled(value: int, levels: float) -> int:
    """Returns value * 2^levels, rounded."""
    fraction, whole = math.modf(levels)  # both exact, of one sign
    shift = int(whole)
    bits = value.bit_length() + max(shift, 0) + _GUARD if fraction else 0
    if fraction < 0:
        product, shift = (value << 2 * bits) // _power(-fraction, bits), bits - shift
    else:
        product, shift = value * _power(fraction, bits), bits - shift
    return product << -shift if shift <= 0 else product + (1 << shift - 1) >> shift


def _power(fraction: float, bits: int) -> int:
    """Returns 2^fraction in units of 2^-bits, 0 <= fraction < 1; off by some hundred units at most."""
    out, root = 1 << bits, 2 << bits
    while fraction:
        root = math.isqrt(root << bits)  # 2^(1/2), 2^(1/4), ...: one for each bit of the fraction
        fraction *= 2
        if fraction >= 1:
            out, fraction = out * root >> bits, fraction - 1
    return out
