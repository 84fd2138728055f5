"""Where what a node shows lies, level by level: what shows it elsewhere leaves out all that lies beside.

Only exact values tell: coarse paint reaches wide, and is mostly nothing.  So a layer is walked down to its
finest paint, once for each of its states, where tiles are few, as in what is shown many times; others lie anywhere.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np

from engine.canvas.evaluate import evaluate_sparse
from engine.canvas.layers import Group, Layer, Node
from engine.canvas.placing.filled import filled_levels
from engine.canvas.placing.placement import Placement
from engine.canvas.placing.sampling import Picture, source_level
from engine.canvas.placing.shared.kept_pictures import KeptPictures
from engine.canvas.placing.through import Seen
from engine.canvas.placing.views import mapped
from engine.canvas.store import Pyramid
from engine.canvas.tile_cache import TileCache
from engine.numeric.address import Rect, TileKey

MOST_STORED = 512  # tiles of a layer whose extent is told
MOST_FILLED = 256  # of one of its levels: coarse paint fills ever more of them
_CACHE = 16 << 20  # bytes, while one is told
_KEPT = 256  # layers
_AROUND = 3  # pixels of the level of the finest paint beside it that those below can see
_NOWHERE = Rect(0, 0, 0, 0)
_Levels = dict[int, Rect]
_UNKNOWN = "unknown"
_known: dict[tuple[int, int | None], _Levels | None] = {}  # by the state of a layer's paint


def painted_at(layer: Layer, level: int) -> Rect | None:
    """Returns a rectangle of a level outside which a layer holds nothing; None: anywhere."""
    pyramid = layer.pyramid
    if layer.growth or layer.wrap is not None or pyramid.ground is not None:
        return None
    held = pyramid.uid, None if pyramid.last is None else pyramid.last.serial
    levels = _known.get(held, _UNKNOWN)
    if isinstance(levels, str):
        few = sum(map(len, pyramid.levels.values())) <= MOST_STORED
        levels = _by_level(pyramid) if few else None
        if len(_known) >= _KEPT:
            _known.clear()
        _known[held] = levels
    if levels is None:
        return None
    finest = max(levels, default=level)
    return levels.get(level, _NOWHERE) if level <= finest else levels[finest].grown(_AROUND).zoomed(level - finest)


def _by_level(pyramid: Pyramid) -> _Levels | None:
    if pyramid.coarsest is None or pyramid.finest is None:
        return {}
    cache, found = TileCache(_CACHE), dict.fromkeys(range(pyramid.coarsest, pyramid.finest + 1), _NOWHERE)

    def filled(key: TileKey) -> bool:
        planes = evaluate_sparse(pyramid, key.level, key.rect, cache)
        if planes is None:
            return False
        lies = np.any(planes.data, axis=0)
        rows, columns = np.flatnonzero(lies.any(axis=1)), np.flatnonzero(lies.any(axis=0))
        if not len(rows):
            return False
        x, y = key.rect.x0, key.rect.y0
        here = Rect(x + int(columns[0]), y + int(rows[0]), x + int(columns[-1]) + 1, y + int(rows[-1]) + 1)
        found[key.level] = found[key.level].union(here)
        return True

    walk = filled_levels(lambda k: pyramid.levels.get(k, ()), filled, pyramid.coarsest, pyramid.finest)
    return found if all(len(tiles) <= MOST_FILLED for _, tiles in walk) else None


class Shared:
    """What placements of a tree show: where it lies, and its pictures.  `nodes`: by their ids; `end`: the last of
    exact placements in one another, and how it is seen; `anywhere`: nodes of which nothing is told, as they show
    themselves, or are painted on at the moment."""

    def __init__(
        self,
        root: Group,
        nodes: Mapping[int, Node],
        end: Callable[[Placement], tuple[Placement, Seen]],
        anywhere: frozenset[int],
    ) -> None:
        self._root, self._nodes, self._end, self._anywhere = root, nodes, end, anywhere
        self._found: dict[tuple[int, int], Rect | None] = {}
        self._pictures = KeptPictures()

    def keeps(self, of: int | None) -> bool:
        """Tells whether tiles of the picture of a node are kept: of one that is no layer, and does not show itself."""
        node = self._node(of)
        return not isinstance(node, Layer) and node.id not in self._anywhere

    def kept(self, of: int | None, picture: Picture) -> Picture:
        """Returns the whole picture of such a node with its tiles kept."""
        return self._pictures.of(of, picture)

    def _node(self, of: int | None) -> Node:
        return self._root if of is None else self._nodes[of]

    def lies(self, of: int | None, level: int, through: Seen) -> Rect | None:
        """Returns a rectangle of a level outside which nothing is seen of a node through placements; None:
        anywhere."""
        finer = through.finer(level)
        if through.repeats:
            return None
        at = source_level(through.similarity, level) if finer is None else level + through.levels + finer
        inner = self._of(self._node(of), at)
        return inner if inner is None or inner.empty else mapped(inner, at, through, level)

    def _of(self, node: Node, level: int) -> Rect | None:
        held = node.id, level
        if held not in self._found:
            self._found[held] = self._looked_up(node, level)
        return self._found[held]

    def _looked_up(self, node: Node, level: int) -> Rect | None:
        if node.id in self._anywhere:
            return None
        if isinstance(node, Layer):
            return painted_at(node, level)
        if isinstance(node, Placement):
            last, seen = self._end(node)
            if last.pose.similarity.quarter is None or last.repeat:
                return None
            return self.lies(last.of, level, seen.of(last))
        whole = _NOWHERE
        for child in node.children:
            found = self._of(child, level)
            if found is None:
                return None
            whole = whole.union(found)
        return whole
