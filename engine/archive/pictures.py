"""The pictures that inks and textures refer to, as members of a painting's file."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from typing import Any, ClassVar

import numpy as np

from engine.archive import plot_files
from engine.archive.implied import Tile
from engine.archive.packing import RESIDUAL_CAP
from engine.canvas import layers
from engine.canvas.store import Record
from engine.files.fault import FileError
from engine.numeric.address import Rect, TileKey
from engine.numeric.grid import Q
from engine.painting.value import Painting
from engine.texture.image import ImageSource, narrowed
from engine.texture.raster import row_bands
from engine.texture.record import Instance, pictures_of


def sources(painting: Painting) -> dict[str, ImageSource]:
    """Returns all pictures that a painting needs, by their sha, in the order of it.

    One that has several names goes by what inks call it, else textures, else plots; among those by the first name.
    """
    grown: list[ImageSource] = []
    inks: set[Instance] = set()
    for layer in layers.layers(painting.root):
        for plot in layer.growth:
            about = plot_files.origin(plot)
            learnt = None if about.learning is None else about.learning.maps
            held = about.source, about.mask, about.control, learnt
            grown += [replace(source, name=plot.name) for source in held if source is not None]
        for pyramid in (layer.pyramid, *layer.heaps.values()):
            for _, record in pyramid.all_records():
                inks.update(record.inks)
    named = [source for texture in painting.textures.values() for source in texture.pictures]
    found = _collected(grown) | _collected(named) | _collected(one for ink in inks for one in pictures_of(ink))
    return dict(sorted(found.items()))


def _collected(sources: Iterable[Any]) -> dict[str, ImageSource]:
    found: dict[str, ImageSource] = {}
    for source in sources:
        if isinstance(source, ImageSource) and source.there:
            held = found.get(source.sha)
            if held is None or source.name < held.name:
                found[source.sha] = source
    return found


def tiles(source: ImageSource) -> list[Tile]:
    """Returns a picture on the grid, cut into tiles of whole numbers; ValueError if it does not lie on the grid."""
    for band in row_bands(source.width, source.height):
        planes = source.planes(band)
        steps = np.rint(planes / np.float32(Q))
        if not (np.array_equal(steps * np.float32(Q), planes) and np.abs(steps).max() <= RESIDUAL_CAP):
            raise ValueError(f"picture {source.name!r}: values off the grid of 2^-16")
    return [
        (key, Record(Rect(0, 0, place.width, place.height), _Part(source, place), (), 0))
        for key, place in _places(source.width, source.height)
    ]


@dataclass(frozen=True, slots=True)
class _Part:
    """A part of a picture as the data of a record, made each time they are asked for."""

    source: ImageSource
    place: Rect

    nbytes: ClassVar[int] = 0
    itemsize: ClassVar[int] = 4

    def made(self) -> np.ndarray:
        """Returns int32 (4, h, w) in steps of the grid."""
        return np.ascontiguousarray(np.rint(self.source.planes(self.place) / np.float32(Q)), np.int32)


def _places(width: int, height: int) -> Iterator[tuple[TileKey, Rect]]:
    whole = Rect(0, 0, width, height)
    for key in whole.tiles(0):
        yield key, key.rect.intersect(whole)


def assembled(name: str, sha: str, size: tuple[int, int], parts: list[Tile], where: str) -> ImageSource:
    """Returns the picture of `size` (width, height) again; FileError if its tiles do not cover exactly that."""
    width, height = size
    data = np.empty((4, height, width), np.float32)
    left = dict(_places(width, height))
    for key, record in parts:
        place = left.pop(key, None)
        if place is None or record.data.shape != (4, place.height, place.width):
            raise FileError(where, f"picture {sha[:12]}: a tile at {key.x}, {key.y} does not fit {width} x {height}")
        data[:, place.y0 : place.y1, place.x0 : place.x1] = record.data * np.float32(Q)
    if left:
        raise FileError(where, f"picture {sha[:12]}: {len(left)} tiles are missing")
    # Its members' checksums were compared; the name is kept whatever the pixels hash to.
    return ImageSource(name, sha, narrowed(data))
