"""Reading PNG (ISO/IEC 15948) from anywhere: every kind, 16 bits kept, in strips, every claim checked first.

Checksums of IHDR, PLTE, tRNS, IDAT and IEND must hold; other chunks are skipped unread, as they cannot change the
values.  Colour profiles are not applied: the numbers are given as they are, and the profile beside them.
"""

from __future__ import annotations

import struct
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import BinaryIO

import numpy as np

from engine.files.fault import shown
from engine.files.inflate import DeflateError, Inflated
from engine.files.limits import LIMITS, Limits
from engine.files.png_chunks import Chunks
from engine.files.png_writer import SIGNATURE
from engine.numeric.kernel import inner, kernel
from engine.numeric.parted import Raster

CHANNELS = {0: 1, 2: 3, 3: 1, 4: 2, 6: 4}
DEPTHS = {0: (1, 2, 4, 8, 16), 2: (8, 16), 3: (1, 2, 4, 8), 4: (8, 16), 6: (8, 16)}
# Section 8.2: first column, first row, column step, row step of each of the seven passes.
ADAM7 = (
    (0, 0, 8, 8), (4, 0, 8, 8), (0, 4, 4, 8), (2, 0, 4, 4), (0, 2, 2, 4), (1, 0, 2, 2), (0, 1, 1, 2),
)  # fmt: skip
STRIP = 1 << 20
FOREIGN_PROFILE = "its colour profile is not applied"
_LARGEST_ICCP = 1 << 22  # bytes, deflated
_LARGEST_PROFILE = 1 << 24  # bytes


@dataclass(frozen=True)
class Header:
    """What IHDR says, and what stands before the image data."""

    width: int
    height: int
    depth: int  # bits per sample
    colour: int  # colour type: 0 grey, 2 RGB, 3 palette, 4 grey + alpha, 6 RGBA
    interlaced: bool
    palette: bytes = b""
    transparency: bytes = b""
    notes: tuple[str, ...] = ()
    deflated: bytes = b""  # the profile of its colours, where they are not sRGB

    @property
    def dtype(self) -> np.dtype:
        """Gives the type of a decoded sample: uint8, or uint16 for 16 bits."""
        return np.dtype(np.uint16 if self.depth == 16 else np.uint8)

    @property
    def profile(self) -> bytes:
        """Gives the profile of its colours, where they are not sRGB; nothing where it is damaged."""
        room = memoryview(bytearray(min(_LARGEST_PROFILE, 1032 * len(self.deflated) + 64)))
        try:
            return bytes(room[: Inflated(iter((self.deflated,))).readinto(room)]) if self.deflated else b""
        except DeflateError:
            return b""

    def stride(self, width: int) -> int:
        """Returns bytes in an unfiltered row of `width` pixels."""
        return (width * self.depth * CHANNELS[self.colour] + 7) // 8


@inner
def _add_paeth(row: np.ndarray, above: np.ndarray, step: int) -> None:
    """Adds the Paeth predictor (section 9.4) to a row in place."""
    for i in range(min(step, row.size)):
        row[i] = np.uint8(row[i] + above[i])
    for i in range(step, row.size):
        a = np.int32(row[i - step])
        b = np.int32(above[i])
        c = np.int32(above[i - step])
        pa = abs(b - c)
        pb = abs(a - c)
        pc = abs(a + b - c - c)
        nearest = a
        if pb < pa and pb <= pc:
            nearest = b
        elif pc < pa and pc < pb:
            nearest = c
        row[i] = np.uint8(row[i] + nearest)


@kernel
def _unfilter(raw: np.ndarray, before: np.ndarray, step: int) -> int:
    """Undoes the filters of `raw` uint8 (n, 1 + stride) in place (section 9.2); `before` is the row above (stride).

    Gives the number of rows done: fewer than n if a row names no known filter.
    """
    for y in range(raw.shape[0]):
        kind = raw[y, 0]
        row = raw[y, 1:]
        above = before if y == 0 else raw[y - 1, 1:]
        if kind == 1:
            for i in range(step, row.size):
                row[i] = np.uint8(row[i] + row[i - step])
        elif kind == 2:
            for i in range(row.size):
                row[i] = np.uint8(row[i] + above[i])
        elif kind == 3:
            for i in range(min(step, row.size)):
                row[i] = np.uint8(row[i] + (above[i] >> 1))
            for i in range(step, row.size):
                row[i] = np.uint8(row[i] + ((np.int32(row[i - step]) + np.int32(above[i])) >> 1))
        elif kind == 4:
            _add_paeth(row, above, step)
        elif kind != 0:
            return y
    return raw.shape[0]  # type: ignore[no-any-return]


