"""Rock: 1/f noise that never runs out of detail.

Perlin & Velho 1995, section 3.3: each finer level adds noise of a smaller amplitude.  Octave j, white in 2 x 2 blocks
of zero mean (so that coarser levels stay as they are), lives at level root + j; at the root, a pixel is as large as
the texture's period, or up to twice that, octave 0 being the weaker the nearer its size is to twice the period.
Writing n_j for an octave and E for expand, the texture at depth d (level root + d) is

    S_d = sum over j <= d of  W(d, j) E^(d-j) n_j                  and   bandpass_d = S_d - E S_(d-1).

**The first octaves** (the first ten at least, and all down to the base level) have W = g 2^(-H j): the two-dimensional
amplitude spectrum falls as f^-(1+H), whatever the roughness H.

**Re-basing.**  Left at that, Rock would fade into blur: at H = 1/2, eight levels after the tenth octave the contrast
of a view is a sixteenth.  So from depth D on (D = 10, or the base's depth where that is more) each further level
raises what is there by 2^H and a little more before it adds its own octave, and halves the octaves that have grown
larger than a view.  With the age m = d - j of an octave,

    W(d, j) = g 2^(H (m - M)) for m <= M,   g 2^(M - m) beyond,

where the peak M goes back from D to 8 by half an octave per level, and g keeps the standard deviation of S at 0.36.
(With M = d the same formula is the first octaves' rule.)  At every depth a view then shows the spectrum f^-(1+H) over
its last M octaves with the same contrast, and the mean, what is left of the older ones, stays bounded.  Ages whose
weight is below 2^-17 are left out, so S and the bandpass are finite cascades at any depth.

**What lasts.**  Heights must not change as one comes nearer: slopes of re-based rock double with every level.  Rock
that is not renewed keeps W = g 2^(-H j) for ever, down to any depth.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from engine.numeric.address import Rect
from engine.numeric.arithmetic import EVERYWHERE, LIBRARY
from engine.numeric.detail import add_expanded, blend_rows, cut, expand_row, parents
from engine.numeric.functions import functions
from engine.numeric.hashing import MASK32, fold_key, place64
from engine.numeric.kernel import inner, kernel
from engine.texture.record import told_kind

FIRST = 10  # the depth down to which octaves keep their amplitudes, at least
PEAK = 8  # the age of the strongest octave in the end: features of 2^8 pixels
SPREAD = 0.36  # standard deviation of S from that depth on: one pixel in 200 leaves the nominal -1..1
_LONGEST = 28  # octaves that are worked out at once
_FAINTEST = 17  # octaves: below 2^-17, a weight is negligible
_DOMAIN = 0x726F636B  # "rock": tells these hashes from those of other textures

# Coordinates reach the kernel as their low 62 bits; what lies above 2^32 is in the keys.  An ancestor m levels up
# is found by shifting those bits, which is right for m <= 30, and the cascade is never longer.
_SEEN = (1 << 62) - 1
_FIELD = np.uint64(0x1FFFFF)
_MIDDLE = np.float32(0x100000 - 0.5)


@dataclass(frozen=True, slots=True)
class Rock:
    """`period`: the largest features, in pixels of the base level; `roughness`: H, 0..1 (0 is the roughest);
    `renew`: whether octaves are re-based."""

    base: int
    period: float
    roughness: float = 0.5
    seed: int = 0
    arithmetic: int = LIBRARY
    renew: bool = True

    @property
    def key(self) -> tuple[object, ...]:
        """Tells this instance from all others, as `Instance.key`."""
        return (told_kind("rock", self.arithmetic, self.renew), self.base, self.period, self.roughness, self.seed)

    @property
    def root(self) -> int:
        """Returns the level of octave 0."""
        return self.base - math.ceil(_size(self.period, EVERYWHERE))  # both arithmetics agree on the whole number

    @property
    def first(self) -> float:
        """Returns the part of octave 0 that is there, 0..1, so that S varies steadily with the period."""
        size = _size(self.period, self.arithmetic)
        return 1.0 + size - math.ceil(size)

    @property
    def settled(self) -> int:
        """D: the depth down to which octaves keep their amplitudes."""
        return max(FIRST, self.base - self.root)

    def appearance(self, level: int, rect: Rect) -> np.ndarray:
        """Gives S at a level over a rectangle, as `Instance.appearance`."""
        if level < self.base:
            raise ValueError(f"rock: level {level} is coarser than the base level {self.base}")
        return self._cascade(level, rect, self.weights(level))

    def bandpass(self, level: int, rect: Rect) -> np.ndarray | None:
        """Gives what the level adds over a rectangle, as `Instance.bandpass`."""
        if level <= self.base or rect.empty:
            return None
        return self._cascade(level, rect, self.changes(level))

    def weights(self, level: int) -> np.ndarray:
        """Returns what S takes of the octaves of ages 0, 1, ...: float32 (ages,)."""
        depth, about = level - self.root, (self.settled, self.roughness, self.first, self.arithmetic)
        return octave_weights(depth, *about) if self.renew else lasting_weights(depth, *about)

    def changes(self, level: int) -> np.ndarray:
        """Returns what the bandpass takes of them, without the zeros at the end: float32 (ages,)."""
        depth, about = level - self.root, (self.settled, self.roughness, self.first, self.arithmetic)
        return octave_changes(depth, *about) if self.renew or depth <= self.settled else octave_alone(depth, *about)

    def _cascade(self, level: int, rect: Rect, factors: np.ndarray) -> np.ndarray:
        """sum over m of factors[m] E^m n_(level - m), over `rect`: float32 (1, h, w)."""
        if factors.size > _LONGEST:
            return self._far_cascade(level, rect, factors)
        even = rect.evened()
        keys = _keys(self.seed, self.base, level, (even.x0 >> 32, even.y0 >> 32), factors.size)
        out = np.empty((1, even.height, even.width), np.float32)
        _fill_cascade(out[0], even.x0 & _SEEN, even.y0 & _SEEN, keys, factors)
        return cut(out, rect, even)

    def _far_cascade(self, level: int, rect: Rect, factors: np.ndarray) -> np.ndarray:
        """As `_cascade`, of so many octaves that the older ones are carried down from where they are the newest."""
        places = [rect.evened()]
        for _ in range(_LONGEST):
            places.append(parents(places[-1]).evened())
        out = self._cascade(level - _LONGEST, places[-1], factors[_LONGEST:])
        for up in range(_LONGEST - 1, -1, -1):
            fine = np.zeros((1, places[up].height, places[up].width), np.float32)
            add_expanded(fine, cut(out, parents(places[up]), places[up + 1]))
            out = fine
        out += self._cascade(level, places[0], factors[:_LONGEST])
        return cut(out, rect, places[0])


@lru_cache(maxsize=4096)
def _size(period: float, arithmetic: int) -> float:
    """Returns log2 of a period."""
    return functions(arithmetic).log2(period)


@lru_cache(maxsize=4096)
def octave_weights(depth: int, settled: int, roughness: float, first: float, arithmetic: int = LIBRARY) -> np.ndarray:
    """W(depth, depth - m) for the ages m = 0, 1, ...: float32 (number of octaves,)."""
    two_to = functions(arithmetic).two_to
    if depth <= settled:
        first_octaves = np.array(_profile(depth, depth, roughness, first, two_to), np.float32)
        return first_octaves * _first_gain(settled, roughness, first, two_to)
    profile = _profile(max(float(PEAK), settled - (depth - settled) / 2), depth, roughness, first, two_to)
    return np.array(profile, np.float32) * np.float32(_gain(profile))


@lru_cache(maxsize=4096)
def octave_changes(depth: int, settled: int, roughness: float, first: float, arithmetic: int = LIBRARY) -> np.ndarray:
    """W(depth, j) - W(depth - 1, j), by age, without the zeros at the end: float32 (number of octaves,)."""
    now, before = (octave_weights(d, settled, roughness, first, arithmetic) for d in (depth, depth - 1))
    both = np.zeros(max(now.size, before.size + 1), np.float32)
    both[: now.size] = now
    both[1 : before.size + 1] -= before
    return np.trim_zeros(both, "b")


@lru_cache(maxsize=4096)
def lasting_weights(depth: int, settled: int, roughness: float, first: float, arithmetic: int = LIBRARY) -> np.ndarray:
    """As `octave_weights`, of octaves that keep their amplitudes for ever: g 2^(-H j)."""
    two_to = functions(arithmetic).two_to
    profile = [two_to(roughness * (m - depth)) for m in range(depth + 1)]
    profile[depth] *= first
    return np.array(profile, np.float32) * _first_gain(settled, roughness, first, two_to)


@lru_cache(maxsize=4096)
def octave_alone(depth: int, settled: int, roughness: float, first: float, arithmetic: int = LIBRARY) -> np.ndarray:
    """As `octave_changes`, of octaves that keep their amplitudes: the newest one's weight, float32 (1,)."""
    two_to = functions(arithmetic).two_to
    return np.array([two_to(-roughness * depth)], np.float32) * _first_gain(settled, roughness, first, two_to)


