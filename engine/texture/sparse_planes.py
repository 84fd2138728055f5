"""Planes of many inks, each kept only as far as anything lies in it: a coarse tile may meet hundreds of instances, each
of which fills a few of its pixels."""

from __future__ import annotations

from bisect import insort
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from itertools import chain, compress

import numpy as np
from isal import isal_zlib

from engine.numeric.address import Rect
from engine.texture.planes import COLOURS, sort_key
from engine.texture.record import Instance

MANY = 8  # inks from which on planes are kept so
_SHEET_OVERHEAD = 300  # bytes of a sheet's own objects, roughly
_WORTH = 4 << 10  # bytes of a sheet from which on it may be packed
_LESS = 2  # its own bytes are such a multiple of those packed, at least: else it stays as it is


@dataclass(frozen=True, eq=False, slots=True)
class SparseSheet:
    """Some planes of integers over the smallest `rect` that holds what is not zero; `held`: their `data`, or these
    packed; `most`: the largest of their absolute values."""

    rect: Rect
    held: np.ndarray | bytes
    most: int

    @classmethod
    def of(cls, data: np.ndarray, corner: tuple[int, int]) -> SparseSheet | None:
        """Copies what is not zero of planes whose first pixel lies at `corner` (x, y); None where all is."""
        marked = np.any(data, axis=0)
        rows = np.flatnonzero(marked.any(axis=1))
        if not len(rows):
            return None
        columns = np.flatnonzero(marked.any(axis=0))
        y0, y1, x0, x1 = int(rows[0]), int(rows[-1]) + 1, int(columns[0]), int(columns[-1]) + 1
        part = data[:, y0:y1, x0:x1]
        most = _most(part)
        kept = part.astype(integers_up_to(most))
        kept.flags.writeable = False
        x, y = corner
        return cls(Rect(x + x0, y + y0, x + x1, y + y1), kept, most)

    @property
    def nbytes(self) -> int:
        """Counts the bytes of memory that it takes."""
        return (len(self.held) if isinstance(self.held, bytes) else self.held.nbytes) + _SHEET_OVERHEAD

    @property
    def data(self) -> np.ndarray:
        """Gives the planes, (c, h, w) read-only: int16 where that holds them, else int32."""
        held = self.held
        if not isinstance(held, bytes):
            return held
        told = np.frombuffer(isal_zlib.decompress(held), integers_up_to(self.most))
        return told.reshape(-1, self.rect.height, self.rect.width)

    def pack(self) -> None:
        """Holds the planes packed, where that is much less.  Other threads may read them meanwhile."""
        plain = self.held
        if not isinstance(plain, bytes) and plain.nbytes >= _WORTH:
            packed = isal_zlib.compress(np.ascontiguousarray(plain).data, 1)
            if len(packed) * _LESS <= plain.nbytes:
                object.__setattr__(self, "held", packed)

    def paste(self, out: np.ndarray, first: int, rect: Rect) -> None:
        """Writes what lies in `rect` into planes (c, h, w) over it, from the plane `first` on."""
        left, top, right, bottom = self.rect  # by numbers: of many inks there are as many sheets
        x, y, x1, y1 = rect
        data = self.data
        last = first + len(data)
        if x <= left and y <= top and right <= x1 and bottom <= y1:
            out[first:last, top - y : bottom - y, left - x : right - x] = data
        elif left < x1 and x < right and top < y1 and y < bottom:
            x0, y0, x1, y1 = max(left, x), max(top, y), min(right, x1), min(bottom, y1)
            part = data[:, y0 - top : y1 - top, x0 - left : x1 - left]
            out[first:last, y0 - y : y1 - y, x0 - x : x1 - x] = part

    def replaced(self, data: np.ndarray, rect: Rect) -> SparseSheet | None:
        """Returns it with `data` in place of what lies in `rect`."""
        whole = self.rect.union(rect)
        kind = integers_up_to(max(self.most, _most(data)))
        own = self.data
        if whole == self.rect and own.dtype == kind:
            out = own.copy()
        else:
            out = np.zeros((len(own), whole.height, whole.width), kind)
            self.paste(out, 0, whole)
        out[:, *rect.slices(whole)] = data
        edges = out[:, 0], out[:, -1], out[:, :, 0], out[:, :, -1]
        if kind is np.int32 or not all(edge.any() for edge in edges):  # it may be smaller, in one way or the other
            return SparseSheet.of(out, (whole.x0, whole.y0))
        out.flags.writeable = False
        return SparseSheet(whole, out, _most(out))


