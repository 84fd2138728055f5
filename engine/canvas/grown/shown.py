"""What a region painted with an example looks like on the canvas: tiles at its own level and at the coarser ones, kept
and followed where the region changes; and any rectangle at any level, read from them.

All values are premultiplied and on the grid.  A coarser pixel is the snapped mean of four, a finer one the B-spline of
those around it with the detail that the example itself has below its pixels (`closer`).
"""

from __future__ import annotations

from collections import deque
from collections.abc import Generator, Iterable, Iterator
from concurrent.futures import Executor, Future

import numpy as np

from engine.canvas.grown import closer
from engine.numeric.address import Rect
from engine.numeric.grid import snap
from engine.numeric.kernel import kernel
from engine.numeric.pyramid import reduce
from engine.texture.example import show, tiles
from engine.texture.example.region import Region
from engine.texture.example.region_window import OUTSIDE
from engine.texture.example.tiles import NONE, TILE_SIDE, Key, TilePlanes, Tiles, sealed

Shown = tuple[Tiles, ...]  # float32 (4, TILE_SIDE, TILE_SIDE), from the region's own level to coarser ones
FEW = 4  # tiles: with no more of them, a level is coarse enough to be the last that is kept
_HALF = TILE_SIDE // 2
_RUN = 16  # tiles between two pauses
_SHARED = 8  # rectangles that threads are given ahead
_NOWHERE = Rect(0, 0, 0, 0)
_ONE = np.float32(1.0)


# --- following the region -----------------------------------------------------------------------------------------


def followed(shown: Shown, drawn: Region | None, region: Region, threads: Executor | None = None) -> Shown:
    """As `following`, at once."""
    steps = following(shown, drawn, region, threads)
    while True:
        try:
            next(steps)
        except StopIteration as end:
            out: Shown = end.value
            return out


def following(
    shown: Shown, drawn: Region | None, region: Region, threads: Executor | None = None
) -> Generator[None, None, Shown]:
    """Yields what `region` looks like, from what `drawn`, an earlier state of it (None: nothing of it), looks like;
    pauses after some tiles.  Tiles that look alike stay the same objects."""
    base = shown[0] if shown else NONE
    held: dict[Key, TilePlanes] = {}
    stale = yield from _stale(base, drawn, region)
    for found in _looked_at(base, region, list(_runs(stale)), threads):
        held.update(found)
        yield
    return (yield from _with_coarser(shown, _put(base, held), set(held)))


def _runs(stale: dict[Key, Rect]) -> Iterator[Rect]:
    """Rectangles that hold all parts of tiles: several whole tiles beside one another as one."""
    run = _NOWHERE
    for key in sorted(stale):
        part = stale[key]
        joins = part == tiles.rect_of(key) and (part.x0, part.y0) == (run.x1, run.y0)
        if joins and run.height == TILE_SIDE and run.width % TILE_SIDE == 0 and run.width < _RUN * TILE_SIDE:
            run = run.union(part)
            continue
        if not run.empty:
            yield run
        run = part
    if not run.empty:
        yield run


def _looked_at(
    base: Tiles, region: Region, runs: list[Rect], threads: Executor | None
) -> Iterator[dict[Key, TilePlanes]]:
    """For each rectangle the tiles that change, in order."""
    if threads is None or len(runs) < _SHARED:
        for run in runs:
            yield _look(base, region, run)
        return
    jobs: deque[Future[dict[Key, TilePlanes]]] = deque()
    try:
        for run in runs:
            jobs.append(threads.submit(_look, base, region, run))
            if len(jobs) == _SHARED:
                yield jobs.popleft().result()
        while jobs:
            yield jobs.popleft().result()
    finally:  # also where the next step is never asked for
        for job in jobs:
            job.cancel()


def _look(base: Tiles, region: Region, rect: Rect) -> dict[Key, TilePlanes]:
    new = show.preview(region, rect)
    held: dict[Key, TilePlanes] = {}
    for key in tiles.keys_of(rect):
        place = tiles.rect_of(key)
        both = place.intersect(rect)
        _lay(held, key, base.get(key), both.slices(place), new[:, *both.slices(rect)])
    return held