def _profile(peak: float, depth: int, roughness: float, first: float, two_to: Callable[[float], float]) -> list[float]:
    """Returns the weights of ages 0, 1, ... to `depth` or until they are negligible; 1 at age `peak`."""
    ages = range(min(depth, int(peak + _FAINTEST)) + 1)
    profile = [two_to(roughness * (m - peak) if m <= peak else peak - m) for m in ages]
    if len(profile) == depth + 1:
        profile[depth] *= first
    return profile


def _first_gain(settled: int, roughness: float, first: float, two_to: Callable[[float], float]) -> np.float32:
    return np.float32(_gain(_profile(settled, settled, roughness, first, two_to)))


def _gain(profile: list[float]) -> float:
    return SPREAD / math.sqrt(sum(w * w * octave_variance(m) for m, w in enumerate(profile)))


@lru_cache(maxsize=64)
def octave_variance(age: int) -> float:
    """Returns the variance of E^age n, n being the noise of one octave, of variance 1 itself."""
    along, across = np.ones(2), np.array([1.0, -1.0])
    age = min(age, 12)  # by then it has converged, to a part in a million
    for _ in range(age):
        along, across = (_expanded(np.repeat(f, 2)) for f in (along, across))
    va, vd = (float((f * f).sum()) / 2 ** (age + 1) for f in (along, across))
    out: float = (2 * va * vd + vd * vd) / 3
    return out


