"""The coverage of one stroke: how much of each pixel its dabs have covered."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Protocol

import numpy as np

from engine.brush import discs as kernels
from engine.brush.checks import BrushError
from engine.brush.print_form import Print
from engine.brush.tinting import Tinted
from engine.numeric.address import TILE, Rect, TileKey
from engine.numeric.grid import SNAP

TILES_CAP = 1 << 15  # of one stroke: 2 GiB of coverage if none of them is flat
_PAIRS = 1 << 17  # (tile, dab) pairs sorted at once
_SLABS = 4, 64  # tiles of the first slab, and of the largest: of 4 MB
_FEW = 6  # tiles that are laid one by one
_PAIRS_OF_ONE = 4608  # more tiles than the largest dab can meet


class Stain(Protocol):
    """Another colour that some of the paint turns to: `colour`, float32 (3,), encoded sRGB."""

    @property
    def colour(self) -> np.ndarray:
        """Gives what the paint turns to: premultiplied float32 (4,)."""
        ...

    def part(self, key: TileKey) -> np.ndarray | None:
        """Tells how much of a tile's paint turns to it, 0..1: float32 (128, 128); None where nothing does."""
        ...


@dataclass(frozen=True, eq=False)
class Coverage:
    """A stroke's coverage at one moment; shares its tiles with the mask it was taken from, and never changes.

    `tiles`: by key, M as float32 (128, 128), or one float where M is the same all over; between grid values, in 0..1.
    `rect`: pixels of `level` outside which M is 0.  `tints`: of strokes whose dabs have some, their means (`tinting`).
    `places`: of strokes that have textures of their own, where pixels lie in them (`located`), float32 (2, 128, 128).
    """

    level: int
    tiles: Mapping[TileKey, np.ndarray | float]
    rect: Rect
    stain: Stain | None = None
    tints: Mapping[TileKey, np.ndarray] | None = None
    places: Mapping[TileKey, np.ndarray] | None = None

    @cached_property
    def keys(self) -> tuple[TileKey, ...]:
        """Returns the tiles, sorted by row, then column."""
        return tuple(sorted(self.tiles, key=lambda key: (key.y, key.x)))

    def on_grid(self, key: TileKey) -> np.ndarray:
        """M of one tile rounded to the grid: a new float32 (128, 128)."""
        m = np.empty((TILE, TILE), np.float32)
        m[...] = self.tiles.get(key, 0.0)
        m += SNAP
        m -= SNAP
        return m


