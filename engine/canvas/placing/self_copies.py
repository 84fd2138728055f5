"""A picture that contains itself several times: followed inwards copy by copy, each piece read straight through all.

A tile is a piece.  Of each copy that its layers show, the part in the tile is a piece in turn, and so on inwards while
the frames are larger than `TILED` pixels: deep in the picture mostly one frame holds all of a piece, so they are few.
Smaller copies are read from tiles of the level where what they show is as small.  These are few, and each is made once:
copies of copies, of which there are ever more, are never told apart.

Where frames lie over one another the pieces double with each turn.  A tile is made of `MOST_PIECES` and `MOST_READS` at
most.  One that needs more ends after as many turns as their number allows, and shows the mean colour of all from there
on.  All of that follows from the tile alone: its pixels are the same whatever else was asked for.
"""

from __future__ import annotations

import functools
from collections.abc import Callable, Generator, Iterator, Sequence
from dataclasses import dataclass
from typing import Generic, NamedTuple, Protocol, TypeVar

import numpy as np

from engine.canvas.placing.placement import Placement
from engine.canvas.placing.sampling import source_level
from engine.canvas.placing.through import UNPLACED, Seen, looked_coarser, set_in
from engine.canvas.placing.unrolled import HIDING
from engine.numeric.address import Rect, TileKey

TILED = 512  # pixels along the largest frame up to which copies are read from tiles of all that a node shows
MOST_PIECES = 4096  # in a tile of a larger one, besides one for each turn
MOST_READS = 256  # pictures of layers, and tiles of small ones, in such a tile
_TURNED_PIECE, _TURNED_READ = 8, 2  # for how many of them one counts that is turned
_MEAN = 8  # pixels along the largest frame, at most, of which the mean colour is taken
_LARGE_KEPT = 64  # tiles of large ones
_PATHS = 1 << 14  # ways inwards that are kept
_CHAINS = 8  # nodes of which they are


class Laid(Protocol):
    """What is asked of a composite's step: whether it is laid over what is below, and how opaque."""

    @property
    def over(self) -> bool:
        """Tells whether the operator is src-over."""

    @property
    def opacity(self) -> np.float32:
        """Gives its opacity, 0..1."""


SourceT = TypeVar("SourceT")  # a source of a step
FoundT = TypeVar("FoundT")  # what was found of all
Above = Sequence[tuple[Laid, object]]  # steps, and their pixels, (4, n), where they are of one source
Asking = Generator[
    tuple[SourceT, "Above | None"], "np.ndarray | None", FoundT
]  # also for what lies above, where that is known


@dataclass(frozen=True)
class Drawing(Generic[SourceT, FoundT]):
    """How the node is drawn whose copies these are.

    `asking`: asks for the pixels of its sources, from the top down; returns what was found.  `copy`: the placement if a
    source is a copy of the node.  `read`: the pixels of one that is none: float32 (4, h, w), None where it is empty.
    `drawn`: what was found composited, likewise, not to be written to.
    """

    asking: Callable[[], Asking[SourceT, FoundT]]
    copy: Callable[[SourceT], Placement | None]
    read: Callable[[SourceT, int, Rect, Seen], np.ndarray | None]
    drawn: Callable[[FoundT, Rect], np.ndarray | None]


class _Path:
    """A way inwards through copies: how what the last of them shows is seen."""

    def __init__(self, seen: Seen, paths: _Paths) -> None:
        self.seen, self.inside, self._paths = seen, seen.unclipped, paths
        self.turned = seen.similarity.quarter is None
        self._inner: dict[Placement, _Path] = {}
        self._bounds: dict[int, Rect] = {}

    def inner(self, copy: Placement) -> _Path:
        found = self._inner.get(copy)
        if found is None:
            found = self._inner[copy] = _Path(self.inside.of(copy), self._paths)
            self._paths.kept += 1
        return found

    def part(self, level: int, rect: Rect) -> Rect:
        """Returns the pixels of a rectangle in which the copy is seen; none where it is too small."""
        found = self._bounds.get(level)
        if found is None:
            gone = self.seen.vanishes(level) or self.seen.own is None
            found = self._bounds[level] = Rect(0, 0, 0, 0) if gone else self.seen.meets(level, self._all(level))
            self._paths.kept += 1
        return rect.intersect(found)

    def _all(self, level: int) -> Rect:
        assert self.seen.own is not None
        return self.seen.own.bounds(level)


