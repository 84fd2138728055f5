"""Pictures and matched textures that are refined, below their own pixels, by what was learnt of them.

Level n + 1, n being the last with pixels of their own, is made of level n by maps (`engine.texture.learnt.refinement`),
and level n + 2 of that.  A picture is smooth from there on; a matched texture goes on by octaves of noise, as ever,
the first of them being weaker.
"""

from __future__ import annotations

from dataclasses import dataclass, fields
from functools import cached_property

import numpy as np

from engine.numeric.address import Rect
from engine.texture.image import Cover, Image, ImageSource
from engine.texture.learnt.maps import maps_of
from engine.texture.learnt.refinement import UNLEARNT, Learning, channels_of
from engine.texture.matched import Matched, MatchedCover, Series, SeriesCover
from engine.texture.octaves import octave_weights
from engine.texture.record import LEARNT, Instance

_FADED = (0.5, 0.75)  # of the first octaves of noise after those that were learnt
_LEAST = 0.02  # roughness below which octaves have no weight that learnt ones could be measured by
_HALF, _ONE = np.float32(0.5), np.float32(1.0)


class Refined:
    """What all of them have: how they were refined."""

    learning: Learning

    @property
    def maps(self) -> ImageSource:
        """Gives the maps as a picture."""
        return self.learning.maps


@dataclass(frozen=True)
class LearntImage(Refined, Image):
    """A picture whose next two octaves are learnt."""

    learning: Learning

    @property
    def key(self) -> tuple[object, ...]:
        """Tells this instance from all others, as `Instance.key`."""
        return (LEARNT, self.base, *self.learning.key, Image(self.base, self.period, self.source).key)

    @property
    def cover(self) -> LearntCover | None:
        """Returns what the picture hides, as `Image.cover`."""
        return None if self.source.opaque else LearntCover(self.base, self.period, self.source, self.learning)

    def appearance(self, level: int, rect: Rect) -> np.ndarray:
        """Gives S at a level over a rectangle, as `Instance.appearance`."""
        octave = self._octave_at(level)
        if octave is None:
            return super().appearance(level, rect)
        return _four(self.learning.seen(octave, rect, self._pixels))[self.shown]

    def bandpass(self, level: int, rect: Rect) -> np.ndarray | None:
        """Gives what the level adds over a rectangle, as `Instance.bandpass`."""
        octave = self._octave_at(level)
        if octave is None or rect.empty:
            return super().bandpass(level, rect)
        added = self.learning.added(octave, rect, self._pixels)
        return _four(added, np.float32(0.0))[self.refined] if added.any() else None

    def _octave_at(self, level: int) -> int | None:
        """Tells which of the learnt octaves a level adds."""
        octave = level - self.base - self.refinements
        return octave if self.source.there and 0 < octave <= self.learning.there else None

    def _pixels(self, rect: Rect) -> np.ndarray:
        maps = maps_of(self.learning.maps)
        assert maps is not None
        return channels_of(self._own(self.base + self.refinements, rect, slice(0, 4)), maps)


@dataclass(frozen=True)
class LearntCover(LearntImage):
    """The alpha of such a picture."""

    kind = Cover.kind
    shown = Cover.shown
    refined = Cover.refined

    @property
    def key(self) -> tuple[object, ...]:
        """Tells this instance from all others, as `Instance.key`."""
        return (LEARNT, self.base, *self.learning.key, Cover(self.base, self.period, self.source).key)


def _four(planes: np.ndarray, alpha: np.float32 = _ONE) -> np.ndarray:
    """Returns RGBA of grey, RGB or RGBA."""
    if len(planes) == 4:
        return planes
    out = np.empty((4, *planes.shape[1:]), np.float32)
    out[:3] = planes
    out[3] = alpha
    return out


