"""PNG out and in: against Pillow, the plain form of the filters, and files that lie."""

import contextlib
import io
import struct
import zlib

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from PIL import Image

from engine.files import png_reader, png_writer
from engine.files.fault import FileError
from engine.files.limits import Limits
from engine.files.png_reader import PngReader
from engine.files.png_writer import PngWriter, write_png


def image(height, width, channels, dtype=np.uint8):
    """Smooth with a noisy corner, so that both filters are chosen."""
    y, x = np.mgrid[0:height, 0:width]
    top = np.iinfo(dtype).max
    planes = [(x * (k + 3) + y * 5 * (k + 1)) * (top // 255) % (top + 1) for k in range(channels)]
    out = np.stack(planes, axis=-1).astype(dtype)
    rng = np.random.default_rng(height * width)
    out[: height // 2, : width // 2] = rng.integers(0, top + 1, out[: height // 2, : width // 2].shape)
    return out


def encoded(pixels):
    file = io.BytesIO()
    write_png(file, pixels)
    return file.getvalue()


def decoded(data, limits=None):
    return PngReader(io.BytesIO(data), "a.png", *([limits] if limits else [])).read()


@pytest.mark.parametrize("size", [(1, 1), (1, 7), (7, 1), (3, 2), (129, 257)])
@pytest.mark.parametrize("channels", [1, 2, 3, 4])
def test_written_8_bit_is_what_pillow_reads(size, channels):
    pixels = image(*size, channels)
    shown = np.asarray(Image.open(io.BytesIO(encoded(pixels)))).reshape(pixels.shape)
    assert np.array_equal(shown, pixels)


@pytest.mark.parametrize("size", [(1, 1), (5, 3), (70, 131)])
@pytest.mark.parametrize("channels", [1, 2, 3, 4])
def test_16_bit_round_trip_keeps_every_bit(size, channels):
    pixels = image(*size, channels, np.uint16)
    back = decoded(encoded(pixels))
    assert back.dtype == np.uint16
    assert np.array_equal(back[:, :, : min(channels, 3) or 1][:, :, :1], pixels[:, :, :1])
    if channels in (2, 4):
        assert np.array_equal(back[:, :, 3], pixels[:, :, -1])
    else:
        assert (back[:, :, 3] == 65535).all()
    if channels >= 3:
        assert np.array_equal(back[:, :, :3], pixels[:, :, :3])


def test_rows_may_come_in_any_strips():
    pixels = image(57, 33, 4)
    file = io.BytesIO()
    writer = PngWriter(file, 33, 57)
    for part in np.split(pixels, [1, 2, 20, 20, 56]):
        writer.rows(part)
    writer.close()
    assert np.array_equal(decoded(file.getvalue()), pixels)


def test_colour_chunks():
    eight, sixteen = encoded(image(2, 2, 4)), encoded(image(2, 2, 4, np.uint16))
    assert b"sRGB" in eight[:60]
    assert b"iCCP" not in eight
    profile = Image.open(io.BytesIO(sixteen)).info["icc_profile"]
    assert profile == png_writer.srgb_profile()
    assert profile[36:40] == b"acsp"
    assert b"sRGB" not in sixteen.split(b"iCCP")[0]


def test_wrong_rows_are_a_programming_error():
    writer = PngWriter(io.BytesIO(), 4, 4)
    for bad in (np.zeros((1, 4, 3), np.uint8), np.zeros((1, 4, 4), np.uint16), np.zeros((5, 4, 4), np.uint8)):
        with pytest.raises(ValueError, match="expected"):
            writer.rows(bad)
    with pytest.raises(ValueError, match="missing"):
        writer.close()
    with pytest.raises(ValueError, match="expected 1 to"):
        PngWriter(io.BytesIO(), 0, 4)


# ---- filters against their plain form ----


def plain_unfilter(raw, before, step):
    """Section 9.2 of the standard, byte by byte."""
    out = []
    above = before.tolist()
    for line in raw.tolist():
        kind, row = line[0], list(line[1:])
        for i in range(len(row)):
            a = row[i - step] if i >= step else 0
            b = above[i]
            c = above[i - step] if i >= step else 0
            p = a + b - c
            paeth = min((abs(p - a), 0, a), (abs(p - b), 1, b), (abs(p - c), 2, c))[2]
            row[i] = (row[i] + (0, a, b, (a + b) // 2, paeth)[kind]) % 256
        out.append(row)
        above = row
    return np.array(out, np.uint8)


@settings(deadline=None, max_examples=40)
@given(st.integers(1, 6), st.integers(1, 9), st.sampled_from([1, 2, 3, 4, 6, 8]), st.integers(0, 2**32))
def test_unfilter_is_the_plain_form(count, width, step, seed):
    rng = np.random.default_rng(seed)
    raw = rng.integers(0, 256, (count, width * step + 1)).astype(np.uint8)
    raw[:, 0] = rng.integers(0, 5, count)
    before = rng.integers(0, 256, width * step).astype(np.uint8)
    expected = plain_unfilter(raw, before, step)
    assert png_reader._unfilter(raw, before, step) == count
    assert np.array_equal(raw[:, 1:], expected)


@settings(deadline=None, max_examples=40)
@given(st.integers(1, 6), st.integers(1, 9), st.sampled_from([1, 2, 3, 4, 6, 8]), st.integers(0, 2**32))
def test_filter_is_undone(count, width, step, seed):
    rng = np.random.default_rng(seed)
    rows = rng.integers(0, rng.choice([2, 256]), (count, width * step)).astype(np.uint8)
    before = rng.integers(0, 256, width * step).astype(np.uint8)
    out = np.empty((count, width * step + 1), np.uint8)
    png_writer._filter(rows, before, step, out)
    assert np.array_equal(plain_unfilter(out, before, step), rows)


# ---- all kinds that others write ----


def png(width, height, depth, colour, rows, interlace=0, extra=b""):
    """A PNG put together by hand; `rows` are the filtered bytes."""
    header = struct.pack(">IIBBBBB", width, height, depth, colour, 0, 0, interlace)
    return png_writer.SIGNATURE + chunk(b"IHDR", header) + extra + chunk(b"IDAT", zlib.compress(rows)) + END


def chunk(kind, data):
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


END = chunk(b"IEND", b"")


@pytest.mark.parametrize("depth", [1, 2, 4])
def test_small_depths_are_scaled(depth):
    data = png(3, 1, depth, 0, bytes([0, 0b00011011 if depth == 2 else 0b10100000 if depth == 1 else 0x0F, 0xF0]))
    if depth != 4:
        data = png(3, 1, depth, 0, bytes([0, 0b00011011 if depth == 2 else 0b10100000]))
    expected = {1: [255, 0, 255], 2: [0, 85, 170], 4: [0, 255, 255]}[depth]
    assert decoded(data)[0, :, 0].tolist() == expected
    assert (decoded(data)[0, :, 3] == 255).all()


def test_palette_and_transparency():
    extra = chunk(b"PLTE", bytes([1, 2, 3, 4, 5, 6])) + chunk(b"tRNS", bytes([7]))
    assert decoded(png(3, 1, 8, 3, bytes([0, 0, 1, 9]), extra=extra)).tolist() == [
        [[1, 2, 3, 7], [4, 5, 6, 255], [0, 0, 0, 255]]
    ]
    grey = png(2, 1, 4, 0, bytes([0, 0x5F]), extra=chunk(b"tRNS", struct.pack(">H", 5)))
    assert decoded(grey)[0, :, 3].tolist() == [0, 255]
    rgb = png(2, 1, 8, 2, bytes([0, 1, 2, 3, 1, 2, 4]), extra=chunk(b"tRNS", struct.pack(">HHH", 1, 2, 3)))
    assert decoded(rgb)[0, :, 3].tolist() == [0, 255]


@pytest.mark.parametrize("dtype", [np.uint8, np.uint16])
@pytest.mark.parametrize("size", [(1, 1), (3, 5), (8, 8), (33, 17)])
def test_interlaced(size, dtype):
    pixels = image(*size, 4, dtype)
    rows = b""
    for x, y, across, down in png_reader.ADAM7:
        for row in pixels[y::down, x::across]:
            if len(row):
                rows += b"\0" + row.astype(row.dtype.newbyteorder(">")).tobytes()
    data = png(size[1], size[0], 8 * pixels.itemsize, 6, rows, interlace=1)
    assert np.array_equal(decoded(data), pixels)


@pytest.mark.parametrize("mode", ["1", "L", "LA", "P", "RGB", "RGBA"])
def test_what_pillow_writes(mode):
    picture = Image.fromarray(image(37, 53, 4)).convert(mode)
    file = io.BytesIO()
    picture.save(file, "PNG")
    assert np.array_equal(decoded(file.getvalue()), np.asarray(picture.convert("RGBA")))


# ---- files that lie ----

GOOD = png(2, 2, 8, 6, bytes([0, *range(8), 0, *range(8)]))
HEADER = struct.pack(">IIBBBBB", 2, 2, 8, 6, 0, 0, 0)


def with_header(*fields):
    return png_writer.SIGNATURE + chunk(b"IHDR", struct.pack(">IIBBBBB", *fields)) + GOOD[33:]


HOSTILE = {
    "empty": (b"", "not a PNG"),
    "text": (b"%!PS-Adobe-3.0 EPSF", "not a PNG"),
    "zero width": (with_header(0, 2, 8, 6, 0, 0, 0), "0 x 2"),
    "two thousand million wide": (with_header(2**31, 1, 8, 6, 0, 0, 0), "expected 1 to"),
    "too many pixels": (with_header(100_000, 100_000, 8, 6, 0, 0, 0), "expected at most"),
    "colour type 5": (with_header(2, 2, 8, 5, 0, 0, 0), "colour type 5"),
    "RGB of 4 bits": (with_header(2, 2, 4, 2, 0, 0, 0), "does not exist"),
    "filter method 1": (with_header(2, 2, 8, 6, 0, 1, 0), "filter 1"),
    "no IHDR": (png_writer.SIGNATURE + GOOD[33:], "expected IHDR"),
    "bad IHDR checksum": (GOOD[:29] + b"\0\0\0\0" + GOOD[33:], "IHDR: checksum"),
    "bad IDAT checksum": (GOOD[:-16] + b"\0\0\0\0" + GOOD[-12:], "IDAT: checksum"),
    "no data": (GOOD[:33] + END, "no image data"),
    "no palette": (png(1, 1, 8, 3, b"\0\0"), "PLTE"),
    "palette of 4 bytes": (png(1, 1, 8, 3, b"\0\0", extra=chunk(b"PLTE", b"1234")), "do not fit"),
    "palette twice": (png(1, 1, 8, 3, b"\0\0", extra=2 * chunk(b"PLTE", b"123")), "twice"),
    "transparency of RGBA": (png(1, 1, 8, 6, b"\0\0", extra=chunk(b"tRNS", b"12")), "do not fit"),
    "huge palette": (png_writer.SIGNATURE + GOOD[8:33] + struct.pack(">I4s", 2**30, b"PLTE"), "at most"),
    "huge text": (png_writer.SIGNATURE + GOOD[8:33] + struct.pack(">I4s", 2**30, b"tEXt") + b"x", "ends inside"),
    "unknown critical chunk": (GOOD[:33] + chunk(b"ABCD", b"") + GOOD[33:], "must be understood"),
    "chunk type of digits": (GOOD[:33] + chunk(b"12\n4", b"") + GOOD[33:], "four letters"),
    "filter 7": (png(1, 2, 8, 6, bytes([0, 1, 2, 3, 4, 7, 1, 2, 3, 4])), "row 1: filter 7"),
    "too few rows": (png(2, 2, 8, 6, bytes([0, *range(8), 0, 1])), "ends in row 1"),
    "not deflate": (GOOD[:33] + chunk(b"IDAT", b"\x78\x01" + b"\xff" * 9) + END, "damaged"),
    "no zlib checksum": (GOOD[:33] + chunk(b"IDAT", zlib.compress(bytes(18))[:-4]) + END, "without its checksum"),
    "wrong zlib checksum": (GOOD[:33] + chunk(b"IDAT", zlib.compress(bytes(18))[:-1] + b"x") + END, "damaged"),
    "no IEND": (GOOD[:-12], "ends inside"),
}


@pytest.mark.parametrize("name", HOSTILE)
def test_hostile(name):
    data, expected = HOSTILE[name]
    with pytest.raises(FileError) as caught:
        decoded(data)
    assert str(caught.value).startswith("a.png: ")
    assert expected in str(caught.value)
    assert str(caught.value).isprintable()


def test_every_truncation_is_refused():
    data = encoded(image(9, 7, 4))
    for length in range(len(data)):
        with pytest.raises(FileError):
            decoded(data[:length])


@settings(deadline=None, max_examples=150)
@given(st.data())
def test_flipped_bits_raise_nothing_else(data):
    good = bytearray(encoded(image(6, 5, 4)))
    for _ in range(data.draw(st.integers(1, 3))):
        bit = data.draw(st.integers(0, 8 * len(good) - 1))
        good[bit // 8] ^= 1 << bit % 8
    with contextlib.suppress(FileError):
        decoded(bytes(good), Limits(pixels=1 << 20))


def test_a_bomb_costs_no_memory():
    """20,000 x 20,000 in 1.6 MB; read in strips, it never takes more than a few strips."""
    import tracemalloc

    header = struct.pack(">IIBBBBB", 20_000, 20_000, 8, 6, 0, 0, 0)
    body = zlib.compress(bytes(80_001 * 200), 9)
    data = png_writer.SIGNATURE + chunk(b"IHDR", header) + chunk(b"IDAT", body) + END
    tracemalloc.start()
    try:
        with pytest.raises(FileError, match="ends in row 200 of 20000"):
            for _ in PngReader(io.BytesIO(data), "bomb.png").strips():
                pass
        assert tracemalloc.get_traced_memory()[1] < 16 << 20
    finally:
        tracemalloc.stop()


def test_extra_data_and_chunks_are_passed_over():
    rows = bytes([0, *range(8), 0, *range(8)])
    data = png(2, 2, 8, 6, rows + bytes(1000), extra=chunk(b"tEXt", b"k\0v"))
    assert decoded(data).shape == (2, 2, 4)
    assert decoded(data + b"after the end").shape == (2, 2, 4)


@pytest.mark.parametrize("grain", [0, 3])
def test_small_files_hold_the_same_pixels(grain):
    """Grainy pictures get smaller than by a search for matches, smooth ones do not get larger."""
    rng = np.random.default_rng(1)
    smooth = np.linspace(0, 255, 300 * 400 * 4).reshape(300, 400, 4)
    pixels = np.clip(smooth + rng.normal(0, grain, smooth.shape).round(), 0, 255).astype(np.uint8)
    sizes = []
    for small in (False, True):
        file = io.BytesIO()
        writer = PngWriter(file, 400, 300, small=small)
        writer.rows(pixels[:100])
        writer.rows(pixels[100:])
        writer.close()
        assert (np.asarray(Image.open(io.BytesIO(file.getvalue()))) == pixels).all()
        sizes.append(len(file.getvalue()))
    assert sizes[1] < 0.98 * sizes[0] if grain else sizes[1] <= sizes[0]
