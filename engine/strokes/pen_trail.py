"""What a stroke with an example tells of its pixels, by the control channels that the example has: which way the stroke
runs there, what a texture or a number says, or what the example is like anyhow.

A pixel that a stroke takes is told the direction of the part of its path that is nearest, in whatever portions its
points come: so what was laid last is told anew as the stroke goes on.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace

import numpy as np

from engine.brush.copies import Copies, Torus, one_by_one
from engine.brush.dabs import Stroker
from engine.brush.felt import steadied
from engine.brush.footprint import Footprint
from engine.brush.ink import named
from engine.brush.parts import BY_STROKE, Surface
from engine.brush.settings import Brush
from engine.numeric.address import Rect
from engine.numeric.elementary import angles
from engine.painting.textures import Texture
from engine.texture.example import tiles
from engine.texture.example.control import Control, stored_channels
from engine.texture.example.flow import follow
from engine.texture.example.parameters import ORIENTATION
from engine.texture.example.tiles import TILE_SIDE
from engine.texture.grey import grey

_SPACING = 0.25  # radii between two places of the path, at least
_TOGETHER = 1 << 18  # pixels that are told at once
_REACH = 1.5  # px beyond a dab's radius in which its pixels lie

Parts = Iterator[tuple[Rect, np.ndarray]]


class PenTrail:
    """The footprint of a stroke, and which way it runs: `lay` and `rest` as a `Footprint`'s, but what is taken comes
    again where it is told otherwise than before.  `origin`, `finer`, `copies` as there."""

    def __init__(
        self, footprint: Footprint, brush: Brush, place: tuple[tuple[int, int], int, Copies | Torus], usual: int
    ) -> None:
        self._footprint, self._usual = footprint, usual
        self._origin, self._finer, self._copies = place
        path = steadied(replace(brush, spacing=max(brush.spacing, _SPACING)))
        self._stroker = Stroker(path)
        self._last: dict[int, np.ndarray] = {}  # of the stroke and its copies, the place where they are
        self._held: dict[tuple[int, int], tuple[np.ndarray, np.ndarray, np.ndarray]] = {}

    def lay(self, points: np.ndarray) -> Parts:
        """As `Footprint.lay`."""
        parts = self._footprint.lay(points)
        return self._told(parts, self._lines(self._stroker.walk(points)))

    def rest(self) -> Parts:
        """As `Footprint.rest`."""
        return self._told(self._footprint.rest(), [])

    def directions(self, rect: Rect) -> np.ndarray:
        """Returns which way the stroke runs: uint8 (h, w) of a rectangle."""
        out = np.full((rect.height, rect.width), self._usual, np.uint8)
        for key in tiles.keys_of(rect):
            held = self._held.get(key)
            if held is not None:
                place = tiles.rect_of(key)
                both = place.intersect(rect)
                out[both.slices(rect)] = held[1][both.slices(place)]
        return out

    def _lines(self, dabs: np.ndarray) -> list[np.ndarray]:
        """Returns the lines, float64 (n, 5), along which the stroke and each of its copies have gone on; in pixels that
        are taken, from its origin."""
        found = []
        for number, part in enumerate(one_by_one(dabs, self._copies)):
            places = np.empty((len(part), 3))
            for n in range(2):
                left_over = self._origin[n] & ((1 << -self._finer) - 1) if self._finer < 0 else 0
                places[:, n] = (part[:, n] + left_over) * 2.0**self._finer
            places[:, 2] = part[:, 2] * 2.0**self._finer
            if not len(places):
                continue
            before = self._last.get(number)
            self._last[number] = places[-1]
            whole = places if before is None else np.concatenate([before[None], places])
            reach = np.maximum(whole[:-1, 2], whole[1:, 2]) + _REACH
            lines = np.concatenate([whole[:-1, :2], whole[1:, :2], reach[:, None]], axis=1)
            found.append(lines[self._goes_on(lines)])
        return found

    def _goes_on(self, lines: np.ndarray) -> np.ndarray:
        """Tells which lines are part of the path: those that lead from rim to rim of a cell are not."""
        far = np.abs(lines[:, 2:4] - lines[:, :2])
        going: np.ndarray = far.max(axis=1) > 0.0
        if isinstance(self._copies, Torus):
            cell = np.array([self._copies.width, self._copies.height]) * 2.0**self._finer
            going &= (2.0 * far < cell).all(axis=1)
        return going

    def _told(self, parts: Parts, lines: list[np.ndarray]) -> Parts:
        stale: dict[tuple[int, int], np.ndarray] = {}
        for rect, mask in parts:
            for key in tiles.keys_of(rect):
                place = tiles.rect_of(key)
                both = place.intersect(rect)
                new = mask[both.slices(rect)]
                if new.any():
                    part = stale.setdefault(key, np.zeros((TILE_SIDE, TILE_SIDE), np.bool_))
                    part[both.slices(place)] |= new
        for key, new in stale.items():
            self._tile(key)[2][new] = True
        for own in lines:
            self._go_along(own, stale)
        yield from _joined({key: part for key, part in stale.items() if part.any()})

    def _go_along(self, lines: np.ndarray, stale: dict[tuple[int, int], np.ndarray]) -> None:
        if not len(lines):
            return
        down, across = lines[:, 3] - lines[:, 1], lines[:, 2] - lines[:, 0]
        values = (np.rint(angles(down, across) * (128.0 / np.pi)).astype(np.int64) & 255).astype(np.uint8)
        origin = [value << self._finer if self._finer >= 0 else value >> -self._finer for value in self._origin]
        met: dict[tuple[int, int], list[int]] = {}
        for k, line in enumerate(lines.tolist()):
            box = Rect(
                int(np.floor(min(line[0], line[2]) - line[4])) + origin[0],
                int(np.floor(min(line[1], line[3]) - line[4])) + origin[1],
                int(np.ceil(max(line[0], line[2]) + line[4])) + origin[0],
                int(np.ceil(max(line[1], line[3]) + line[4])) + origin[1],
            )
            for key in tiles.keys_of(box):
                met.setdefault(key, []).append(k)
        for key, which in met.items():
            nearest, told, taken = self._tile(key)
            before, place = told.copy(), tiles.rect_of(key)
            follow(lines[which], values[which], float(place.x0 - origin[0]), float(place.y0 - origin[1]), nearest, told)
            changed = (told != before) & taken
            if changed.any():
                part = stale.setdefault(key, np.zeros((TILE_SIDE, TILE_SIDE), np.bool_))
                part |= changed

    def _tile(self, key: tuple[int, int]) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Returns of a tile how far the stroke is, squared, which way it runs, and what it has taken."""
        if key not in self._held:
            size = TILE_SIDE, TILE_SIDE
            usual = np.full(size, self._usual, np.uint8)
            self._held[key] = np.full(size, np.inf, np.float32), usual, np.zeros(size, np.bool_)
        return self._held[key]