class StrokeMask:
    """The coverage M of a stroke at `level`, grown dab by dab: M' = M + max(0, opacity - M) * flow * d(r).

    So a dab's opacity is a ceiling that no number of dabs passes, and flow the rate at which M comes up to it; d is
    the profile of module `discs`, times what the pattern of `tip` has there, if there is one.  `origin`: the stroke's
    origin, integers of any size; `each`: dabs that follow one another
    as copies of one.  Only touched tiles take memory, and of those only the ones that are not of one value.
    """

    def __init__(
        self, level: int, origin: tuple[int, int], tiles_cap: int = TILES_CAP, tip: Print | None = None, each: int = 1
    ) -> None:
        self.level = level
        self._tip = tip
        self._each = each
        self._laid = 0  # dabs in all
        self.origin = origin
        self._tiles_cap = tiles_cap
        self._corner = origin[0] // TILE, origin[1] // TILE  # the tile of the origin
        self._shift = float(origin[0] % TILE), float(origin[1] % TILE)
        self._tiles: dict[TileKey, np.ndarray | float] = {}
        self._lent: set[TileKey] = set()  # tiles that a Coverage also holds: copied before they are written
        self._bounds = kernels.no_bounds()  # and the highest ceiling so far
        self._slabs: list[np.ndarray] = []  # new tiles, zero before
        self._free = 0  # of the last slab
        self._places: dict[tuple[int, int], tuple[int, int, TileKey]] = {}  # slab and slot of tiles that are not lent
        self._lists: tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray] | None = None

    @property
    def rect(self) -> Rect:
        """Returns the pixels of the level that the dabs so far may have covered."""
        if not self._tiles:
            return Rect(0, 0, 0, 0)
        x0, y0, x1, y1, _ = self._bounds.tolist()
        left, top = self._corner[0] * TILE, self._corner[1] * TILE
        return Rect(left + int(x0 // 1), top + int(y0 // 1), left - int(-x1 // 1), top - int(-y1 // 1))

    @property
    def _ceiling(self) -> float:
        """Gives the highest coverage that any dab so far comes up to."""
        return float(self._bounds[4])

    def coverage(self) -> Coverage:
        """Returns what is covered so far, as a value that later dabs do not change."""
        self._lent = set(self._tiles)
        self._places.clear()
        tints, places = self._tip.told() if isinstance(self._tip, Tinted) else (None, None)
        return Coverage(self.level, dict(self._tiles), self.rect, None, self._by_key(tints), self._by_key(places))

    def _by_key(self, told: dict[tuple[int, int], np.ndarray] | None) -> dict[TileKey, np.ndarray] | None:
        if told is None:
            return None
        left, top = self._corner
        return {TileKey(self.level, left + x // TILE, top + y // TILE): tile for (x, y), tile in told.items()}

    def paint(self, dabs: np.ndarray) -> set[TileKey]:
        """Lays dabs, float64 (n, 6 or more) of `Stroker.add`, in order; returns the tiles that may have changed.

        BrushError if the stroke would meet more than `tiles_cap` tiles; dabs before that may have been laid.
        """
        discs = kernels.as_discs(dabs, *self._shift, self._bounds)
        if not len(discs):
            return set()
        codes, which, inside, runs = self._lists_of(max(_PAIRS_OF_ONE, min(_PAIRS, 16 * len(discs))))
        touched: set[TileKey] = set()
        start = 0
        while start < len(discs):
            count, start = kernels.list_runs(discs, start, codes, which, inside, runs)
            if self._tip is not None:  # such dabs fill no tile evenly
                inside[:], runs[:count, 4] = False, 0
            listed = runs[:count].tolist()
            if count > _FEW and self._places:
                listed = self._lay_known(listed, runs[:count], discs, which, touched)
            keys = [TileKey(self.level, self._corner[0] + x, self._corner[1] + y) for _, _, x, y, _ in listed]
            self._make_room(keys)
            for key, run in zip(keys, listed, strict=True):
                if self._lay(key, run, discs, which, inside):
                    touched.add(key)
        self._laid += len(discs)
        return touched

    def _lists_of(self, room: int) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
        """Returns what `kernels.list_runs` writes into, for at least `room` pairs: kept, as points come a few at a
        time."""
        if self._lists is None or len(self._lists[0]) < room:
            numbers = np.empty(room, np.int64), np.empty(room, np.int64)
            self._lists = *numbers, np.empty(room, np.bool_), np.empty((room, 5), np.int64)
        return self._lists

    def _make_room(self, keys: list[TileKey]) -> None:
        total = len(self._tiles) + len(keys)
        if total > self._tiles_cap:
            total = len(self._tiles) + sum(key not in self._tiles for key in keys)
        if total > self._tiles_cap:
            raise BrushError(
                "stroke", f"one that meets {total} tiles", f"at most {self._tiles_cap} of {TILE} x {TILE} px"
            )

    def _lay(self, key: TileKey, run: list[int], discs: np.ndarray, which: np.ndarray, inside: np.ndarray) -> bool:
        """Lays a run of discs (`kernels.list_runs`) into their tile; False if that changes nothing."""
        first, last, x, y, full = run
        old = self._tiles.get(key, 0.0)
        if not isinstance(old, np.ndarray) or (full and self._wiped(discs, which[first:last], inside[first:last])):
            start = 0.0 if isinstance(old, np.ndarray) else old
            part = slice(first, last)
            value, laid = kernels.lay_flat(discs, which[part], inside[part], np.float32(start), self._ceiling)
            first += laid
            if first == last:
                self._tiles[key] = float(value)
                self._places.pop((x, y), None)
                return isinstance(old, np.ndarray) or value != old
            tile = self._new_tile(key, (x, y))
            if value:
                tile[...] = value
        else:
            tile = old.copy() if key in self._lent else old
        self._lent.discard(key)
        if self._tip is None:
            kernels.lay(tile, discs, which, first, last, x * TILE, y * TILE)
        else:
            self._tip.lay(tile, discs, which[first:last], (self._laid, self._each), (x * TILE, y * TILE))
        self._tiles[key] = tile
        return True

    def _lay_known(
        self, listed: list[list[int]], runs: np.ndarray, discs: np.ndarray, which: np.ndarray, touched: set[TileKey]
    ) -> list[list[int]]:
        """Lays the runs of tiles whose places are known, all at once; returns the others."""
        rest: list[list[int]] = []
        slots: dict[int, np.ndarray] = {}
        across = np.empty(TILE, np.float32)
        for i, run in enumerate(listed):
            place = self._places.get((run[2], run[3]))
            if place is None or run[4]:
                rest.append(run)
                continue
            number, slot, key = place
            if number not in slots:
                slots[number] = np.full(len(listed), -1, np.int64)
            slots[number][i] = slot
            touched.add(key)
        for number, named in slots.items():
            kernels.lay_runs(self._slabs[number], named, runs, discs, which, across)
        return rest

    def _new_tile(self, key: TileKey, place: tuple[int, int]) -> np.ndarray:
        """Returns a tile of zeros; its place is known, unless a tip lays it."""
        if not self._free:
            self._free = min(len(self._slabs[-1]) * 2, _SLABS[1]) if self._slabs else _SLABS[0]
            self._slabs.append(np.zeros((self._free, TILE, TILE), np.float32))
        self._free -= 1
        if self._tip is None:
            self._places[place] = len(self._slabs) - 1, self._free, key
        tile: np.ndarray = self._slabs[-1][self._free]
        return tile

    def _wiped(self, discs: np.ndarray, which: np.ndarray, inside: np.ndarray) -> bool:
        out: bool = kernels.wiped(discs, which, inside, self._ceiling)
        return out
