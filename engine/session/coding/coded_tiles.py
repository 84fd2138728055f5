"""Tiles of what was painted with examples, made smaller where only old states have them: compressed, each by itself.

A tile keeps its value and its identity; the planes of a coded one are made when they are asked for.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from isal import isal_zlib

from engine.keeping.spill import PLACE_OVERHEAD, Spilled
from engine.numeric.grid import FINE_STEP
from engine.numeric.recent import Recent
from engine.session.coding.byte_planes import joined_bytes, split_bytes
from engine.texture.example.tiles import TilePlanes

_MADE = 16 << 20  # bytes of planes kept that were asked for
_OVERHEAD = 150  # bytes of a coded tile's own objects, roughly
_LEVEL = 1


@dataclass(frozen=True, eq=False, slots=True)
class CodedTile:
    """The planes of a tile, of a `shape` and type.

    `steps`: the type of the steps of the grid that the planes are told in; None where they are told as they are;
    `packed`: low bytes before high ones, deflated; or where on disk that is.
    """

    shape: tuple[int, ...]
    dtype: np.dtype
    steps: np.dtype | None
    packed: bytes | Spilled

    @property
    def nbytes(self) -> int:
        """Counts the bytes of memory that it takes."""
        return _OVERHEAD + (len(self.packed) if isinstance(self.packed, bytes) else PLACE_OVERHEAD)

    def made(self) -> np.ndarray:
        """Returns the planes, read-only.  OSError if they cannot be read."""
        known = TILES_MADE.get(self)
        if known is not None:
            return known
        told = self.dtype if self.steps is None else self.steps
        packed = self.packed if isinstance(self.packed, bytes) else self.packed.read()
        raw = np.frombuffer(isal_zlib.decompress(packed), np.uint8).reshape(told.itemsize, -1)
        planes = joined_bytes(raw, told).reshape(self.shape)
        if self.steps is not None:
            planes = planes.astype(self.dtype) * self.dtype.type(FINE_STEP)
        planes.flags.writeable = False
        TILES_MADE.keep(self, planes, planes.nbytes)
        return planes


TILES_MADE: Recent[np.ndarray] = Recent(lambda: _MADE)


def encode_tile(tile: TilePlanes) -> int:
    """Makes a tile smaller.  Returns the bytes that it takes less than before: 0 if it is coded already, or not worth
    it."""
    planes = tile.held
    if not isinstance(planes, np.ndarray):
        return 0
    steps = _steps(planes)
    packed = isal_zlib.compress(split_bytes(planes if steps is None else steps).data, _LEVEL)
    coded = CodedTile(planes.shape, planes.dtype, None if steps is None else steps.dtype, packed)
    if coded.nbytes >= planes.nbytes:
        return 0
    tile.exchange(coded)
    return planes.nbytes - coded.nbytes


def decode_tile(tile: TilePlanes) -> None:
    """Makes a tile as it was."""
    held = tile.held
    if isinstance(held, CodedTile):
        tile.exchange(held.made())
        TILES_MADE.forget(held)


def _steps(planes: np.ndarray) -> np.ndarray | None:
    """Returns planes of colour in steps of the grid, as integers; None for others, and for those that lie beside it."""
    if planes.dtype.kind != "f":
        return None
    steps = (planes * planes.dtype.type(1.0 / FINE_STEP)).astype(np.int32)
    back = steps.astype(planes.dtype) * planes.dtype.type(FINE_STEP)
    same = np.array_equal(back.view(np.int32), planes.view(np.int32))  # zeros with their signs
    return steps if same else None
