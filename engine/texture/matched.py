"""Matched textures as ink: the result of a match, tiled without end, and beyond its own pixels more of the same kind.

Down to its native level S is the tile's pyramid (`engine.texture.spectral`).  Each finer level adds an octave of noise
matched to the texture's finest subbands (`engine.texture.continuation`), as strong as the roughness says: by default
the slope that was measured across the subbands, so that the spectrum goes on as it came; 0 is smooth.

A texture with alpha is a picture like any other: premultiplied RGBA, whose alpha is a texture too, of the same noise at
every level.  As ink, its alpha hides what its colours are laid over.  An octave is strong wherever it falls, also where
the picture is clear, or opaque, all around.  So beyond its own pixels alpha is sent through a curve: what is nearer to
0 or 1 than noise reaches is 0 or 1; colours keep what they are where they are seen.  A curve is no linear thing, so
there the bandpass is what two levels differ by, as of `engine.texture.shaped`.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, fields, replace
from typing import ClassVar

import numpy as np

from engine.numeric.address import Rect
from engine.numeric.array_functions import array_functions
from engine.numeric.detail import cut, parents, subtract_expanded
from engine.numeric.functions import functions
from engine.numeric.hashing import fold_key
from engine.numeric.memo import remembered
from engine.texture import sample
from engine.texture.continuation import STEEPEST, octave_of
from engine.texture.image import ImageSource, tiled
from engine.texture.octaves import Continuation, octave_weights
from engine.texture.record import told_kind
from engine.texture.spectral import Tiled

_DOMAIN = 0x6D6F6374  # "moct": tells these hashes from those of other textures
_SIZE = 1.0  # log2 of an octave's features in pixels of its level
_LOUD = 0.125  # roughness below which octaves are too faint to be seen in alpha
_REACH, _FARTHEST = 1.25, 0.12  # how far noise reaches: standard deviations of it, and at most
_TINY = np.float32(1e-6)


@dataclass(frozen=True)
class Matched(Tiled):
    """One texture, repeated from pixel (0, 0) of the base level on.

    S is as of other samples; with alpha, premultiplied RGBA (4, h, w) as of an image, and the bandpass its colours'.
    """

    kind: ClassVar[str] = "matched"

    @property
    def picture(self) -> ImageSource:
        """Returns the picture of this texture, with its alpha."""
        return self.source

    @property
    def shown(self) -> ImageSource:
        """Gives the picture that is tiled."""
        return self.picture

    @property
    def cover(self) -> Matched | None:
        """Returns what it hides of another colour that it lies over: its alpha as a texture.  None if it is opaque."""
        if not self.source.there or self.source.opaque:
            return None
        return _COVERS[self.kind](**{field.name: getattr(self, field.name) for field in fields(self)})

    def appearance(self, level: int, rect: Rect) -> np.ndarray:
        """Gives S at a level over a rectangle, as `Instance.appearance`."""
        seen, cover = super().appearance(level, rect), self.cover
        if cover is None:
            return seen
        out = np.empty((4, rect.height, rect.width), np.float32)
        out[:3] = _unit(seen)
        if not self._curved(level):
            out[3:] = cover.appearance(level, rect)
            return out
        alpha = _unit(Tiled.appearance(cover, level, rect))[0]
        out[3] = self._curve(alpha, level)
        out[:3] = np.clip(out[:3] / np.maximum(alpha, _TINY), 0.0, 1.0) * out[3]
        return out

    def bandpass(self, level: int, rect: Rect) -> np.ndarray | None:
        """Gives what the level adds over a rectangle, as `Instance.bandpass`."""
        if self.source.opaque or not self.source.there:
            return super().bandpass(level, rect)
        if not self._curved(level) or level <= self.base or rect.empty:
            found = super().bandpass(level, rect)
            return None if found is None else found * np.float32(0.5)
        even = rect.evened()
        fine = self.appearance(level, even)[:3]
        subtract_expanded(fine, self.appearance(level - 1, parents(even))[:3])
        return cut(fine, rect, even)

    def _curved(self, level: int) -> bool:
        """Tells whether noise added to the alpha may be seen."""
        return self.source.there and level > self.native and self.roughness >= _LOUD

    def _curve(self, alpha: np.ndarray, level: int) -> np.ndarray:
        """0 up to t, as it is from 2.5 t on; 1 likewise."""
        about = self.roughness, level - self.native, self.arithmetic, self.renew
        t = np.float32(_reach(self.picture, self.period, *about))
        near = np.clip(np.minimum(alpha, np.float32(1.0) - alpha), np.float32(0.0), np.float32(0.5))
        near = np.minimum(near, np.maximum(near - t, np.float32(0.0)) * np.float32(2.5 / 1.5))
        out: np.ndarray = np.where(alpha < np.float32(0.5), near, np.float32(1.0) - near)
        return out

    @property
    def octave(self) -> np.ndarray:
        """Gives what continues it: float32 (c, h, w), before its weight."""
        own = self._planes(octave_of(self.picture, self.arithmetic).tile)
        return own * np.float32(_stretched(self.shown, self.period, self.roughness, self.arithmetic))

    def _octave(self, depth: int, rect: Rect) -> np.ndarray:
        tile = self._planes(octave_of(self.picture, self.arithmetic).tile)
        h = fold_key(_DOMAIN, depth)
        x, y = (h & 0xFFFFFFFF) % tile.shape[2], (h >> 32) % tile.shape[1]
        out = tiled(tile, Rect.at(rect.x0 + x, rect.y0 + y, rect.width, rect.height))
        out *= np.float32(_stretched(self.shown, self.period, self.roughness, self.arithmetic))
        return out

    def _planes(self, octave: np.ndarray) -> np.ndarray:
        """Returns those of an octave that continue what is shown."""
        return octave[:-1]

    @property
    def form(self) -> Continuation:
        """Returns the same for colours and alpha, so that they stay together."""
        return _form(self.picture, self.period, self.roughness, self.arithmetic)


@dataclass(frozen=True)
class Series(Matched):
    """One of several textures between two, made of the same noise, or what lies between two of them.

    The picture holds them one below the other, `stages` of them, at the weights 0 to 1; `weight` says which one it is.
    """

    stages: int = 2
    weight: float = 0.0

    kind: ClassVar[str] = "series"

    @property
    def key(self) -> tuple[object, ...]:
        """Tells this instance from all others, as `Instance.key`."""
        numbers = (self.period, self.roughness, self.stages, self.weight)
        told = told_kind(self.kind, self.arithmetic, self.renew)
        return (told, self.base, *numbers, self.source.name, self.source.sha)

    @property
    def coloured(self) -> bool:
        """Of the whole series: one of its textures may be grey all the same."""
        return sample.coloured(self.source)

    @property
    def picture(self) -> ImageSource:
        """Gives the picture of the stage that the pen's pressure chose; the source where its pixels are not there."""
        lost = not self.source.there or self.source.height < self.stages
        return self.source if lost else stage(self.source, self.stages, self.weight)


