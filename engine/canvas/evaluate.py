"""Evaluation: the value of any rectangle at any level, from what is stored (features P1, P3).

The work goes down a cascade: the rectangle's ancestors, each half as large plus a pixel around, from the coarsest
stored level, or from the nearest level whose tiles are cached, to the level asked for.  It is a pure function of the
pyramid and the place; the cache only shortens it.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial

import numpy as np

from engine.canvas import kernels
from engine.canvas.attenuate import effective
from engine.canvas.descent import from_afar
from engine.canvas.store import Pyramid, Record
from engine.canvas.tile_cache import Square, TileCache, lies_in, parted, without_empty_inks
from engine.numeric.address import TILE, Rect, TileKey, lies_within
from engine.numeric.column import Column
from engine.numeric.pyramid import expand_into
from engine.texture.planes import COLOURS, Planes, merged, plane_map
from engine.texture.record import Instance

_ALPHA = COLOURS - 1
_CLOSE = 8  # levels above a rectangle that are gone through one by one
_CLIMB = 3  # levels up to what is kept of a coarse level for all that lies below it
_SQUARES = 6  # of these above one another: from there on what is kept is sparser (`from_afar`)
_SQUARE_BYTES = 4 << 20  # of its planes, at most
_LENT = 4  # tiles that the cache holds as parts of one array, at most
_BAND = 64  # rows worked on at a time, so that a band of all planes stays in the cache of the processor
_BAND_BYTES = 9 << 16  # of few planes so many rows more: half of a tile of the screen, also of one beside the grid

# A record, and what it covers of a rectangle: its first row, the one behind its last, its first column and how many
# there are; and the row and the column of its data that lie there first.
_Found = tuple[Record, int, int, int, int, int, int]


def evaluate(pyramid: Pyramid, level: int, rect: Rect, cache: TileCache | None = None) -> Planes:
    """Returns the value of `rect` at `level`: colour clamped in alpha only, ink as it lies there."""
    found = evaluate_sparse(pyramid, level, rect, cache)
    return Planes.empty(rect.height, rect.width) if found is None else found


def shown(pyramid: Pyramid, level: int, rect: Rect) -> np.ndarray | None:
    """Returns colour and alpha of `rect` at `level`, as `evaluate` has them: float32 (4, h, w), None where nothing
    lies.

    Ink that adds no texture down to this level is left out on the way: half the work where there is any.
    """
    bare = pyramid.bare
    start = min(level, 0) if bare is not None and min(level, 0) in bare.values else pyramid.coarsest
    if start is None or level < start:
        return None
    rects = [rect.evened()]
    for _ in range(level - start if bare is not None else min(level - start, _CLOSE)):
        rects.append(rects[-1].parents().evened())
    above = rects[-1]
    if level - start > _CLOSE and bare is None:
        start = level - _CLOSE
        known, value = True, from_afar(pyramid, start, above, None, partial(step, pyramid, finest=level))
    else:
        known, value = _of_ground(pyramid, start, above)
    for k in range(start + known, level + 1):
        inner = rects[level - k]
        value = step(pyramid, value, above, k, inner, level)
        above = inner
    return None if value is None else value.rgba[:, *rect.slices(rects[0])]


def evaluate_sparse(
    pyramid: Pyramid, level: int, rect: Rect, cache: TileCache | None, lent: bool = False, tiled: bool = True
) -> Planes | None:
    """As `evaluate`, but None where nothing lies.  `lent`: the cache holds the same array, nobody writes to it.
    `tiled`: the cache keeps the tiles that lie within."""
    known, value = _known(pyramid, level, rect, cache)
    if known:
        return value
    around, value = _evaluated(pyramid, level, rect, cache, _SQUARES)
    if cache is not None and tiled:
        _keep_tiles(pyramid, level, around, value, cache, lent)
    return None if value is None else value.cut(*rect.slices(around))


def _evaluated(
    pyramid: Pyramid, level: int, rect: Rect, cache: TileCache | None, squares: int
) -> tuple[Rect, Planes | None]:
    """As `evaluate_sparse`, of what is not known; of the smallest even rectangle around it, which is returned with it.
    `squares`: so many may be kept above one another."""
    rects = [rect.evened()]
    above, value = rects[0].parents(), None
    if pyramid.coarsest is None or level < pyramid.coarsest:
        return rects[0], None
    for k in range(level - 1, pyramid.coarsest - 1, -1):
        parents = rects[-1].parents().evened()
        above = parents
        known, value = _known(pyramid, k, parents, cache)
        if known:
            break
        wanted = cache is not None and squares and _climbed(level, k, squares)
        around = _square_at(pyramid, k, parents) if wanted else None
        if cache is not None and around is not None:
            above = around.rect
            known, value = cache.get(pyramid, around)
            if not known:
                if _nothing_below(pyramid, level, Column(rects[0]), cache, squares):
                    return rects[0], None
                value = _square(pyramid, around, cache, squares - 1)
            if _is_empty(pyramid, around, value, parents, rects):
                return rects[0], None
            break
        if level - k >= _CLOSE:
            value = from_afar(pyramid, k, parents, cache, partial(step, pyramid))
            break
        rects.append(parents)
        above = parents.parents()
    for k, inner in zip(range(level - len(rects) + 1, level + 1), reversed(rects), strict=True):
        value = step(pyramid, value, above, k, inner)
        above = inner
    return above, value


def _square_at(pyramid: Pyramid, level: int, rect: Rect) -> Square | None:
    """Returns a square of a level that holds a rectangle; None where it is too large for one, or so much ink lies there
    that none is kept: each stroke would have all of it copied."""
    around = Square.of(level, rect)
    return None if around is None or is_crowded(pyramid, level, around.rect, _SQUARE_BYTES) else around


def is_crowded(pyramid: Pyramid, level: int, rect: Rect, most: int) -> bool:
    """Tells whether so many inks are stored in a rectangle of a level that its planes would take more bytes than
    `most`."""
    found = max((len(record.inks) for _, record in pyramid.records(level, rect)), default=0)
    return 4 * rect.area * (COLOURS + 3 * found) > most


def _climbed(level: int, k: int, squares: int) -> bool:
    """Tells whether squares of level `k` are kept above a rectangle of a level.  Those above squares are kept at some
    levels only: one row of them serves all levels that are looked at."""
    return level - k >= _CLIMB if squares == _SQUARES else level - k >= _CLIMB - 1 and k % _CLIMB == 0


def _nothing_below(pyramid: Pyramid, level: int, column: Column, cache: TileCache, squares: int) -> bool:
    """Tells whether a rectangle lies so far below all that is stored, and has nothing above it there, that nothing is
    in it; False where it is not known."""
    finest = pyramid.finest
    if finest is None or level - finest < _CLIMB:
        return False
    above = column.at(level - finest)
    around = _square_at(pyramid, finest, above)
    return around is not None and _is_empty(pyramid, around, _square(pyramid, around, cache, squares - 1), above)


def _is_empty(
    pyramid: Pyramid, around: Square, value: Planes | None, rect: Rect, below: Sequence[Rect] | None = None
) -> bool:
    """Tells whether nothing is in a rectangle of a square, nor in all that lies below it; `below`: nor in these
    rectangles of the levels below it, the finest first."""
    finest = pyramid.finest
    if value is not None and lies_in(value, *rect.slices(around.rect)):
        return False
    if finest is None or finest <= around.level:
        return True
    levels = enumerate(reversed(below or ()), around.level + 1)
    return below is not None and not any(pyramid.has_records(k, inner) for k, inner in levels)


def _square(pyramid: Pyramid, around: Square, cache: TileCache, squares: int) -> Planes | None:
    """Returns the values of all of it, from the cache or for the cache."""
    known, value = cache.get(pyramid, around)
    if not known:
        known, value = _known(pyramid, around.level, around.rect, cache)
        if not known:
            _, value = _evaluated(pyramid, around.level, around.rect, cache, squares)
        cache.adopt(pyramid, around, value)
    return value


def step(
    pyramid: Pyramid,
    parent: Planes | None,
    parent_at: Rect,
    level: int,
    rect: Rect,
    finest: int | None = None,
    textured: bool = True,
) -> Planes | None:
    """Returns one level down: v of the even `rect` from its parents, which lie at `parent_at`; without the ink that
    adds no texture down to the level `finest`, where that is given, and without what ink adds where not `textured`."""
    records = _found(pyramid, level, rect, finest)
    if parent is None and not records:
        return None
    inks = merged(() if parent is None else parent.inks, *(record.inks for record, *_ in records))
    if finest is not None:
        inks = tuple(ink for ink in inks if ink.base < finest)
    out, unit = np.empty((COLOURS + 3 * len(inks), rect.height, rect.width), np.float32), pyramid.step
    if parent is None:
        out[:] = 0.0
    sources = plane_map(() if parent is None else parent.inks, inks)
    top = (rect.y0 >> 1) - 1 - parent_at.y0
    left = (rect.x0 >> 1) - 1 - parent_at.x0
    laid = [
        (record.data, plane_map(record.inks, inks), y0, y1, x, width, row, column)
        for record, y0, y1, x, width, row, column in records
    ]
    rows = max(_BAND, _BAND_BYTES // (4 * len(out) * rect.width) & ~1)
    for first in range(0, rect.height, rows):
        last = min(first + rows, rect.height)
        if parent is not None:
            expand_into(parent.data, top, left, sources, out, first, last, unit)
        for data, planes, y0, y1, x, width, row, column in laid:
            begin, end = y0 if y0 > first else first, y1 if y1 < last else last
            if begin < end:
                kernels.add_residual(out, begin, x, data, row + begin - y0, column, end - begin, width, planes, unit)
        if textured and inks:
            band = Rect(rect.x0, rect.y0 + first, rect.x1, rect.y0 + last)
            _add_texture_band(out, inks, level, rect, band, unit)
        kernels.clamp_alpha(out, first, last)
    return without_empty_inks(Planes(out, inks))


def _found(pyramid: Pyramid, level: int, rect: Rect, finest: int | None) -> list[_Found]:
    """Returns the records of a level that meet a rectangle, as they are now; `finest`: as `_within` has it."""
    left, top, right, bottom = rect
    found, waits = [], pyramid.waits is not None
    for key, stored in pyramid.records(level, rect):  # of a screen thousands: nothing is called that need not be
        record = effective(pyramid, key, stored) if waits else stored
        if not isinstance(record.held, np.ndarray):
            within = _within(key, record, rect, finest)
            if within is None:
                continue
            record = within
        _, column, row = key
        x0, y0, x1, y1 = record.rect
        x0, y0, x1, y1 = x0 + column * TILE - left, y0 + row * TILE - top, x1 + column * TILE, y1 + row * TILE
        x, y = x0 if x0 > 0 else 0, y0 if y0 > 0 else 0
        width, last = (x1 if x1 < right else right) - left - x, (y1 if y1 < bottom else bottom) - top
        if width > 0 and last > y:
            found.append((record, y, last, x, width, y - y0, x - x0))
    return found


def _within(key: TileKey, record: Record, rect: Rect, finest: int | None) -> Record | None:
    """Returns a record, of one of many inks only the part that lies in a rectangle: most of them do not; `finest`: and
    of these those that add texture down to this level."""
    held = record.sheets
    if held is None:
        return record
    x, y = key.x * TILE, key.y * TILE
    inner = Rect(rect.x0 - x, rect.y0 - y, rect.x1 - x, rect.y1 - y).intersect(record.rect)
    if inner.empty:
        return None
    inks, data = held.within_of(inner, finest)
    data.flags.writeable = False  # as those of other records are: so the kernel is compiled once
    return Record(inner, data, inks, record.depth)


def add_texture(out: np.ndarray, ink: Planes, level: int, rect: Rect, unit: np.float32) -> None:
    """Add to the colour planes of `out` what the ink lying on `rect` adds at this level, on the grid of this step."""
    for first in range(0, rect.height, _BAND):
        last = min(first + _BAND, rect.height)
        band = Rect(rect.x0, rect.y0 + first, rect.x1, rect.y0 + last)
        _add_texture_band(out, ink.inks, level, rect, band, unit, ink.data)


def _add_texture_band(
    out: np.ndarray,
    inks: tuple[Instance, ...],
    level: int,
    rect: Rect,
    band: Rect,
    unit: np.float32,
    ink_planes: np.ndarray | None = None,
) -> None:
    """colour += snap(ink amplitude * bandpass) for every instance (Perlin & Velho 1995, section 5.2)."""
    amplitudes = out if ink_planes is None else ink_planes
    first, last = band.y0 - rect.y0, band.y1 - rect.y0
    for i, ink in enumerate(inks):
        plane = COLOURS + 3 * i
        if level <= ink.base:
            continue
        top, bottom, left, right = kernels.extent_in_rows(amplitudes, plane, plane + 3, first, last)
        if top < bottom:
            detail = ink.bandpass(level, Rect(rect.x0 + left, rect.y0 + top, rect.x0 + right, rect.y0 + bottom))
            if detail is not None:
                onto = out[_ALPHA:] if getattr(ink, "on_alpha", False) else out  # whose other two planes are 0
                part = np.ascontiguousarray(detail, np.float32)
                kernels.add_texture(onto, amplitudes, plane, part, top, left, unit)


def _known(pyramid: Pyramid, level: int, rect: Rect, cache: TileCache | None) -> tuple[bool, Planes | None]:
    """(known, value) of what need not be worked out."""
    known, value = _of_ground(pyramid, level, rect)
    return (known, value) if known else _from_cache(pyramid, level, rect, cache)


def _of_ground(pyramid: Pyramid, level: int, rect: Rect) -> tuple[bool, Planes | None]:
    """Returns the picture that a layer is, where it is nothing else."""
    ground = pyramid.bare
    values = ground.values.get(level) if ground is not None else None
    return (False, None) if values is None else (True, without_empty_inks(Planes(values(rect), ())))


def _from_cache(pyramid: Pyramid, level: int, rect: Rect, cache: TileCache | None) -> tuple[bool, Planes | None]:
    if cache is None:
        return False, None
    tiles, count = [], 0
    for key in rect.tiles(level):
        known, value = cache.view(pyramid, key)
        if not known:
            return False, None
        count += 1
        if value is not None:
            tiles.append((key, value))
    if not tiles:
        return True, None
    inks = merged(*(value.inks for _, value in tiles))
    shape = COLOURS + 3 * len(inks), rect.height, rect.width
    whole = len(tiles) == count and all(value.inks == inks for _, value in tiles)
    out = np.empty(shape, np.float32) if whole else np.zeros(shape, np.float32)
    for key, value in tiles:
        part = key.rect.intersect(rect)
        source = value.data[:, *part.slices(key.rect)]
        target = out[:, *part.slices(rect)]
        if value.inks == inks:
            target[:] = source
        else:
            for c, s in enumerate(plane_map(value.inks, inks)):
                if s >= 0:
                    target[c] = source[s]
    return True, Planes(out, inks)


def _keep_tiles(pyramid: Pyramid, level: int, rect: Rect, value: Planes | None, cache: TileCache, lent: bool) -> None:
    keys = [key for key in rect.tiles(level) if lies_within(key.rect, rect)]
    if value is None or not lent or rect.area != len(keys) * TILE * TILE or len(keys) > _LENT:
        for key in keys:
            cache.keep(pyramid, key, None if value is None else value.cut(*key.rect.slices(rect)))
        return
    for key, part in zip(keys, parted(value, [key.rect.slices(rect) for key in keys]), strict=True):
        cache.lend(pyramid, key, part)