@dataclass(frozen=True)
class LearntMatched(Refined, Matched):
    """A matched texture whose next two octaves are learnt."""

    learning: Learning = UNLEARNT

    @property
    def key(self) -> tuple[object, ...]:
        """Tells this instance from all others, as `Instance.key`."""
        return (LEARNT, self.base, *self.learning.key, super().key)

    @property
    def cover(self) -> Matched | None:
        """Returns what it hides, as `Matched.cover`."""
        return None if not self.source.there or self.source.opaque else _as(_LEARNT_COVERS[self.kind], self)

    def _curved(self, level: int) -> bool:
        return level > self.native + self.learning.there and super()._curved(level)

    def _octave(self, depth: int, rect: Rect) -> np.ndarray:
        there = self.learning.there
        if depth <= there:
            weight = octave_weights(depth, self.roughness, self.form, self.arithmetic, self.renew)[0]
            learnt_octave = self._learnt(depth, rect)
            learnt_octave *= np.float32(2.0) / weight
            return learnt_octave
        out = super()._octave(depth, rect)
        if there and depth - there <= len(_FADED):
            out *= np.float32(_FADED[depth - there - 1])
        return out

    def _learnt(self, octave: int, rect: Rect) -> np.ndarray:
        """Returns what a learnt octave adds to the planes that are shown, in units of 0..1."""
        added = self.learning.added(octave, rect, self.pixels)
        return _four(added)[:3] if self.coloured else added[:1]

    def pixels(self, rect: Rect) -> np.ndarray:
        """Returns its own pixels with the channels that maps are for: float32 in 0..1."""
        seen = (self._own(self.native, rect) + self.centre + _ONE) * _HALF
        maps, alpha = maps_of(self.learning.maps), self.cover
        assert maps is not None
        if alpha is not None:
            seen = np.concatenate([_four(seen)[:3], (alpha._own(self.native, rect) + alpha.centre + _ONE) * _HALF])
        return channels_of(np.clip(seen, 0.0, 1.0), maps)


@dataclass(frozen=True)
class LearntSeries(LearntMatched, Series):
    """A texture of a series whose next two octaves are learnt."""


class _Alpha(LearntMatched):
    """The alpha of one of both."""

    @cached_property
    def _whole(self) -> LearntMatched:
        return _as(LearntSeries if self.kind == SeriesCover.kind else LearntMatched, self)

    def _learnt(self, octave: int, rect: Rect) -> np.ndarray:
        return _four(self._whole.learning.added(octave, rect, self._whole.pixels), np.float32(0.0))[3:]


@dataclass(frozen=True)
class LearntMatchedCover(_Alpha, MatchedCover):
    """The alpha of a matched texture whose next two octaves are learnt."""

    @property
    def cover(self) -> None:
        """Returns None: nothing is hidden by what hides."""
        return None


@dataclass(frozen=True)
class LearntSeriesCover(_Alpha, SeriesCover):
    """The alpha of a texture of a series whose next two octaves are learnt."""

    @property
    def cover(self) -> None:
        """Returns None: nothing is hidden by what hides."""
        return None


_LEARNT: dict[str, type[LearntImage] | type[LearntMatched]] = {
    Image.kind: LearntImage,
    Cover.kind: LearntCover,
    Matched.kind: LearntMatched,
    Series.kind: LearntSeries,
    MatchedCover.kind: LearntMatchedCover,
    SeriesCover.kind: LearntSeriesCover,
}
_LEARNT_COVERS = {Matched.kind: LearntMatchedCover, Series.kind: LearntSeriesCover}
REFINABLE = tuple(_LEARNT)


def _as(kind: type[LearntMatched], made: LearntMatched) -> LearntMatched:
    return kind(**{field.name: getattr(made, field.name) for field in fields(made)})


def learnt(made: Instance, learning: Learning) -> Instance:
    """Returns a picture or matched texture that is refined by what was learnt; another one as it is."""
    if not isinstance(made, Image | Cover | Matched):
        return made
    given = {field.name: getattr(made, field.name) for field in fields(made)}
    if isinstance(made, Matched):
        given["roughness"] = max(made.roughness, _LEAST)
    return _LEARNT[made.kind](**given, learning=learning)
