"""Reading the TIFF (TIFF 6.0 and BigTIFF) that paint programs and cameras write, 16 bits kept, every claim checked.

Done here: grey and RGB of 8 or 16 bits, with or without alpha, uncompressed or deflated, in strips or tiles, both
byte orders.  `Layout.ours` is False for everything else.

tifffile, which writes ours, does not read them: without imagecodecs it inflates a strip to whatever its bytes hold
before it looks at how large the strip may be.  Here no more is held than the checked size.
"""

from __future__ import annotations

import io
import struct
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import BinaryIO

import numpy as np

from engine.files.fault import FileError
from engine.files.inflate import PIECE, DeflateError, Inflated
from engine.files.limits import LIMITS, Limits

# TIFF 6.0, page 117 ff: the tags that are looked at.
TAGS = {
    256: "ImageWidth", 257: "ImageLength", 258: "BitsPerSample", 259: "Compression", 262: "Photometric",
    273: "StripOffsets", 274: "Orientation", 277: "SamplesPerPixel", 278: "RowsPerStrip", 279: "StripByteCounts",
    284: "PlanarConfiguration", 317: "Predictor", 322: "TileWidth", 323: "TileLength", 324: "TileOffsets",
    325: "TileByteCounts", 338: "ExtraSamples", 339: "SampleFormat", 34675: "ICCProfile",
}  # fmt: skip
# Field types that are kept: BYTE, SHORT, LONG, UNDEFINED, IFD, LONG8.
WHOLE_NUMBERS = {1: "B", 3: "H", 4: "I", 7: "B", 13: "I", 16: "Q"}
_KINDS = ("u1", "u2", "u4", "i1", "i2", "i4", "f2", "f4", "f8")
MAX_TAGS = 4096
NONE, DEFLATE = 1, (8, 32946)
UNSIGNED = 1
_LETTERS = {UNSIGNED: "u", 2: "i", 3: "f"}  # of the formats of samples
_FLOAT_PREDICTOR = 3  # bytes by significance, then differences
ASSOCIATED, UNASSOCIATED = 1, 2


@dataclass(frozen=True)
class Layout:
    """The first picture of a file: `tags` by name, `order` "<" or ">"."""

    name: str
    order: str
    tags: dict[str, tuple[int, ...]]

    def one(self, tag: str, default: int | None = None) -> int:
        """Gives the single value of a tag; `default` where it is missing.  FileError if there is none, or several."""
        values = self.tags.get(tag, ())
        if not values:
            if default is None:
                raise FileError(self.name, f"no tag {tag}")
            return default
        return values[0]

    @property
    def size(self) -> tuple[int, int]:
        """Gives (width, height) in pixels."""
        return self.one("ImageWidth"), self.one("ImageLength")

    @property
    def bits(self) -> tuple[int, ...]:
        """Gives the bits of each sample."""
        return self.tags.get("BitsPerSample", (1,))

    @property
    def samples(self) -> int:
        """Counts the samples of a pixel."""
        return self.one("SamplesPerPixel", 1)

    @property
    def tiled(self) -> bool:
        """Tells whether pixels lie in tiles, not strips."""
        return "TileOffsets" in self.tags

    @property
    def ours(self) -> bool:
        """Tells whether `read_tiff` can decode it."""
        formats = self.tags.get("SampleFormat", (UNSIGNED,))
        colours = {1: 1, 2: 3}.get(self.one("Photometric", 99), 99)
        return (
            len(set(self.bits)) == 1
            and self.bits[0] in (8, 16)
            and set(formats) == {UNSIGNED}
            and colours <= self.samples <= colours + 1
            and self.one("PlanarConfiguration", 1) == 1
            and self.one("Predictor", 1) in (1, 2)
            and self.one("Compression", NONE) in (NONE, *DEFLATE)
        )

    @property
    def kind(self) -> np.dtype[np.generic] | None:
        """Gives what a sample is, in this machine's byte order; None for what is none of NumPy's."""
        letter = _LETTERS.get(self.one("SampleFormat", UNSIGNED), "")
        name = f"{letter}{self.bits[0] // 8}"
        alike = len(set(self.bits)) == 1 and self.bits[0] % 8 == 0
        return np.dtype(name) if alike and name in _KINDS else None

    @property
    def one_channel(self) -> bool:
        """Tells whether `read_channel` can decode it: numbers of any kind, one for each pixel."""
        predictor = self.one("Predictor", 1)
        return (
            self.kind is not None
            and self.samples == 1
            and predictor in ((1, _FLOAT_PREDICTOR) if self.kind.kind == "f" else (1, 2))
            and self.one("Compression", NONE) in (NONE, *DEFLATE)
        )


