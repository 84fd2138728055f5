"""Where there is paint, and how deep: read from the tiles that are stored.

A place is as deep as the finest tile stored there: every stroke stores tiles at the levels above its own, too.
"""

from __future__ import annotations

import heapq
import math
from collections import defaultdict
from collections.abc import Callable, Generator, Iterator

from engine.canvas.layers import Group, Layer
from engine.numeric.address import TILE, Rect, TileKey
from engine.studio.results import Spot

Place = tuple[int, int]  # of a tile: column, row
Finest = dict[int, set[Place]]  # by level, the tiles that have nothing finer below them
_BLOCK = 12  # tiles along a block of paint that one goes to: about a screen
_MOST = 300  # spots on a map
_ASKED = 600  # tiles whose pixels are looked at
_CANDIDATES = 6  # of each level, the tiles nearest to a place


def finest_tiles(root: Group, painted: Callable[[int, Rect], bool]) -> Generator[None, None, Finest]:
    """Returns the finest tiles of all that is visible; pauses between pieces of work.

    Beside what is finer a stroke stores tiles in which nothing shows: those there are asked for, by `painted`.
    """
    stored: dict[int, set[Place]] = defaultdict(set)
    for layer in _visible(root):
        for level, records in layer.pyramid.levels.items():
            stored[level].update(records.keys())
            yield
        for plot in layer.growth:
            stored[plot.level].update((column >> 1, row >> 1) for row, column in plot.region.masks[0])
    found: Finest = {}
    covered: set[Place] = set()  # by what is finer
    below, asked = 0, 0
    for level in sorted(stored, reverse=True):
        covered, below = {(x >> below - level, y >> below - level) for x, y in covered}, level
        open_tiles = stored[level] - covered
        for tile in _beside(covered, open_tiles):
            asked += 1
            if asked <= _ASKED and not painted(level, TileKey(level, *tile).rect):
                open_tiles.discard(tile)
            yield
        if open_tiles:
            found[level] = open_tiles
        covered |= stored[level]
        yield
    return found


def _beside(covered: set[Place], tiles: set[Place]) -> list[Place]:
    """Returns those of some tiles that touch covered ones."""
    around = [(i, j) for i in (-1, 0, 1) for j in (-1, 0, 1)]
    if len(covered) < len(tiles):
        return sorted({(x + i, y + j) for x, y in covered for i, j in around} & tiles)
    return sorted(tile for tile in tiles if any((tile[0] + i, tile[1] + j) in covered for i, j in around))


def _visible(node: Group) -> Iterator[Layer]:
    for child in node.children:
        if child.visible and child.opacity > 0:
            if isinstance(child, Layer):
                yield child
            else:
                yield from _visible(child)


def tiles_bounds(finest: Finest, level: int) -> Rect:
    """Returns the pixels of a level that hold all of the tiles."""
    whole = Rect(0, 0, 0, 0)
    for own, found in finest.items():
        whole = whole.union(_hull(found).zoomed(level - own))
    return whole


def _hull(found: set[Place]) -> Rect:
    xs, ys = [x for x, _ in found], [y for _, y in found]
    return Rect(min(xs) * TILE, min(ys) * TILE, (max(xs) + 1) * TILE, (max(ys) + 1) * TILE)


def spots(finest: Finest, level: int, cell: int) -> tuple[Spot, ...]:
    """Returns the paint as few places, of each level at most one in each square of `cell` pixels of `level`: the block
    of a screen's size that has most of it there.  The coarsest level first."""
    while True:
        found = [spot for own in sorted(finest) for spot in _spots(finest[own], own, level, cell)]
        if len(found) <= _MOST:
            return tuple(found)
        cell *= 2


def _spots(found: set[Place], own: int, level: int, cell: int) -> Iterator[Spot]:
    blocks: dict[Place, list[Place]] = defaultdict(list)
    for x, y in found:
        blocks[x // _BLOCK, y // _BLOCK].append((x, y))
    cells: dict[Place, list[Place]] = defaultdict(list)
    for block in blocks:
        x, y = (_shifted((2 * side + 1) * _BLOCK * TILE >> 1, level - own) // cell for side in block)
        cells[x, y].append(block)
    for _, inside in sorted(cells.items()):
        best = max(inside, key=lambda block: (len(blocks[block]), block))
        yield Spot(own, _hull(set(blocks[best])), sum(len(blocks[block]) for block in inside))


def _shifted(value: int, bits: int) -> int:
    return value << bits if bits >= 0 else value >> -bits


def nearest_tiles(finest: Finest, level: int, sight: Rect) -> list[tuple[int, Place]]:
    """Returns tiles near what is in sight of a level, `sight`, the nearest first: (level, tile).

    It counts how far they lie in screens, and by how many levels they are finer or coarser.
    """
    x, y = (sight.x0 + sight.x1) // 2, (sight.y0 + sight.y1) // 2
    screen = math.log2(max(sight.width, sight.height, 1))
    found = []
    for own, tiles in finest.items():
        at = _shifted(x, own - level), _shifted(y, own - level)
        for away, tile in heapq.nsmallest(_CANDIDATES, ((_away(tile, at), tile) for tile in tiles)):
            screens = math.log2(away) + level - own - screen if away else -math.inf
            far = screens if screens > 60 else math.log2(1 + 2.0**screens)
            found.append((abs(own - level) + far, own, tile))
    return [(own, tile) for _, own, tile in sorted(found)]


def _away(tile: Place, at: Place) -> int:
    """Returns how far a tile is from a pixel of its level, along the longer way."""
    (x, y), (left, top) = at, (tile[0] * TILE, tile[1] * TILE)
    return max(left - x, x - left - TILE + 1, top - y, y - top - TILE + 1, 0)
