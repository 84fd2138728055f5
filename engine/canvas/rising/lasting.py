"""What a commit leaves of finer detail, tile by tile, as long as somebody may ask for it: the history asks for all."""

from __future__ import annotations

import numpy as np
from isal import isal_zlib

from engine.numeric.address import Rect

_OVERHEAD = 250  # bytes of one's own objects, roughly


class Lasting:
    """A of one tile of a commit, float32 (h, w), over the `rect` of its level outside which it is 1.  A value; other
    threads may read it while it is packed."""

    __slots__ = ("__weakref__", "_held", "rect")

    def __init__(self, rect: Rect, data: np.ndarray) -> None:
        self.rect = rect
        self._held: np.ndarray | bytes = data

    @property
    def data(self) -> np.ndarray:
        """Gives the values, which nobody writes to."""
        held = self._held
        if not isinstance(held, bytes):
            return held
        parts = np.frombuffer(isal_zlib.decompress(held), np.uint8).reshape(4, -1)
        return np.ascontiguousarray(parts.T).view(np.float32).reshape(self.rect.height, self.rect.width)

    @property
    def nbytes(self) -> int:
        """Counts the bytes of memory that it takes."""
        return _OVERHEAD + (len(self._held) if isinstance(self._held, bytes) else self._held.nbytes)

    def pack(self) -> None:
        """Takes fewer bytes from now on."""
        held = self._held
        if not isinstance(held, bytes):
            parts = np.ascontiguousarray(held).view(np.uint8).reshape(-1, 4)
            self._held = isal_zlib.compress(np.ascontiguousarray(parts.T).data, 1)
