"""Textures that are refined below their own pixels by what was learnt of them, as definitions describe them
(Perlin & Velho 1995, sections 7.2 and 8.2).

A definition that has `detail`: "learnt" keeps its picture's maps; the maker `learn` is one of a picture with no more
to it.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from engine.canvas.grown.learnt_below import below_own
from engine.numeric.address import Rect
from engine.numeric.grid import snapped
from engine.painting.textures import LEARNT_SHA, Around, Texture
from engine.texture.image import ImageSource
from engine.texture.learnt import least_squares
from engine.texture.learnt.inks import REFINABLE
from engine.texture.learnt.maps import as_picture, maps_of, nothing_learnt
from engine.texture.learnt.refinement import Learning, channels_of
from engine.texture.matching import noise
from engine.texture.record import LEARNT
from engine.texture.sample import coloured
from engine.texture.table import KINDS, refinement

_SMALL = 48  # pixels along the sides of a picture that nobody sees
_KEPT = 16
_FITTED: dict[str, ImageSource] = {}  # the last maps, by the sha of what they were fitted to
_KINDS = (*REFINABLE, "canvas", "example")


def learnt_of(texture: Texture) -> Texture:
    """Returns the texture of a picture, refined whatever its definition says."""
    return replace(texture, parameters=texture.parameters.set("detail", LEARNT))


def with_maps(name: str, texture: Texture, around: Around) -> Texture:
    """Returns a texture with its maps, if its definition asks for them: those that are known already, or new ones.
    TextureError names what is wrong with what it asks for."""
    source = texture.source
    if texture.kind not in _KINDS or not KINDS[texture.kind].pictured or source is None or not source.there:
        return texture
    if refinement(texture.parameters) is None:
        return texture
    known = around.pictures.get(texture.parameters.get(LEARNT_SHA, ""))
    return replace(texture, maps=replace(_fitted(source) if known is None else known, name=name))


def _fitted(source: ImageSource) -> ImageSource:
    """Returns the maps of a picture, once they were fitted: an example is defined anew with each of its settings."""
    found = _FITTED.get(source.sha)
    if found is None:
        while len(_FITTED) >= _KEPT:
            _FITTED.pop(next(iter(_FITTED)), None)
        found = _FITTED[source.sha] = maps_for("", source)
    return found


def maps_for(name: str, source: ImageSource) -> ImageSource:
    """Returns the maps of a picture that is there."""
    channels = [*range(3 if coloured(source) else 1), *([] if source.opaque else [3])]
    if len(channels) == 2:
        channels = [0, 1, 2, 3]
    rects = least_squares.pieces(source.width, source.height)
    return as_picture(
        name, least_squares.maps_fitted([np.ascontiguousarray(source.planes(rect)[channels]) for rect in rects])
    )


@dataclass(frozen=True, slots=True)
class Finer:
    """A picture refined by so many `octaves`; beyond its edges it goes on as its mirror image, or, if it `tiles`, as
    itself.  Another `seed`, other noise."""

    source: ImageSource
    learning: Learning
    tiles: bool = False
    seed: int = 0

    @property
    def size(self) -> tuple[int, int]:
        """Gives width and height."""
        return self.source.width << self.learning.octaves, self.source.height << self.learning.octaves

    def planes(self, rect: Rect) -> np.ndarray:
        """Returns grey, RGB or premultiplied RGBA, float32 in 0..1, over a rectangle of the finer picture."""
        away = 2 * self.seed  # as many whole pictures, mirror images and all
        shift = away * self.size[0], away * self.size[1]
        place = Rect.at(rect.x0 + shift[0], rect.y0 + shift[1], rect.width, rect.height)
        return self.learning.seen(self.learning.octaves, place, self._pixels)

    def _pixels(self, rect: Rect) -> np.ndarray:
        columns = self._places(rect.x0, rect.width, self.source.width)
        rows = self._places(rect.y0, rect.height, self.source.height)
        low, high = int(rows.min()), int(rows.max()) + 1
        seen = self.source.planes(Rect(0, low, self.source.width, high))[:, rows - low][:, :, columns]
        maps = maps_of(self.learning.maps)
        assert maps is not None
        return channels_of(seen, maps)

    def _places(self, first: int, count: int, size: int) -> np.ndarray:
        if self.tiles:
            return (first % size + np.arange(count)) % size
        found = (first % (2 * size) + np.arange(count)) % (2 * size)
        return np.minimum(found, 2 * size - 1 - found)


def make_once() -> None:
    """Learns from a small picture and makes it finer, so that all kernels are compiled and kept."""
    picture = snapped(np.ascontiguousarray(0.5 + 0.2 * noise(4, (_SMALL, _SMALL), 1), np.float32))
    picture[3] = np.float32(1.0)
    source = ImageSource.of("", picture)
    Finer(source, Learning(maps_for("", source))).planes(Rect(0, 0, _SMALL, _SMALL))
    look_once()


def look_once() -> None:
    """Makes some pixels finer that were grown, by maps that nothing was learnt for: so all kernels are compiled that
    looking at learnt detail needs, in a quarter of the time that learning takes."""
    weaker = Learning(as_picture("", nothing_learnt(np.eye(3, dtype=np.float32))), 0.5)
    below_own(weaker, 1, Rect(0, 0, 2, 2), lambda rect: np.ones((4, rect.height, rect.width), np.float32))
