"""How strong the self-similar octaves are that continue a sample beyond its own pixels.

Octave j >= 1 is the sample's finest content laid at level native + j; octave 0 is the texture itself.  At depth d the
texture is the sum over j <= d of W(d, j) E^(d-j) O_j, E being expand.

**The first octaves** have W = r^j, r being the roughness: each level adds its octave and keeps what is there.

**Re-basing.**  Left at that, a view would fade into blur as the sample grows larger than it.  From the depth D on at
which the sample's strongest features are as large as a view, what is there is raised together before a level adds its
octave, and what has grown larger than a view is lowered.  With H = -log2 r and the age m = d - j,

    W(d, j) = g 2^(H (m - M)) for m <= M,   g 2^(M - m) beyond,

where M goes by half an octave per level from D to the age at which an octave's features fill a view, and g keeps the
variance (compare `engine.texture.rock`).  Below a roughness of an eighth nothing is raised; at 0 nothing is added.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from engine.numeric.arithmetic import LIBRARY
from engine.numeric.elementary import log2
from engine.numeric.functions import functions

VIEW = 7  # features of 2^7 pixels are as large as one likes to see them
_SMOOTH = 0.125  # below this roughness nothing is raised
_FAINTEST = 12  # octaves: 2^-12 of the strongest is negligible


@dataclass(frozen=True, slots=True)
class Continuation:
    """`strength`: the standard deviation of an octave to that of the texture; `scale`, `octave`: log2 of the size of
    the features of the texture, and of an octave, in pixels of their own level."""

    strength: float
    scale: float
    octave: float

    @property
    def settled(self) -> int:
        """D: the depth down to which octaves keep their strength."""
        return max(1, round(VIEW - self.scale))

    def peak(self, depth: int) -> float:
        """M: the age of the strongest octave."""
        there, past = max(1.0, VIEW - self.octave), 0.5 * max(0, depth - self.settled)
        return self.settled + min(max(there - self.settled, -past), past)


@lru_cache(maxsize=4096)
def octave_weights(
    depth: int, roughness: float, form: Continuation, arithmetic: int = LIBRARY, renew: bool = True
) -> np.ndarray:
    """W(depth, depth - m) for the ages m = 0, 1, ...: float32 (number of octaves,).  W = r^j for ever, if not
    `renew`."""
    settled, own = form.settled, functions(arithmetic)
    if lasting(roughness, renew) or depth <= settled:
        out = np.zeros(depth + 1)
        for j in range(min(depth, _added(roughness)) + 1):
            out[depth - j] = own.power(roughness, j)
        return out.astype(np.float32)
    slope = -own.log2(roughness)
    profile = _profile(depth, slope, form, own.two_to)
    gain = _size(_profile(settled, slope, form, own.two_to), settled, form) / _size(profile, depth, form)
    return (np.array(profile) * gain).astype(np.float32)


@lru_cache(maxsize=4096)
def octave_changes(
    depth: int, roughness: float, form: Continuation, arithmetic: int = LIBRARY, renew: bool = True
) -> np.ndarray:
    """W(depth, j) - W(depth - 1, j), by age, without the zeros at the end: float32 (number of octaves,)."""
    if lasting(roughness, renew):  # so deep that the arrays of weights would be long
        return np.array(
            [functions(arithmetic).power(roughness, depth)] if depth <= _added(roughness) else [], np.float32
        )
    now, before = (octave_weights(d, roughness, form, arithmetic) for d in (depth, depth - 1))
    both = np.zeros(max(now.size, before.size + 1), np.float32)
    both[: now.size] = now
    both[1 : before.size + 1] -= before
    return np.trim_zeros(both, "b")


def lasting(roughness: float, renew: bool) -> bool:
    """Tells whether octaves keep their strength for ever."""
    return not renew or roughness < _SMOOTH


def _added(roughness: float) -> int:
    """Tells how many octaves of a smooth texture are strong enough to be seen."""
    if roughness <= 0.0:
        return 0
    return 1 << 20 if roughness >= _SMOOTH else int(-_FAINTEST / log2(roughness))


def _profile(depth: int, slope: float, form: Continuation, two_to: Callable[[float], float]) -> list[float]:
    """Returns the weights of ages 0, 1, ... to `depth` or until they are negligible; 1 at age M."""
    peak = form.peak(depth)
    ages = range(min(depth, int(peak + _FAINTEST)) + 1)
    return [two_to(slope * (m - peak) if m <= peak else peak - m) for m in ages]


def _size(profile: list[float], depth: int, form: Continuation) -> float:
    """Returns the standard deviation of the sum, that of the texture being 1."""
    octaves = sum(w * w for m, w in enumerate(profile) if m < depth) * form.strength**2
    texture = profile[depth] ** 2 if len(profile) > depth else 0.0
    return math.sqrt(max(octaves + texture, 1e-12))
