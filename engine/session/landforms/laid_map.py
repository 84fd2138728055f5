"""A height map as ground: it lies beside the paint of a layer of heights, as what brushes heap does, exact to 22 bits
of its highest and more, and rock goes on below its pixels."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import PurePath

import numpy as np

from engine.brush.stamp import Stamp
from engine.canvas import layers
from engine.canvas.commit import commit
from engine.canvas.evaluate import evaluate
from engine.canvas.heaps.heaping import amplitude_of, room_left
from engine.canvas.heaps.heaps import MOST_HEAPED, MOST_INK, NO_HEAP, exponent, held_once, lies, share
from engine.canvas.layers import Layer
from engine.canvas.node_checks import LayerError
from engine.canvas.store import Pyramid
from engine.canvas.tile_cache import TileCache
from engine.files.fault import FileError
from engine.files.layered.whole_file import as_bytes
from engine.files.spatial.height_map import HeightMap, read_height_map
from engine.numeric.address import TILE, Rect, TileKey
from engine.numeric.functions import functions
from engine.numeric.grid import snapped
from engine.painting.capture import read_bytes
from engine.painting.commands import LayGround
from engine.painting.textures import Around, Texture
from engine.painting.value import Painting
from engine.session.landforms.erosion import OnRect, height_layer
from engine.terrain.heaped_land import heap_told
from engine.terrain.height_window import FINEST_TOLD
from engine.terrain.map_fitting import FittedMap, filled_in
from engine.terrain.plane import DEEP
from engine.texture.image import ImageSource
from engine.texture.planes import COLOURS, Planes
from engine.texture.record import Instance
from engine.texture.rock import Rock

_ALL = np.ones((TILE, TILE), np.float32)
_ALPHA = 3
_FINER = 12  # octaves: the unit of the heap that holds what the grid of the first leaves over
_PERIOD = 2.0  # pixels of the rock's first octave: the finest that the map itself tells
_PART = 6  # of the longer side: how high a map is that tells no scale
_SEEN = 1 << 25  # bytes of tiles that are held while what the first heap leaves over is worked out
_MOST_LAID = 1 << 26  # pixels that are laid at once


@dataclass(frozen=True, eq=False)
class _Laid(OnRect):
    """An edit that adds a map's heights to a heap, and how strong the rock is.

    `shares`: units of a pixel of height of the map's level, None where only the rock is laid; `over`: the heap of units
    2^12 times as large before and after it had its part, where only what that leaves over is laid; `cache`: by which
    that is seen; `rock`: None where there is none; `strong`: its strength, in units, where the map is as rough as 1.
    """

    fitted: FittedMap
    shares: float | None
    over: tuple[Pyramid, Pyramid] | None = None
    rock: Instance | None = None
    strong: float = 0.0
    cache: TileCache | None = None

    def stamp(self, key: TileKey, old: Planes) -> Stamp:
        """Adds to the tile's values, as `Edit.stamp`; never more than a heap holds."""
        part = key.rect.intersect(self.rect)
        rows, columns = part.slices(key.rect)
        inks = () if self.rock is None else (self.rock,)
        add = np.zeros((COLOURS + 3 * len(inks), TILE, TILE), np.float32)
        if self.shares is not None:
            laid = self._told(part)
            add[:_ALPHA, rows, columns] = room_left(old.data[0][rows, columns], laid, MOST_HEAPED)
        if self.rock is not None:
            laid = snapped((self.fitted.rough(self.level, part) * self.strong).astype(np.float32))
            add[COLOURS:, rows, columns] = room_left(amplitude_of(old, self.rock)[rows, columns], laid, MOST_INK)
        return Stamp(_ALL, add, inks)

    def _told(self, part: Rect) -> np.ndarray:
        assert self.shares is not None
        laid = self.fitted.at(self.level, part) * self.shares
        if self.over is not None:
            laid = laid - np.ldexp(self._risen(self.over, part), _FINER)
        return snapped(laid.astype(np.float32))

    def _risen(self, heap: tuple[Pyramid, Pyramid], part: Rect) -> np.ndarray:
        """By how much a heap rose, in its unit: as the land has it as long as that is told from the sea."""
        told = heap_told if self.level <= DEEP else _as_the_canvas
        after: np.ndarray = told(heap[1], self.level, part, self.cache)
        if lies(heap[0], self.level, part):
            after -= told(heap[0], self.level, part, self.cache)
        return after


def _as_the_canvas(heap: Pyramid, level: int, part: Rect, cache: TileCache | None) -> np.ndarray:
    out: np.ndarray = evaluate(heap, level, part, cache).data[0].astype(np.float64)
    return out


