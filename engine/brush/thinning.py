"""What makes less of a stroke's coverage: the brush's relief, a selection."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from typing import Protocol

import numpy as np

from engine.brush.mask import Coverage
from engine.numeric.address import TileKey

Plane = np.ndarray | float  # of a tile, as a `Coverage` has it


class Thinning(Protocol):
    """Thins coverages."""

    def over(self, coverage: Coverage) -> Coverage:
        """Returns what is left of a coverage; its tiles are made when they are asked for."""
        ...


class LazyTiles(Mapping[TileKey, "np.ndarray | float"]):
    """The tiles of a coverage, thinned when they are asked for."""

    def __init__(self, tiles: Mapping[TileKey, Plane], made: Callable[[TileKey], Plane]) -> None:
        self._tiles, self._made = tiles, made

    def __getitem__(self, key: TileKey) -> Plane:
        return self._made(key)

    def __iter__(self) -> Iterator[TileKey]:
        return iter(self._tiles)

    def __len__(self) -> int:
        return len(self._tiles)

    def __contains__(self, key: object) -> bool:
        return key in self._tiles
