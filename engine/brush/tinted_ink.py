"""The ink of a brush whose dabs have colours and amounts of their own: what it is under any of them.

With the colour C and the factor f of each component, a pixel's colour is C + sum f a s (X - C), as module `ink` has it:
what a component adds is linear in C, and is known from what it adds over black and over white.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace

import numpy as np

from engine.brush import sway
from engine.brush.ink import Ink, Texture, refuse_ways, resolve
from engine.brush.located import Patches, located
from engine.brush.settings import Brush
from engine.numeric.address import Rect, TileKey
from engine.texture.image import ImageSource
from engine.texture.planes import sort_key
from engine.texture.record import Instance
from engine.texture.rock import Rock

_LOWEST, _HIGHEST = "#000000", "#ffffff"
_SAMPLE = Rect(0, 0, 64, 64)  # by whose pixels the mean of a texture is told


@dataclass(frozen=True, eq=False, slots=True)
class _Linear:
    """A value by colour: `low` over black, `low + slope` over white; float32 (3,) each."""

    low: np.ndarray
    slope: np.ndarray

    def under(self, colour: np.ndarray) -> np.ndarray:
        """float32 (3, h, w), under colours of that shape."""
        out: np.ndarray = self.low[:, None, None] + self.slope[:, None, None] * colour
        return out


@dataclass(frozen=True, eq=False, slots=True)
class _Part:
    """A component: what it adds to the colour, and the amplitude of each of its instances."""

    shift: _Linear
    amplitudes: tuple[tuple[Instance, _Linear], ...]


@dataclass(frozen=True, eq=False)
class TintedInk(Ink):
    """An ink that is also known under tints: a colour, and a factor for each of its `parts`."""

    parts: tuple[_Part, ...] = ()
    level: int = 0
    _patches: dict[Instance, Patches] = field(default_factory=dict, repr=False)
    _means: dict[Instance, np.ndarray] = field(default_factory=dict, repr=False)

    def mean_of(self, made: Instance) -> np.ndarray:
        """Returns the mean of what a texture looks like, float32 (1 or 3,): the same bits everywhere."""
        if made not in self._means:
            seen = made.appearance(self.level, _SAMPLE)[:3]
            total = [math.fsum(plane.ravel().tolist()) / _SAMPLE.area for plane in seen]
            self._means[made] = np.array(total, np.float32)
        return self._means[made]

    def mean_under(self, tints: np.ndarray) -> np.ndarray:
        """Returns the colour that the ink has on the whole under tints, float64 (m, 3 + parts): float64 (m, 3)."""
        under = tints[:, :3]
        if not self.parts:
            return under
        out = under.copy()
        for part, factor in zip(self.parts, tints[:, 3:].T, strict=True):
            out += factor[:, None] * (part.shift.low + part.shift.slope * under)
            for made, amplitude in part.amplitudes:
                out += factor[:, None] * ((amplitude.low + amplitude.slope * under) * self.mean_of(made))
        held: np.ndarray = np.clip(out, 0.0, 1.0)
        return held

    def _seen(self, made: Instance, key: TileKey, places: np.ndarray | None) -> np.ndarray:
        if places is None:
            return made.appearance(key.level, key.rect)[:3]
        if made not in self._patches:
            self._patches[made] = Patches(lambda rect: made.appearance(self.level, rect)[:3])
        return located(places, self._patches[made])

    def rough(
        self, key: TileKey, colour: np.ndarray, amounts: np.ndarray, places: np.ndarray | None
    ) -> tuple[np.ndarray, np.ndarray, tuple[Instance, ...]]:
        """Returns, of a tile, by how much the ink differs from what it is on the whole under one `colour`, float32
        (3,), float32 (3, 128, 128); the amplitudes of its instances, and these.  `amounts`: of each part, float32
        (parts, 128, 128); `places`: as of `tinted`."""
        found: dict[Instance, np.ndarray] = {}
        for part, amount in zip(self.parts, amounts, strict=True):
            for made, amplitude in part.amplitudes:
                more = (amplitude.low + amplitude.slope * colour)[:, None, None] * amount
                found[made] = found[made] + more if made in found else more
        inks = tuple(sorted(found, key=lambda made: sort_key(made.key)))
        out = np.zeros((3, *amounts.shape[1:]), np.float32)
        for made in inks:
            out += found[made] * (self._seen(made, key, places) - self.mean_of(made)[:, None, None])
        inks = _going_on(inks, places)
        return out, np.concatenate([found[made] for made in inks]) if inks else out[:0], inks

    def tinted(
        self, key: TileKey, tints: np.ndarray, places: np.ndarray | None = None
    ) -> tuple[np.ndarray, np.ndarray, tuple[Instance, ...]]:
        """Under tints, float32 (3 + parts, 128, 128), of a tile: as `Ink.under`.  `places`: where its pixels lie in the
        textures (`located`), if these do not lie on the canvas: then only rock goes on at finer levels."""
        under = tints[:3]
        found: dict[Instance, np.ndarray] = {}
        colour = under.copy()
        for part, factor in zip(self.parts, tints[3:], strict=True):
            colour += factor * part.shift.under(under)
            for made, amplitude in part.amplitudes:
                more = factor * amplitude.under(under)
                found[made] = found[made] + more if made in found else more
        inks = tuple(sorted(found, key=lambda made: sort_key(made.key)))
        for made in inks:
            colour += found[made] * self._seen(made, key, places)
        inks = _going_on(inks, places)
        planes = [found[made] for made in inks]
        empty = np.empty((0, *under.shape[1:]), np.float32)
        return colour, np.concatenate(planes) if planes else empty, inks


def _going_on(inks: tuple[Instance, ...], places: np.ndarray | None) -> tuple[Instance, ...]:
    """Returns those that add detail at finer levels: all of the canvas; elsewhere only what has no direction, so that
    it does not show that it lies on the canvas."""
    return inks if places is None else tuple(made for made in inks if isinstance(made, Rock))


def tinted_ink(brush: Brush, textures: Mapping[str, Texture | ImageSource], level: int, seed: int) -> TintedInk:
    """Returns the ink of a brush, as `ink.resolve`; what goes with the pressure is as at full pressure."""
    ink = tuple(sway.still(component, textures) for component in brush.ink)
    whole = resolve(replace(brush, ink=ink), textures, level, seed)
    refuse_ways(whole, "another where a brush is wet, fixes its textures, or its colour follows something")
    parts = []
    for component in ink:
        alone = replace(brush, ink=(component,))
        low, high = (resolve(replace(alone, colour=colour), textures, level, seed) for colour in (_LOWEST, _HIGHEST))
        ends = [{part.instance: part.amplitude for part in one.loaded} for one in (low, high)]
        none = np.zeros(3, np.float32)
        each = dict.fromkeys((*ends[0], *ends[1]))
        amplitudes = tuple((made, _linear(*(end.get(made, none) for end in ends))) for made in each)
        parts.append(_Part(_linear(low.base, high.base - np.float32(1.0)), amplitudes))
    return TintedInk(whole.base, whole.loaded, parts=tuple(parts), level=level)


def _linear(low: np.ndarray, high: np.ndarray) -> _Linear:
    return _Linear(low, high - low)
