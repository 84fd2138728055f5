"""Where there is paint, and how deep: read from the tiles that are stored.

A place is as deep as the finest tile stored there: every stroke stores tiles at the levels above its own, too.
"""

from __future__ import annotations

import heapq
import math
from collections import defaultdict
from collections.abc import Callable, Generator, Iterable, Iterator
from itertools import islice
from typing import TypeVar

from engine.canvas.layers import Group, Layer, layers
from engine.canvas.placing.placement import Placement
from engine.canvas.placing.through import Seen
from engine.canvas.placing.views import Views
from engine.numeric.address import TILE, Rect, TileKey
from engine.studio.results import Spot

Place = tuple[int, int]  # of a tile: column, row
Finest = dict[int, set[Place]]  # by level, the tiles that have nothing finer below them
_BLOCK = 12  # tiles along a block of paint that one goes to: about a screen
_MOST = 300  # spots on a map
_ASKED = 600  # tiles whose pixels are looked at
_CANDIDATES = 6  # of each level, the tiles nearest to a place
_SHOWN_MOST = 16  # tiles in which one of a source is shown
_TILES_AT_ONCE = 4096  # tiles that are gone through without a pause: some milliseconds
_NEIGHBOURS = tuple((i, j) for i in (-1, 0, 1) for j in (-1, 0, 1))
_Block = tuple[int, int, int]  # its level, and where it lies; or a square of the map, by the level of what is in it
_T = TypeVar("_T")


def finest_tiles(root: Group, painted: Callable[[int, Rect], bool]) -> Generator[None, None, Finest]:
    """Returns the finest tiles of all that is visible; pauses between pieces of work.

    Beside what is finer a stroke stores tiles in which nothing shows: those there are asked for, by `painted`.
    """
    stored = yield from _stored(root)
    found: Finest = {}
    covered: set[Place] = set()  # by what is finer
    below, asked = 0, 0
    for level in sorted(stored, reverse=True):
        finer, bits = covered, below - level
        covered, below = set(), level
        for piece in _pieces(finer):
            covered.update((x >> bits, y >> bits) for x, y in piece)
            yield
        open_tiles: set[Place] = set()
        for piece in _pieces(stored[level]):
            open_tiles.update(tile for tile in piece if tile not in covered)
            yield
        beside = yield from _beside(covered, open_tiles)
        for tile in heapq.nsmallest(_ASKED - asked, beside):
            asked += 1
            if not painted(level, TileKey(level, *tile).rect):
                open_tiles.discard(tile)
            yield
        if open_tiles:
            found[level] = open_tiles
        for piece in _pieces(stored[level]):
            covered.update(piece)
            yield
    return found


def _stored(root: Group) -> Generator[None, None, dict[int, set[Place]]]:
    """Returns the tiles, by level, that are stored of all that is visible, or shown; pauses on the way."""
    stored: dict[int, set[Place]] = defaultdict(set)
    for layer in _visible(root):
        for level, records in layer.pyramid.levels.items():
            for piece in _pieces(records.keys()):
                stored[level].update(piece)
                yield
        for plot in layer.growth:
            stored[plot.level].update((column >> 1, row >> 1) for row, column in plot.region.masks[0])
    for level, places in _placed(root):
        for piece in _pieces(places):
            stored[level].update(piece)
            yield
    return stored


def _placed(root: Group) -> Iterator[tuple[int, Iterator[Place]]]:
    """Yields the tiles, by level, in which visible placements show stored ones; of one that lies in what it shows, its
    first turn."""
    views, own = Views(root), {layer.id: layer for layer in layers(root)}
    for node in _visible_nodes(root) if views.any else ():
        first: dict[int, Seen] = {}
        for number, seen in (views.of(0, node.id) or ()) if isinstance(node, Placement) else ():
            held = first.get(number)
            if held is None or seen.similarity.log_scale > held.similarity.log_scale:
                first[number] = seen
        for number, seen in first.items():
            for at, records in own[number].pyramid.levels.items():
                yield at - seen.levels, _shown_tiles(seen, at, records.keys())


def _shown_tiles(seen: Seen, at: int, places: Iterable[Place]) -> Iterator[Place]:
    level = at - seen.levels
    for place in places:
        rect = seen.meets(level, seen.similarity.shown(TileKey(at, *place).rect, at, level))
        yield from ((key.x, key.y) for key in islice(rect.tiles(level), _SHOWN_MOST))


def _pieces(places: Iterable[_T]) -> Iterator[list[_T]]:
    """Yields some tiles, or blocks of them, a piece at a time."""
    rest = iter(places)
    while piece := list(islice(rest, _TILES_AT_ONCE)):
        yield piece


def _beside(covered: set[Place], tiles: set[Place]) -> Generator[None, None, set[Place]]:
    """Returns those of some tiles that touch covered ones; pauses on the way."""
    found: set[Place] = set()
    few = len(covered) < len(tiles)
    for piece in _pieces(covered if few else tiles):
        around = (((x + i, y + j), (x, y)) for x, y in piece for i, j in _NEIGHBOURS)
        found.update(other if few else own for other, own in around if other in (tiles if few else covered))
        yield
    return found


