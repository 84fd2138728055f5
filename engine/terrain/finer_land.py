"""The last picture at rest: land finer than its pixels where it is seen, part by part of the picture.

Colours are those of the windows that the picture was made with before; only the land is finer.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, replace

import numpy as np

from engine.files.fault import Cancelled
from engine.keeping.giving_way import give_way
from engine.numeric.address import Rect
from engine.terrain import daylight
from engine.terrain.camera import Windows, resampled
from engine.terrain.caster import CELLS_PER_PIXEL, maxima
from engine.terrain.height_window import FINEST_TOLD, in_pixels
from engine.terrain.land_bound import Remainder
from engine.terrain.land_picture import Shot, developed, eye_of, numbers_of
from engine.terrain.plane import DEEP, Land
from engine.terrain.seen_parts import (
    LAID_SIDE,
    PART_WINDOWS,
    Fine,
    Grid,
    LandPart,
    SeenLand,
    grid_of,
    parts_of,
    seen_by,
)

FINE_CELLS = 8.4  # of a window to a pixel, at most; 3.3 at least
_THREADS = 2
_ONE_BY_ONE = 64  # pixels of a part
_ROWS_A_TASK = 8  # of pixels that are worked out at a time
_ROWS_LAID = 128  # of a window, likewise


@dataclass(slots=True)
class _Sum:
    """Of the errors of what is seen, pixels; `known`: whether all are."""

    hard: float = 0.0
    squares: float = 0.0
    pixels: int = 0
    known: bool = True


def roomy(windows: Windows) -> Windows:
    """Returns windows with room for those of a part behind them: the same arrays where these have that `room`."""
    count = len(windows.levels)

    def whole(array: np.ndarray) -> np.ndarray:
        if isinstance(array.base, np.ndarray) and len(array.base) == count + PART_WINDOWS:
            return array.base
        made = np.empty((count + PART_WINDOWS, *array.shape[1:]), array.dtype)
        made[:count] = array
        return made

    return replace(
        windows,
        heights=whole(windows.heights),
        tops=whole(windows.tops),
        colours=whole(windows.colours),
        places=whole(windows.places),
    )


class FinerPicture:
    """`land`, `shot`: of the picture `before`, uint8 (h, w, 3), which was made with the `windows` and has an `error`;
    `wide`: the frame's width; `cancelled` is asked every some milliseconds: Cancelled if it says so."""

    def __init__(
        self, land: Land, windows: Windows, shot: Shot, wide: float, cancelled: Callable[[], bool] | None = None
    ) -> None:
        self._land, self._shot, self._wide, self._cancelled = land, shot, wide, cancelled
        self._windows, self._count = windows, len(windows.levels)
        self._eye = eye_of(windows, shot, 1)
        self._pixel = 2.0 * math.tan(math.radians(shot.camera.fov) / 2) / shot.size[0]
        self._light = np.zeros((shot.size[1], shot.size[0], 3), np.float32)
        self._error = _Sum()

    def over(self, before: np.ndarray, error: Remainder | None) -> tuple[np.ndarray, Remainder | None]:
        """Returns the picture, and by how many pixels land lies elsewhere in it."""
        windows, shot, out = self._windows, self._shot, before.copy()
        bare = self._first(self._count)
        seen = seen_by(bare, self._eye, shot.size, self._pixel, FINE_CELLS)
        with ThreadPoolExecutor(_THREADS, "inkfall land", give_way) as pool:
            for part in parts_of(seen, shot.camera, windows.levels[-1], shot.size, bare.heights.shape[1] - 1):
                self._part(pool, part, seen, error)
                box = part.box
                there = slice(box.y0, box.y1), slice(box.x0, box.x1)
                out[there] = developed(self._light[there], shot.samples)
        found = self._error
        if not found.known or not found.pixels:
            return out, None
        return out, Remainder(found.hard, math.sqrt(found.squares / found.pixels))

    def _first(self, count: int) -> Windows:
        w = self._windows
        return replace(
            w, heights=w.heights[:count], tops=w.tops[:count], colours=w.colours[:count], places=w.places[:count]
        )

    def _asks(self) -> None:
        if self._cancelled is not None and self._cancelled():
            raise Cancelled

    def _part(self, pool: ThreadPoolExecutor, part: LandPart, seen: SeenLand, error: Remainder | None) -> None:
        windows = self._windows
        fine = [one for one in part.windows if self._told(windows.levels[-1] - one.k)]
        rows, columns = seen.within(part.box)
        k = seen.k[rows, columns]
        left = seen.away[rows, columns] > 0.0
        for n, one in enumerate(fine):
            grid = grid_of(self._shot.camera, windows.levels[-1], one.k)
            laid = self._lay(pool, one, grid, self._count + n)
            there = k == one.k
            i, j = grid.cells(seen.x[rows, columns][there], seen.y[rows, columns][there])
            left[there] = ~self._count_in(one, laid, (i, j), seen.away[rows, columns][there])
        if error is None:
            self._error.known = False
        elif left.any():
            self._count_left(seen, (rows, columns), left, error)
        self._draw(pool, part.box, self._first(self._count + len(fine)))

    def _told(self, level: int) -> bool:
        """Tells whether heights of a level are told from the same as those of the other windows."""
        about = self._windows.about
        return level <= DEEP if about is None else about.level <= level <= FINEST_TOLD

    def _lay(self, pool: ThreadPoolExecutor, one: Fine, grid: Grid, w: int) -> list[tuple[Rect, Remainder | None]]:
        """Lays a window behind the others; returns what of it was made, with the bound of each."""
        windows = self._windows
        n = windows.heights.shape[1]
        place = grid.place(one.left, one.top)
        windows.places[w] = place
        heights, colours = windows.heights[w], windows.colours[w]
        around = self._under(place, n - 1, 0.0)
        rows, columns = self._samples(place, (0, n), around), self._samples(place, (0, n), around, 0)
        ratio = grid.side / windows.places[around, 2]
        near = [np.clip(np.rint(at), 0, n - 1).astype(np.int64) for at in (rows, columns)]
        for some in (slice(y, y + _ROWS_LAID) for y in range(0, n, _ROWS_LAID)):
            heights[some] = resampled(windows.heights[around], rows[some], columns) / np.float32(ratio)
            colours[some] = windows.colours[around][np.ix_(near[0][some], near[1])]
        runs = list(_laid_runs(one.made))

        def work(run: Rect) -> tuple[Rect, Remainder | None]:
            self._asks()
            rect = Rect(run.x0, run.y0, min(run.x1 + 1, n), min(run.y1 + 1, n))
            return run, self._made(one, grid, rect, place, (heights, colours))

        done = list(pool.map(work, runs))
        windows.tops[w] = maxima(heights)
        return done

    def _made(
        self,
        one: Fine,
        grid: Grid,
        rect: Rect,
        place: tuple[float, float, float],
        into: tuple[np.ndarray, np.ndarray],
    ) -> Remainder | None:
        """Works out samples of a window; returns the bound of the land there, pixels of level 0."""
        windows = self._windows
        there = slice(rect.y0, rect.y1), slice(rect.x0, rect.x1)
        x, y = grid.x + one.left + rect.x0, grid.y + one.top + rect.y0
        area = Rect.at(x, y, rect.width, rect.height)
        told = self._land.height(grid.level, area, windows.about)
        if windows.sea > -math.inf:
            told = np.maximum(told, 0.0)
        into[0][there] = in_pixels(told - windows.base, grid.level).astype(np.float32)
        corner = place[0] + rect.x0 * place[2], place[1] + rect.y0 * place[2], place[2]
        under = self._under(corner, max(rect.width, rect.height), FINE_CELLS / (2.5 * CELLS_PER_PIXEL))
        rows = self._samples(place, (rect.y0, rect.y1), under)
        columns = self._samples(place, (rect.x0, rect.x1), under, 0)
        near = [slice(max(0, int(at[0])), int(max(0.0, at[-1])) + 2) for at in (rows, columns)]
        painted = windows.colours[under][near[0], near[1]].astype(np.float32)
        into[1][there] = np.rint(resampled(painted, rows - near[0].start, columns - near[1].start))
        return self._land.bound(grid.level, area)

    def _under(self, place: tuple[float, float, float], cells: int, wider: float) -> int:
        """Returns the finest of the first windows that holds a square, with cells at least `wider` times as wide."""
        places, n = self._windows.places, self._windows.heights.shape[1] - 1
        for w in range(self._count - 1, 0, -1):
            side = places[w, 2]
            ends = (places[w, axis] <= place[axis] <= places[w, axis] + n * side - cells * place[2] for axis in (0, 1))
            inside = all(ends)
            if inside and side >= wider * place[2]:
                return w
        return 0

    def _samples(self, place: tuple[float, float, float], ends: tuple[int, int], w: int, axis: int = 1) -> np.ndarray:
        """Returns where samples of a window lie in another one, along an axis."""
        other = self._windows.places[w]
        found: np.ndarray = (place[axis] - other[axis] + np.arange(*ends) * place[2]) / other[2]
        return found

    def _count_in(
        self,
        one: Fine,
        laid: list[tuple[Rect, Remainder | None]],
        at: tuple[np.ndarray, np.ndarray],
        away: np.ndarray,
    ) -> np.ndarray:
        """Adds the errors of pixels whose land lies in cells of a window; returns which of them are counted."""
        n = len(one.made)
        by = math.ldexp(1.0, self._windows.levels[-1]) / (away * self._pixel)
        column, row = (at[0] - one.left) // LAID_SIDE, (at[1] - one.top) // LAID_SIDE
        inside: np.ndarray = (column >= 0) & (column < n) & (row >= 0) & (row < n)
        found = self._error
        for run, bound in laid:
            here = (
                inside & (row == run.y0 // LAID_SIDE) & (column >= run.x0 // LAID_SIDE) & (column < run.x1 // LAID_SIDE)
            )
            if not here.any():
                continue
            if bound is None:
                found.known = False
                continue
            scale = by[here]
            found.hard = max(found.hard, bound.hard * float(scale.max()))
            found.squares += float(((bound.rms * scale) ** 2).sum())
            found.pixels += len(scale)
        return inside

    def _count_left(self, seen: SeenLand, part: tuple[slice, slice], left: np.ndarray, error: Remainder) -> None:
        """Adds the errors of pixels whose land lies in no window of their part: what is around each in the first
        ones; where these are many, of all the picture before."""
        windows, found = self._windows, self._error
        bounds: list[Remainder | None] = [error] * int(left.sum())
        if len(bounds) <= _ONE_BY_ONE:
            places = zip(*(at[part][left].tolist() for at in (seen.x, seen.y, seen.away)), strict=True)
            bounds = [self._bound_at(windows, x, y, away) for x, y, away in places]
        for bound in bounds:
            if bound is None:
                found.known = False
                continue
            found.hard, found.squares = max(found.hard, bound.hard), found.squares + bound.rms**2
            found.pixels += 1

    def _bound_at(self, windows: Windows, x: float, y: float, away: float) -> Remainder | None:
        """Returns the bound, pixels of the picture, of what is seen at a place in the first windows."""
        side = 1.2 * away * self._pixel / CELLS_PER_PIXEL
        w = self._under((x - side, y - side, side), 2, 1.0)
        k = round(math.log2(windows.places[w, 2]))
        grid = grid_of(self._shot.camera, windows.levels[-1], k)
        i, j = (int(at[0]) for at in grid.cells(np.array([x]), np.array([y])))
        bound = self._land.bound(grid.level, Rect.at(grid.x + i - 1, grid.y + j - 1, 4, 4))
        by = math.ldexp(1.0, windows.levels[-1]) / (away * self._pixel)
        return None if bound is None else Remainder(bound.hard * by, bound.rms * by)

    def _draw(self, pool: ThreadPoolExecutor, box: Rect, windows: Windows) -> None:
        shot = self._shot
        numbers = numbers_of(windows, shot, self._wide, (0, shot.samples), FINE_CELLS)
        tables = windows.heights, windows.tops, windows.mips, windows.places, windows.colours

        def work(top: int) -> None:
            self._asks()
            place = np.array([box.x0, top, box.x1, min(top + _ROWS_A_TASK, box.y1)])
            daylight.picture_block(*tables, self._eye, numbers, place, self._light)

        for _ in pool.map(work, range(box.y0, box.y1, _ROWS_A_TASK)):
            pass


def _laid_runs(made: np.ndarray) -> list[Rect]:
    """Returns blocks that lie side by side in a row, as rectangles of cells."""
    found = []
    for row, line in enumerate(made):
        steps = np.flatnonzero(np.diff(np.concatenate([[False], line, [False]]).astype(np.int8)))
        for first, end in zip(steps[::2].tolist(), steps[1::2].tolist(), strict=True):
            found.append(Rect(first * LAID_SIDE, row * LAID_SIDE, end * LAID_SIDE, (row + 1) * LAID_SIDE))
    return found
