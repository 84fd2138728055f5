"""White, Stripes, Sawtooth and Squares: the paper's textures, with exact edges at every depth.

Perlin & Velho 1995, section 5.3.  Their power curves depend on the reconstruction filter; for the quadratic B-spline
the rule here needs no curve: S_k is the exact average over each pixel of level k, and the bandpass is what expand
leaves out, S_k - E S_(k-1).  It differs from zero only within four pixels of an edge.

Squares are the product of two waves at right angles.  Along the axes that is exact; turned, a pixel that holds
a corner gets the product of the two averages instead of the average of the product (off by 1/4 at most, in the
pixels at corners only).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache
from typing import ClassVar

import numpy as np

from engine.numeric.address import Rect
from engine.numeric.arithmetic import LIBRARY
from engine.numeric.detail import FLOOR, cut, expand_row, parents, subtract_expanded
from engine.numeric.kernel import kernel
from engine.numeric.wave import FAR, LONGEST, Wave, saw_wave, square_wave, step_wave
from engine.texture.record import told_kind

Sampler = Callable[[Wave, Rect], np.ndarray]  # pixel averages, float32 (h, w)

_wave = lru_cache(maxsize=256)(Wave.of)
_REACH = 4  # pixels around an edge where the bandpass may differ from zero


@dataclass(frozen=True, slots=True)
class White:
    """S = 1 everywhere; nothing to add at finer levels."""

    base: int

    @property
    def key(self) -> tuple[object, ...]:
        """Tells this instance from all others, as `Instance.key`."""
        return ("white", self.base)

    def appearance(self, level: int, rect: Rect) -> np.ndarray:
        """Gives S at a level over a rectangle, as `Instance.appearance`."""
        return np.ones((1, rect.height, rect.width), np.float32)

    def bandpass(self, level: int, rect: Rect) -> np.ndarray | None:
        """Gives what the level adds over a rectangle, as `Instance.bandpass`."""
        return None


@dataclass(frozen=True, slots=True)
class _Waves:
    """What the three wave textures share: `period` in pixels of the base level, `angle` in degrees, `phase` 0..1."""

    base: int
    period: float
    angle: float = 0.0
    phase: float = 0.0
    arithmetic: int = LIBRARY

    kind: ClassVar[str]

    @property
    def key(self) -> tuple[object, ...]:
        return (told_kind(self.kind, self.arithmetic), self.base, self.period, self.angle, self.phase)

    def wave(self, level: int) -> Wave:
        if level < self.base:
            raise ValueError(f"{self.kind}: level {level} is coarser than the base level {self.base}")
        return _wave(self.period, self.angle, self.phase, self.arithmetic).finer(level - self.base)

    def sampler(self, fine: Wave) -> Sampler:
        """Returns the pixel averages whose refinement at the level of `fine` is wanted."""
        return square_wave

    def edges(self, fine: Wave) -> list[tuple[Wave, int]]:
        """Returns the waves and the distances between their edges."""
        return [(fine, fine.period // 2)]

    def appearance(self, level: int, rect: Rect) -> np.ndarray:
        wave = self.wave(level)
        return self.sampler(wave)(wave, rect)[None]

    def bandpass(self, level: int, rect: Rect) -> np.ndarray | None:
        if level <= self.base or rect.empty:
            return None
        fine, coarse = self.wave(level), self.wave(level - 1)
        if not any(wave.edge_near(rect, cell, _REACH) for wave, cell in self.edges(fine)):
            return None
        even = rect.evened()
        if fine.ux and fine.uy:
            sample = self.sampler(fine)
            out = sample(fine, even)[None]
            return _kept(out, subtract_expanded(out, sample(coarse, parents(even))[None]), rect, even)
        return self.along_axes(fine, coarse, rect, even)

    def along_axes(self, fine: Wave, coarse: Wave, rect: Rect, even: Rect) -> np.ndarray | None:
        """Returns the bandpass of a wave along an axis: one line of it, repeated."""
        s, e = _line(self.sampler(fine), fine, coarse, even)
        line = s - e
        line[np.abs(line) <= FLOOR] = 0.0
        if not line.any():
            return None
        out = np.empty((1, even.height, even.width), np.float32)
        out[0] = line if fine.ux else line[:, None]
        return _kept(out, True, rect, even)


@dataclass(frozen=True, slots=True)
class Stripes(_Waves):
    """+1 on the first half of each period, -1 on the second."""

    kind: ClassVar[str] = "stripes"


@dataclass(frozen=True, slots=True)
class Sawtooth(_Waves):
    """From +1 down to -1 over each period, then a jump.  E keeps the ramp as it is: only the jumps need refining."""

    kind: ClassVar[str] = "sawtooth"

    def sampler(self, fine: Wave) -> Sampler:
        """Gives the function that evaluates a wave over a rectangle."""
        return step_wave if fine.period > FAR else saw_wave

    def edges(self, fine: Wave) -> list[tuple[Wave, int]]:
        """Gives the waves whose jumps need exact means, each with the distance of its jumps."""
        return [(fine, fine.period)]

    def appearance(self, level: int, rect: Rect) -> np.ndarray:
        """Gives S at a level over a rectangle, as `Instance.appearance`."""
        wave = self.wave(level)
        if wave.period <= LONGEST:
            return saw_wave(wave, rect)[None]
        # So long a ramp is, to 2^-36, the ramp of a coarser ancestor; the jump is this level's own.
        up = wave.period.bit_length() - LONGEST.bit_length() + 1
        above = rect.zoomed(-up)
        ancestor = self.wave(level - up)
        saw, step = saw_wave(ancestor, above), step_wave(ancestor, above)
        between = (np.abs(saw) < 0.5) & (np.abs(step) == 1.0)
        rows = [((rect.y0 + j) >> up) - above.y0 for j in range(rect.height)]
        columns = [((rect.x0 + i) >> up) - above.x0 for i in range(rect.width)]
        saw, ramp, between = (a[rows][:, columns] for a in (saw, saw - step, between))
        # Half way between two jumps it is open which of them is the nearest, and the two levels may not agree.
        return np.where(between, saw, step_wave(wave, rect) + ramp)[None]


@dataclass(frozen=True, slots=True)
class Squares(_Waves):
    """A checkerboard of squares half a period wide; +1 where the halves of both waves agree, -1 elsewhere."""

    kind: ClassVar[str] = "squares"

    def sampler(self, fine: Wave) -> Sampler:
        """Gives the function that evaluates a wave over a rectangle."""
        return _checkerboard

    def edges(self, fine: Wave) -> list[tuple[Wave, int]]:
        """Gives the waves whose jumps need exact means, each with the distance of its jumps."""
        return [(wave, wave.period // 2) for wave in (fine, fine.across())]

    def along_axes(self, fine: Wave, coarse: Wave, rect: Rect, even: Rect) -> np.ndarray | None:
        """Returns the bandpass of squares along the axes: one line for the columns, one for the rows."""
        pairs = [(fine, coarse), (fine.across(), coarse.across())]
        if fine.uy:
            pairs.reverse()
        (sx, ex), (sy, ey) = (_line(square_wave, *pair, even) for pair in pairs)
        out = np.empty((1, even.height, even.width), np.float32)
        return _kept(out, _outer_difference(sx, sy, ex, ey, out[0]), rect, even)


def _checkerboard(wave: Wave, rect: Rect) -> np.ndarray:
    out = square_wave(wave, rect)
    out *= square_wave(wave.across(), rect)
    return out


def _line(sample: Sampler, fine: Wave, coarse: Wave, even: Rect) -> tuple[np.ndarray, np.ndarray]:
    """(S, E S') over `even` along the one axis on which a wave that lies along the axes varies: float32 (n,) each."""
    above = parents(even)
    if fine.ux:
        here, above = Rect(even.x0, 0, even.x1, 1), Rect(above.x0, 0, above.x1, 1)
    else:
        here, above = Rect(0, even.y0, 1, even.y1), Rect(0, above.y0, 1, above.y1)
    s = sample(fine, here).ravel()
    e = np.empty_like(s)
    expand_row(sample(coarse, above).ravel() * np.float32(4.0), e)
    return s, e


def _kept(out: np.ndarray, some: bool, rect: Rect, even: Rect) -> np.ndarray | None:
    """Returns the part of `out` over `rect`, None if it is zero."""
    if not some:
        return None
    if rect == even:
        return out
    inner = cut(out, rect, even)
    return inner if inner.any() else None


@kernel
def _outer_difference(sx: np.ndarray, sy: np.ndarray, ex: np.ndarray, ey: np.ndarray, out: np.ndarray) -> bool:
    """out (h, w) = sy sx - ey ex, values up to FLOOR to zero; whether any is left."""
    some = False
    for y in range(out.shape[0]):
        row, a, b = out[y], sy[y], ey[y]
        count = np.int32(0)
        for i in range(row.size):
            d = a * sx[i] - b * ex[i]
            d = d if abs(d) > FLOOR else np.float32(0.0)
            row[i] = d
            count += np.int32(d != np.float32(0.0))
        if count > 0:
            some = True
    return some