def _expanded(f: np.ndarray) -> np.ndarray:
    """Returns values (n,) smoothed by (1, 2, 1)/4: (n + 2,)."""
    out = np.zeros(f.size + 2)
    out[:-2] += 0.25 * f
    out[1:-1] += 0.5 * f
    out[2:] += 0.25 * f
    return out


@lru_cache(maxsize=256)
def _keys(seed: int, base: int, level: int, high: tuple[int, int], ages: int) -> np.ndarray:
    """Keys of the 2^32-pixel squares around the ancestors of square `high`: uint64 (ages, 3 rows, 3 columns)."""
    out = np.empty((ages, 3, 3), np.uint64)
    for m in range(ages):
        octave = fold_key(_DOMAIN, seed, base, level - m)
        for j in range(3):
            for i in range(3):
                out[m, j, i] = fold_key(octave, (high[0] >> m) + i - 1, (high[1] >> m) + j - 1)
    return out


@inner
def _noise_run(
    upper: np.ndarray, lower: np.ndarray, key: np.uint64, x: np.uint64, y: np.uint64, factor: np.float32
) -> None:
    """Adds an octave's noise to two rows, `x`, `y` (uint64) being the low halves of the first pixel's place.

    Of the 2 x 2 pixels of a block the noise is +a+b+c, +a-b-c over -a+b-c, -a-b+c: variance 1, mean exactly zero.
    """
    for i in range(upper.size // 2):
        h = place64(key, x + np.uint64(2 * i), y)
        a = (np.float32(np.int32(h & _FIELD)) - _MIDDLE) * factor
        b = (np.float32(np.int32((h >> np.uint64(21)) & _FIELD)) - _MIDDLE) * factor
        c = (np.float32(np.int32((h >> np.uint64(42)) & _FIELD)) - _MIDDLE) * factor
        upper[2 * i] += a + (b + c)
        upper[2 * i + 1] += a - (b + c)
        lower[2 * i] += (b - c) - a
        lower[2 * i + 1] += (c - b) - a


@inner
def _noise_rows(
    upper: np.ndarray, lower: np.ndarray, x: int, y: int, keys: np.ndarray, high: tuple[int, int], factor: np.float32
) -> None:
    """`_noise_run` from the place (x, y), cut where x passes a multiple of 2^32; high = (x, y) >> 32 of keys[1, 1]."""
    row = keys[(y >> 32) - high[1] + 1]
    i, n = 0, upper.size
    step = factor * np.float32(2.0**-20)
    while i < n:
        square = (x + i) >> 32
        stop = min(n, ((square + 1) << 32) - x)
        low = np.uint64((x + i) & MASK32)
        _noise_run(upper[i:stop], lower[i:stop], row[square - high[0] + 1], low, np.uint64(y & MASK32), step)
        i = stop


@inner
def _ancestors(x: int, y: int, height: int, width: int, ages: int) -> np.ndarray:
    """Even rectangles x, y, height, width (ages, 4): the first is given, each next holds what E needs for the last."""
    places = np.empty((ages, 4), np.int64)
    for m in range(ages):
        places[m, 0], places[m, 1], places[m, 2], places[m, 3] = x, y, height, width
        right, bottom = ((x + width) >> 1) + 1, ((y + height) >> 1) + 1
        x, y = ((x >> 1) - 1) & ~1, ((y >> 1) - 1) & ~1
        width, height = ((right + 1) & ~1) - x, ((bottom + 1) & ~1) - y
    return places


@kernel
def _fill_cascade(out: np.ndarray, x: int, y: int, keys: np.ndarray, factors: np.ndarray) -> None:
    """out (h, w) = sum over m of factors[m] E^m n_m; x, y: low 62 bits of the even place of its first pixel."""
    places = _ancestors(x, y, out.shape[0], out.shape[1], factors.size)
    coarse = out
    for m in range(factors.size - 1, -1, -1):
        px, py, height, width = places[m]
        fine = out if m == 0 else np.empty((height, width), np.float32)
        high = ((x >> 32) >> m, (y >> 32) >> m)
        t = np.empty(width // 2 + 2, np.float32)
        for j in range(0, height, 2):
            if m == factors.size - 1:
                fine[j : j + 2] = np.float32(0.0)
            else:
                left = (px >> 1) - 1 - places[m + 1, 0]
                row = ((py + j) >> 1) - places[m + 1, 1]
                near = coarse[row, left : left + t.size]
                for r in range(2):
                    blend_rows(near, coarse[row + 2 * r - 1, left : left + t.size], t)
                    expand_row(t, fine[j + r])
            if factors[m] != np.float32(0.0):
                _noise_rows(fine[j], fine[j + 1], px, py + j, keys[m], high, factors[m])
        coarse = fine