class _Paths:
    """The ways inwards of some copies."""

    def __init__(self) -> None:
        self.kept = 0
        self._first = _Path(UNPLACED, self)

    @property
    def first(self) -> _Path:
        """Gives the way through none."""
        if self.kept > _PATHS:
            self.kept, self._first = 0, _Path(UNPLACED, self)
        return self._first


@functools.lru_cache(_CHAINS)
def _paths_of(copies: tuple[Placement, ...]) -> _Paths:
    del copies
    return _Paths()


class _TooManyError(Exception):
    """A tile would need more than it may."""


class _Piece(NamedTuple):
    """A part of a tile that a copy is seen in; what is left of each of its pixels behind what lies above it."""

    path: _Path
    rect: Rect
    left: np.ndarray | None
    turn: int


class Tiles(Generic[SourceT, FoundT]):
    """The tiles of what a node shows, which holds `copies` of itself."""

    def __init__(self, copies: Sequence[Placement], drawing: Drawing[SourceT, FoundT]) -> None:
        self._copies, self._drawing = tuple(copies), drawing
        self._paths = _paths_of(self._copies)
        parts = [one.part for one in copies if one.part is not None]
        self._side = max(max(part.rect.width, part.rect.height).bit_length() - part.level for part in parts)
        self._small: dict[TileKey, np.ndarray | None] = {}
        self._large: dict[TileKey, np.ndarray | None] = {}
        self.pieces = self.reads = self.made = 0

    def picture(self, level: int, rect: Rect) -> np.ndarray | None:
        """Returns what the node shows of a rectangle: float32 (4, h, w), None where it is empty."""
        out: np.ndarray | None = None
        for key in rect.tiles(level):
            pixels = self._tile(key)
            if pixels is not None:
                out = np.zeros((4, rect.height, rect.width), np.float32) if out is None else out
                part = key.rect.intersect(rect)
                out[:, *part.slices(rect)] = pixels[:, *part.slices(key.rect)]
        return out

    def _is_small(self, level: int) -> bool:
        return level + self._side <= TILED.bit_length() - 1

    def _tile(self, key: TileKey) -> np.ndarray | None:
        held = self._small if self._is_small(key.level) else self._large
        if key not in held:
            made = self._make(key)
            while held is self._large and len(held) >= _LARGE_KEPT:
                del held[next(iter(held))]
            held[key] = None if made is None else made.copy()
            self.made += 1
        return held[key]

    def _make(self, key: TileKey) -> np.ndarray | None:
        whole = _Piece(self._paths.first, key.rect, None, 0)
        try:
            return _Work(self, self._drawing, key.level, None).drawn(whole)
        except _TooManyError:
            return _Work(self, self._drawing, key.level, self._turns(key)).drawn(whole)

    def _turns(self, key: TileKey) -> int:
        """Returns how many turns of copies there are pieces enough for in a tile."""
        edge, count, turns = [(self._paths.first, key.rect)], 0, 0
        while edge:
            edge = list(self._next(edge, key.level))
            count += sum(_TURNED_READ if path.turned else 1 for path, _ in edge)
            if count > MOST_READS:
                break
            turns += 1
        return turns

    def _next(self, edge: list[tuple[_Path, Rect]], level: int) -> Iterator[tuple[_Path, Rect]]:
        for path, rect in edge:
            for copy in self._copies:
                inner = path.inner(copy)
                part = inner.part(level, rect)
                if not part.empty:
                    yield inner, part

    def is_read(self, seen: Seen, level: int) -> bool:
        """Tells whether what is seen so is read from tiles."""
        return self._is_small(source_level(seen.similarity, level))

    def mean(self, rect: Rect) -> np.ndarray | None:
        """Returns pixels of the mean colour of all that copies show."""
        return None if self._mean is None else np.broadcast_to(self._mean, (4, rect.height, rect.width))

    @functools.cached_property
    def _mean(self) -> np.ndarray | None:
        level = _MEAN.bit_length() - 1 - self._side
        part = self._copies[0].part
        assert part is not None
        found = self.picture(level, part.rect.zoomed(level - part.level))
        return None if found is None else found.mean(axis=(1, 2), dtype=np.float64).astype(np.float32)[:, None, None]


