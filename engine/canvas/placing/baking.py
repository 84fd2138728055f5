"""What any placement shows as paint: record by record where it is one layer by quarter turns, else at one level."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from itertools import islice

import numpy as np

from engine.brush.stamp import Stamp
from engine.canvas import layers
from engine.canvas.attenuate import placed as placed_rect
from engine.canvas.commit import commit
from engine.canvas.composite import composite
from engine.canvas.evaluate import evaluate_sparse
from engine.canvas.flatten import flattened
from engine.canvas.heaps.heaps import NO_HEAPS, Heaps
from engine.canvas.layers import Group, Layer, Node
from engine.canvas.merging.laying import laid_at
from engine.canvas.node_checks import LayerError
from engine.canvas.placing.bake import Pasted, baked, tiles_of
from engine.canvas.placing.clip import Clip, clipped
from engine.canvas.placing.filled import TilePlace, filled_levels, filled_tiles
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
_MOST_CHOSEN = (1 << 24) // TILE**2  # tiles that become paint where nobody says at which level
_SLACK = 16  # by which paint of several layers may be told too much from afar
_WEAK = 1 / 64  # alpha that may be but rounded
_NOTHING = np.zeros((COLOURS, TILE, TILE), np.float32)


@dataclass(frozen=True)
class BakeLevels:
    """The level at which a placement should become pixels, and the finest that its source has; `endless`: ink goes on
    below that."""

    level: int
    finest: int
    endless: bool = False

    @property
    def loses(self) -> bool:
        """Tells whether the source has finer detail than the pixels."""
        return self.endless or self.level < self.finest


def paint_of(root: Group, node: Placement, frame: Rect, grid: int, level: int | None = None) -> Pyramid:
    """Returns what a placement of a tree shows as paint; the tree's examples are grown to the end.

    One layer by quarter turns and powers of two is baked exactly, ink included; anything else as pixels of `level`, or
    of the finest level that its source has, if it is coarser or None is given.  What is repeated, in a placement or in
    a layer that wraps around, ends at the `frame`.  LayerError if that would be too many tiles.
    """
    layer, seen = _one_layer(root, node)
    if layer is None or layer.wrap is not None or seen.similarity.quarter is None or seen.repeats:
        return _at_one_level(root, node, frame, grid, level)
    made = baked(flattened(layer).pyramid if layer.growth else layer.pyramid, seen.similarity)
    for clip in seen.clips:
        made = _cut(made, clip)
    return made


def heaps_of(root: Group, node: Placement) -> Heaps:
    """Returns what is heaped on the layer that a placement shows, as high as it is there; nothing where that is not
    exact."""
    layer, seen = _one_layer(root, node)
    if layer is None or layer.wrap is not None or seen.similarity.quarter is None or seen.repeats:
        return NO_HEAPS
    out, levels = NO_HEAPS, seen.similarity.quarter[0]
    for unit, heap in layer.heaps.items():
        made = baked(heap, seen.similarity)
        for clip in seen.clips:
            made = _cut(made, clip)
        out = out.set(unit + levels, made)
    return out


def leaves_heaps(root: Group, node: Placement) -> bool:
    """Tells whether anything is heaped on what a placement shows that does not go along where it is baked."""
    ways = ways_of(root, node)
    return any(layer.heaps for layer, _ in ways) and not heaps_of(root, node)


def _one_layer(root: Group, node: Placement) -> tuple[Layer | None, Seen]:
    """Returns the layer that a placement shows, directly or through other placements, and how."""
    seen, gone, nodes = UNPLACED, set[int](), by_ids(root)
    while node.id not in gone:
        gone.add(node.id)
        seen, source = seen.of(node), nodes[root.id if node.of is None else node.of]
        if not isinstance(source, Placement):
            return (source if isinstance(source, Layer) and _unmasked(source) else None), seen
        if not _unmasked(source):
            break
        node = source
    return None, seen


def _unmasked(node: Node) -> bool:
    """Tells whether nothing of a node is hidden by a mask of its own."""
    return node.mask is None or node.mask.off


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


def bake_levels(root: Group, node: Placement, frame: Rect) -> BakeLevels | None:
    """Returns at which level a placement should become pixels: the finest of which no more of them hold paint than one
    can wait for.  None if it is baked exactly, or shows nothing."""
    layer, seen = _one_layer(root, node)
    showing = _Showing(root, node, frame)
    exact = layer is not None and layer.wrap is None and seen.similarity.quarter is not None and not seen.repeats
    if not showing.ways or exact:
        return None
    pyramids = [layer.pyramid for layer, _ in showing.ways]
    endless = any(inks for one in pyramids for level in one.levels for inks in one.stacks(level))
    return BakeLevels(showing.fitting(), showing.finest, endless)


def _at_one_level(root: Group, node: Placement, frame: Rect, grid: int, level: int | None) -> Pyramid:
    showing, empty = _Showing(root, node, frame), Pyramid(grid=grid)
    if not showing.ways:
        return empty
    at = showing.finest if level is None else min(level, showing.finest)
    tiles = showing.tiles(at)
    return commit(empty, Pasted(at, sorted(tiles, key=_by_row), showing.pixels)) if tiles else empty


def shown_over(below: Pyramid, root: Group, node: Placement, frame: Rect, level: int) -> Pyramid:
    """Returns paint with what a placement of a tree shows over it, as pixels of a level, however coarse its source is.
    LayerError if that would be too many tiles."""
    showing = _Showing(root, node, frame)
    if not showing.ways:
        return below
    if level < showing.first:
        raise LayerError(f"layer: found level {level}, expected one from {showing.first} on, where its paint begins")
    return laid_at(below, level, showing.tiles(level), showing.pixels)


class _Showing:
    """What a placement shows by itself, tile by tile."""

    def __init__(self, root: Group, node: Placement, frame: Rect) -> None:
        self.ways = [(layer, seen) for layer, seen in ways_of(root, node) if layer.pyramid.levels]
        self.finest = max((_finest(layer) - seen.levels for layer, seen in self.ways), default=0)
        self.first = min((min(layer.pyramid.levels) - seen.levels for layer, seen in self.ways), default=0)
        self._node, self._frame = node, frame
        self._shown, self._cache = layers.alone(node, root), TileCache(_CACHE)
        self._repeats = any(seen.repeats or layer.wrap is not None for layer, seen in self.ways)

    def picture(self, key: TileKey) -> np.ndarray:
        """Returns what is seen in a tile."""
        cache = self._cache
        return composite(self._shown, key.level, key.rect, lambda layer, at, rect: layer_planes(layer, at, rect, cache))

    def pixels(self, key: TileKey) -> Planes:
        """Returns the same on the grid, as what is laid."""
        return Planes(snapped(self.picture(key)))

    def tiles(self, level: int) -> list[TileKey]:
        """Returns the tiles of a level that hold paint.  LayerError if they are too many."""
        if self._repeats:
            near = _few(self._node, level, self._frame.zoomed(level).tiles(level))
            return [key for key in near if self.picture(key).any()]
        found = set[TileKey]()
        for k, found, full in self._levels(level):
            if len(found) > _MOST or full > _SLACK * _MOST * 0.25 ** (level - k):
                raise _too_many(self._node, level)
        return list(found)

    def fitting(self) -> int:
        """Returns the finest level of which few enough tiles hold paint."""
        if self._repeats:
            level = self.finest
            while level > self.first and _count(self._frame.zoomed(level)) > _MOST_CHOSEN:
                level -= 1
            return level
        fits = self.first
        for k, tiles, _ in self._levels(self.finest, _MOST_CHOSEN):
            if len(tiles) > _MOST_CHOSEN:
                break
            fits = k
        return fits

    def _levels(self, level: int, most: int | None = None) -> Iterator[tuple[int, set[TileKey], float]]:
        """Yields the levels on the way to one, each with its tiles that hold paint, and how many full ones that paint
        would make: a coarse pixel is the mean of finer ones, so that it is four times as many at the next level.  Of
        more tiles than `most` not all are looked at."""
        alpha = [0.0]

        def filled(key: TileKey) -> bool:
            picture = self.picture(key)
            alpha[0] += float(picture[3][picture[3] > _WEAK].sum())
            return bool(picture.any())

        for k, tiles in filled_levels(stored_tiles(self.ways), filled, self.first, level, most):
            yield k, tiles, alpha[0] / TILE**2
            alpha[0] = 0.0


def _count(rect: Rect) -> int:
    return rect.area // TILE**2


def _too_many(node: Placement, level: int) -> LayerError:
    return LayerError(
        f"layer {node.name!r}: found more than {_MOST:,} tiles to paint at level {level}, expected a coarser level"
        " or a smaller part"
    )


def _few(node: Placement, level: int, tiles: Iterable[TileKey]) -> list[TileKey]:
    out = list(islice(tiles, _MOST + 1))
    if len(out) > _MOST:
        raise _too_many(node, level)
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