def with_ground(painting: Painting, command: LayGround, around: Around) -> Painting:
    """Returns a painting with a map as ground of its heights.  LayerError if it cannot be laid."""
    layer = height_layer(painting, command.layer, "ground")
    if command.level > FINEST_TOLD:
        raise LayerError(f"ground: found level {command.level}, expected at most {FINEST_TOLD}")
    told = map_of(painting.textures.get(command.texture), command.texture)
    ends, shape = _scale(told, command), told.heights.shape
    fitted = FittedMap(scaled(filled_in(told.heights), *ends), command.level, command.rect, command.rim)
    del told  # a large map takes much memory
    level = fitted.own_level
    rect = fitted.rect_at(level)
    if rect.area > _MOST_LAID or rect.empty or level > FINEST_TOLD:
        size = f"{shape[1]} x {shape[0]}"
        wanted = f"{command.rect.width} x {command.rect.height}"
        raise LayerError(f"ground: found a map of {size} pixels for {wanted}, expected one of about its shape")
    layer, fitted = _with_heights(layer, fitted, level, rect), fitted.roughness_alone()
    layer = _with_rock(layer, fitted, level, rect, command, painting.arithmetic)
    return replace(painting, root=layers.with_heaps(painting.root, layer.name, layer.heaps))


def map_of(texture: Texture | None, name: str) -> HeightMap:
    """Returns the map whose file a texture holds; LayerError if it holds none."""
    source = None if texture is None else texture.source
    pixels = source.straight() if isinstance(source, ImageSource) and source.there else None
    data = None if pixels is None else as_bytes(pixels)
    if data is None:
        raise LayerError(f"ground: found no texture {name!r} that holds a file, expected one")
    try:
        return read_height_map(data, name)
    except FileError as error:
        raise LayerError(f"ground: {error}") from None


def map_in(path: str) -> tuple[ImageSource, HeightMap]:
    """Returns a file as a painting holds it, and the map in it.  FileError if it cannot be read, or is none."""
    data = read_bytes(path, None)
    held = ImageSource.of_raster(PurePath(path).name, data)
    return held, read_height_map(as_bytes(data) or b"", path)


def usual_ends(told: HeightMap, rect: Rect) -> tuple[float, float]:
    """Returns how high a map's lowest and highest lie over a rectangle, in its pixels, where nothing is said: to scale
    where the file tells how wide its pixels are."""
    low, high = told.ends
    if told.pixel is None:
        return 0.0, max(rect.width, rect.height) / _PART
    by = rect.width / (told.pixel * told.heights.shape[1])
    return low * by, high * by


def scaled(heights: np.ndarray, of: tuple[float, float], ends: tuple[float, float]) -> np.ndarray:
    """Returns heights, which are written to, so that those `of` lie at the ends."""
    heights -= of[0]
    if of[0] != of[1]:
        heights *= (ends[1] - ends[0]) / (of[1] - of[0])
    heights += ends[0]
    return heights


def _scale(told: HeightMap, command: LayGround) -> tuple[tuple[float, float], tuple[float, float]]:
    return command.of or told.ends, command.ends or usual_ends(told, command.rect)


def _with_heights(layer: Layer, fitted: FittedMap, level: int, rect: Rect) -> Layer:
    """Returns a layer with the heights in two heaps: most of them, and what the grid of the first leaves over."""
    most = max(-float(fitted.heights.min()), float(fitted.heights.max()))
    if most == 0.0:
        return layer
    unit = exponent(most, fitted.level)
    before = layer.heaps.get(unit, NO_HEAP)
    layer = _heaped(layer, unit, _Laid(level, rect, fitted, share(1.0, fitted.level, unit)))
    over = before, layer.heaps[unit]
    finer, cache = share(1.0, fitted.level, unit - _FINER), TileCache(_SEEN)
    return _heaped(layer, unit - _FINER, _Laid(level, rect, fitted, finer, over, cache=cache))


def _with_rock(layer: Layer, fitted: FittedMap, level: int, rect: Rect, command: LayGround, arithmetic: int) -> Layer:
    """Returns a layer with rock below the map's pixels."""
    rock, strength = _rock(command, level, arithmetic)
    strong = strength * fitted.roughest
    if strong == 0.0:
        return layer
    unit = exponent(strong, command.level)
    laid = _Laid(level, rect, fitted, None, None, rock, share(strength, command.level, unit))
    return _heaped(layer, unit, laid)


def _rock(command: LayGround, level: int, arithmetic: int) -> tuple[Rock, float]:
    """Returns the rock below the map's pixels, and how strong it is where the map is as rough as 1: its first octave is
    two finer than the one that was measured, and as much weaker as `roughness` has it."""
    rock = Rock(level, _PERIOD, command.roughness, command.seed, arithmetic, renew=False)
    first = float(rock.changes(level + 1)[0])
    return rock, command.rock * functions(arithmetic).two_to(-2.0 * command.roughness) / first


def _heaped(layer: Layer, unit: int, edit: _Laid) -> Layer:
    heap = layer.heaps.get(unit)
    heap = commit(NO_HEAP.branched() if heap is None else heap, edit, lessen=held_once)
    return replace(layer, heaps=layer.heaps.set(unit, heap))
