"""Spectral textures as ink: a sample tiled, or the endless field that it is the impulse response of (Lewis 1984, 5.2).

Down to the sample's native level S is that of the tile or the field: S_k is the mean of S_(k+1) over 2 x 2 pixels.
Beyond, it is continued by self-similar octaves: octave j is the sample's finest content (`sample.Tile.top`), laid at
level native + j as it was at the native level, in other places and about r^j as strong, r being the roughness.  With E
for expand and O_j for an octave (O_0: the texture itself, less its mean) the texture at depth d (level native + d) is

    S_d = mean + sum over j <= d of  W(d, j) E^(d-j) O_j        with the weights of `engine.texture.octaves`.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache
from typing import ClassVar

import numpy as np

from engine.numeric import sparse
from engine.numeric.address import Rect
from engine.numeric.arithmetic import LIBRARY
from engine.numeric.detail import add_expanded, cut, parents, subtract_expanded
from engine.numeric.hashing import fold_key
from engine.numeric.spectra import SPREAD
from engine.texture import sample
from engine.texture.image import ImageSource, tiled
from engine.texture.octaves import Continuation, lasting, octave_changes, octave_weights
from engine.texture.record import told_kind

_DOMAIN = 0x73706172  # "spar": tells these hashes from those of other textures


class _Spectral:
    """What both share.  `_own` gives the texture from its base to its native level, `_octave` what continues it; both
    float32 (c, h, w), of mean zero."""

    kind: ClassVar[str]
    base: int
    period: int
    roughness: float
    source: ImageSource
    arithmetic: int
    renew: bool

    @property
    def shown(self) -> ImageSource:
        """Returns the sample: the picture, or a part of it."""
        return self.source

    @property
    def coloured(self) -> bool:
        """Tells whether S has three channels."""
        return sample.coloured(self.shown)

    @property
    def native(self) -> int:
        """Returns the level of the sample's own pixels; it may be coarser than the base."""
        raise NotImplementedError

    @property
    def centre(self) -> np.ndarray:
        """Of each channel: float32 (c, 1, 1)."""
        raise NotImplementedError

    @property
    def form(self) -> Continuation:
        raise NotImplementedError

    @property
    def raised(self) -> bool:
        """Tells whether older octaves are raised again below some level."""
        return not lasting(self.roughness, self.renew)

    def newest(self, depth: int) -> float:
        """Returns the weight of the octave that a level adds so many levels below the native one."""
        changes = octave_changes(depth, self.roughness, self.form, self.arithmetic, self.renew)
        return float(changes[0]) if changes.size else 0.0

    def _own(self, level: int, rect: Rect) -> np.ndarray:
        raise NotImplementedError

    def _octave(self, depth: int, rect: Rect) -> np.ndarray:
        raise NotImplementedError

    def appearance(self, level: int, rect: Rect) -> np.ndarray:
        if level < self.base:
            raise ValueError(f"{self.kind}: level {level} is coarser than the base level {self.base}")
        if not self.shown.there:
            return np.zeros((1, rect.height, rect.width), np.float32)
        if level <= self.native:
            out: np.ndarray = self._own(level, rect) + self.centre
            return out
        factors = octave_weights(level - self.native, self.roughness, self.form, self.arithmetic, self.renew)
        carried: np.ndarray = self._cascade(level - self.native, rect, factors) + self.centre
        return carried

    def bandpass(self, level: int, rect: Rect) -> np.ndarray | None:
        if level <= self.base or rect.empty or not self.shown.there:
            return None
        if level > self.native:
            changes = octave_changes(level - self.native, self.roughness, self.form, self.arithmetic, self.renew)
            return self._cascade(level - self.native, rect, changes) if changes.size else None
        even = rect.evened()
        out = self._own(level, even)
        return cut(out, rect, even) if subtract_expanded(out, self._own(level - 1, parents(even))) else None

    def _cascade(self, depth: int, rect: Rect, factors: np.ndarray) -> np.ndarray:
        """sum over m of factors[m] E^m O_(depth - m), over `rect`."""
        places = [rect.evened()]
        for _ in range(factors.size - 1):
            places.append(parents(places[-1]).evened())
        channels = 3 if sample.coloured(self.shown) else 1
        coarse: np.ndarray | None = None
        for m in range(factors.size - 1, -1, -1):
            even = places[m]
            if factors[m] != 0.0:
                out = self._own(self.native, even) if m == depth else self._octave(depth - m, even)
                out *= factors[m]
            else:
                out = np.zeros((channels, even.height, even.width), np.float32)
            if coarse is not None:
                add_expanded(out, cut(coarse, parents(even), places[m + 1]))
            coarse = out
        assert coarse is not None
        return cut(coarse, rect, places[0])


