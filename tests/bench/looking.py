"""Four layers of 4000 x 4000 looked at, as the window does, without the window: processor time of the engine's thread.

Against a copy of what the tiles of the screen hold of all layers, which is the least that compositing moves, and, for
pictures of whole layers, against MyPaint: its figures of another run, as much longer as copying takes now.
"""

from __future__ import annotations

import time
from collections.abc import Iterator, Sequence
from statistics import median

from app.canvas.screen import cells
from app.canvas.view import Place, View, place_of_pixel
from bench import Figure
from bench.clock import best, copying, slowness
from bench.files import LAYERS, SIDE, photographs, strokes
from engine.keeping import collecting
from engine.session.apply import Painting
from engine.session.session import Session
from engine.studio.requests import SCREEN_TILE, Look
from engine.studio.studio import Studio

WIDTH, HEIGHT = 1920, 1080
REPEATS = 4
ZOOMS = {0: "1", -1: "1/2", 1: "2"}  # by level
MYPAINT = {0: (0.136, 4.0), -1: (0.229, 4.0), 1: (0.033, 2.0)}  # seconds; times faster
COLD, COLUMN = 0.100, 0.015  # seconds of painted strokes, at most
LEVELS, SHOWN_WIDTH, SHOWN_HEIGHT = 40, 1280, 800  # of a zoom
SHOWN, SLOWEST = 0.060, 0.120  # seconds of a level
ROCKY = 2160, 968  # pixel of level 0 where rock lies in both layers that have any
Size = tuple[int, int]
Tiles = Sequence[tuple[int, int, int]]


def measure(small: bool = False) -> Iterator[Figure]:
    side, repeats, size = (200, 1, (256, 256)) if small else (SIDE, REPEATS, (WIDTH, HEIGHT))
    slow = slowness(2 if small else 25)
    for level, times in _looked_at(photographs(side), side, size, repeats).items():
        theirs, faster = MYPAINT[level]
        theirs *= slow
        note = f"its figure of another run, as copying takes {slow:.2f} x as long; {_moved(level, side, size)}"
        name, bound = f"photographs, zoom {ZOOMS[level]}, cold", f"MyPaint's {theirs * 1e3:.0f} ms"
        yield Figure(name, times[0] * 1e3, "ms", bound, theirs / times[0], faster, True, note)
    painting = strokes(side)
    for level, times in _looked_at(painting, side, size, repeats).items():
        for what, taken, most in (("cold", times[0], COLD), ("a column panned", times[1], COLUMN)):
            name, note = f"strokes with rock, zoom {ZOOMS[level]}, {what}", _moved(level, side, size)
            yield Figure(name, taken * 1e3, "ms", f"{most * 1e3:.0f} ms", taken / most, 1.0, note=note)
    yield from _zoomed(painting, 2 if small else LEVELS)


def _moved(level: int, side: int, size: Size) -> str:
    count = len(_seen(level, side, size, 0))
    moved = count * SCREEN_TILE**2 * 4 * (4 * LAYERS + 1)
    return (
        f"copying the {moved >> 20} MiB that its {count} tiles hold takes {best(3, copying(2 * moved))[0] * 1e3:.0f} ms"
    )


def _seen(level: int, side: int, size: Size, right: int) -> Tiles:
    """The tiles of a view of the middle, so many pixels to the right."""
    view = View(place_of_pixel(0, side // 2, side // 2), level, 0.0, *size)
    x, y = view.centre.pixel(level)
    return cells(View(place_of_pixel(level, x + right, y), level, 0.0, *size), level)


def _looked_at(painting: Painting, side: int, size: Size, repeats: int) -> dict[int, tuple[float, float]]:
    """By level: seconds for all tiles from nothing, and for those that come in when the view moves by a tile."""
    found = {}
    for level in ZOOMS:
        first, then = (_seen(level, side, size, right) for right in (0, SCREEN_TILE))
        looks = (first, [tile for tile in then if tile not in first])
        times = [_times(painting, looks) for _ in range(repeats)]
        found[level] = min(cold for cold, _ in times), min(column for _, column in times)
    return found


def _zoomed(painting: Painting, levels: int) -> Iterator[Figure]:
    place = place_of_pixel(0, *ROCKY)
    times = _times(painting, [_of_level(place, level) for level in range(levels + 1)])[1:]
    for what, taken, most in (("median", median(times), SHOWN), ("slowest", max(times), SLOWEST)):
        bound = f"{most * 1e3:.0f} ms"
        yield Figure(f"a level of a zoom, {what} of {levels}", taken * 1e3, "ms", bound, taken / most, 1.0)


def _of_level(place: Place, level: int) -> Tiles:
    return cells(View(place, level, 0.0, SHOWN_WIDTH, SHOWN_HEIGHT), level)


def _times(painting: Painting, looks: Sequence[Tiles]) -> list[float]:
    """Seconds of the processor for each of some looks, one after the other, the first from nothing."""
    studio = Studio(lambda result: None, lambda request: None)
    studio.easel.show(Session(painting), None)
    collecting.pass_over()  # as the window's engine does when it begins: the interpreter looks through none of it
    times = []
    for tiles in looks:
        start = time.thread_time()
        studio.look(Look(tuple((*tile, -1) for tile in tiles)))
        while studio.step():
            pass
        times.append(time.thread_time() - start)
    studio.close()
    return times
