"""A file's bytes as the pixels of a picture, so that a painting holds them as it holds pictures, by their hash."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from engine.files.fault import FileError, TooMuch, reason_of
from engine.numeric.parted import Raster

_WIDTH, _A_PIXEL = 1024, 3  # pixels of a row; bytes in each, its red, green and blue
_LENGTH = 8  # bytes before the file's, which tell how many these are
MOST = 3 << 26  # bytes of a file


def read_whole(path: Path, name: str) -> np.ndarray:
    """Returns the bytes of a file as pixels, uint8 RGBA (h, w, 4).  FileError if it cannot be read, TooMuch if they are
    more than MOST; `name` stands in it."""
    if not path.is_file():  # also so that no pipe or device is opened
        raise FileError(name, "found no file there, expected one")
    try:
        size = path.stat().st_size
        if size > MOST:
            raise TooMuch(name, f"takes {size >> 20} MB, expected at most {MOST >> 20} to be held within a painting")
        return as_pixels(path.read_bytes())
    except OSError as error:
        raise FileError(name, f"cannot be read: {reason_of(error)}") from error


def as_pixels(data: bytes) -> np.ndarray:
    """Returns bytes as opaque pixels, uint8 RGBA (h, w, 4); `as_bytes` is the inverse."""
    told = len(data).to_bytes(_LENGTH, "little") + data
    height = -(-len(told) // (_A_PIXEL * _WIDTH))
    out = np.full((height, _WIDTH, 4), 255, np.uint8)
    room = np.zeros(height * _WIDTH * _A_PIXEL, np.uint8)
    room[: len(told)] = np.frombuffer(told, np.uint8)
    out[:, :, :_A_PIXEL] = room.reshape(height, _WIDTH, _A_PIXEL)
    return out


def as_bytes(pixels: Raster) -> bytes | None:
    """Returns the bytes that pixels hold; None where they hold none."""
    height, width, _ = pixels.shape
    if width != _WIDTH or pixels.dtype != np.uint8:
        return None
    told = pixels[0:height, 0:width][:, :, :_A_PIXEL].tobytes()
    length = int.from_bytes(told[:_LENGTH], "little")
    return told[_LENGTH : _LENGTH + length] if length <= len(told) - _LENGTH else None