def read_layout(file: BinaryIO, name: str, limits: Limits = LIMITS) -> Layout:
    """Returns the tags of the first picture.  FileError if they are not sound or ask for too much."""
    size = file.seek(0, io.SEEK_END)
    file.seek(0)
    order, big, place = _start(file.read(16), name)
    width = 20 if big else 12
    head = _at(file, place, 8 if big else 2, size, name)
    (count,) = struct.unpack(order + ("Q" if big else "H"), head)
    if not 0 < count <= MAX_TAGS:
        raise FileError(name, f"found {count} tags, expected 1 to {MAX_TAGS}")
    table = _at(file, place + len(head), count * width, size, name)
    tags = {}
    for number in range(count):
        entry = table[number * width : (number + 1) * width]
        tag, kind = struct.unpack(order + "HH", entry[:4])
        if tag in TAGS and kind in WHOLE_NUMBERS:
            tags[TAGS[tag]] = _values(file, name, entry, (order, big, size))
    layout = Layout(name, order, tags)
    across, down = layout.size
    if not (0 < across <= limits.side and 0 < down <= limits.side and across * down <= limits.pixels):
        raise FileError(
            name, f"{across} x {down} pixels; expected 1 to {limits.side} each way, at most {limits.pixels} in all"
        )
    return layout


def _start(head: bytes, name: str) -> tuple[str, bool, int]:
    """Byte order, whether it is BigTIFF, and where the first table stands."""
    order = {b"II": "<", b"MM": ">"}.get(head[:2])
    if order is None or len(head) < 8:
        raise FileError(name, "not a TIFF, or it ends after its first bytes")
    (version,) = struct.unpack(order + "H", head[2:4])
    if version == 42:
        return order, False, struct.unpack(order + "I", head[4:8])[0]
    if version == 43 and len(head) == 16:
        return order, True, struct.unpack(order + "Q", head[8:16])[0]
    raise FileError(name, f"TIFF version {version}; expected 42 or 43")


def _at(file: BinaryIO, place: int, count: int, size: int, name: str) -> bytes:
    if place + count > size:
        raise FileError(name, f"ends at byte {size}; expected {count} bytes at {place}")
    file.seek(place)
    data = file.read(count)
    if len(data) != count:
        raise FileError(name, f"ends inside {count} bytes at {place}")
    return data


def _values(file: BinaryIO, name: str, entry: bytes, form: tuple[str, bool, int]) -> tuple[int, ...]:
    order, big, size = form
    letter = WHOLE_NUMBERS[struct.unpack(order + "H", entry[2:4])[0]]
    (count,) = struct.unpack(order + ("Q" if big else "I"), entry[4:12] if big else entry[4:8])
    inline = entry[12:] if big else entry[8:]
    length = count * struct.calcsize(letter)
    if length > len(inline):
        (place,) = struct.unpack(order + ("Q" if big else "I"), inline)
        inline = _at(file, place, length, size, name)
    return struct.unpack(f"{order}{count}{letter}", inline[:length])


def read_tiff(file: BinaryIO, layout: Layout, progress: Callable[[float], None] | None = None) -> np.ndarray:
    """Returns the picture as uint8 or uint16 RGBA (height, width, 4), alpha not premultiplied, as stored (not turned).

    `layout.ours` must hold.  FileError if a strip or tile is missing, short or damaged.
    """
    width, height = layout.size
    image = np.empty((height, width, 4), np.uint8 if layout.bits[0] == 8 else np.uint16)
    done = 0
    for (top, left), block in _blocks(file, layout):
        place = image[top : top + len(block), left : left + block.shape[1]]
        _place(block[: len(place), : place.shape[1]], layout, place)
        done += place.size
        if progress:
            progress(done / image.size)
    return image


def read_channel(file: BinaryIO, layout: Layout) -> np.ndarray:
    """Returns the numbers of a picture of one channel, of its own kind: (height, width), as stored.

    `layout.one_channel` must hold.  FileError as `read_tiff`.
    """
    width, height = layout.size
    out = np.empty((height, width), layout.kind)
    for (top, left), block in _blocks(file, layout):
        place = out[top : top + len(block), left : left + block.shape[1]]
        place[...] = block[: len(place), : place.shape[1], 0]
    return out


