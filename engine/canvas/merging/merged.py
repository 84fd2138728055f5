"""What several nodes show together, as the paint of one layer.

Level by level, from the coarsest that any of them has: a tile's value is what was seen there, rounded to the grid, and
its residual is what expand and the ink that lies there leave of it.  So the picture is the same at every level at which
anything is stored, and not only at one.  Where just one layer is seen, its values stay as they are, ink included: there
it is refined as before.  Below another layer that is half transparent, ink stays by the part that is seen.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace

import numpy as np

from engine.canvas import layers
from engine.canvas.compact import compact
from engine.canvas.composite import composite
from engine.canvas.evaluate import add_texture, evaluate, evaluate_sparse
from engine.canvas.flatten import flattened
from engine.canvas.layers import Group, Layer, Node
from engine.canvas.node_checks import LayerError
from engine.canvas.placing.baking import stored_tiles, ways_of
from engine.canvas.placing.composite_steps import CompositeStep, steps
from engine.canvas.placing.filled import TilePlace
from engine.canvas.placing.placement import Placement
from engine.canvas.placing.through import UNPLACED, Seen
from engine.canvas.reading import layer_planes
from engine.canvas.selecting.layer_mask import moved_of
from engine.canvas.store import Pyramid, Record, level_of
from engine.canvas.tile_cache import TileCache
from engine.numeric.address import TILE, Rect, TileKey
from engine.numeric.grid import snapped_to
from engine.numeric.pyramid import expand_into
from engine.texture.planes import COLOURS, Planes, merged, plane_map, widened

_KEPT_BYTES = 256 << 20  # bytes
_MOST_MIXED = 2048  # tiles in which two layers mix, beyond those that store anything, down to which all stays exact
_MOST_MERGED = 1 << 16  # tiles of a merged layer
_ALL_OF_IT = Rect(0, 0, TILE, TILE)
_WHOLE = np.float32(1)


def keeps_ink(nodes: Iterable[Node]) -> bool:
    """Tells whether the ink of some nodes, bottom first, stays ink where they are merged: they are layers, or groups of
    layers, each laid over those below."""
    return _sheets(steps(Group(0, "merged", children=tuple(nodes)))) is not None


def merged_paint(root: Group, nodes: tuple[Node, ...], grid: int) -> Pyramid:
    """Returns what some nodes of a tree show together on nothing, bottom first; the tree's examples are grown to the
    end.  LayerError if that would be too much."""
    root, nodes = _flat(root), tuple(map(_flat_node, nodes))
    return _Merging(root, nodes, grid).made()


def _flat(root: Group) -> Group:
    """Returns the tree with all that was painted with examples as paint."""
    return replace(root, children=tuple(map(_flat_node, root.children)))


def _flat_node(node: Node) -> Node:
    if isinstance(node, Group):
        return _flat(node)
    return flattened(node) if isinstance(node, Layer) and node.growth else node


@dataclass(frozen=True, slots=True)
class _Sheet:
    """A layer that is laid over those below it."""

    layer: Layer
    opacity: np.float32


def _sheets(plan: tuple[CompositeStep, ...]) -> list[_Sheet] | None:
    """Returns the layers of a plan, bottom first; None where they mix in another way."""
    out: list[_Sheet] = []
    for step in plan:
        if not step.over:
            return None
        if isinstance(step.source, Layer):
            out.append(_Sheet(step.source, step.opacity))
            continue
        inner = _sheets(step.source) if isinstance(step.source, tuple) and step.opacity == 1 else None
        if inner is None:
            return None
        out += inner
    return out


class _Merging:
    """The paint of one layer while it is made, from the coarsest level on."""

    def __init__(self, root: Group, nodes: tuple[Node, ...], grid: int) -> None:
        self._shown = layers.together(nodes, root)
        self._sheets = _sheets(steps(self._shown))
        self._ways = _ways(root, nodes)
        self._made, self._cache, self._count = Pyramid(grid=grid), TileCache(_KEPT_BYTES), 0

    def made(self) -> Pyramid:
        """Returns the whole of it."""
        ways = [(layer, seen) for layer, seen in self._ways if layer.pyramid.levels]
        if not ways:
            return self._made
        stored = stored_tiles(ways)
        first = min(min(layer.pyramid.levels) - seen.levels for layer, seen in ways)
        last = max(max(layer.pyramid.levels) - seen.levels for layer, seen in ways)
        mixed: set[TilePlace] = set()
        for level in range(first, last + 1):
            own = set(stored(level))
            near = own | set(_around(mixed))
            mixed = self._level(level, near)
            if self._count + len(mixed) > _MOST_MIXED:
                mixed = set()
        return self._made

    def _level(self, level: int, places: Iterable[TilePlace]) -> set[TilePlace]:
        """Stores the records of a level's tiles.  Returns those in which nodes mix, or beside which they do."""
        found: dict[TilePlace, Record] = {}
        shows: dict[TilePlace, frozenset[int]] = {}
        for x, y in sorted(places, key=lambda place: (place[1], place[0])):
            key = TileKey(level, x, y)
            values, shows[x, y] = self._values(key)
            record = left_of(self._made, key, values, self._cache)
            if record is not None:
                found[x, y] = record
            self._count += 1
        if self._count > _MOST_MERGED:
            raise LayerError(f"layer: found more than {_MOST_MERGED} tiles to merge, expected fewer")
        if found:
            self._made = replace(self._made, levels=self._made.levels.set(level, level_of(found)))
        return {place for place in shows if len(_near(shows, place)) > 1}

    def _values(self, key: TileKey) -> tuple[Planes, frozenset[int]]:
        """Returns what is seen of a tile, and the layers whose values that are; two where nodes mix in other ways."""
        unit, cache = self._made.step, self._cache

        def read(layer: Layer, level: int, rect: Rect) -> np.ndarray | None:
            return layer_planes(layer, level, rect, cache)

        seen = snapped_to(composite(self._shown, key.level, key.rect, read), unit)
        if self._sheets is None:
            return Planes(seen), frozenset((0, 1) if seen.any() else ())
        out, alone, shows = self._stacked(key)
        np.copyto(out.data[:COLOURS], seen, where=~alone)
        return out, shows

    def _stacked(self, key: TileKey) -> tuple[Planes, np.ndarray, frozenset[int]]:
        """Returns the ink of a tile's layers over one another, and where just one layer is seen, (h, w), its values;
        the layers that are seen."""
        out, alone, shows = Planes.empty(TILE, TILE), np.ones((TILE, TILE), bool), frozenset[int]()
        assert self._sheets is not None
        for sheet in self._sheets:
            above = evaluate_sparse(sheet.layer.pyramid, key.level, key.rect, self._cache)
            if above is None:
                continue
            inks = merged(out.inks, above.inks)
            source, below = widened(above, inks).data, widened(out, inks).data
            lies = (source != 0).any(0)
            covers = (source[3] >= 1) & (sheet.opacity == 1)
            keep = _WHOLE - sheet.opacity * np.clip(source[3], 0, 1)
            mixed = snapped_to(sheet.opacity * source + keep * below, self._made.step)
            taken = covers | (~(below != 0).any(0) & (sheet.opacity == 1))
            alone = np.where(lies, taken, alone)
            out = Planes(np.where(lies, np.where(taken, source, mixed), below), inks)
            shows = frozenset() if covers.all() else shows
            if lies.any():
                shows |= {sheet.layer.id} if sheet.opacity == 1 else {sheet.layer.id, 0}
        return out, alone, shows


