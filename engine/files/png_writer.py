"""Writing PNG (ISO/IEC 15948) row by row in constant memory.

Each row is filtered by `sub` or `up`, whichever leaves the smaller sum of absolute differences (section 12.8), and
deflated by isal at level 2: several times the speed of zlib at about the same size.
"""

from __future__ import annotations

import functools
import struct
import zlib
from typing import Any, BinaryIO

import numpy as np
from isal import isal_zlib

from engine.numeric.kernel import kernel

SIGNATURE = b"\x89PNG\r\n\x1a\n"
COLOUR_TYPES = {1: 0, 2: 4, 3: 2, 4: 6}  # channels -> colour type: grey, grey + alpha, RGB, RGBA
STRIP = 1 << 20  # bytes filtered and deflated at a time
LEVEL = 2


@kernel
def _filter(rows: np.ndarray, before: np.ndarray, step: int, out: np.ndarray) -> None:
    """Filters `rows` uint8 (n, stride) into `out` (n, stride + 1); `before` is the row above the first."""
    count, stride = rows.shape
    for y in range(count):
        row = rows[y]
        above = before if y == 0 else rows[y - 1]
        line = out[y, 1:]
        left = row[: stride - step]
        here = row[step:]
        by_sub = np.int64(0)
        for i in range(stride - step):
            ahead = np.uint8(here[i] - left[i])
            by_sub += min(ahead, np.uint8(-ahead))
        for i in range(step):
            by_sub += min(row[i], np.uint8(-row[i]))
        by_up = np.int64(0)
        for i in range(stride):
            below = np.uint8(row[i] - above[i])
            by_up += min(below, np.uint8(-below))
        if by_up < by_sub:
            out[y, 0] = 2
            for i in range(stride):
                line[i] = np.uint8(row[i] - above[i])
        else:
            out[y, 0] = 1
            for i in range(step):
                line[i] = row[i]
            rest = line[step:]
            for i in range(stride - step):
                rest[i] = np.uint8(here[i] - left[i])


@functools.cache
def srgb_profile() -> bytes:
    """Returns a small ICC profile of sRGB, the same bytes every time.

    Krita asks the user about every 16-bit PNG without one.
    """
    from PIL import ImageCms

    profile = bytearray(ImageCms.ImageCmsProfile(ImageCms.createProfile("sRGB")).tobytes())
    profile[24:36] = struct.pack(">6H", 2000, 1, 1, 0, 0, 0)  # the date of making
    return bytes(profile)


class PngWriter:
    """A PNG of known size, written from the top in strips of rows.

    Channels: 1 grey, 2 grey + alpha, 3 RGB, 4 RGBA (alpha not premultiplied); depth 8 or 16.  8-bit files carry an
    sRGB chunk, 16-bit ones the sRGB profile.  `file` needs only `write`.  Call `close` after the last row.
    `small`: takes up to four times as long if that makes a smaller file; `colours`: False for numbers that are none,
    which no profile may change.
    """

    def __init__(
        self,
        file: BinaryIO,
        width: int,
        height: int,
        channels: int = 4,
        depth: int = 8,
        small: bool = False,
        colours: bool = True,
    ) -> None:
        if not (0 < width < 1 << 31 and 0 < height < 1 << 31):
            raise ValueError(f"PNG size {width} x {height}; expected 1 to 2^31 - 1 each way")
        if channels not in COLOUR_TYPES or depth not in (8, 16):
            raise ValueError(f"PNG with {channels} channels of {depth} bits; expected 1 to 4 of 8 or 16")
        self.width, self.height, self.channels, self.depth = width, height, channels, depth
        self._file = file
        self._left = height
        self._step = channels * depth // 8
        self._above = np.zeros(width * self._step, np.uint8)
        self._deflate = None if small else isal_zlib.compressobj(LEVEL)
        file.write(SIGNATURE)
        self._chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, depth, COLOUR_TYPES[channels], 0, 0, 0))
        if not colours:
            return
        if depth == 8:
            self._chunk(b"sRGB", b"\0")
        else:
            self._chunk(b"iCCP", b"sRGB\0\0" + zlib.compress(srgb_profile(), 9))

    def rows(self, strip: np.ndarray) -> None:
        """Appends rows: uint8 or uint16 (n, width, channels), matching the depth."""
        wanted = np.uint8 if self.depth == 8 else np.uint16
        if strip.shape[1:] != (self.width, self.channels) or strip.dtype != wanted or len(strip) > self._left:
            raise ValueError(
                f"rows {strip.dtype} {strip.shape}; expected {np.dtype(wanted)} (n <= {self._left}, {self.width}, "
                f"{self.channels})"
            )
        self._left -= len(strip)
        step = max(1, STRIP // len(self._above))
        for start in range(0, len(strip), step):
            part = strip[start : start + step]
            plain = part.astype(">u2").view(np.uint8) if self.depth == 16 else np.ascontiguousarray(part)
            self._put(plain.reshape(len(part), -1))

    def _put(self, rows: np.ndarray) -> None:
        out = np.empty((len(rows), rows.shape[1] + 1), np.uint8)
        _filter(rows, self._above, self._step, out)
        self._above = rows[-1].copy()
        if self._deflate is None:
            self._deflate = _smaller(out)
        self._data(self._deflate.compress(out.data))

    def close(self) -> None:
        """Ends the file; ValueError if rows are missing."""
        if self._left:
            raise ValueError(f"PNG closed with {self._left} of {self.height} rows missing")
        assert self._deflate is not None
        self._data(self._deflate.flush())
        self._chunk(b"IEND", b"")

    def _data(self, data: bytes) -> None:
        if data:
            self._chunk(b"IDAT", data)

    def _chunk(self, kind: bytes, data: bytes) -> None:
        check = isal_zlib.crc32(data, isal_zlib.crc32(kind))
        self._file.write(struct.pack(">I", len(data)) + kind)
        self._file.write(data)
        self._file.write(struct.pack(">I", check))


def _smaller(sample: np.ndarray) -> Any:
    """Returns the compressor that makes less of the first rows.

    In grainy pictures the short matches that a fast search finds cost more than the letters they replace: Huffman
    codes alone make files a quarter smaller.
    """
    letters, matches = zlib.compressobj(1, strategy=zlib.Z_HUFFMAN_ONLY), isal_zlib.compressobj(LEVEL)
    sizes = [len(c.compress(sample.data)) + len(c.flush()) for c in (letters, matches)]
    if sizes[0] < sizes[1]:
        return zlib.compressobj(1, strategy=zlib.Z_HUFFMAN_ONLY)
    return isal_zlib.compressobj(LEVEL)


def write_png(file: BinaryIO, pixels: np.ndarray) -> None:
    """Writes a whole image: uint8 or uint16 (height, width, channels)."""
    height, width, channels = pixels.shape
    writer = PngWriter(file, width, height, channels, 8 * pixels.dtype.itemsize)
    writer.rows(pixels)
    writer.close()