class PngReader:
    """A PNG being read.  `file` needs only `read`; `name` stands in the messages.  FileError on any fault."""

    def __init__(self, file: BinaryIO, name: str, limits: Limits = LIMITS) -> None:
        self._limits = limits
        self._chunks = Chunks(file, name, limits)
        self._data_left = 0  # bytes of the first IDAT chunk
        found = file.read(len(SIGNATURE))
        if found != SIGNATURE:
            raise self._chunks.fail(f"not a PNG: starts with {shown(found)}")
        self.header = self._read_header()

    # ---- the part before the image data ----

    def _read_header(self) -> Header:
        kind, length = self._chunks.head()
        if kind != b"IHDR" or length != 13:
            raise self._chunks.fail(f"chunk 1: found {shown(kind)} of {length} bytes, expected IHDR of 13")
        width, height, depth, colour, method, filtering, interlace = struct.unpack(
            ">IIBBBBB", self._chunks.body(kind, 13)
        )
        self._check_size(width, height, interlace != 0)
        if colour not in DEPTHS or depth not in DEPTHS[colour]:
            raise self._chunks.fail(f"chunk IHDR: colour type {colour} with {depth} bits does not exist")
        if method or filtering or interlace > 1:
            raise self._chunks.fail(
                f"chunk IHDR: compression {method}, filter {filtering}, interlace {interlace}; expected 0, 0, 0 or 1"
            )
        found_before = self._before_data(colour)
        palette, transparency = found_before.get(b"PLTE", b""), found_before.get(b"tRNS", b"")
        if colour == 3 and not palette:
            raise self._chunks.fail("image data before the palette; expected chunk PLTE")
        title, _, deflated = found_before.get(b"iCCP", b"sRGB").partition(b"\0")
        told = width, height, depth, colour, interlace == 1, palette, transparency
        return Header(*told) if b"sRGB" in title else Header(*told, (FOREIGN_PROFILE,), deflated[1:])

    def _check_size(self, width: int, height: int, whole: bool) -> None:
        """`whole`: it can only be decoded in one piece."""
        limits = self._limits
        most = min(limits.pixels, LIMITS.pixels) if whole else limits.pixels
        if not (0 < width <= limits.side and 0 < height <= limits.side):
            raise self._chunks.fail(f"chunk IHDR: {width} x {height} pixels; expected 1 to {limits.side} each way")
        if width * height > most:
            raise self._chunks.fail(f"chunk IHDR: {width} x {height} pixels; expected at most {most} in all")

    def _before_data(self, colour: int) -> dict[bytes, bytes]:
        kept: dict[bytes, bytes] = {}
        while True:
            kind, length = self._chunks.head()
            if kind == b"IDAT":
                self._data_left = length
                return kept
            if kind in (b"PLTE", b"tRNS"):
                if kind in kept:
                    raise self._chunks.fail(f"chunk {kind.decode()} twice")
                kept[kind] = self._chunks.body(kind, length)
                self._check_body(kind, kept[kind], colour)
            elif kind == b"IEND":
                raise self._chunks.fail("no image data; expected chunk IDAT before IEND")
            elif not kind[0] & 0x20:
                raise self._chunks.fail(f"chunk {kind.decode()}: a kind that must be understood, and is not known")
            else:
                if kind == b"iCCP":
                    kept[kind] = self._chunks.exactly(min(length, _LARGEST_ICCP), "chunk iCCP")
                    length -= len(kept[kind])
                self._chunks.skip(kind, length)

    def _check_body(self, kind: bytes, data: bytes, colour: int) -> None:
        if kind == b"PLTE":
            good = len(data) % 3 == 0 and 0 < len(data) <= 768
        else:
            good = {0: len(data) == 2, 2: len(data) == 6, 3: 0 < len(data) <= 256}.get(colour, False)
        if not good:
            raise self._chunks.fail(f"chunk {kind.decode()}: {len(data)} bytes do not fit colour type {colour}")

    # ---- the image data ----

    def strips(self) -> Iterator[np.ndarray]:
        """Yields the rows from the top as uint8 or uint16 RGBA (n, width, 4), n as suits; interlaced images in one
        piece.

        May be called once.  A fault in the file's last bytes comes after the last strip.
        """
        header = self.header
        pieces = self._chunks.data(self._data_left)
        data = Inflated(pieces)
        try:
            if header.interlaced:
                yield self._interlaced(data)
            else:
                for samples in self._rows(data, header.width, header.height):
                    yield to_rgba(samples, header)
            complete = data.finish()
            for _ in pieces:  # whatever the stream did not need must still be whole
                pass
        except DeflateError as error:
            raise self._chunks.fail(f"chunk IDAT: damaged image data ({error})") from error
        if not complete:
            raise self._chunks.fail("chunk IDAT: the image data ends without its checksum")

    def _rows(self, data: Inflated, width: int, height: int) -> Iterator[np.ndarray]:
        """Unfiltered samples (n, width, channels) of one pass."""
        header = self.header
        stride = header.stride(width)
        step = max(1, header.depth * CHANNELS[header.colour] // 8)
        above = np.zeros(stride, np.uint8)
        count = max(1, STRIP // (stride + 1))
        for top in range(0, height, count):
            raw = np.empty((min(count, height - top), stride + 1), np.uint8)
            filled = data.readinto(raw.reshape(-1).data)
            if filled != raw.size:
                row = top + filled // (stride + 1)
                raise self._chunks.fail(f"chunk IDAT: the image data ends in row {row} of {height}")
            good = _unfilter(raw, above, step)
            if good != len(raw):
                raise self._chunks.fail(f"row {top + good}: filter {raw[good, 0]}; expected 0 to 4")
            above = raw[-1, 1:].copy()
            yield unpacked(raw[:, 1:], width, header)

    def _interlaced(self, data: Inflated) -> np.ndarray:
        header = self.header
        image = np.empty((header.height, header.width, 4), header.dtype)
        for x, y, across, down in ADAM7:
            place = image[y::down, x::across]
            if place.size:
                row = 0
                for samples in self._rows(data, place.shape[1], place.shape[0]):
                    place[row : row + len(samples)] = to_rgba(samples, header)
                    row += len(samples)
        return image

    def read(self, progress: Callable[[float], None] | None = None) -> np.ndarray:
        """Returns the whole image: uint8 or uint16 RGBA (height, width, 4), alpha not premultiplied."""
        image = np.empty((self.header.height, self.header.width, 4), self.header.dtype)
        self.read_into(image, progress)
        return image

    def read_into(self, image: Raster, progress: Callable[[float], None] | None = None) -> None:
        """Puts the whole image, strip by strip, where there is room for it, of its shape and type."""
        row = 0
        for strip in self.strips():
            image[row : row + len(strip)] = strip
            row += len(strip)
            if progress:
                progress(row / self.header.height)


def unpacked(rows: np.ndarray, width: int, header: Header) -> np.ndarray:
    """Samples (n, width, channels) of unfiltered rows uint8 (n, stride): uint16 for 16 bits, else uint8, unscaled."""
    channels = CHANNELS[header.colour]
    if header.depth == 8:
        return rows.reshape(len(rows), width, channels)
    if header.depth == 16:
        return np.ascontiguousarray(rows).view(">u2").astype(np.uint16).reshape(len(rows), width, channels)
    per_byte = 8 // header.depth
    shifts = np.arange(per_byte - 1, -1, -1, dtype=np.uint8) * header.depth
    samples = (rows[:, :, None] >> shifts) & np.uint8((1 << header.depth) - 1)
    return samples.reshape(len(rows), -1)[:, :width, None]


def to_rgba(samples: np.ndarray, header: Header) -> np.ndarray:
    """RGBA (n, width, 4) of samples (n, width, channels), with palette and transparency applied."""
    if header.colour == 6:
        return samples
    if header.colour == 3:
        out: np.ndarray = _palette(header)[samples[:, :, 0]]
        return out
    rgba = np.empty((*samples.shape[:2], 4), header.dtype)
    full = (1 << header.depth) - 1
    scale = 255 // full if header.depth < 8 else 1
    rgba[:, :, :3] = samples[:, :, :3] if header.colour == 2 else samples[:, :, :1] * np.uint8(scale)
    if header.colour == 4:
        rgba[:, :, 3] = samples[:, :, 1]
        return rgba
    rgba[:, :, 3] = 255 if header.depth < 16 else 65535
    if header.transparency:
        key = np.frombuffer(header.transparency, ">u2").astype(np.uint16)
        rgba[(samples == key).all(axis=2), 3] = 0
    return rgba


def _palette(header: Header) -> np.ndarray:
    """256 RGBA entries; those that the file does not give are opaque black, as libpng has them."""
    table = np.zeros((256, 4), np.uint8)
    table[:, 3] = 255
    given = np.frombuffer(header.palette, np.uint8).reshape(-1, 3)
    table[: len(given), :3] = given
    table[: len(header.transparency), 3] = np.frombuffer(header.transparency, np.uint8)
    return table
