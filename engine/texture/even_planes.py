"""Planes of heights, held once: red, green and blue of them are the same, and of each of their inks, and alpha is 0."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from engine.texture.planes import COLOURS

_ALPHA = COLOURS - 1


@dataclass(frozen=True, eq=False, slots=True)
class EvenPlanes:
    """Data (4 + 3n, h, w) of a record: `planes`, (1 + n, h, w), of its brightness and of each of its inks."""

    planes: np.ndarray

    @classmethod
    def of(cls, data: np.ndarray) -> EvenPlanes | None:
        """Returns data in that form; None where their planes are not the same."""
        if data[_ALPHA].any():
            return None
        first = [0, *range(COLOURS, len(data), 3)]
        for plane in first:
            told = data[plane].tobytes()
            if any(data[plane + k].tobytes() != told for k in (1, 2)):
                return None
        planes = data[first]
        planes.flags.writeable = False
        return cls(planes)

    @property
    def nbytes(self) -> int:
        """Counts the bytes of memory that it takes."""
        return self.planes.nbytes

    @property
    def itemsize(self) -> int:
        """Counts the bytes of each of the data."""
        return self.planes.itemsize

    def made(self) -> np.ndarray:
        """Returns the data, read-only."""
        count, height, width = self.planes.shape
        out = np.empty((COLOURS + 3 * (count - 1), height, width), self.planes.dtype)
        out[:_ALPHA] = self.planes[0]
        out[_ALPHA] = 0
        out[COLOURS:].reshape(count - 1, 3, height, width)[:] = self.planes[1:, None]
        out.flags.writeable = False
        return out
