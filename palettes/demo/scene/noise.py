"""Chance for a painter's hand: noise by (seed, place), and dice by name.  The same on every machine."""

from __future__ import annotations

import math
from random import Random

_MASK = 0xFFFFFFFF


def dice(name: str) -> Random:
    """Random numbers that depend on the name only."""
    return Random(f"inkfall {name}")


def _lattice(seed: int, i: int, j: int) -> float:
    h = (i * 0x165667B1 + j * 0x27D4EB2F + seed * 0x9E3779B1) & _MASK
    h = ((h ^ (h >> 15)) * 0x2C1B3C6D) & _MASK
    h = ((h ^ (h >> 12)) * 0x297A2D39) & _MASK
    return ((h ^ (h >> 15)) & 0xFFFFFF) / 0x7FFFFF - 1.0


def value(seed: int, x: float, y: float = 0.0) -> float:
    """Smooth noise of unit grid, -1..1."""
    i, j = math.floor(x), math.floor(y)
    u, v = x - i, y - j
    u, v = u * u * (3 - 2 * u), v * v * (3 - 2 * v)
    upper = _lattice(seed, i, j) * (1 - u) + _lattice(seed, i + 1, j) * u
    lower = _lattice(seed, i, j + 1) * (1 - u) + _lattice(seed, i + 1, j + 1) * u
    return upper * (1 - v) + lower * v


def fractal(seed: int, x: float, y: float = 0.0, octaves: int = 4) -> float:
    """Octaves of `value`, each half as strong and twice as fine; about -1..1."""
    return sum(value(seed + k, x * 2**k, y * 2**k) / 2**k for k in range(octaves)) / 1.5


def ridged(seed: int, x: float, y: float, octaves: int = 3) -> float:
    """Noise with crests, 0..1 and 1 on the crests."""
    return sum((1 - abs(value(seed + k, x * 2**k, y * 2**k))) / 2**k for k in range(octaves)) / (2 - 2 ** (1 - octaves))
