"""Small pictures of steps: where a stroke was painted, or the frame, as it was seen after the step."""

from __future__ import annotations

from collections import OrderedDict, deque

import numpy as np
from isal import isal_zlib

from engine.canvas.composite import composite
from engine.canvas.layers import Layer
from engine.canvas.reading import layer_planes
from engine.canvas.store import Change
from engine.canvas.tile_cache import TileCache
from engine.keeping.spill import Spilled, spill
from engine.numeric.address import TILE, Rect
from engine.numeric.colour import to_premul8
from engine.painting import commands as c
from engine.painting.fill_command import place_of
from engine.painting.value import Painting
from engine.session.steps import LoggedStep
from engine.strokes.coverage_at import stroke_bounds

PICTURE_WIDTH, PICTURE_HEIGHT = 96, 72  # pixels
_ROOM = 0.8  # of a picture that a stroke may fill
_PICTURE_BYTES = 64 << 20  # bytes of pictures kept, the oldest forgotten first; those on disk count, too
_AT_HAND = 2 << 20  # bytes of the newest that are not on disk


class StepPainter:
    """Makes pictures of steps, one after the other."""

    def __init__(self) -> None:
        self._before: dict[int, tuple[int, Change | None]] = {}  # by their ids, what layers were at the last picture

    def made(self, step: LoggedStep, painting: Painting, cache: TileCache | None) -> np.ndarray:
        """Returns the picture of a step: uint8 (72, 96, 4), premultiplied; `painting`: as it was after it."""
        own, whole = _place(step.command, painting)
        known: dict[int, tuple[Rect, np.ndarray | None]] = {}

        def read(layer: Layer, level: int, rect: Rect) -> np.ndarray | None:
            if level != own or rect.intersect(whole) != rect:  # what placements show of other places
                return layer_planes(layer, level, rect, cache)
            if layer.id not in known:  # once for all blocks
                around = whole if self._at_hand(layer, level, whole, cache) else _tiled(whole)
                known[layer.id] = around, layer_planes(layer, level, around, cache)
                self._before[layer.id] = _state(layer)
            around, planes = known[layer.id]
            return None if planes is None else planes[:, *rect.slices(around)]

        return to_premul8(composite(painting.root, own, whole, read))

    def _at_hand(self, layer: Layer, level: int, rect: Rect, cache: TileCache | None) -> bool:
        """Tells whether a rectangle of a layer is soon read, or of a layer that changes.  If not, whole tiles are kept
        for the next picture."""
        if cache is None or layer.growth or self._before.get(layer.id) != _state(layer):
            return True
        return all(cache.view(layer.pyramid, key)[0] for key in rect.tiles(level))


def _state(layer: Layer) -> tuple[int, Change | None]:
    """Tells a layer's paint from what it was before, which nobody need keep for it."""
    return layer.pyramid.uid, layer.pyramid.last


def _tiled(rect: Rect) -> Rect:
    """Returns the tiles that a rectangle meets."""
    x0, y0 = rect.x0 // TILE * TILE, rect.y0 // TILE * TILE
    return Rect(x0, y0, -(-rect.x1 // TILE) * TILE, -(-rect.y1 // TILE) * TILE)


def _place(command: c.Command, painting: Painting) -> tuple[int, Rect]:
    """Returns the level, no finer than the stroke's, and its pixels that are shown."""
    level, whole = 0, painting.frame
    if isinstance(command, c.Stroke):
        level, whole = command.level, stroke_bounds(command)
    elif isinstance(command, c.Fill):
        fill_level, looked_at = place_of(command)
        if looked_at is not None:
            level, whole = fill_level, looked_at
    while whole.width > _ROOM * PICTURE_WIDTH or whole.height > _ROOM * PICTURE_HEIGHT:
        level, whole = level - 1, whole.zoomed(-1)
    left = whole.x0 - (PICTURE_WIDTH - whole.width) // 2
    top = whole.y0 - (PICTURE_HEIGHT - whole.height) // 2
    return level, Rect.at(left, top, PICTURE_WIDTH, PICTURE_HEIGHT)


class StepPictures:
    """The pictures made so far, by the index of the step and its command, which tells whether it is still that one."""

    def __init__(self) -> None:
        self._kept: OrderedDict[int, tuple[c.Command, bytes | Spilled]] = OrderedDict()
        self._here: deque[int] = deque()  # the indices of those that are not on disk, or were not, the oldest first
        self.held = self._held_here = 0  # bytes

    def __contains__(self, step: LoggedStep) -> bool:
        known = self._kept.get(step.index)
        return known is not None and known[0] is step.command

    def keep(self, step: LoggedStep, pixels: np.ndarray) -> None:
        """Keeps a picture, uint8 (72, 96, 4)."""
        self._forget(step.index)
        packed = isal_zlib.compress(pixels.data, 1)
        self._kept[step.index] = step.command, packed
        self._here.append(step.index)
        self._count(packed, 1)
        while self._held_here > _AT_HAND and self._here:
            self._put_away(self._here.popleft())
        while self.held > _PICTURE_BYTES:
            self._forget(next(iter(self._kept)))

    def of(self, step: LoggedStep) -> np.ndarray:
        """Returns a picture that is kept."""
        held = self._kept[step.index][1]
        packed = held if isinstance(held, bytes) else held.read()
        return np.frombuffer(isal_zlib.decompress(packed), np.uint8).reshape(PICTURE_HEIGHT, PICTURE_WIDTH, 4)

    def _forget(self, index: int) -> None:
        known = self._kept.pop(index, None)
        if known is not None:
            self._count(known[1], -1)

    def _put_away(self, index: int) -> None:
        """Puts a picture on disk, if it is still there, and there is room."""
        command, packed = self._kept.get(index, (None, None))
        put = spill().put_spare(packed) if command is not None and isinstance(packed, bytes) else None
        if command is not None and isinstance(packed, bytes) and put is not None:
            self._count(packed, -1)
            self._kept[index] = command, put
            self._count(put, 1)

    def _count(self, held: bytes | Spilled, sign: int) -> None:
        self.held += sign * (len(held) if isinstance(held, bytes) else held.size)
        self._held_here += sign * len(held) if isinstance(held, bytes) else 0
