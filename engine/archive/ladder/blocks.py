"""The pixels of a ladder's blocks, and the loop that makes many of them on all cores."""

from __future__ import annotations

import os
import threading
from collections import deque
from collections.abc import Callable, Generator, Iterable, Iterator
from concurrent.futures import Future, ThreadPoolExecutor
from dataclasses import dataclass, field
from typing import TypeVar

import numpy as np

from engine.archive.ladder.rungs import Block, Ladder
from engine.canvas import layers
from engine.canvas.layers import Group
from engine.canvas.reading import Read
from engine.numeric.address import Rect
from engine.numeric.colour import to_rgba8, to_rgba16
from engine.painting.lighting import Lighting, needed, pictured
from engine.painting.rendering import HELD, Stop, check_cancelled, keeping, piece_reader

AHEAD = 3  # blocks of each thread that are begun before the first of them is asked for
_COLUMNS, _ROWS = 1024, 512  # of the pieces in which layers are evaluated
_LITTLE = 64  # pixels along a side

_Made = TypeVar("_Made")


@dataclass(frozen=True, eq=False, slots=True)
class Source:
    """Where pixels come from: layers with nothing pending, the ladder that is made of them, and the light on them."""

    root: Group
    ladder: Ladder
    lighting: Lighting | None = None
    elsewhere: Read = field(default_factory=keeping)  # what placements show

    def prepare(self) -> None:
        """Has the kernels compiled, or loaded: by the coarsest rung, and a little of the finest."""
        for rung in (self.ladder.rungs[-1], self.ladder.rungs[0]):
            width, height = rung.size
            middle = Rect.at(width // 2, height // 2, _LITTLE, _LITTLE)
            self.pixels(rung.step, middle.intersect(Rect(0, 0, width, height)))

    def pixels(self, rung: int, rect: Rect, cancelled: Stop = None) -> np.ndarray:
        """Returns straight RGBA (h, w, 4) of a rectangle of a rung, counted from its corner."""
        place = self.ladder.rungs[rung]
        area = Rect.at(place.rect.x0 + rect.x0, place.rect.y0 + rect.y0, rect.width, rect.height)
        convert, kind = (to_rgba8, np.uint8) if self.ladder.depth == 8 else (to_rgba16, np.uint16)
        out = np.empty((rect.height, rect.width, 4), kind)
        for piece in _pieces(area, sum(1 for _ in layers.layers(self.root))):
            check_cancelled(cancelled)
            read = piece_reader(place.level, needed(piece, self.lighting), placed=self.elsewhere)
            out[piece.slices(area)] = convert(pictured(self.root, place.level, piece, read, self.lighting))
        return out


def _pieces(area: Rect, count: int) -> Iterator[Rect]:
    """Yields what is evaluated at a time of so many layers: large enough that what it has in common with its
    neighbours, the coarser levels around it, counts little."""
    columns = max(128, _COLUMNS * HELD // max(HELD, count))
    for y in range(area.y0, area.y1, _ROWS):
        for x in range(area.x0, area.x1, columns):
            yield Rect.at(x, y, columns, _ROWS).intersect(area)


def in_order(
    blocks: Iterable[Block], work: Callable[[Block, Stop], _Made], cancelled: Stop = None
) -> Generator[tuple[Block, _Made], None, None]:
    """Yields every block with what `work` makes of it, in order; on all cores, a few blocks ahead.

    `work` gets what tells whether to stop.  Whatever is raised, no work goes on afterwards.
    """
    threads = os.cpu_count() or 1
    ended = threading.Event()

    def stopped() -> bool:
        return ended.is_set() or (cancelled is not None and cancelled())

    waiting: deque[tuple[Block, Future[_Made]]] = deque()
    with ThreadPoolExecutor(threads, "inkfall export") as pool:
        try:
            for block in blocks:
                waiting.append((block, pool.submit(work, block, stopped)))
                if len(waiting) >= AHEAD * threads:
                    yield _first(waiting, cancelled)
            while waiting:
                yield _first(waiting, cancelled)
        finally:
            ended.set()
            pool.shutdown(wait=True, cancel_futures=True)


def _first(waiting: deque[tuple[Block, Future[_Made]]], cancelled: Stop) -> tuple[Block, _Made]:
    check_cancelled(cancelled)
    block, future = waiting.popleft()
    return block, future.result()
