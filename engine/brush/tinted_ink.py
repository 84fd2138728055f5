"""The ink of a brush whose dabs have colours and amounts of their own: what it is under any of them.

With the colour C and the factor f of each component, a pixel's colour is C + sum f a s (X - C), as module `ink` has it:
what a component adds is linear in C, and is known from what it adds over black and over white.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import NamedTuple

import numpy as np

from engine.brush import sway
from engine.brush.dyeing import dye
from engine.brush.ink import Ink, Texture, refuse_ways, resolve
from engine.brush.located import Patches, located
from engine.brush.settings import Brush
from engine.numeric.address import TILE, Rect, TileKey
from engine.numeric.oklch import lab_of, shift_colours
from engine.texture.image import ImageSource
from engine.texture.planes import COLOURS, sort_key
from engine.texture.record import Instance
from engine.texture.rock import Rock

_LOWEST, _HIGHEST = "#000000", "#ffffff"
_SAMPLE = Rect(0, 0, 64, 64)  # by whose pixels the mean of a texture is told


class _Linear(NamedTuple):
    """A value by colour: `low` over black, `low + slope` over white; float32 (3,) each."""

    low: np.ndarray
    slope: np.ndarray


@dataclass(frozen=True, eq=False, slots=True)
class _Part:
    """A component: what it adds to the colour, and the amplitude of each of its instances."""

    shift: _Linear
    amplitudes: tuple[tuple[Instance, _Linear], ...]


@dataclass(frozen=True, eq=False)
class TintedInk(Ink):
    """An ink that is also known under tints: a colour, and a factor for each of its `parts`.  `own`: the brush's
    colour, float32 (3,), as dabs have it that follow nothing."""

    parts: tuple[_Part, ...] = ()
    own: np.ndarray = field(default_factory=lambda: np.zeros(3, np.float32))
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

    def _seen(self, made: Instance, key: TileKey, places: np.ndarray | None, covered: np.ndarray) -> np.ndarray:
        if places is None:
            return made.appearance(key.level, key.rect)[:3]
        if made not in self._patches:
            self._patches[made] = Patches(lambda rect: made.appearance(self.level, rect)[:3])
        return located(places, covered, self._patches[made])

    def rough(
        self, key: TileKey, colour: np.ndarray, amounts: np.ndarray, places: np.ndarray | None, covered: np.ndarray
    ) -> tuple[np.ndarray, np.ndarray, tuple[Instance, ...]]:
        """Returns, of a tile, by how much the ink differs from what it is on the whole under one `colour`, float32
        (3,), float32 (3, 128, 128); the amplitudes of its instances, and these.  `amounts`: of each part, float32
        (parts, 128, 128); `places`: as of `lay`."""
        found: dict[Instance, np.ndarray] = {}
        for part, amount in zip(self.parts, amounts, strict=True):
            for made, amplitude in part.amplitudes:
                more = (amplitude.low + amplitude.slope * colour)[:, None, None] * amount
                found[made] = found[made] + more if made in found else more
        inks = tuple(sorted(found, key=lambda made: sort_key(made.key)))
        out = np.zeros((3, *amounts.shape[1:]), np.float32)
        for made in inks:
            out += found[made] * (self._seen(made, key, places, covered) - self.mean_of(made)[:, None, None])
        inks = _going_on(inks, places)
        return out, np.concatenate([found[made] for made in inks]) if inks else out[:0], inks

    @cached_property
    def _each(self) -> tuple[Instance, ...]:
        every = {made for part in self.parts for made, _ in part.amplitudes}
        return tuple(sorted(every, key=lambda made: sort_key(made.key)))

    @cached_property
    def _lines(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Shifts, terms and amplitudes, as `dye` wants them."""
        shifts = np.array([part.shift for part in self.parts], np.float32).reshape(-1, 2, 3)
        terms = [(n, *one) for n, part in enumerate(self.parts) for one in part.amplitudes]
        told = np.array([(n, self._each.index(made)) for n, made, _ in terms], np.int64).reshape(-1, 2)
        return shifts, told, np.array([line for *_, line in terms], np.float32).reshape(-1, 2, 3)

    @cached_property
    def untinted(self) -> np.ndarray:
        """The tints of dabs that follow nothing, over a tile."""
        told = np.concatenate([self.own, np.ones(len(self.parts), np.float32)])
        return np.tile(told[:, None, None], (1, TILE, TILE))

    def inks_under(self, places: np.ndarray | None) -> tuple[Instance, ...]:
        """Returns the instances that have planes of their own under tints."""
        return _going_on(self._each, places)

    def lay(
        self, key: TileKey, tints: np.ndarray, places: np.ndarray | None, weight: np.ndarray, add: np.ndarray
    ) -> None:
        """Writes B of a tile under tints, float32 (3 + parts, 128, 128), laid with a weight, float32 (128, 128), but
        for alpha: float32 (4 + 3 n, 128, 128), n of `inks_under`.  `places`: where its pixels lie in the textures
        (`located`), if these do not lie on the canvas: then only rock goes on at finer levels."""
        looks = [self._seen(made, key, places, weight) for made in self._each]
        seen = np.concatenate(looks) if looks else np.empty((0, *weight.shape), np.float32)
        shown, inks, first = np.empty((len(looks), 4), np.int64), self.inks_under(places), 0
        for row, made, look in zip(shown, self._each, looks, strict=True):
            row[:3] = first + np.arange(3) % len(look)
            row[3] = COLOURS + 3 * inks.index(made) if made in inks else -1
            first += len(look)
        dye(weight, tints, *self._lines, seen, shown, add)


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
    own = np.array([[0.0, 1.0, 1.0]])  # of hue, lightness, chroma
    shift_colours(own, lab_of(brush.rgb))
    return TintedInk(whole.base, whole.loaded, parts=tuple(parts), own=own[0].astype(np.float32), level=level)


def _linear(low: np.ndarray, high: np.ndarray) -> _Linear:
    return _Linear(low, high - low)
