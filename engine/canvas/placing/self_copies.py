"""A picture that contains itself several times: followed inwards copy by copy, each piece read straight through all.

So are several that show one another, as long as one gets round.  A tile of one is a piece.  Of each copy that its
layers show, the part in the tile is a piece in turn, and so on inwards while the frames are larger than `TILED` pixels:
deep in the picture mostly one frame holds all of a piece, so they are few.
Smaller copies are read from tiles of the level where what they show is as small.  These are few, and each is made once:
copies of copies, of which there are ever more, are never told apart.

Where frames lie over one another the pieces double with each turn.  A tile is made of `MOST_PIECES` and `MOST_READS` at
most.  One that needs more ends after as many turns as their number allows, and shows the mean colour of all from there
on.  All of that follows from the tile alone: its pixels are the same whatever else was asked for.

With `portions` a tile is made some steps at a time; meanwhile one of few turns is shown.
"""

from __future__ import annotations

import functools
import itertools
import threading
from collections.abc import Callable, Generator, Iterator
from typing import Generic, NamedTuple, cast

import numpy as np

from engine.canvas.placing.drawn_copies import Above, Copies, Drawing, FoundT, Shown, SourceT
from engine.canvas.placing.placement import Placement
from engine.canvas.placing.portions import Portions, Work, run_through
from engine.canvas.placing.sampling import Picture, source_level
from engine.canvas.placing.through import UNPLACED, Seen, looked_coarser, set_in
from engine.canvas.placing.unrolled import HIDING
from engine.numeric.address import Rect, TileKey

TILED = 512  # pixels along the largest frame up to which copies are read from tiles of all that a node shows
MOST_PIECES = 4096  # in a tile of a larger one, besides one for each turn
MOST_READS = 256  # pictures of layers, and tiles of small ones, in such a tile
_TURNED_PIECE, _TURNED_READ = 8, 2  # for how many of them one counts that is turned
_STEP = 8  # pieces that are made at a time, of which nothing is read
_MEAN = 8  # pixels along the largest frame, at most, of which the mean colour is taken
_LARGE_KEPT = 64  # tiles of large ones
_PATHS = 1 << 14  # ways inwards that are kept
_CHAINS = 8  # nodes of which they are


class _Path:
    """A way inwards through copies: how the node that the last of them shows is seen."""

    def __init__(self, node: Shown, seen: Seen, paths: _Paths) -> None:
        self.node, self.seen, self.inside, self._paths = node, seen, seen.unclipped, paths
        self.turned = seen.similarity.quarter is None
        self._inner: dict[Placement, _Path] = {}
        self._bounds: dict[int, Rect] = {}

    def inner(self, copy: Placement) -> _Path:
        found = self._inner.get(copy)
        if found is None:
            found = self._inner[copy] = _Path(copy.of, self.inside.of(copy), self._paths)
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
        self._first: dict[Shown, _Path] = {}

    def first(self, node: Shown) -> _Path:
        """Returns the way to a node through none."""
        if self.kept > _PATHS:
            self.kept, self._first = 0, {}
        found = self._first.get(node)
        if found is None:
            found = self._first[node] = _Path(node, UNPLACED, self)
        return found


@functools.lru_cache(_CHAINS)
def _paths_of(copies: tuple[tuple[Shown, tuple[Placement, ...]], ...]) -> _Paths:
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


class _MissingError(Exception):
    """A tile has to be made first."""

    def __init__(self, wanted: _Wanted) -> None:
        super().__init__(wanted)
        self.wanted = wanted


class _Wanted(NamedTuple):
    """A tile of what a node shows."""

    node: Shown
    key: TileKey


_Making = Generator["_Wanted | None", None, "np.ndarray | None"]  # asks for tiles to be made first; None after a step