def left_of(made: Pyramid, key: TileKey, values: Planes, cache: TileCache) -> Record | None:
    """Returns what expand and ink leave of a tile's values, above which all levels of a pyramid are made."""
    rect, unit = key.rect, made.step
    above = evaluate(made, key.level - 1, rect.parents(), cache)
    inks = merged(values.inks, above.inks)
    here = Planes(np.ascontiguousarray(widened(values, inks).data), inks)
    predicted = np.empty_like(here.data)
    coarse = np.ascontiguousarray(above.data)
    expand_into(coarse, 0, 0, plane_map(above.inks, inks), predicted, 0, TILE, unit)
    if any(key.level > ink.base for ink in inks):
        add_texture(predicted, here, key.level, rect, unit)
    steps_left = np.rint((here.data - predicted) / unit).astype(np.int32)
    return compact(_ALL_OF_IT, steps_left, inks, 0)


def _around(places: Iterable[TilePlace]) -> Iterable[TilePlace]:
    """Yields the tiles of the next level that lie in some tiles, or beside them."""
    return {(2 * x + i, 2 * y + j) for x, y in places for i in range(-1, 3) for j in range(-1, 3)}


def _near(shows: dict[TilePlace, frozenset[int]], place: TilePlace) -> frozenset[int]:
    """Returns the layers that are seen in a tile and in those beside it."""
    x, y = place
    beside = (shows.get((x + i, y + j)) for i in (-1, 0, 1) for j in (-1, 0, 1))
    return frozenset().union(*(held for held in beside if held))


def _ways(root: Group, nodes: tuple[Node, ...]) -> list[tuple[Layer, Seen]]:
    """Returns the layers that are seen in some nodes, and how."""
    found: list[tuple[Layer, Seen]] = []
    for node in nodes:
        if node.mask is not None:
            found.append((Layer(node.id, node.name, pyramid=node.mask.pyramid), moved_of(node)))
        if isinstance(node, Group):
            found += _ways(root, node.children)
        elif isinstance(node, Placement):
            if node.repeat:
                raise LayerError(f"layer {node.name!r}: found it repeated without end, expected it baked before")
            found += ways_of(root, node)
        elif node.wrap is not None:
            raise LayerError(f"layer {node.name!r}: found it wrapped around, expected wrap-around off before")
        else:
            found.append((node, UNPLACED))
    return found
