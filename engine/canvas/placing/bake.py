"""What a placement shows as paint of its own.

Shown by quarter turns and powers of two, every record keeps its values and goes to another place; ink stays ink.  Only
where the move is by parts of a coarse level's pixels, one edit at the coarsest level where it is not makes what lies
above.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace

import numpy as np

from engine.brush.stamp import Stamp
from engine.canvas.attenuate import fold
from engine.canvas.attenuate import placed as placed_rect
from engine.canvas.commit import commit
from engine.canvas.compact import compact
from engine.canvas.evaluate import evaluate_sparse
from engine.canvas.node_checks import LayerError
from engine.canvas.placing.filled import filled_levels
from engine.canvas.store import Level, Pyramid, Record, level_of
from engine.canvas.tile_cache import TileCache
from engine.numeric.address import TILE, Rect, TileKey
from engine.numeric.similarity import Similarity
from engine.texture.placed import as_placed, oriented
from engine.texture.planes import COLOURS, Planes, merged, plane_map, sort_key
from engine.texture.record import Instance

_CACHE = 256 << 20  # bytes
MOST_ENLARGED = 1 << 15  # tiles of a level that is finer than all that is stored, as foretold
_SOME = 64  # tiles from which on each level has four times as many
_NOTHING = np.zeros((TILE, TILE), np.float32)


class TooFine(LayerError):
    """What is moved by so small parts of its pixels that nobody could wait for all the tiles."""


@dataclass(frozen=True, eq=False)
class Pasted:
    """An edit that puts values where nothing lay."""

    level: int
    tiles: list[TileKey]
    values: Callable[[TileKey], Planes | None]
    spares_alpha: bool = False

    @property
    def rect(self) -> Rect:
        """Gives the tiles' bounds."""
        return tiles_of(self.tiles)

    def stamp(self, key: TileKey, old: Planes) -> Stamp | None:
        """Puts the tile's values there, as `Edit.stamp`."""
        found = self.values(key)
        return None if found is None else Stamp(_NOTHING, found.data, found.inks)


def tiles_of(keys: Iterable[TileKey]) -> Rect:
    """Returns the bounds of some tiles."""
    whole = Rect(0, 0, 0, 0)
    for key in keys:
        whole = whole.union(key.rect)
    return whole


def baked(pyramid: Pyramid, similarity: Similarity) -> Pyramid:
    """Returns a pyramid as it is shown by a similarity of quarter turns: at every level at which its move is by whole
    pixels, its values are those of the source there; coarser levels follow from them.  TooFine where that is far
    finer than all that is stored."""
    assert similarity.quarter is not None
    source = fold(pyramid)
    levels, aligned = similarity.quarter[0], similarity.aligned_from
    coarsest = None if source.coarsest is None else source.coarsest - levels
    empty = Pyramid(grid=pyramid.grid)
    if coarsest is None:
        return empty
    above = aligned is not None and coarsest < aligned
    turned = _Turned(source, similarity, aligned if above and aligned is not None else coarsest)
    out = turned.above() if above else empty
    first = turned.base + 1 if above else coarsest
    stored = dict(out.levels)
    for at in sorted(source.levels):
        if at - levels >= first:
            stored[at - levels] = turned.level(at, out.depth)
    return replace(
        out, levels=type(source.levels)({k: level for k, level in stored.items() if level}), settled=out.depth
    )


class _Turned:
    """A folded pyramid as a similarity shows it; ink adds detail there above level `base`."""

    def __init__(self, source: Pyramid, similarity: Similarity, base: int) -> None:
        assert similarity.quarter is not None
        self._source, self._similarity, self.base = source, similarity, base
        self._levels = similarity.quarter[0]
        self._back = similarity.inverse()
        self._inks: dict[Instance, Instance] = {}  # as they are shown, by what they are in the source

    def above(self) -> Pyramid:
        """Returns what the base level and all coarser ones hold: made of the values at the base."""
        keys = sorted(self._shown_tiles(), key=lambda key: (key.y, key.x))
        cache = TileCache(_CACHE)

        def values(key: TileKey) -> Planes | None:
            rect = self._back.shown(key.rect, key.level, key.level + self._levels)
            found = evaluate_sparse(self._source, key.level + self._levels, rect, cache)
            return None if found is None else self._oriented(found)

        return commit(Pyramid(grid=self._source.grid), Pasted(self.base, keys, values))

    def level(self, at: int, depth: int) -> Level:
        """Returns the records of the source's level `at` in their places."""
        level, tiles = at - self._levels, set[TileKey]()
        for place, record in self._source.levels[at].items():
            rect = placed_rect(TileKey(at, *place), record.rect)
            tiles.update(self._similarity.shown(rect, at, level).tiles(level))
        made = ((key, self._record(key, at, depth)) for key in tiles)
        return level_of({(key.x, key.y): record for key, record in made if record is not None})

    def _record(self, key: TileKey, at: int, depth: int) -> Record | None:
        rect = self._back.shown(key.rect, key.level, at)
        found = [(placed_rect(other, record.rect), record) for other, record in self._source.records(at, rect)]
        found = [(there, record) for there, record in found if there.meets(rect)]
        inks = merged(*(record.inks for _, record in found))
        data = np.zeros((COLOURS + 3 * len(inks), TILE, TILE), np.int32)
        for there, record in found:
            part = there.intersect(rect)
            source = record.data[:, *part.slices(there)]
            for c, plane in enumerate(plane_map(record.inks, inks).tolist()):
                if plane >= 0:
                    data[c, *part.slices(rect)] = source[plane]
        turned = self._oriented(Planes(data, inks))
        return compact(Rect(0, 0, TILE, TILE), turned.data, turned.inks, depth)

    def _oriented(self, planes: Planes) -> Planes:
        """Returns planes as they lie where they are shown, with their inks as they are there, sorted."""
        data = np.ascontiguousarray(oriented(planes.data, self._similarity))
        shown = tuple(self._ink(ink) for ink in planes.inks)
        inks = tuple(sorted(shown, key=lambda ink: sort_key(ink.key)))
        places = plane_map(shown, inks)  # placed, they sort in another order
        return Planes(data if inks == shown else np.ascontiguousarray(data[places]), inks)

    def _ink(self, ink: Instance) -> Instance:
        if ink not in self._inks:
            self._inks[ink] = as_placed(ink, self._similarity, max(ink.base - self._levels, self.base))
        return self._inks[ink]

    def _shown_tiles(self) -> Iterable[TileKey]:
        """Returns the tiles of the base level in which something lies."""
        at, cache = self.base + self._levels, TileCache(_CACHE)
        source = self._source
        assert source.coarsest is not None

        def filled(key: TileKey) -> bool:
            found = evaluate_sparse(source, key.level, key.rect, cache)
            return found is not None and bool(found.data.any())

        found, tiles = set[TileKey](), set[TileKey]()
        finest = max(source.levels)
        for level, tiles in filled_levels(lambda k: source.levels.get(k, ()), filled, source.coarsest, at):
            if at > finest <= level and len(tiles) > _SOME and len(tiles) << 2 * (at - level) > MOST_ENLARGED:
                raise TooFine(
                    f"layer: found a move by parts of a pixel, {at - finest} levels finer than all that is painted,"
                    " expected one of fewer: move it at a coarser level"
                )
        for key in tiles:
            found.update(self._similarity.shown(key.rect, at, self.base).tiles(self.base))
        return found
