"""Colours as "#rrggbb", mixed as the canvas mixes them: in encoded sRGB."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise


def mix(a: str, b: str, t: float) -> str:
    """The colour a fraction `t`, held to 0..1, of the way from `a` to `b`."""
    t = min(max(t, 0.0), 1.0)
    pairs = ((int(a[i : i + 2], 16), int(b[i : i + 2], 16)) for i in (1, 3, 5))
    return "#" + "".join(f"{round(p + (q - p) * t):02x}" for p, q in pairs)


def ramp(stops: Sequence[tuple[float, str]], at: float) -> str:
    """The colour at a place of a gradient given by rising stops (place, colour)."""
    for (low, a), (high, b) in pairwise(stops):
        if at <= high:
            return mix(a, b, (at - low) / (high - low))
    return stops[-1][1]