class _Work(Generic[SourceT, FoundT]):
    """The making of one tile, its pieces in one another: there may be thousands, too many for calls in calls.

    `most`: turns after which only the mean colour is shown; None: all are wanted.
    """

    def __init__(
        self, tiles: Tiles[SourceT, FoundT], drawing: Drawing[SourceT, FoundT], level: int, most: int | None
    ) -> None:
        self._tiles, self._drawing, self._level, self._most = tiles, drawing, level, most
        self._pieces = self._reads = self._deepest = 0

    def drawn(self, piece: _Piece) -> np.ndarray | None:
        """Returns the pixels of a piece: float32 (4, h, w), None where it is empty."""
        waiting = [self._drawing_of(piece)]
        pixels: np.ndarray | None = None
        while waiting:
            try:
                inner = waiting[-1].send(pixels)
            except StopIteration as done:
                waiting.pop()
                pixels = done.value
            else:
                waiting.append(self._drawing_of(inner))
                pixels = None
        return pixels

    def _drawing_of(self, piece: _Piece) -> Generator[_Piece, np.ndarray | None, np.ndarray | None]:
        """Asks for the pieces within one, and returns its pixels."""
        path, rect, _, turn = piece
        self._count_piece(piece)
        if turn and turn == self._most:
            return self._cut(piece, self._tiles.mean(rect))
        asking = self._drawing.asking()
        pixels: np.ndarray | None = None
        while True:
            try:
                source, above = asking.send(pixels)
            except StopIteration as done:
                return self._cut(piece, self._drawing.drawn(done.value, rect))
            copy = self._drawing.copy(source)
            if copy is None:
                pixels = self._drawing.read(source, self._level, rect, path.inside)
                self._count_reads(path, pixels is not None)
                continue
            inner, pixels = path.inner(copy), None
            part = inner.part(self._level, rect)
            if part.empty:
                continue
            left = _left(piece, above)
            if left is not None:
                left = left[part.slices(rect)]
                if (left < 1 - HIDING).all():
                    continue
            if self._tiles.is_read(inner.seen, self._level):
                pixels = looked_coarser(self._tiles.picture, self._level, part, inner.seen)
                self._count_reads(inner, 1)
            else:
                pixels = yield _Piece(inner, part, left, turn + 1)
            pixels = None if pixels is None else set_in(pixels, part, rect)

    def _count_piece(self, piece: _Piece) -> None:
        weight = _TURNED_PIECE if piece.path.turned else 1
        self._tiles.pieces += 1
        if piece.turn > self._deepest:
            self._deepest = piece.turn
            return
        self._pieces += weight
        if self._most is None and self._pieces > MOST_PIECES:
            raise _TooManyError

    def _count_reads(self, path: _Path, count: int) -> None:
        self._tiles.reads += count
        self._reads += count * (_TURNED_READ if path.turned else 1)
        if self._most is None and self._reads > MOST_READS:
            raise _TooManyError

    def _cut(self, piece: _Piece, pixels: np.ndarray | None) -> np.ndarray | None:
        seen = piece.path.seen
        return pixels if pixels is None or not seen.clips else seen.clipped(pixels, self._level, piece.rect, piece.rect)


def _left(piece: _Piece, above: Above | None) -> np.ndarray | None:
    """Returns how much of each pixel is left behind what lies above in a piece and before it, float32 (h, w); None:
    all of it, or it is not known."""
    if above is None or not all(step.over for step, _ in above):
        return None
    left = piece.left
    for step, pixels in above:
        if isinstance(pixels, np.ndarray):
            shown = np.float32(1) - step.opacity * pixels[3].reshape(piece.rect.height, piece.rect.width)
            left = shown if left is None else left * shown
    return left
