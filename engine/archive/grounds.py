"""Grounds: layers that began as a picture, kept in files as that picture and what was painted since."""

from __future__ import annotations

import io
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from typing import Any

from engine.archive.implied import ordered
from engine.canvas.ground import laid, unchanged
from engine.canvas.layers import Layer
from engine.canvas.rising.paged_level import PagedLevel
from engine.canvas.store import PutAway, Pyramid, Record, level_of
from engine.checks.field_error import FieldError
from engine.files.limits import STREAMED, Limits
from engine.files.png_reader import PngReader
from engine.files.png_writer import STRIP, PngWriter
from engine.files.strict_json import Fields
from engine.keeping.disk_raster import DiskBytes, room
from engine.numeric.address import Rect, TileKey, lies_within
from engine.numeric.parted import Raster
from engine.painting.commands import LEVEL_LIMIT, PLACE_LIMIT
from engine.texture.raster import planes_of

LAID = 1 << 26  # pixels of a picture up to which it is laid down at once and kept


@dataclass(frozen=True)
class GroundEntry:
    """Where a layer's ground is in a file: the member with its pixels, the place of its corner on level 0, and the
    tiles of it that are no longer stored."""

    member: str
    at: tuple[int, int]
    gone: tuple[TileKey, ...] = ()


def lay_ground(pixels: Raster, x: int, y: int, png: bytes | PutAway | None = None) -> Pyramid:
    """Returns a layer that begins with a picture, uint8 or uint16 RGBA (h, w, 4), at (x, y) of level 0; `png`: the same
    picture as a PNG, where it is at hand."""
    rect = Rect.at(x, y, pixels.shape[1], pixels.shape[0])
    return laid(lambda part: planes_of(pixels[part.slices(rect)]), rect, _png_of(pixels) if png is None else png, room)


def _png_of(pixels: Raster) -> bytes | PutAway:
    """Returns a picture as a PNG; a large one is put away on disk."""
    height, width, channels = pixels.shape
    file = DiskBytes() if height * width > LAID else io.BytesIO()
    writer = PngWriter(file, width, height, channels, 8 * pixels.dtype.itemsize)  # type: ignore[arg-type]
    rows = max(1, STRIP // (width * channels * pixels.dtype.itemsize))
    for top in range(0, height, rows):
        writer.rows(pixels[top : min(top + rows, height), 0:width])
    writer.close()
    return file.getvalue() if isinstance(file, io.BytesIO) else file


def whole(layer: Layer, frame: Rect) -> bool:
    """Tells whether a layer is its ground and nothing else, all of it within `frame`: then its picture shows it
    fully."""
    ground = layer.pyramid.ground
    if ground is None or layer.growth or layer.pyramid.levels is not ground.levels:
        return False
    return lies_within(ground.rect, frame)


def painted_since(pyramid: Pyramid) -> Iterator[tuple[TileKey, Record]]:
    """Yields the records that a layer's ground does not account for, all of them where there is none, in the order of
    files.  Of those on disk few are in memory at a time."""
    for level in sorted(pyramid.levels):
        stored = pyramid.levels[level]
        for part in stored.lines(1) if isinstance(stored, PagedLevel) else [stored.items()]:
            tiles = ((TileKey(level, *place), record) for place, record in part)
            yield from ordered([tile for tile in tiles if not unchanged(pyramid, *tile)])


def entry(pyramid: Pyramid, member: str) -> GroundEntry | None:
    """Tells how a file names a layer's ground; None if it has none."""
    if pyramid.ground is None:
        return None
    gone = tuple(
        TileKey(level, *place)
        for level, tiles in sorted(pyramid.ground.levels.items())
        if tiles is not pyramid.levels.get(level)
        for place in sorted(tiles)
        if place not in pyramid.levels.get(level, {})
    )
    return GroundEntry(member, (pyramid.ground.rect.x0, pyramid.ground.rect.y0), gone)


def restored(found: GroundEntry, png: bytes, where: str, limits: Limits) -> Pyramid:
    """The ground laid down again from its PNG, without the tiles that are gone.  FileError if that is none."""
    reader = PngReader(io.BytesIO(png), where, replace(limits, pixels=max(limits.pixels, STREAMED)))
    pixels = room((reader.header.height, reader.header.width, 4), reader.header.dtype)
    reader.read_into(pixels)
    pyramid = lay_ground(pixels, *found.at, png)
    levels = pyramid.levels
    for key in found.gone:
        tiles = levels.get(key.level)
        if tiles is not None and (key.x, key.y) in tiles:
            smaller = tiles.delete((key.x, key.y))
            levels = levels.set(key.level, smaller) if len(smaller) else levels.delete(key.level)
    return replace(pyramid, levels=levels)


def with_tiles(ground: Pyramid, levels: Mapping[int, Mapping[tuple[int, int], Record]]) -> Pyramid:
    """Returns a ground, or nothing, with what was painted since in its place; records by pages are of its depth."""
    stored = ground.levels
    for level, tiles in levels.items():
        if isinstance(tiles, PagedLevel) and level not in stored:
            stored = stored.set(level, tiles)
            continue
        editable = level_of(stored.get(level, {})).mutate()
        for place, record in tiles.items():
            editable.set(place, record if record.depth == ground.depth else replace(record, depth=ground.depth))
        stored = stored.set(level, level_of(editable.finish()))
    return replace(ground, levels=stored)


# ---- in the manifest ----


def to_json(found: GroundEntry) -> dict[str, Any]:
    """Tells a ground as the manifest does; `parse` is the inverse."""
    return {"member": found.member, "at": list(found.at), "gone": [list(key) for key in found.gone]}


def read_ground(value: Any, where: str) -> GroundEntry:
    """FieldError names the member that is wrong."""
    members = Fields(value, where)
    x, y = members.integers("at", 2, limit=PLACE_LIMIT)
    gone = members.take("gone", expected="a list")
    if not isinstance(gone, list):
        raise members.fault("gone", "a list")
    return GroundEntry(members.text("member"), (x, y), tuple(_keys(gone, where)))


def _keys(gone: list[Any], where: str) -> Iterable[TileKey]:
    for key in gone:
        sound = isinstance(key, list) and len(key) == 3 and all(type(v) is int for v in key)
        if not sound or abs(key[0]) > LEVEL_LIMIT + 256 or max(abs(key[1]), abs(key[2])) > PLACE_LIMIT:
            raise FieldError(f"{where}.gone", "another form", "[level, x, y] each")
        yield TileKey(*key)