def _blocks(file: BinaryIO, layout: Layout) -> Iterator[tuple[tuple[int, int], np.ndarray]]:
    """(top, left) and samples (rows, columns, samples) of each strip or tile."""
    width, height = layout.size
    kind = "Tile" if layout.tiled else "Strip"
    across = layout.one("TileWidth") if layout.tiled else width
    down = layout.one("TileLength") if layout.tiled else min(height, layout.one("RowsPerStrip", height))
    if not (0 < across <= 2 * LIMITS.side and 0 < down <= 2 * LIMITS.side):
        raise FileError(layout.name, f"{kind.lower()}s of {across} x {down} pixels")
    if across * down * layout.samples > 4 * LIMITS.pixels:
        raise FileError(layout.name, f"{kind.lower()}s of {across} x {down} pixels")
    places = [(y, x) for y in range(0, height, down) for x in range(0, width, across)]
    offsets, counts = layout.tags.get(f"{kind}Offsets", ()), layout.tags.get(f"{kind}ByteCounts", ())
    if len(offsets) != len(places) or len(counts) != len(places):
        found = f"{len(offsets)} offsets and {len(counts)} lengths"
        raise FileError(layout.name, f"{found} of {kind.lower()}s, expected {len(places)} of each")
    size = file.seek(0, io.SEEK_END)
    for number, (top, left) in enumerate(places):
        rows = down if layout.tiled else min(down, height - top)
        where = f"{kind.lower()} {number}"
        if offsets[number] + counts[number] > size:
            raise FileError(layout.name, f"{where} lies beyond the end of the file")
        file.seek(offsets[number])
        yield (top, left), _block(file, counts[number], layout, (rows, across, where))


def _block(file: BinaryIO, count: int, layout: Layout, form: tuple[int, int, str]) -> np.ndarray:
    rows, across, where = form
    kept = layout.kind
    assert kept is not None
    raw = np.empty(rows * across * layout.samples * kept.itemsize, np.uint8)
    pieces = _pieces(file, count)
    try:
        if layout.one("Compression", NONE) == NONE:
            data = b"".join(pieces) if count <= raw.size else file.read(raw.size)
            filled = len(data)
            raw[:filled] = np.frombuffer(data, np.uint8)
        else:
            filled = Inflated(pieces).readinto(raw.data)
    except DeflateError as error:
        raise FileError(layout.name, f"{where}: damaged ({error})") from error
    if filled != raw.size:
        raise FileError(layout.name, f"{where}: found {filled} bytes of pixels, expected {raw.size}")
    if layout.one("Predictor", 1) == _FLOAT_PREDICTOR:
        bands = np.cumsum(raw.reshape(rows, -1), axis=1, dtype=np.uint8).reshape(rows, kept.itemsize, across)
        return np.ascontiguousarray(bands.swapaxes(1, 2)).view(kept.newbyteorder(">")).astype(kept)
    block = (
        raw.view(kept.newbyteorder("<" if layout.order == "<" else ">"))
        .astype(kept)
        .reshape(rows, across, layout.samples)
    )
    if layout.one("Predictor", 1) == 2:
        np.cumsum(block, axis=1, dtype=kept, out=block)
    return block


def _pieces(file: BinaryIO, count: int) -> Iterator[bytes]:
    while count:
        piece = file.read(min(count, PIECE))
        if not piece:
            return
        count -= len(piece)
        yield piece


def _place(block: np.ndarray, layout: Layout, out: np.ndarray) -> None:
    """Writes samples (n, m, samples) as RGBA into `out` (n, m, 4)."""
    full = np.iinfo(out.dtype).max
    grey = layout.one("Photometric") == 1
    colours = 1 if grey else 3
    out[:, :, :3] = block[:, :, :colours]
    if layout.samples == colours:
        out[:, :, 3] = full
        return
    kind = layout.one("ExtraSamples", UNASSOCIATED)
    out[:, :, 3] = block[:, :, colours] if kind in (ASSOCIATED, UNASSOCIATED) else full
    if kind == ASSOCIATED:
        alpha = np.maximum(out[:, :, 3:].astype(np.float32), 1)
        out[:, :, :3] = np.minimum(np.rint(out[:, :, :3] * (full / alpha)), full)
