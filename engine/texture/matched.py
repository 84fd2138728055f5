"""Matched textures as ink: the result of a match, tiled without end, and beyond its own pixels more of the same kind.

Down to its native level S is the tile's pyramid (`engine.texture.spectral`).  Each finer level adds an octave of noise
matched to the texture's finest subbands (`engine.texture.continuation`), as strong as the roughness says: by default
the slope that was measured across the subbands, so that the spectrum goes on as it came; 0 is smooth.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import ClassVar

import numpy as np

from engine.numeric.address import Rect
from engine.numeric.hashing import fold_key
from engine.texture import sample
from engine.texture.continuation import STEEPEST, octave_of
from engine.texture.image import ImageSource, tiled
from engine.texture.octaves import Continuation
from engine.texture.spectral import Tiled

_DOMAIN = 0x6D6F6374  # "moct": tells these hashes from those of other textures
_SIZE = 1.0  # log2 of an octave's features in pixels of its level


@dataclass(frozen=True)
class Matched(Tiled):
    """One texture, repeated from pixel (0, 0) of the base level on."""

    kind: ClassVar[str] = "matched"

    def _octave(self, depth: int, rect: Rect) -> np.ndarray:
        tile = octave_of(self.shown).tile
        h = fold_key(_DOMAIN, depth)
        x, y = (h & 0xFFFFFFFF) % tile.shape[2], (h >> 32) % tile.shape[1]
        out = tiled(tile, Rect.at(rect.x0 + x, rect.y0 + y, rect.width, rect.height))
        out *= np.float32(_stretched(self.shown, self.period, self.roughness))
        return out

    @property
    def form(self) -> Continuation:
        return _form(self.shown, self.period, self.roughness)


@dataclass(frozen=True)
class Series(Matched):
    """One of several textures between two, made of the same noise, or what lies between two of them.

    The picture holds them one below the other, `stages` of them, at the weights 0 to 1; `weight` says which one it is.
    """

    stages: int
    weight: float

    kind: ClassVar[str] = "series"

    @property
    def key(self) -> tuple:
        numbers = (self.period, self.roughness, self.stages, self.weight)
        return (self.kind, self.base, *numbers, self.source.name, self.source.sha)

    @property
    def coloured(self) -> bool:
        """Of the whole series: one of its textures may be grey all the same."""
        return sample.coloured(self.source)

    @property
    def shown(self) -> ImageSource:
        lost = self.source.data is None or self.source.height < self.stages
        return self.source if lost else stage(self.source, self.stages, self.weight)


def series(base: int, period: int, roughness: float, stages: int, weight: float, source: ImageSource) -> Series:
    """The texture at `weight` of a series."""
    return Series(base, period, roughness, source, stages, weight)


def weights(stages: int) -> tuple[float, ...]:
    """Those of the textures of a series."""
    return tuple(k / (stages - 1) for k in range(stages)) if stages > 1 else (0.0,)


@lru_cache(maxsize=64)
def stage(whole: ImageSource, stages: int, weight: float) -> ImageSource:
    """One picture of a series: between two stages, their mean by the weight."""
    assert whole.data is not None
    place = weight * (stages - 1)
    k = min(int(place), max(stages - 2, 0))
    height = whole.height // stages
    first, second = (whole.data[:, i * height : (i + 1) * height] for i in (k, min(k + 1, stages - 1)))
    part = np.float32(place - k)
    data = first if part == 0.0 else second if part == 1.0 else first + (second - first) * part
    return ImageSource(whole.name, f"{whole.sha}/{stages}/{weight!r}", np.ascontiguousarray(data))


def _stretched(source: ImageSource, period: int, roughness: float) -> float:
    """How much weaker an octave is because the native level is wider than the picture's own pixels."""
    wide = sample.tile(source, period).levels[-1].shape[2] / max(source.width, 1)
    return max(roughness, STEEPEST) ** math.log2(wide)


@lru_cache(maxsize=256)
def _form(source: ImageSource, period: int, roughness: float) -> Continuation:
    """How strong an octave is to the texture, and how large the features of both are."""
    tile = sample.tile(source, period)
    own, octave = (
        float(np.square(planes, dtype=np.float64).mean()) for planes in (tile.levels[-1], octave_of(source).tile)
    )
    strength = math.sqrt(octave / own) * _stretched(source, period, roughness) if own > 0.0 else 0.0
    return replace(tile.form, strength=round(strength, 6), octave=_SIZE)
