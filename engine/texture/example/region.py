"""What is painted with one example: a region of the plane, its sources at every level, and their refinement.

The sources depend on the region, the exemplar and the seed alone, not on how the region came about: painting dab by
dab, in any order, erasing and painting again, all give what painting at once gives.  A region is a value; refining one
gives others, and any of them may be kept.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Generator, Iterator
from concurrent.futures import Executor, Future, wait
from dataclasses import dataclass, replace
from itertools import islice
from threading import Event

import numpy as np

from engine.numeric.address import Rect
from engine.numeric.halving import halved_region
from engine.numeric.hashing import fold_key, hash_plane
from engine.numeric.neighbourhood import RADIUS
from engine.texture.example import correction, narrow, pieces, starts, tiles, told
from engine.texture.example.correction import REACH
from engine.texture.example.exemplar import Exemplar
from engine.texture.example.region_value import Filled as Filled
from engine.texture.example.region_value import Region as Region
from engine.texture.example.region_window import (
    MARGIN,
    OUTSIDE,
    SUBPASSES,
    Example,
    Rules,
    Window,
    WindowPlace,
    window_of,
)
from engine.texture.example.rules import example_of, rules_of
from engine.texture.example.tiles import NONE, Tiles

COARSEST_PASSES = 2  # of the method "correction"
_DOMAIN, _PATCHES = 0x65786D70, 0x70617463  # tell these hashes from those of other textures
_AT_ONCE = 640  # pixels along a window, at most; larger ones are refined in squares of _SQUARE
_SQUARE = 512
_TOGETHER = 1 << 15  # pixels of a window that is refined without a pause
_SLICE = 4096  # pixels between two pauses
_SEARCHING = 32  # times as long as elsewhere a pixel takes at the coarsest level, about
_SHARED = 1 << 17  # pixels of a window that threads refine in parts
_AHEAD = 9  # squares that threads are given, at most: they go on with them where nobody asks for the next step
_PAUSE = 0.004  # seconds between two pauses while threads are at work


Square = tuple[Rect, int]  # and how many pixels around it take part
Filling = tuple[float, Rect, np.ndarray | None]  # the part done, a square, and what it is filled with if it is known


@dataclass(frozen=True, slots=True)
class Step:
    """How far a refinement has come: the region with all levels that are finished, and the part done, 0..1, of the one
    at work."""

    region: Region
    level: int
    done: float


def empty(exemplar: Exemplar, seed: int = 0) -> Region:
    """Makes a region without a pixel, of an example and a seed."""
    count = len(exemplar.levels)
    stored = exemplar.control is not None and exemplar.control.stored > 0
    return Region(exemplar, seed, (NONE,) * count, (Filled(),) * count, (NONE,) * count if stored else ())


def painted(
    region: Region, rect: Rect, mask: np.ndarray, erase: bool = False, values: np.ndarray | None = None
) -> Region:
    """With the pixels of `mask`, bool (h, w) over `rect`, added or erased; nothing is refined.  `values`: uint8 (C, h,
    w), what stored control channels tell of them; None for what they usually tell."""
    if rect.empty or not mask.any():
        return region
    step = 1 << len(region.masks) - 1
    whole = Rect(rect.x0 // step * step, rect.y0 // step * step, -(-rect.x1 // step) * step, -(-rect.y1 // step) * step)
    held = np.zeros((1, whole.height, whole.width), np.uint8)
    tiles.gathered(region.masks[0], whole, held)
    part = held[0][rect.slices(whole)]
    part[mask] = 0 if erase else 1
    masks, insides, place = [], [held[0]], whole
    for n, old in enumerate(region.masks):
        if n:
            place = place.zoomed(-1)
            insides.append(halved_region(insides[-1]))
        masks.append(tiles.laid(old, place, insides[n][None], 0, place))
    if not region.told:
        return replace(region, masks=tuple(masks))
    if values is None:
        assert region.exemplar.control is not None
        usual = np.array(region.exemplar.control.usual, np.uint8)
        values = np.broadcast_to(usual[:, None, None], (len(usual), *mask.shape))
    return replace(region, masks=tuple(masks), told=told.told_laid(region.told, whole, insides, (rect, mask), values))


def refined(region: Region, upto: int = 0, threads: Executor | None = None) -> Region:
    """With the levels down to `upto` as they will stay."""
    for step in refining(region, upto, threads):
        region = step.region
    return region


def refining(region: Region, upto: int = 0, threads: Executor | None = None) -> Iterator[Step]:
    """Yields the steps of a refinement, coarse to fine, some milliseconds each.  Any may be the last that is asked
    for; the levels that its region has are finished, and a later refinement goes on from there."""
    for n in reversed(range(upto, len(region.levels))):
        if region.fresh(n):
            continue
        sources = region.levels[n].sources
        for done, found in _refining_level(region, n, threads):
            sources = found
            yield Step(region, n, done)
        told_there = region.told[n] if region.told else NONE
        seen = region.masks[narrow.seen_level(region, n)]
        level = Filled(region.masks[n], region.above(n), sources, told_there, seen)
        region = replace(region, levels=(*region.levels[:n], level, *region.levels[n + 1 :]))
        yield Step(region, n, 1.0)


def _refining_level(region: Region, n: int, threads: Executor | None) -> Iterator[tuple[float, Tiles]]:
    """Yields the part done, and the sources so far, which hold nothing but finished squares."""
    sources = region.levels[n].sources
    squares = _squares(region, n, threads is not None)
    if threads is None or len(squares) < 2:
        filling = _one_by_one(region, n, squares, threads)
    else:
        filling = _at_once(region, n, squares, threads)
    for done, square, found in filling:
        if found is not None:
            sources = tiles.laid(sources, square, found, OUTSIDE, square)
        yield done, sources
    yield 1.0, sources


def _one_by_one(region: Region, n: int, squares: list[Square], threads: Executor | None) -> Iterator[Filling]:
    for k, (square, room) in enumerate(squares):
        for done, found in _filling(region, n, square, room, threads):
            yield (k + done) / len(squares), square, found


def _at_once(region: Region, n: int, squares: list[Square], threads: Executor) -> Iterator[Filling]:
    """Each square by one thread: none reads what another one makes.  The largest first, so that all end together."""
    over = Event()
    jobs: deque[tuple[Rect, Future[np.ndarray | None]]] = deque()
    left = iter(sorted(squares, key=lambda one: -one[0].area))
    try:
        for k in range(len(squares)):
            for square, room in islice(left, _AHEAD - len(jobs)):
                jobs.append((square, threads.submit(_alone, region, n, square, room, over)))
            square, job = jobs.popleft()
            while not job.done():
                wait([job], _PAUSE)
                yield k / len(squares), square, None
            yield (k + 1) / len(squares), square, job.result()
    finally:  # also where the next step is never asked for
        over.set()
        for _, job in jobs:
            job.cancel()


def _alone(region: Region, n: int, square: Rect, room: int, over: Event) -> np.ndarray | None:
    """Returns what a square is filled with; None if that is over before it is done."""
    filling = _filling(region, n, square, room, None)
    while not over.is_set():
        _, found = next(filling)
        if found is not None:
            return found.copy()  # the window takes much more memory
    return None


def _filling(
    region: Region, n: int, square: Rect, room: int, threads: Executor | None
) -> Iterator[tuple[float, np.ndarray | None]]:
    """Yields the part done after each piece of work, at last with what the square is filled with."""
    window = yield from _readying(region, n, square, room)
    for done in _correcting(region, n, window, room, threads):
        yield done, None
    yield 1.0, _kept(region, n, window, room)


def _kept(region: Region, n: int, window: Window, room: int) -> np.ndarray:
    """Returns the sources of a square, (planes, h, w), of all passes that are kept."""
    return window.planes[0 if _coarsest(region, n) else 1 :, room:-room, room:-room]


def _coarsest(region: Region, n: int) -> bool:
    return n == len(region.levels) - 1


def _passes(region: Region, n: int) -> int:
    if not _coarsest(region, n):
        return region.exemplar.parameters.passes
    return 1 if region.exemplar.seamless else COARSEST_PASSES


def _squares(region: Region, n: int, shared: bool) -> list[Square]:
    """Rectangles that hold all that can change at a level, and how much around each takes part in its refinement; some
    more of them if they are to be shared out."""
    old = region.levels[n]
    altered = tiles.changed_rect(old.mask, region.masks[n], 0)
    altered = altered.union(told.altered(region, n, altered)).union(narrow.newly_narrow(region, n, altered))
    altered = altered.union(tiles.changed_rect(old.above, region.above(n), OUTSIDE).zoomed(1))
    if altered.empty:
        return []
    reach = REACH * _passes(region, n)
    whole = altered.grown(RADIUS + reach)
    if max(whole.width, whole.height) <= _AT_ONCE:
        if shared and whole.area > _SHARED and not _coarsest(region, n):
            return [(part, reach + MARGIN) for part in _quarters(whole)]
        whole = _filled_part(region, n, whole)
        return [] if whole.empty else [(whole, MARGIN)]
    whole = whole.intersect(tiles.hull(old.mask).union(tiles.hull(region.masks[n])))  # beyond it nothing is to be done
    keys, rims = tiles.changed(old.mask, region.masks[n]), told.rim_reach(region, n) + narrow.narrow_reach(region, n)
    near = [tiles.rect_of(key).grown(RADIUS + reach + rims) for key in keys]
    if region.told:
        near += [tiles.rect_of(key).grown(reach) for key in tiles.changed(old.told, region.told[n])]
    if not _coarsest(region, n):
        above = tiles.changed(old.above, region.above(n))
        near += [tiles.rect_of(key).zoomed(1).grown(RADIUS + reach) for key in above]
    found: dict[tuple[int, int], Rect] = {}
    for rect in near:
        for y, x in _square_keys(rect):
            part = Rect.at(x * _SQUARE, y * _SQUARE, _SQUARE, _SQUARE).intersect(rect).intersect(whole)
            found[y, x] = found.get((y, x), Rect(0, 0, 0, 0)).union(part)
    return [(rect, reach + MARGIN) for _, rect in sorted(found.items()) if not rect.empty]


def _quarters(rect: Rect) -> list[Rect]:
    y, x = (rect.y0 + rect.y1) // 2, (rect.x0 + rect.x1) // 2
    rows, columns = ((rect.y0, y), (y, rect.y1)), ((rect.x0, x), (x, rect.x1))
    return [Rect(x0, y0, x1, y1) for y0, y1 in rows for x0, x1 in columns]


def _square_keys(rect: Rect) -> Iterator[tuple[int, int]]:
    for y in range(rect.y0 // _SQUARE, (rect.y1 - 1) // _SQUARE + 1):
        for x in range(rect.x0 // _SQUARE, (rect.x1 - 1) // _SQUARE + 1):
            yield y, x


def _filled_part(region: Region, n: int, square: Rect) -> Rect:
    """Returns the part of a square beyond which there is no region, nor was."""
    y0, y1, x0, x1 = tiles.bounds(region.both_masks(n, square))
    return Rect(square.x0 + x0, square.y0 + y0, square.x0 + x1, square.y0 + y1)


def _readying(region: Region, n: int, square: Rect, room: int) -> Generator[tuple[float, None], None, Window]:
    """Yields a square with `room` pixels around it, ready for its first pass; pauses between pieces of work."""
    old = region.levels[n]
    rect = square.grown(room)
    size = rect.height, rect.width
    mask, was = region.both_masks(n, rect)
    planes = np.full((_passes(region, n) + 1, *size), OUTSIDE, np.int32)
    tiles.gathered(old.sources, rect, planes if _coarsest(region, n) else planes[1:])
    yield 0.0, None
    hashes = hash_plane(fold_key(_DOMAIN, region.seed, n), rect.x0, rect.y0, rect.width, rect.height)
    place = WindowPlace(rect.y0 & 1, rect.x0 & 1, told.told_within(region, n, rect))
    window = window_of(mask, was, planes, hashes, place)
    narrow.widen(region, n, rect, window)
    yield 0.0, None
    if _coarsest(region, n):
        _start_coarsest(region, window, rect)
    else:
        above = rect.zoomed(-1)
        parents, before = np.full((2, 1, above.height, above.width), OUTSIDE, np.int32)
        tiles.gathered_last(region.above(n), above, parents)
        tiles.gathered_last(old.above, above, before)
        starts.start_finer(window, parents[0], before[0], example_of(region.exemplar, n))
    return window


def _start_coarsest(region: Region, window: Window, rect: Rect) -> None:
    exemplar = region.exemplar
    block = exemplar.block
    x, y = rect.x0 // block, rect.y0 // block
    columns, rows = (rect.x1 - 1) // block + 1 - x, (rect.y1 - 1) // block + 1 - y
    key, n = fold_key(_PATCHES, region.seed), len(exemplar.levels) - 1
    offset, example = (rect.y0 - y * block, rect.x0 - x * block), example_of(exemplar, n)
    if exemplar.seamless:
        wanted = pieces.squares_of(window.mask, offset, block, (rows, columns))
        patches = pieces.fitting(key, Rect.at(x, y, columns, rows), exemplar.blocks, block, example, wanted)
    else:
        patches = hash_plane(key, x, y, columns, rows)
    starts.start_coarsest(window, patches, exemplar.blocks, block, offset, example, rules_of(exemplar, n))


def _correcting(region: Region, n: int, window: Window, room: int, threads: Executor | None) -> Iterator[float]:
    """Yields the part done, 0..1, after each piece of work."""
    example, rules = example_of(region.exemplar, n), rules_of(region.exemplar, n)
    passes = len(window.planes) - 1
    heavy = _SEARCHING if _coarsest(region, n) else 1
    for p in range(1, passes + 1):
        beyond = room - RADIUS * SUBPASSES * (passes - p)
        if window.mask.size <= _TOGETHER // heavy:
            correction.correct_all(window, p, beyond, example, rules)
            yield p / passes
            continue
        for done in _sliced_pass(window, p, beyond, example, rules, max(1, _SLICE // heavy), threads):
            yield (p - 1 + done) / passes


def _sliced_pass(
    window: Window, p: int, beyond: int, example: Example, rules: Rules, step: int, threads: Executor | None
) -> Iterator[float]:
    height, width = window.mask.shape
    places = np.empty(window.mask.size // 4 + height + width + 1, np.int32)
    found = np.empty(places.size, np.int32)
    for turn in range(SUBPASSES):
        count = correction.wanted(window, p, turn, beyond, places)
        for last in _corrected(window, places, count, p, example, rules, found, step, threads):
            yield (turn + last / count) / SUBPASSES
        correction.settle(window, places, count, found, p, turn, example)


def _corrected(
    window: Window,
    places: np.ndarray,
    count: int,
    p: int,
    example: Example,
    rules: Rules,
    found: np.ndarray,
    step: int,
    threads: Executor | None,
) -> Iterator[int]:
    """Corrects places[:count] in slices; yields how many are done after each."""
    slices = [(first, min(first + step, count)) for first in range(0, count, step)]
    if threads is None or len(slices) == 1:
        for first, last in slices:
            correction.correct(window, places, first, last, p, example, rules, found)
            yield last
        return
    jobs = [
        threads.submit(correction.correct, window, places, first, last, p, example, rules, found)
        for first, last in slices
    ]
    for (_, last), job in zip(slices, jobs, strict=True):
        job.result()
        yield last