@dataclass(frozen=True)
class Tiled(_Spectral):
    """The sample itself, repeated from pixel (0, 0) of the base level on.

    `period`: its width in pixels of the base level; `roughness`: the strength of an octave to the one before, 0..1.
    """

    base: int
    period: int
    roughness: float
    source: ImageSource
    arithmetic: int = LIBRARY
    renew: bool = True

    kind: ClassVar[str] = "spectrum"

    @property
    def key(self) -> tuple[object, ...]:
        """Tells this instance from all others, as `Instance.key`."""
        told = told_kind(self.kind, self.arithmetic, self.renew)
        return (told, self.base, self.period, self.roughness, self.source.name, self.source.sha)

    @property
    def native(self) -> int:
        """Gives the level at which a pixel is one of the sample's."""
        return self.base + sample.finer(self.shown, self.period)

    @property
    def centre(self) -> np.ndarray:
        """Gives the mean around which the sample varies: float32 (1 or 3, 1, 1)."""
        return sample.tile(self.shown, self.period, self.arithmetic).mean

    @property
    def form(self) -> Continuation:
        """Gives how octaves beyond the sample's pixels go on."""
        return sample.tile(self.shown, self.period, self.arithmetic).form

    @property
    def size(self) -> tuple[int, int]:
        """Gives its width and height at the native level."""
        height, width = sample.tile(self.shown, self.period, self.arithmetic).levels[-1].shape[1:]
        return width, height

    @property
    def octave(self) -> np.ndarray:
        """Gives what continues it: float32 (c, h, w), before its weight."""
        return sample.tile(self.shown, self.period, self.arithmetic).top

    def _own(self, level: int, rect: Rect) -> np.ndarray:
        levels = sample.tile(self.shown, self.period, self.arithmetic).levels
        return tiled(levels[level - self.native - 1], rect)

    def _octave(self, depth: int, rect: Rect) -> np.ndarray:
        """Returns the tile's finest content, shifted elsewhere."""
        top = self.octave
        h = fold_key(_DOMAIN, depth)
        x, y = (h & 0xFFFFFFFF) % top.shape[2], (h >> 32) % top.shape[1]
        return tiled(top, Rect.at(rect.x0 + x, rect.y0 + y, rect.width, rect.height))