@dataclass(frozen=True, eq=False, slots=True)
class SparsePlanes:
    """Planes (4 + 3n, h, w) of integers over `rect`: of colour, None where there is none, and of each ink."""

    rect: Rect
    colours: SparseSheet | None
    inks: dict[Instance, SparseSheet]  # in the order of their keys
    _boxes: np.ndarray | None = field(default=None, init=False, repr=False)  # of the sheets, once they are asked for,
    _size: int = field(default=0, init=False, repr=False)  # and the bytes of all

    @classmethod
    def of(cls, rect: Rect, data: np.ndarray, inks: tuple[Instance, ...]) -> SparsePlanes:
        """Takes planes (4 + 3n, h, w) apart; `rect` is the smallest that holds what is not zero."""
        corner = rect.x0, rect.y0
        sheets = {ink: SparseSheet.of(data[at : at + 3], corner) for at, ink in _places(inks)}
        return cls(rect, SparseSheet.of(data[:COLOURS], corner), {ink: s for ink, s in sheets.items() if s is not None})

    @property
    def nbytes(self) -> int:
        """Counts the bytes of memory that it takes."""
        if not self._size:
            object.__setattr__(self, "_size", sum([sheet.nbytes for sheet in self._sheets]))
        return self._size

    def alone(self, other: SparsePlanes) -> int:
        """Counts the bytes of what it does not share with another."""
        shared = set(map(id, other._sheets))
        return sum([sheet.nbytes for sheet in self._sheets if id(sheet) not in shared])

    def inks_apart(self, other: SparsePlanes) -> tuple[Instance, ...]:
        """Returns the inks of which another does not hold the very same."""
        shared = set(map(id, other.inks.values()))
        return tuple(ink for ink, sheet in self.inks.items() if id(sheet) not in shared)

    def pack(self, before: SparsePlanes | None, which: Callable[[Instance], bool]) -> None:
        """Packs colour, and some of the inks, where `before` has not the very same."""
        known = set(map(id, before._sheets)) if before is not None else set()
        object.__setattr__(self, "_size", 0)
        sheets = [sheet for ink, sheet in self.inks.items() if id(sheet) not in known and which(ink)]
        for sheet in [*sheets, *([self.colours] if self.colours is not None else [])]:
            if id(sheet) not in known:
                sheet.pack()

    @property
    def _sheets(self) -> list[SparseSheet]:
        return [*self.inks.values(), *([self.colours] if self.colours is not None else [])]

    @property
    def kind(self) -> type[np.signedinteger]:
        """Gives the smaller integer that holds all of it."""
        return integers_up_to(max([sheet.most for sheet in self._sheets]))

    @property
    def itemsize(self) -> int:
        """Counts its bytes."""
        return np.dtype(self.kind).itemsize

    def made(self) -> np.ndarray:
        """Returns the planes, int16 or int32 as they need it."""
        out = self.over(self.rect, tuple(self.inks), self.kind)
        out.flags.writeable = False
        return out

    def over(self, rect: Rect, inks: tuple[Instance, ...], kind: type[np.signedinteger]) -> np.ndarray:
        """Returns what lies in a rectangle of colour and some of the inks: new."""
        out = np.zeros((COLOURS + 3 * len(inks), rect.height, rect.width), kind)
        if self.colours is not None:
            self.colours.paste(out, 0, rect)
        for at, ink in _places(inks):
            sheet = self.inks.get(ink)
            if sheet is not None:
                sheet.paste(out, at, rect)
        return out

    def within(self, rect: Rect) -> tuple[Instance, ...]:
        """Returns the inks of which something may lie in a rectangle."""
        return tuple(compress(self.inks, self._meets(rect)))

    def within_of(self, rect: Rect, finest: int | None) -> tuple[tuple[Instance, ...], np.ndarray]:
        """Returns the inks of which something may lie in a rectangle, and what lies there of colour and of these, in
        the smaller integer that holds all: new.  `finest`: without ink that adds no texture down to this level."""
        met = self._meets(rect)
        if finest is not None:
            met = [there and ink.base < finest for there, ink in zip(met, self.inks, strict=True)]
        out = np.zeros((COLOURS + 3 * sum(met), rect.height, rect.width), self.kind)
        if self.colours is not None:
            self.colours.paste(out, 0, rect)
        for n, sheet in enumerate(compress(self.inks.values(), met)):
            sheet.paste(out, COLOURS + 3 * n, rect)
        return tuple(compress(self.inks, met)), out

    def _meets(self, rect: Rect) -> list[bool]:
        """Tells of each ink whether its sheet meets a rectangle."""
        x0, y0, x1, y1 = rect
        boxes = self._boxes
        if boxes is None:  # of many inks it takes long to go through all, which each commit does several times
            told = chain.from_iterable([sheet.rect for sheet in self.inks.values()])
            boxes = np.fromiter(told, np.int16, 4 * len(self.inks)).reshape(-1, 4)
            object.__setattr__(self, "_boxes", boxes)
        left, top, right, bottom = boxes.T
        found: list[bool] = ((left < x1) & (right > x0) & (top < y1) & (bottom > y0)).tolist()
        return found

    def replaced(
        self, rect: Rect, data: np.ndarray, inks: tuple[Instance, ...], before: np.ndarray
    ) -> SparsePlanes | None:
        """Returns it with `data`, (4 + 3n, h, w), in place of colour and of some inks in `rect`; None where nothing is
        left.  `before`: what it has there.  What is not replaced, or stays the same, is shared."""
        corner, changed = (rect.x0, rect.y0), (data != before).any(axis=(1, 2)).tolist()
        sheets: dict[Instance, SparseSheet | None] = dict(self.inks)
        for at, ink in _places(inks):
            if any(changed[at : at + 3]):
                old, new = sheets.get(ink), data[at : at + 3]
                sheets[ink] = SparseSheet.of(new, corner) if old is None else old.replaced(new, rect)
        colours = self.colours
        if any(changed[:COLOURS]):
            new = data[:COLOURS]
            colours = SparseSheet.of(new, corner) if colours is None else colours.replaced(new, rect)
        kept = {ink: sheet for ink, sheet in sheets.items() if sheet is not None}
        rects = [sheet.rect for sheet in kept.values()] + ([colours.rect] if colours is not None else [])
        if not rects:
            return None
        lefts, tops, rights, bottoms = zip(*rects, strict=True)
        whole = Rect(min(lefts), min(tops), max(rights), max(bottoms))
        return SparsePlanes(whole, colours, kept if len(sheets) == len(self.inks) else self._ordered(kept))

    def _ordered(self, sheets: dict[Instance, SparseSheet]) -> dict[Instance, SparseSheet]:
        """Returns sheets of these inks, and of others behind them, in the order in which a stack has its inks."""
        inks = [ink for ink in self.inks if ink in sheets]
        for ink in list(sheets)[len(inks) :]:
            insort(inks, ink, key=lambda one: sort_key(one.key))
        return {ink: sheets[ink] for ink in inks}


class OfSheets:
    """What such planes are made of, in fewer bytes."""

    __slots__ = ()

    def plain(self) -> SparsePlanes:
        """Returns the planes."""
        raise NotImplementedError


def integers_up_to(most: int) -> type[np.signedinteger]:
    """Returns the smaller integer that holds values up to this."""
    return np.int16 if most < 1 << 15 else np.int32


def _most(data: np.ndarray) -> int:
    """Returns the largest absolute value of some integers."""
    return max(int(data.max()), -int(data.min()))


def _places(inks: tuple[Instance, ...]) -> Iterable[tuple[int, Instance]]:
    """Yields the first plane of each ink, and the ink."""
    return ((COLOURS + 3 * i, ink) for i, ink in enumerate(inks))