def _visible(node: Group) -> Iterator[Layer]:
    return (child for child in _visible_nodes(node) if isinstance(child, Layer))


def _visible_nodes(node: Group) -> Iterator[Layer | Placement]:
    for child in node.children:
        if child.visible and child.opacity > 0:
            if isinstance(child, Group):
                yield from _visible_nodes(child)
            else:
                yield child


def tiles_within(finest: Finest, area: Rect) -> Generator[None, None, Rect]:
    """Returns the pixels of level 0 that hold all of the tiles which meet `area`, pixels of level 0, none where none
    does; pauses on the way."""
    whole = Rect(0, 0, 0, 0)
    for own, tiles in finest.items():
        inner = area.zoomed(own)
        left, top, right, bottom = (edge // TILE for edge in (inner.x0, inner.y0, inner.x1 - 1, inner.y1 - 1))
        for piece in _pieces(tiles):
            near = {(x, y) for x, y in piece if left <= x <= right and top <= y <= bottom}
            if near:
                whole = whole.union(_hull(near).zoomed(-own))
            yield
    return whole


def _hull(found: Iterable[Place]) -> Rect:
    xs, ys = zip(*found, strict=True)
    return Rect(min(xs) * TILE, min(ys) * TILE, (max(xs) + 1) * TILE, (max(ys) + 1) * TILE)


def spots(finest: Finest, level: int, cell: int) -> Generator[None, None, tuple[Spot, ...]]:
    """Returns the paint as few places, of each level at most one in each square of `cell` pixels of `level`, or of
    twice as many, and so on: the block of a screen's size that has most of it there.  The coarsest level first.  It
    pauses on the way."""
    blocks: dict[_Block, list[Place]] = defaultdict(list)
    for own, tiles in finest.items():
        for piece in _pieces(tiles):
            for x, y in piece:
                blocks[own, x // _BLOCK, y // _BLOCK].append((x, y))
            yield
    squares: dict[_Block, tuple[int, int]] = {}  # in which the blocks' middles lie
    for some in _pieces(blocks):
        for block in some:
            x, y = (_shifted((2 * side + 1) * _BLOCK * TILE >> 1, level - block[0]) // cell for side in block[1:])
            squares[block] = x, y
        yield
    bits = yield from _doublings(squares)
    best: dict[_Block, tuple[int, _Block, int]] = {}  # how many tiles the best block has, which, and how many all have
    for some in _pieces(blocks):
        for block in some:
            x, y = squares[block]
            count, key = len(blocks[block]), (block[0], x >> bits, y >> bits)
            most, one, total = best.get(key, (0, block, 0))
            best[key] = *max((most, one), (count, block)), total + count
        yield
    return tuple(Spot(key[0], _hull(blocks[one]), total) for key, (_, one, total) in sorted(best.items()))


def _doublings(squares: dict[_Block, tuple[int, int]]) -> Generator[None, None, int]:
    """Returns how often squares have to double until there are few enough; pauses on the way."""
    low, high = 0, 0
    for sides in _pieces(squares.values()):
        high = max(high, *(side.bit_length() for square in sides for side in square))
        yield
    while low < high:
        half, larger = (low + high) // 2, set[_Block]()
        for some in _pieces(squares):
            larger.update((block[0], squares[block][0] >> half, squares[block][1] >> half) for block in some)
            yield
            if len(larger) > _MOST:
                break
        low, high = (low, half) if len(larger) <= _MOST else (half + 1, high)
    return low


def _shifted(value: int, bits: int) -> int:
    return value << bits if bits >= 0 else value >> -bits


def nearest_tiles(finest: Finest, level: int, sight: Rect) -> Generator[None, None, list[tuple[int, Place]]]:
    """Returns tiles near what is in sight of a level, `sight`, the nearest first: (level, tile); pauses on the way.

    It counts how far they lie in screens, and by how many levels they are finer or coarser.
    """
    x, y = (sight.x0 + sight.x1) // 2, (sight.y0 + sight.y1) // 2
    screen = math.log2(max(sight.width, sight.height, 1))
    found = []
    for own, tiles in finest.items():
        at = _shifted(x, own - level), _shifted(y, own - level)
        near: list[tuple[int, Place]] = []
        for piece in _pieces(tiles):
            near = heapq.nsmallest(_CANDIDATES, [*near, *((_away(tile, at), tile) for tile in piece)])
            yield
        for away, tile in near:
            screens = math.log2(away) + level - own - screen if away else -math.inf
            far = screens if screens > 60 else math.log2(1 + 2.0**screens)
            found.append((abs(own - level) + far, own, tile))
    return [(own, tile) for _, own, tile in sorted(found)]


def _away(tile: Place, at: Place) -> int:
    """Returns how far a tile is from a pixel of its level, along the longer way."""
    (x, y), (left, top) = at, (tile[0] * TILE, tile[1] * TILE)
    return max(left - x, x - left - TILE + 1, top - y, y - top - TILE + 1, 0)
