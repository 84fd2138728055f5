"""What any placement shows as paint: record by record where it is one layer by quarter turns, else at one level."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass

import numpy as np

from engine.brush.stamp import Stamp
from engine.canvas import layers
from engine.canvas.attenuate import placed as placed_rect
from engine.canvas.commit import commit
from engine.canvas.composite import composite
from engine.canvas.evaluate import evaluate_sparse
from engine.canvas.flatten import flattened
from engine.canvas.layers import Group, Layer
from engine.canvas.node_checks import LayerError
from engine.canvas.placing.bake import Pasted, baked, tiles_of
from engine.canvas.placing.clip import Clip, clipped
from engine.canvas.placing.filled import TilePlace, filled_tiles
from engine.canvas.placing.placement import Placement
from engine.canvas.placing.rounds import by_ids
from engine.canvas.placing.through import UNPLACED, Seen
from engine.canvas.placing.views import Views
from engine.canvas.reading import layer_planes
from engine.canvas.store import Pyramid
from engine.canvas.tile_cache import TileCache
from engine.numeric.address import TILE, Rect, TileKey
from engine.numeric.grid import snapped
from engine.texture.planes import COLOURS, Planes

_CACHE = 256 << 20  # bytes
_MOST = 1 << 16  # tiles that may become paint: a repeated part has no end
_NOTHING = np.zeros((COLOURS, TILE, TILE), np.float32)


def paint_of(root: Group, node: Placement, frame: Rect, grid: int) -> Pyramid:
    """Returns what a placement of a tree shows as paint; the tree's examples are grown to the end.

    One layer by quarter turns and powers of two is baked exactly, ink included; anything else at the finest level that
    its source has, as pixels.  What is repeated, in a placement or in a layer that wraps around, ends at the `frame`.
    LayerError if it has no end otherwise.
    """
    layer, seen = _one_layer(root, node)
    if layer is None or layer.wrap is not None or seen.similarity.quarter is None or seen.repeats:
        return _at_one_level(root, node, frame, grid)
    made = baked(flattened(layer).pyramid if layer.growth else layer.pyramid, seen.similarity)
    for clip in seen.clips:
        made = _cut(made, clip)
    return made


def _one_layer(root: Group, node: Placement) -> tuple[Layer | None, Seen]:
    """Returns the layer that a placement shows, directly or through other placements, and how."""
    seen, gone, nodes = UNPLACED, set[int](), by_ids(root)
    while node.id not in gone:
        gone.add(node.id)
        seen, source = seen.of(node), nodes[root.id if node.of is None else node.of]
        if not isinstance(source, Placement):
            return (
                (source, seen)
                if isinstance(source, Layer) and (source.mask is None or source.mask.off)
                else (None, seen)
            )
        node = source
    return None, seen


@dataclass(frozen=True, eq=False)
class _Cutting:
    """An edit that leaves of what lies on some tiles only what lies within a clip."""

    level: int
    tiles: list[TileKey]
    clip: Clip
    spares_alpha: bool = False

    @property
    def rect(self) -> Rect:
        """Gives the tiles' bounds."""
        return tiles_of(self.tiles)

    def stamp(self, key: TileKey, old: Planes) -> Stamp | None:
        """Takes away what lies outside, as `Edit.stamp`."""
        inner = clipped(np.ones((1, TILE, TILE), np.float32), (self.clip,), key.level, key.rect)[0]
        return Stamp(snapped(inner), _NOTHING)


def _cut(pyramid: Pyramid, clip: Clip) -> Pyramid:
    """Returns a pyramid without what lies outside a clip at its finest level, or at that of the clip if it is finer."""
    if pyramid.finest is None or pyramid.coarsest is None:
        return pyramid
    own = clip.part.level - (clip.similarity.quarter or (0, 0))[0]
    level, cache = max(pyramid.finest, own), TileCache(_CACHE)

    def filled(key: TileKey) -> bool:
        found = evaluate_sparse(pyramid, key.level, key.rect, cache)
        return found is not None and bool(found.data.any()) and not clip.holds(key.level, key.rect)

    tiles = filled_tiles(lambda k: pyramid.levels.get(k, ()), filled, pyramid.coarsest, level)
    return commit(pyramid, _Cutting(level, sorted(tiles, key=_by_row), clip)) if tiles else pyramid


def _by_row(key: TileKey) -> tuple[int, int]:
    return key.y, key.x


def _at_one_level(root: Group, node: Placement, frame: Rect, grid: int) -> Pyramid:
    shown, empty, cache = layers.alone(node, root), Pyramid(grid=grid), TileCache(_CACHE)
    ways = [(layer, seen) for layer, seen in ways_of(root, node) if layer.pyramid.levels]
    if not ways:
        return empty
    level = max(_finest(layer) - seen.levels for layer, seen in ways)

    def picture(key: TileKey) -> np.ndarray:
        return composite(shown, key.level, key.rect, lambda layer, at, rect: layer_planes(layer, at, rect, cache))

    def filled(key: TileKey) -> bool:
        return bool(picture(key).any())

    if any(seen.repeats or layer.wrap is not None for layer, seen in ways):
        tiles = {key for key in _few(node, frame.zoomed(level).tiles(level)) if filled(key)}
    else:
        first = min(min(layer.pyramid.levels) - seen.levels for layer, seen in ways)
        tiles = filled_tiles(stored_tiles(ways), filled, first, level)

    def values(key: TileKey) -> Planes:
        return Planes(snapped(picture(key)))

    return commit(empty, Pasted(level, sorted(_few(node, tiles), key=_by_row), values)) if tiles else empty


def _few(node: Placement, tiles: Iterable[TileKey]) -> list[TileKey]:
    out: list[TileKey] = []
    for key in tiles:
        out.append(key)
        if len(out) > _MOST:
            raise LayerError(f"layer {node.name!r}: found more than {_MOST} tiles to paint, expected a smaller part")
    return out


def ways_of(root: Group, node: Placement) -> list[tuple[Layer, Seen]]:
    """Returns the layers that a placement shows, and how; one that shows itself for its first turn."""
    own = {layer.id: layer for layer in layers.layers(root)}
    ways = Views(root).of(0, node.id)
    if ways is None:
        raise LayerError(f"layer {node.name!r}: found too many placements in one another, expected fewer")
    found: dict[int, Seen] = {}
    for number, seen in ways:
        held = found.get(number)
        if held is None or seen.similarity.log_scale > held.similarity.log_scale:
            found[number] = seen
    return [(own[number], seen) for number, seen in found.items()]


def _finest(layer: Layer) -> int:
    finest = [plot.finest for plot in layer.growth]
    return max([*finest, *layer.pyramid.levels])


def stored_tiles(ways: list[tuple[Layer, Seen]]) -> Callable[[int], Iterator[TilePlace]]:
    """Returns what tells the tiles of a level on which records of layers are shown."""

    def stored(level: int) -> Iterator[TilePlace]:
        for layer, seen in ways:
            at = level + seen.levels
            for place, record in layer.pyramid.levels.get(at, {}).items():
                rect = placed_rect(TileKey(at, *place), record.rect)
                yield from ((key.x, key.y) for key in seen.similarity.shown(rect, at, level).tiles(level))

    return stored