@dataclass(frozen=True)
class Sparse(_Spectral):
    """The endless field by sparse convolution with the windowed sample: S = mean + spread 0.36 F, F of variance 1.

    `turn`: of how much of a whole turn each copy is turned at random (Lewis' faulting takes all of it);
    `density`: points per area of the sample; `mean`, `spread`: of S (a coloured sample's own mean is added);
    `quantise`: 0, or how many values the points' weights have; `seed`: another one, another field.
    """

    base: int
    period: int
    roughness: float
    density: float
    mean: float
    spread: float
    quantise: int
    seed: int
    turn: float
    source: ImageSource
    arithmetic: int = LIBRARY
    renew: bool = True

    kind: ClassVar[str] = "sparse"

    @property
    def key(self) -> tuple[object, ...]:
        """Tells this instance from all others, as `Instance.key`."""
        numbers = (self.roughness, self.density, self.mean, self.spread, self.quantise, self.seed)
        told = told_kind(self.kind, self.arithmetic, self.renew)
        turn = (self.turn,) if self.turn else ()
        return (told, self.base, self.period, *numbers, *turn, self.source.name, self.source.sha)

    @property
    def native(self) -> int:
        """Gives the level at which a pixel is one of the sample's."""
        return self.base + sample.finer(self.source, self.period, sample.LARGEST)

    @property
    def centre(self) -> np.ndarray:
        """Gives the mean of the field: float32 (1 or 3, 1, 1)."""
        if not self.coloured:
            return np.full((1, 1, 1), self.mean, np.float32)
        return sample.sample_response(self.source, self.period, self.arithmetic).mean + np.float32(self.mean)

    def impulse(self, level: int) -> sparse.Impulse:
        """Returns the impulse response at a level from the base to the native one."""
        if level >= self.native:
            return sample.sample_response(self.source, self.period, self.arithmetic).own
        return sample.seen(self.source, self.period, self.native - level, self.arithmetic)

    @property
    def form(self) -> Continuation:
        """Gives how octaves beyond the sample's pixels go on."""
        return sample.finest(self.source, self.period, self.arithmetic)[1]

    @property
    def noise(self) -> sparse.Noise:
        """Returns the points of the field at the native level."""
        return self._noise(0)

    def _noise(self, octave: int) -> sparse.Noise:
        return sparse.Noise(_key(self.seed, self.base, self.native + octave), self.density, self.quantise)

    def _own(self, level: int, rect: Rect) -> np.ndarray:
        return self._field(self.layers(level), rect)

    def _octave(self, depth: int, rect: Rect) -> np.ndarray:
        return self._field(self.layers(self.native + depth), rect)

    def loudness(self, level: int) -> tuple[float, float]:
        """Returns how far the field is from its mean at most, and by rms, at a level down to the native one; beyond, an
        octave before its weight."""
        found = [sparse.loudness(impulse, noise) for impulse, noise in self.layers(level)]
        factor = self.spread * SPREAD / math.sqrt(self.density)
        return sum(most for most, _ in found) * factor, math.sqrt(sum(own * own for _, own in found)) * factor

    def layers(self, level: int) -> list[tuple[sparse.Impulse, sparse.Noise]]:
        """Returns what lies over one another at a level: responses, and the points at which copies of each begin."""
        octave = max(0, level - self.native)
        noise, about = self._noise(octave), (self.source, self.period)
        if not self.turn:
            plain = sample.finest(*about, self.arithmetic)[0] if octave else self.impulse(level)
            return [(plain, noise)]
        if level < self.native:
            turned = sample.turned_seen(*about, self.turn, self.native - level, self.arithmetic)
        else:
            turned = sample.turned_responses(*about, self.turn, self.arithmetic, octave > 0)
        height, width = self.impulse(self.native).size
        density = self.density * (max(height, width) ** 2 / (height * width)) / len(turned)
        keys = (fold_key(noise.key, n) for n in range(len(turned)))
        return [(one, sparse.Noise(key, density, self.quantise)) for one, key in zip(turned, keys, strict=True)]

    def _field(self, laid: list[tuple[sparse.Impulse, sparse.Noise]], rect: Rect) -> np.ndarray:
        out = sparse.field(*laid[0], rect)
        for impulse, noise in laid[1:]:
            out += sparse.field(impulse, noise, rect)
        # A response of energy 1 per area makes a field of variance `density`, whatever the sample.
        out *= np.float32(self.spread * SPREAD / math.sqrt(self.density))
        return out


@lru_cache(maxsize=4096)
def _key(seed: int, base: int, level: int) -> int:
    return fold_key(_DOMAIN, seed, base, level)
