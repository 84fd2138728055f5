"""Pixels that are written and read part by part, wherever they are: as arrays, or as what does as those do."""

from __future__ import annotations

from collections.abc import Callable
from typing import Protocol

import numpy as np


class Raster(Protocol):
    """Pixels uint8 or uint16 (h, w, 4), alpha not premultiplied: an array, or what reads and writes parts of one."""

    @property
    def shape(self) -> tuple[int, ...]:
        """Gives (h, w, 4)."""
        ...

    @property
    def dtype(self) -> np.dtype:
        """Gives uint8 or uint16."""
        ...

    @property
    def nbytes(self) -> int:
        """Counts its bytes."""
        ...

    def __getitem__(self, part: tuple[slice, slice]) -> np.ndarray:
        """Returns the pixels of some rows and columns."""
        ...

    def __setitem__(self, rows: slice, pixels: np.ndarray) -> None:
        """Puts whole rows in their place."""
        ...


Room = Callable[[tuple[int, ...], type | np.dtype], Raster]  # makes room for pixels of a shape and type
