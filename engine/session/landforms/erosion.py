"""Heights worn down: what is carried off and laid down lies beside the paint, as what brushes heap does."""

from __future__ import annotations

import hashlib
from collections.abc import Generator
from dataclasses import dataclass, replace

import numpy as np

from engine.brush.stamp import Stamp
from engine.canvas import layers
from engine.canvas.commit import commit
from engine.canvas.heaps.heaping import room_left
from engine.canvas.heaps.heaps import MOST_HEAPED, NO_HEAP, exponent, held_once, share
from engine.canvas.layers import Layer
from engine.canvas.node_checks import LayerError
from engine.canvas.tile_cache import TileCache
from engine.checks.roles import AS_HEIGHT
from engine.numeric.address import TILE, Rect, TileKey
from engine.numeric.grid import snapped
from engine.painting.layering.erode_command import Erode
from engine.painting.textures import Around
from engine.painting.value import Painting
from engine.terrain.eroding import Weather, eroded, eroding
from engine.terrain.height_window import FINEST_TOLD, in_pixels
from engine.terrain.plane import heights_of, land
from engine.texture.planes import COLOURS, Planes

_ALL = np.ones((TILE, TILE), np.float32)
_ALPHA = 3
_FORESEEN: dict[tuple[str, Weather], np.ndarray] = {}  # the last heights that were worked out ahead
_RIM = 0.08  # of the shorter side, within which nothing becomes all


@dataclass(frozen=True, eq=False)
class OnRect:
    """What an edit of a heap has that changes a rectangle of a level."""

    level: int
    rect: Rect

    @property
    def spares_alpha(self) -> bool:
        """As `Edit.spares_alpha`: a heap has none."""
        return True

    @property
    def tiles(self) -> list[TileKey]:
        """Gives the tiles that it changes."""
        return list(self.rect.tiles(self.level))


@dataclass(frozen=True, eq=False)
class _Raised(OnRect):
    """An edit that adds `parts` (h, w) of a heap's unit to it."""

    parts: np.ndarray

    def stamp(self, key: TileKey, old: Planes) -> Stamp:
        """Adds to the tile's values, as `Edit.stamp`; never more than a heap holds."""
        part = key.rect.intersect(self.rect)
        rows, columns = part.slices(key.rect)
        add = np.zeros((COLOURS, TILE, TILE), np.float32)
        laid = self.parts[part.slices(self.rect)]
        add[:_ALPHA, rows, columns] = room_left(old.data[0][rows, columns], laid, MOST_HEAPED)
        return Stamp(_ALL, add)


def worn(painting: Painting, command: Erode, around: Around) -> Painting:
    """Returns a painting whose heights are worn down.  LayerError if they cannot be."""
    layer, before, weather = _found(painting, command, around.cache)
    key = _key(before, weather)
    after = _FORESEEN.get(key)
    after = eroded(before, weather) if after is None else after
    return raised(painting, layer, command.level, command.rect, after - before)


def foreseen(painting: Painting, command: Erode, cache: TileCache | None = None) -> Generator[float, None, None]:
    """Works out what `worn` will make of the heights that are there now, so that it need not; yields the part that is
    done.  LayerError if it cannot be."""
    _, before, weather = _found(painting, command, cache)
    after = yield from eroding(before, weather)
    _FORESEEN.clear()
    _FORESEEN[_key(before, weather)] = after


def _key(before: np.ndarray, weather: Weather) -> tuple[str, Weather]:
    return hashlib.sha256(repr(before.shape).encode() + before.tobytes()).hexdigest(), weather


def _found(painting: Painting, command: Erode, cache: TileCache | None) -> tuple[Layer, np.ndarray, Weather]:
    """Returns the layer, its heights in pixels of the command's level, and the weather."""
    layer = height_layer(painting, command.layer, "erode")
    if command.level > FINEST_TOLD:
        raise LayerError(f"erode: found level {command.level}, expected at most {FINEST_TOLD}")
    told = land(painting, layer.name, cache=cache)
    before = in_pixels(told.height(command.level, command.rect), command.level)
    if not np.isfinite(before).all():
        raise LayerError(f"erode: found heights beyond all numbers at level {command.level}, expected a smaller scale")
    return layer, before, Weather(command.rain, command.strength, command.talus or None, command.seed)


def height_layer(painting: Painting, name: str | None, what: str) -> Layer:
    """Returns the layer of heights of a name, or (None) the one there is.  LayerError if it may not be changed."""
    node = heights_of(painting) if name is None else layers.find(painting.root, name)
    found = None if node is None or not isinstance(node, Layer) or node.role != AS_HEIGHT else node
    if found is None:
        there = "none" if node is None else f"{node.name!r}, which is none"
        raise LayerError(f"{what}: found {there}, expected a layer of the role height")
    if layers.is_locked(painting.root, found.name):
        raise LayerError(f"{what}: found layer {found.name!r} locked, expected one that is not")
    if found.wrap is not None:
        raise LayerError(f"{what}: found layer {found.name!r} repeated, expected one that is not")
    return found


def raised(painting: Painting, layer: Layer, level: int, rect: Rect, by: np.ndarray) -> Painting:
    """Returns a painting with a layer raised by heights (h, w) in pixels of a level, which grow from nothing at the
    rectangle's rim."""
    by = by * _within(by.shape)
    most = float(np.abs(by).max())
    if most == 0.0:
        return painting
    unit = exponent(most, level)
    parts = snapped((by * share(1.0, level, unit)).astype(np.float32))
    heap = layer.heaps.get(unit)
    heap = commit(NO_HEAP.branched() if heap is None else heap, _Raised(level, rect, parts), lessen=held_once)
    return replace(painting, root=layers.with_heaps(painting.root, layer.name, layer.heaps.set(unit, heap)))


def _within(shape: tuple[int, ...]) -> np.ndarray:
    """Returns how much of a change there is: 0 at the rim, 1 within."""
    sides = []
    for count in shape:
        far = np.minimum(np.arange(count), np.arange(count)[::-1]) / max(1.0, _RIM * min(shape))
        t = np.minimum(far, 1.0)
        sides.append(t * t * (3.0 - 2.0 * t))
    out: np.ndarray = sides[0][:, None] * sides[1][None, :]
    return out