def _stale(base: Tiles, drawn: Region | None, region: Region) -> Generator[None, None, dict[Key, Rect]]:
    """Yields tiles of the region's own level that may look different, and the part of each."""
    found: dict[Key, Rect] = {}
    masks, names = region.masks[0], region.levels[0].sources
    bare: dict[Key, Rect] = {}  # what of a tile has no source of its own

    def add(key: Key, area: Rect) -> None:
        found[key] = found.get(key, _NOWHERE).union(area)

    for k, (n, area) in enumerate(_altered(drawn, region), 1):
        for key in keys_within(area, (masks, base) if n == 0 else (masks,)):
            if n and key not in bare:
                bare[key] = _sourceless(masks[key], names.get(key), key)
            part = area.intersect(bare[key] if n else tiles.rect_of(key))
            if not part.empty:
                add(key, part)
        if n > 0 or k % _RUN == 0:
            yield
    return found


def _altered(drawn: Region | None, region: Region) -> Iterator[tuple[int, Rect]]:
    """Tells where pixels may look different, tile by tile: because of their own sources or as they join or leave the
    region (0), or because of those of a coarser level, if they have none."""
    if drawn is None:
        yield from ((0, area) for area in tiles.changed_rects(NONE, region.masks[0], 0))
        return
    yield from ((0, area) for area in tiles.changed_rects(drawn.masks[0], region.masks[0], 0))
    feather = region.exemplar.parameters.feather
    own = tiles.changed_rects(drawn.levels[0].sources, region.levels[0].sources, OUTSIDE)
    yield from ((0, area.grown(feather)) for area in own)
    for n in range(1, len(region.levels)):
        then, now = drawn.levels[n], region.levels[n]
        areas: dict[Key, Rect] = {}
        # A source counts for the pixels beside it too; not where masks differ, and neither do those beside that.
        pairs = (
            (then.sources, now.sources, OUTSIDE, 1),
            (then.mask, now.mask, 0, 2),
            (drawn.masks[n], region.masks[n], 0, 2),
        )
        for one, other, empty, reach in pairs:
            for area in tiles.changed_rects(one, other, empty):
                key = area.y0 // TILE_SIDE, area.x0 // TILE_SIDE
                areas[key] = areas.get(key, _NOWHERE).union(area.grown(reach))
        yield from ((n, area.zoomed(n)) for area in areas.values())