class Tiles(Generic[SourceT, FoundT]):
    """The tiles of what some nodes show that hold `copies` of one another, or of themselves.  Safe for several
    threads.  `portions`: where those are gone on with that are not made at once; None: all are."""

    def __init__(self, copies: Copies, drawing: Drawing[SourceT, FoundT], portions: Portions | None = None) -> None:
        self.copies, self._drawing, self._portions = copies, drawing, portions
        self._paths = _paths_of(tuple((node, tuple(held)) for node, held in copies.items()))
        self._sides = {node: max(map(_side, held)) for node, held in copies.items()}
        self._means: dict[Shown, np.ndarray | None] = {}
        self._small: dict[_Wanted, np.ndarray | None] = {}
        self._large: dict[_Wanted, np.ndarray | None] = {}
        self._lock = threading.RLock()
        self.pieces = self.reads = self.made = 0

    def of(self, node: Shown) -> Picture:
        """Returns what a node shows, as a picture."""
        return functools.partial(self.picture, node)

    def picture(self, node: Shown, level: int, rect: Rect) -> np.ndarray | None:
        """Returns what a node shows of a rectangle, by now: float32 (4, h, w), None where it is empty."""
        with self._lock:
            return self._picture(node, level, rect, self._tile)

    def small(self, node: Shown, level: int, rect: Rect) -> np.ndarray | None:
        """As `picture`, of tiles that are there; else _MissingError."""
        return self._picture(node, level, rect, self._known)

    def _picture(
        self, node: Shown, level: int, rect: Rect, tile: Callable[[_Wanted], np.ndarray | None]
    ) -> np.ndarray | None:
        out: np.ndarray | None = None
        for key in rect.tiles(level):
            pixels = tile(_Wanted(node, key))
            if pixels is not None:
                out = np.zeros((4, rect.height, rect.width), np.float32) if out is None else out
                part = key.rect.intersect(rect)
                out[:, *part.slices(rect)] = pixels[:, *part.slices(key.rect)]
        return out

    def _known(self, wanted: _Wanted) -> np.ndarray | None:
        if wanted not in self._small:
            raise _MissingError(wanted)
        return self._small[wanted]

    def _tile(self, wanted: _Wanted) -> np.ndarray | None:
        """Returns a tile, or what there is of it by now."""
        begun = functools.partial(self._going_on, wanted)
        return run_through(begun()) if self._portions is None else self._portions.shown(wanted, begun)

    def _going_on(self, wanted: _Wanted) -> Work:
        """Makes a tile; from the end of the first portion on there is something to show."""
        held = self._held(wanted)
        if wanted in held:
            return held[wanted]
        making, meanwhile, steps = self._by_steps(self._make(wanted)), None, 0
        while True:
            steps += 1
            try:
                next(making)
            except StopIteration as done:
                self._hold(wanted, done.value)
                return held[wanted]
            if self._portions is not None and steps == self._portions.turns:
                meanwhile = run_through(self._by_steps(self._make(wanted, steps)))
            yield meanwhile

    def _by_steps(self, making: _Making) -> Work:
        """Makes a tile and, before it, those it needs, step by step: they may be too many for calls in calls."""
        waiting: list[tuple[_Wanted | None, _Making]] = [(None, making)]
        while True:
            try:
                needed = next(waiting[-1][1])
            except StopIteration as done:
                one, _ = waiting.pop()
                if one is None:
                    return cast("np.ndarray | None", done.value)
                self._hold(one, done.value)
            else:
                if needed is not None:
                    waiting.append((needed, self._make(needed)))
                yield None

    def _held(self, wanted: _Wanted) -> dict[_Wanted, np.ndarray | None]:
        return self._small if self.is_small(wanted.node, wanted.key.level) else self._large

    def _hold(self, wanted: _Wanted, made: np.ndarray | None) -> None:
        held = self._held(wanted)
        while held is self._large and len(held) >= _LARGE_KEPT:
            del held[next(iter(held))]
        held[wanted] = None if made is None else made.copy()
        self.made += 1

    def is_small(self, node: Shown, level: int) -> bool:
        """Tells whether the frames in a node are so small at a level that its tiles are few."""
        return level + self._sides[node] <= TILED.bit_length() - 1

    def _make(self, wanted: _Wanted, pieces: int | None = None) -> _Making:
        """Makes a tile; of so many `pieces`, if they are given."""
        key, turns = wanted.key, None if pieces is None else max(1, self._turns(wanted, pieces))
        whole = _Piece(self._paths.first(wanted.node), key.rect, None, 0)
        try:
            return (yield from _Work(self, self._drawing, key.level, turns).drawn(whole))
        except _TooManyError:
            turns = self._turns(wanted, MOST_READS)
        return (yield from _Work(self, self._drawing, key.level, turns).drawn(whole))

    def _turns(self, wanted: _Wanted, most: int) -> int:
        """Returns how many turns of copies so many pieces are enough for in a tile."""
        key = wanted.key
        edge, count, turns = [(self._paths.first(wanted.node), key.rect)], 0, 0
        while edge:
            edge = list(_next(self.copies, edge, key.level))
            count += sum(_TURNED_READ if path.turned else 1 for path, _ in edge)
            if count > most:
                break
            turns += 1
        return turns

    def mean(self, node: Shown, level: int, rect: Rect) -> np.ndarray | None:
        """Returns pixels of the mean colour of all that copies show of a node, for a tile of a level."""
        at = _MEAN.bit_length() - 1 - self._sides[node]
        if level <= max(_MEAN.bit_length() - 1 - side for side in self._sides.values()):
            return None  # of such tiles it is made
        if node not in self._means:
            part = next(copy.part for held in self.copies.values() for copy in held if copy.of == node)
            assert part is not None
            found = self.picture(node, at, part.rect.zoomed(at - part.level))
            colour = None if found is None else found.mean(axis=(1, 2), dtype=np.float64).astype(np.float32)
            self._means[node] = None if colour is None else colour[:, None, None]
        mean = self._means[node]
        return None if mean is None else np.broadcast_to(mean, (4, rect.height, rect.width))