class _Alpha(Matched):
    """The alpha of a matched texture, 0..1: S and the bandpass (1, h, w)."""

    @property
    def shown(self) -> ImageSource:
        return self.picture if not self.source.there else _alpha(self.picture)

    @property
    def coloured(self) -> bool:
        return False

    @property
    def cover(self) -> None:
        return None

    def appearance(self, level: int, rect: Rect) -> np.ndarray:
        seen = super().appearance(level, rect)
        if not self.source.there:
            return seen
        return self._curve(_unit(seen), level) if self._curved(level) else _unit(seen)

    def _planes(self, octave: np.ndarray) -> np.ndarray:
        return octave[-1:]


@dataclass(frozen=True)
class MatchedCover(_Alpha, Matched):
    """The alpha of a matched texture."""

    kind: ClassVar[str] = "matched-cover"


@dataclass(frozen=True)
class SeriesCover(_Alpha, Series):
    """The alpha of a texture of a series."""

    kind: ClassVar[str] = "series-cover"


_COVERS: dict[str, type[Matched]] = {"matched": MatchedCover, "series": SeriesCover}


def _unit(planes: np.ndarray) -> np.ndarray:
    """0..1 of -1..1, on the grid if they are."""
    return (planes + np.float32(1.0)) * np.float32(0.5)