def keys_within(area: Rect, maps: Iterable[Tiles]) -> set[Key]:
    """Returns the tiles of some maps that meet a rectangle, of any size."""
    rows = range(area.y0 // TILE_SIDE, (area.y1 - 1) // TILE_SIDE + 1)
    columns = range(area.x0 // TILE_SIDE, (area.x1 - 1) // TILE_SIDE + 1)
    found: set[Key] = set()
    if area.empty:
        return found
    for held in maps:
        if (rows.stop - rows.start) * (columns.stop - columns.start) < len(held):
            found.update((row, column) for row in rows for column in columns if (row, column) in held)
        else:
            found.update(key for key in held if key[0] in rows and key[1] in columns)
    return found


def _sourceless(mask: TilePlanes, names: TilePlanes | None, key: Key) -> Rect:
    """Returns the smallest rectangle around a tile's pixels that have no source."""
    at = tiles.rect_of(key)
    if names is None:
        return at
    y0, y1, x0, x1 = _bounds_of(mask.data[0], names.data[-1])
    return Rect(at.x0 + x0, at.y0 + y0, at.x0 + x1, at.y0 + y1)


@kernel
def _bounds_of(mask: np.ndarray, names: np.ndarray) -> tuple[int, int, int, int]:
    """Returns rows [0, 1) and columns [2, 3) that hold the pixels of a mask (n, n) without a source; 0 if there are
    none."""
    y0, y1, x0, x1 = mask.shape[0], 0, mask.shape[1], 0
    for y in range(mask.shape[0]):
        for x in range(mask.shape[1]):
            if mask[y, x] and names[y, x] < 0:
                y0, y1 = min(y0, y), y + 1
                x0, x1 = min(x0, x), max(x1, x + 1)
    return (y0, y1, x0, x1) if y1 else (0, 0, 0, 0)


def _lay(
    held: dict[Key, TilePlanes], key: Key, old: TilePlanes | None, place: tuple[slice, ...], new: np.ndarray
) -> None:
    """Lays `new` on the part `place` of the tile `old`, and holds it if that changes it."""
    if not new.any() if old is None else np.array_equal(old.data[:, *place], new):
        return
    tile = np.zeros((4, TILE_SIDE, TILE_SIDE), np.float32) if old is None else old.data.copy()
    tile[:, *place] = new
    held[key] = sealed(tile)


def _put(level: Tiles, held: dict[Key, TilePlanes]) -> Tiles:
    """Returns a level with some of its tiles replaced; those that are empty are left out."""
    if not held:
        return level
    changing = level.mutate()
    for key, tile in held.items():
        if tile.data.any():
            changing[key] = tile
        else:
            changing.pop(key, None)
    return changing.finish()


def _with_coarser(shown: Shown, base: Tiles, touched: set[Key]) -> Generator[None, None, Shown]:
    levels = [base]
    while len(levels[-1]) > FEW:
        n = len(levels)
        held: dict[Key, TilePlanes] = {}
        old, changed = (shown[n], touched) if n < len(shown) else (NONE, set(levels[-1]))
        for k, key in enumerate(changed):
            _reduce_tile(held, old, levels[-1], key)
            if k % _RUN == _RUN - 1:
                yield
        levels.append(_put(old, held))
        touched = set(held)
    return tuple(levels)


def coarser(old: Tiles, finer: Tiles, touched: set[Key]) -> tuple[Tiles, set[Key]]:
    """Returns the level above `finer`, of whose tiles `touched` are not those that `old` was made of; what differs
    in it."""
    held: dict[Key, TilePlanes] = {}
    for key in touched:
        _reduce_tile(held, old, finer, key)
    return _put(old, held), set(held)


def _reduce_tile(held: dict[Key, TilePlanes], old: Tiles, finer: Tiles, place: Key) -> None:
    """Lays a quarter of a tile above `finer`, that above the tile at `place`, on what `held` or `old` has there."""
    row, column = place
    key, child = (row >> 1, column >> 1), finer.get(place)
    new = np.zeros((4, _HALF, _HALF), np.float32) if child is None else reduce(child.data)
    top, left = (row & 1) * _HALF, (column & 1) * _HALF
    _lay(held, key, held.get(key, old.get(key)), (slice(top, top + _HALF), slice(left, left + _HALF)), new)


# --- reading ------------------------------------------------------------------------------------------------------


def over(out: np.ndarray, shown: Shown, region: Region, finer: int, rect: Rect) -> None:
    """Lays what is shown of a region over `out` (C, h, w), which covers `rect` of the level `finer` levels below the
    region's own (above it, if negative).  Planes from the fourth on, ink, are weakened alone."""
    if finer > 0:
        if meets(shown, finer, rect):
            above, at = closer.expanded(shown[0], region, finer, rect)
            over_tile(out, 0, 0, above, rect.y0 - at.y0, rect.x0 - at.x0, rect.height, rect.width)
        return
    level = at_level(shown, -finer, rect)
    for key in keys_within(rect, (level,)):
        place = tiles.rect_of(key)
        part = place.intersect(rect)
        above, height, width = level[key].data, part.height, part.width
        over_tile(
            out, part.y0 - rect.y0, part.x0 - rect.x0, above, part.y0 - place.y0, part.x0 - place.x0, height, width
        )


def meets(shown: Shown, finer: int, rect: Rect) -> bool:
    """Tells whether tiles that `over` would read are there."""
    if finer > 0:
        return bool(shown) and bool(keys_within(rect.zoomed(-finer).grown(closer.HALO), shown[:1]))
    n = min(-finer, len(shown) - 1)
    return bool(shown) and bool(keys_within(rect.zoomed(-finer - n), shown[n : n + 1]))


def at_level(shown: Shown, up: int, rect: Rect) -> Tiles:
    """Returns the tiles `up` levels above the region's own, those that meet a rectangle of it at least."""
    if up < len(shown):
        return shown[up]
    if not shown or not keys_within(rect.zoomed(up - len(shown) + 1), shown[-1:]):
        return NONE
    level = shown[-1]
    for _ in range(up - len(shown) + 1):
        if not level:  # a pixel that is small against the grid is nothing
            break
        level, _ = coarser(NONE, level, set(level))
    return level


@kernel
def over_tile(
    out: np.ndarray, top: int, left: int, above: np.ndarray, row: int, column: int, height: int, width: int
) -> None:
    """out = above + snap((1 - alpha of above) out) for height x width pixels; `out` (C, h, w), `above` (4, h, w)."""
    for y in range(height):
        alpha = above[3, row + y][column : column + width]
        for c in range(out.shape[0]):
            below = out[c, top + y][left : left + width]
            if c < 4:
                own = above[c, row + y][column : column + width]
                for i in range(width):
                    below[i] = own[i] + snap((_ONE - alpha[i]) * below[i])
            else:
                for i in range(width):
                    below[i] = snap((_ONE - alpha[i]) * below[i])