def _next(copies: Copies, edge: list[tuple[_Path, Rect]], level: int) -> Iterator[tuple[_Path, Rect]]:
    for path, rect in edge:
        for copy in copies[path.node]:
            inner = path.inner(copy)
            part = inner.part(level, rect)
            if not part.empty:
                yield inner, part


def _side(copy: Placement) -> int:
    """Returns the logarithm of the pixels of level 0 along a frame, at most."""
    assert copy.part is not None
    return max(copy.part.rect.width, copy.part.rect.height).bit_length() - copy.part.level


class _Work(Generic[SourceT, FoundT]):
    """The making of one tile, its pieces in one another: there may be thousands, too many for calls in calls.

    `most`: turns after which only the mean colour is shown; None: all are wanted.
    """

    def __init__(
        self, tiles: Tiles[SourceT, FoundT], drawing: Drawing[SourceT, FoundT], level: int, most: int | None
    ) -> None:
        self._tiles, self._drawing, self._level, self._most = tiles, drawing, level, most
        self._pieces = self._reads = self._deepest = self._drawn = 0

    def drawn(self, piece: _Piece) -> _Making:
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
                pixels = None
                if not isinstance(inner, _Piece):
                    yield inner
                    continue
                waiting.append(self._drawing_of(inner))
                self._drawn += 1
                if self._drawn % _STEP == 0:
                    yield None
        return pixels

    def _drawing_of(self, piece: _Piece) -> Generator[_Piece | _Wanted | None, np.ndarray | None, np.ndarray | None]:
        """Asks for the pieces within one, and tiles that are to be made; returns its pixels."""
        path, rect, _, turn = piece
        self._count_piece(piece)
        if turn and turn == self._most:
            return self._cut(piece, self._tiles.mean(path.node, self._level, rect))
        asking = self._drawing.asking(path.node)
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
                if pixels is not None:
                    yield None
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
            if self._is_read(inner):
                pixels = yield from self._from_tiles(inner, part)
            else:
                pixels = yield _Piece(inner, part, left, turn + 1)
            pixels = None if pixels is None else set_in(pixels, part, rect)

    def _is_read(self, path: _Path) -> bool:
        """Tells whether what is seen of a node is read from tiles of a coarser level."""
        level = source_level(path.seen.similarity, self._level)
        return level < self._level and self._tiles.is_small(path.node, level)

    def _from_tiles(self, path: _Path, part: Rect) -> Generator[_Wanted, None, np.ndarray | None]:
        self._count_reads(path, 1)
        while True:
            try:
                picture = functools.partial(self._tiles.small, path.node)
                return looked_coarser(picture, self._level, part, path.seen)
            except _MissingError as missing:
                yield missing.wanted

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
    if above is None:
        return None
    left, (height, width) = piece.left, (piece.rect.height, piece.rect.width)
    if above.share != 1:
        share = np.float32(above.share)
        left = np.full((height, width), share) if left is None else left * share
    for step, pixels in itertools.chain.from_iterable(above.found):
        if not (step.over or step.cuts):
            return None
        if isinstance(pixels, np.ndarray):
            alpha = pixels[3].reshape(height, width)
            shown = alpha if step.cuts else np.float32(1) - step.opacity * alpha
            left = shown if left is None else left * shown
    return left