def series(base: int, period: int, roughness: float, stages: int, weight: float, source: ImageSource) -> Series:
    """Returns the texture at `weight` of a series."""
    return Series(base, period, roughness, source, stages=stages, weight=weight)


def series_cover(base: int, period: int, roughness: float, stages: int, weight: float, source: ImageSource) -> Series:
    """Returns its alpha."""
    return SeriesCover(base, period, roughness, source, stages=stages, weight=weight)


def weights(stages: int) -> tuple[float, ...]:
    """Returns those of the textures of a series."""
    return tuple(k / (stages - 1) for k in range(stages)) if stages > 1 else (0.0,)


@remembered
def stage(whole: ImageSource, stages: int, weight: float) -> ImageSource:
    """Returns one picture of a series: between two stages, their mean by the weight."""
    place = weight * (stages - 1)
    k = min(int(place), max(stages - 2, 0))
    height = whole.height // stages
    places = (Rect.at(0, i * height, whole.width, height) for i in (k, min(k + 1, stages - 1)))
    first, second = (whole.planes(place) for place in places)
    part = np.float32(place - k)
    data = first if part == 0.0 else second if part == 1.0 else first + (second - first) * part
    return ImageSource(whole.name, f"{whole.sha}/{stages}/{weight!r}", np.ascontiguousarray(data))


@remembered
def _alpha(picture: ImageSource) -> ImageSource:
    """Returns the alpha of a picture, as an opaque grey one."""
    data = np.ones((4, picture.height, picture.width), np.float32)
    data[:3] = picture.planes(picture.whole)[3]
    return ImageSource(picture.name, f"{picture.sha}/alpha", data)


def _stretched(source: ImageSource, period: int, roughness: float, arithmetic: int) -> float:
    """Tells how much weaker an octave is because the native level is wider than the picture's own pixels."""
    wide = sample.tile(source, period, arithmetic).levels[-1].shape[2] / max(source.width, 1)
    own = functions(arithmetic)
    return own.power(max(roughness, STEEPEST), own.log2(wide))


@remembered
def _form(picture: ImageSource, period: int, roughness: float, arithmetic: int) -> Continuation:
    """Tells how strong an octave is to the texture, and how large the features of both are."""
    tiles = [sample.tile(picture, period, arithmetic)]
    octave = octave_of(picture, arithmetic).tile
    if picture.opaque:
        octave = octave[:-1]
    else:
        tiles.append(sample.tile(_alpha(picture), period, arithmetic))
    own, added = (
        _energy(planes, arithmetic) for planes in (np.concatenate([tile.levels[-1] for tile in tiles]), octave)
    )
    strength = math.sqrt(added / own) * _stretched(picture, period, roughness, arithmetic) if own > 0.0 else 0.0
    loudest = max(tiles, key=lambda tile: _energy(tile.levels[-1], arithmetic))
    return replace(loudest.form, strength=round(strength, 6), octave=_SIZE)


@remembered
def _reach(picture: ImageSource, period: int, roughness: float, depth: int, arithmetic: int, renew: bool) -> float:
    """Tells how far octaves move the alpha of what is opaque or clear, at a depth beyond the native level."""
    form = _form(picture, period, roughness, arithmetic)
    weights = octave_weights(depth, roughness, form, arithmetic, renew)[:depth]
    own = math.sqrt(_energy(octave_of(picture, arithmetic).tile[-1:], arithmetic)) / 2.0
    own *= _stretched(picture, period, roughness, arithmetic)
    far = float(array_functions(arithmetic).total(np.square(weights, dtype=np.float64)))
    return round(min(_REACH * own * math.sqrt(far), _FARTHEST), 5)


def _energy(planes: np.ndarray, arithmetic: int) -> float:
    return float(array_functions(arithmetic).mean(np.square(planes, dtype=np.float64)))
