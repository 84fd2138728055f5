"""Pictures on their way into a painting's file."""

from __future__ import annotations

import tempfile
from typing import IO

import numpy as np

from engine.files.png_writer import PngWriter
from engine.numeric.address import Rect

IN_MEMORY = 256 << 20  # bytes of all pictures that are kept in memory before they go into the file


class SpooledPng:
    """An 8-bit PNG on its way into the file, in memory while it is small; `count` of them share that memory."""

    def __init__(self, place: Rect, count: int, small: bool = False) -> None:
        self.file: IO[bytes] = tempfile.SpooledTemporaryFile(max(1 << 16, IN_MEMORY // count))  # noqa: SIM115
        self._writer = PngWriter(self.file, place.width, place.height, small=small)  # type: ignore[arg-type]

    def rows(self, pixels: np.ndarray) -> None:
        """Adds rows: uint8 (n, w, 4) of straight alpha."""
        self._writer.rows(pixels)

    def finished(self) -> IO[bytes]:
        """Ends the picture; returns the file that holds it."""
        self._writer.close()
        return self.file