def _joined(parts: Mapping[tuple[int, int], np.ndarray]) -> Parts:
    """Yields tiles that lie near one another as one."""
    whole = Rect(0, 0, 0, 0)
    for key in parts:
        whole = whole.union(tiles.rect_of(key))
    if whole.area > _TOGETHER:
        yield from ((tiles.rect_of(key), parts[key]) for key in sorted(parts))
        return
    if not whole.empty:
        mask = np.zeros((whole.height, whole.width), np.bool_)
        for key, part in parts.items():
            mask[tiles.rect_of(key).slices(whole)] = part
        rows, columns = np.flatnonzero(mask.any(axis=1)), np.flatnonzero(mask.any(axis=0))
        inner = Rect(int(columns[0]), int(rows[0]), int(columns[-1]) + 1, int(rows[-1]) + 1)
        yield (
            Rect(whole.x0 + inner.x0, whole.y0 + inner.y0, whole.x0 + inner.x1, whole.y0 + inner.y1),
            mask[inner.slices(Rect(0, 0, whole.width, whole.height))],
        )


class Telling:
    """What a brush tells of pixels of `level` by the channels of an example.  `trail`: of the stroke in hand."""

    def __init__(
        self, brush: Brush, control: Control | None, textures: Mapping[str, Texture], level: int, seed: int
    ) -> None:
        self.trail: PenTrail | None = None
        self.following: int | None = None  # the usual orientation, where it is that of the stroke
        self._level = level
        self._sources: list[Callable[[Rect], np.ndarray | int]] = []
        if control is None:
            return
        for channel, usual in zip(stored_channels(control.channels), control.usual, strict=True):
            self._sources.append(self._source(channel.name, brush.control.get(channel.name), usual, (textures, seed)))

    def __call__(self, rect: Rect) -> np.ndarray | None:
        """Returns planes, uint8 (C, h, w), of a rectangle; None where nothing is to be told."""
        if not self._sources:
            return None
        out = np.empty((len(self._sources), rect.height, rect.width), np.uint8)
        for n, source in enumerate(self._sources):
            out[n] = source(rect)
        return out

    def _source(
        self, name: str, told: object, usual: int, around: tuple[Mapping[str, Texture], int]
    ) -> Callable[[Rect], np.ndarray | int]:
        if name == ORIENTATION and told == BY_STROKE:
            self.following = usual
            return lambda rect: usual if self.trail is None else self.trail.directions(rect)
        if isinstance(told, str):
            made = named(Surface(told), around[0], self._level, around[1], f"brush.control.{name}")
            whole = 256.0 if name == ORIENTATION else 255.0
            return lambda rect: (np.rint(grey(made, self._level, rect) * whole).astype(np.int64) & 255).astype(np.uint8)
        if isinstance(told, float):
            value = round(told * (256 if name == ORIENTATION else 255)) & 255
            return lambda rect: value
        return lambda rect: usual
