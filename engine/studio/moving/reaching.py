"""How far a layer, group or placement reaches: what a hand takes hold of.

Bounds of coarse paint are far too wide: they are followed from level to level, and what is empty at their rims is left.
"""

from __future__ import annotations

from collections.abc import Callable, Generator
from dataclasses import replace

import numpy as np

from engine.canvas import growth as growths
from engine.canvas import layers
from engine.canvas.attenuate import placed
from engine.canvas.layers import Group, Layer, Node
from engine.canvas.placing.placement import Placement
from engine.canvas.placing.pose import SourcePart
from engine.canvas.placing.rounds import by_ids
from engine.canvas.reading import layer_planes
from engine.canvas.selecting.mask_sheet import sheet_of
from engine.canvas.tile_cache import TileCache
from engine.numeric.address import Rect, TileKey
from engine.numeric.similarity import Similarity
from engine.painting.value import Painting

FOLLOWED = 4096  # pixels along what reaches far: its bounds are followed to no finer level
_SPREAD = 2  # pixels of a level into which what lies beside them spreads, at most
_STRIP = 64  # pixels across what is looked at between two pauses
_NOWHERE = Rect(0, 0, 0, 0)
Filled = Callable[[Rect], np.ndarray]  # bool (h, w): where there is paint
Reach = Generator[None, None, SourcePart]  # pauses between pieces of work


def reach_of(painting: Painting, name: str, level: int, cache: TileCache | None = None) -> Reach:
    """Returns how far a node reaches, a placement in the places of its source, in pixels of a level, or of a coarser
    one where it is large; a layer without paint as far as its mask does.  It pauses on the way."""
    node = layers.find(painting.root, name)
    found = yield from _Reaches(painting, cache).of(node, level)
    if found.rect.empty and isinstance(node, Layer) and node.mask is not None:
        found = yield from _painted(sheet_of(node), level, cache)
    return found


def picture_reach(painting: Painting, cache: TileCache | None = None) -> Reach:
    """Returns how far all reaches that is seen of a painting, but for references; likewise, at level 0."""
    picture = replace(painting, root=layers.pictured(painting.root))
    return _Reaches(picture, cache).of(picture.root, 0)


class _Reaches:
    """What nodes of a painting reach; `_open`: the placements whose sources are being looked at."""

    def __init__(self, painting: Painting, cache: TileCache | None) -> None:
        self._painting, self._cache = painting, cache
        self._open: set[int] = set()
        self._nodes = by_ids(painting.root)

    def of(self, node: Node, level: int) -> Reach:
        """Returns what a layer or group reaches; of a placement, what its source does, or the part that it shows."""
        if not isinstance(node, Placement):
            return (yield from self._seen(node, level))
        within: list[
            Similarity
        ] = []  # of placements in one another: there may be thousands, too many for calls in calls
        opened: list[int] = []
        while node.part is None and node.of is not None and node.id not in self._open:
            self._open.add(node.id)
            opened.append(node.id)
            source = self._nodes[node.of]
            if not isinstance(source, Placement):
                found = yield from self._seen(source, level)
                break
            within.append(source.pose.similarity)
            node, level = source, level + source.pose.similarity.like_levels
        else:
            found = SourcePart(0, self._painting.frame) if node.part is None else node.part
        self._open.difference_update(opened)
        for similarity in reversed(within):
            found = _shown(found, similarity)
        return found

    def _seen(self, node: Node, level: int) -> Reach:
        """Returns what a node reaches where it is seen."""
        if isinstance(node, Layer):
            return (yield from _painted(node, level, self._cache))
        if isinstance(node, Group):
            return (yield from self._of_all(node, level))
        similarity = node.pose.similarity
        return _shown((yield from self.of(node, level + similarity.like_levels)), similarity)

    def _of_all(self, group: Group, level: int) -> Reach:
        whole = SourcePart(level, _NOWHERE)
        for child in group.children:
            if child.visible:
                found = yield from self._seen(child, level)
                whole = _both(whole, found)
        return whole


def _shown(part: SourcePart, similarity: Similarity) -> SourcePart:
    """Returns what holds a part of a source where it is shown."""
    at = part.level - similarity.like_levels
    return SourcePart(at, similarity.shown(part.rect, part.level, at))


def _both(one: SourcePart, other: SourcePart) -> SourcePart:
    """Returns what holds two parts, in pixels of the coarser of their levels."""
    if one.rect.empty or other.rect.empty:
        return other if one.rect.empty else one
    at = min(one.level, other.level)
    return SourcePart(at, one.rect.zoomed(at - one.level).union(other.rect.zoomed(at - other.level)))


def _painted(layer: Layer, level: int, cache: TileCache | None) -> Reach:
    """Returns the smallest rectangle that holds all paint of a layer."""
    pyramid = layer.pyramid
    begins = [plot.level for plot in layer.growth] + ([] if pyramid.coarsest is None else [pyramid.coarsest])
    if not begins:
        return SourcePart(level, _NOWHERE)
    at, whole = min(begins), _NOWHERE
    while True:
        grown = growths.bounds(layer.growth, at) if layer.growth else _NOWHERE
        whole = whole.union(stored(layer, at)).union(grown)
        if max(whole.width, whole.height) > FOLLOWED:
            return SourcePart(at, whole)
        whole = yield from trimmed(whole, _filled(layer, at, cache))
        nothing = whole.empty and at >= max([*begins, pyramid.finest or at])
        if nothing or at >= level or 2 * max(whole.width, whole.height) + 2 * _SPREAD > FOLLOWED:
            return SourcePart(at, whole)
        at, whole = at + 1, whole if whole.empty else whole.zoomed(1).grown(_SPREAD)


def stored(layer: Layer, level: int) -> Rect:
    """Returns what holds all records of a level."""
    whole = _NOWHERE
    for place, record in layer.pyramid.levels.get(level, {}).items():
        whole = whole.union(placed(TileKey(level, *place), record.rect))
    return whole


def _filled(layer: Layer, level: int, cache: TileCache | None) -> Filled:
    def filled(rect: Rect) -> np.ndarray:
        found = layer_planes(layer, level, rect, cache)
        return np.zeros((rect.height, rect.width), bool) if found is None else found[3] != 0

    return filled


def trimmed(rect: Rect, filled: Filled) -> Generator[None, None, Rect]:
    """Returns the smallest rectangle within one that holds all that is `filled` there, looking from its sides on; it
    pauses on the way."""
    x0, y0, x1, y1 = rect
    y0, y1 = yield from _ends(y0, y1, lambda low, high: np.any(filled(Rect(x0, low, x1, high)), axis=1))
    if y0 == y1:
        return _NOWHERE
    x0, x1 = yield from _ends(x0, x1, lambda low, high: np.any(filled(Rect(low, y0, high, y1)), axis=0))
    return Rect(x0, y0, x1, y1)


def _ends(low: int, high: int, filled: Callable[[int, int], np.ndarray]) -> Generator[None, None, tuple[int, int]]:
    """Returns from where to where rows or columns are `filled`, bool of each; twice the same if none is."""
    while low < high:
        found = filled(low, min(low + _STRIP, high)).tolist()
        yield
        if True in found:
            low += found.index(True)
            break
        low += len(found)
    while low < high:
        found = filled(max(high - _STRIP, low), high).tolist()
        yield
        if True in found:
            high -= found[::-1].index(True)
            break
        high -= len(found)
    return low, high
