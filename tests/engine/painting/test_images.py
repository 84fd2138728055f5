"""Pictures in (PNG, JPEG, TIFF) and TIFF out, against Pillow and tifffile; and files that lie."""

import contextlib
import io
import os
import struct
import sys
import tracemalloc
import zlib

import numpy as np
import pytest
import tifffile
from hypothesis import given, settings
from hypothesis import strategies as st
from PIL import Image

from engine.files.fault import Cancelled, FileError
from engine.files.images import read_image
from engine.files.limits import Limits
from engine.files.png_writer import srgb_profile, write_png
from engine.files.tiff_writer import write_tiff


def image(height, width, dtype=np.uint8, channels=4):
    rng = np.random.default_rng(height * 1000 + width)
    return rng.integers(0, np.iinfo(dtype).max + 1, (height, width, channels)).astype(dtype)


def tiff(pixels, **settings):
    """Written by tifffile, as the field's reference."""
    file = io.BytesIO()
    settings.setdefault("photometric", "rgb" if pixels.ndim == 3 and pixels.shape[2] > 2 else "minisblack")
    tifffile.imwrite(file, pixels, metadata=None, **settings)
    return file.getvalue()


def by_pillow(picture, form, **settings):
    file = io.BytesIO()
    picture.save(file, form, **settings)
    return file.getvalue()


# ---- TIFF out ----


@pytest.mark.parametrize("dtype", [np.uint8, np.uint16])
@pytest.mark.parametrize("size", [(1, 1), (3, 2), (200, 701)])
def test_written_tiff_is_what_tifffile_and_we_read(size, dtype):
    pixels = image(*size, dtype)
    file = io.BytesIO()
    parts = np.array_split(pixels, min(size[0], 7))
    write_tiff(file, (size[1], size[0]), 8 * pixels.itemsize, iter(parts))
    back, meta = read_image(file.getvalue(), "a.tif")
    assert np.array_equal(back, pixels)
    assert back.dtype == dtype
    assert meta.kind == "tiff"
    assert meta.notes == ()
    with tifffile.TiffFile(io.BytesIO(file.getvalue())) as reference:
        page = reference.pages[0]
        assert page.tags["InterColorProfile"].value == srgb_profile()
        assert page.shape == pixels.shape
        assert page.tags["ExtraSamples"].value == (2,)
    if dtype == np.uint8:  # libtiff
        assert np.array_equal(np.asarray(Image.open(file)), pixels)


@pytest.mark.parametrize("rows", [3, 5])
def test_tiff_with_wrong_rows_is_refused(rows):
    with pytest.raises(ValueError, match="rows"):
        write_tiff(io.BytesIO(), (2, 4), 8, iter([image(rows, 2)]))


# ---- TIFF in ----

KINDS = {
    "plain": {},
    "deflate": {"compression": "deflate"},
    "old deflate": {"compression": 32946},
    "predictor": {"compression": "deflate", "predictor": 2},
    "tiles": {"tile": (32, 16), "compression": "deflate"},
    "strips": {"rowsperstrip": 7},
    "big": {"bigtiff": True},
    "motorola": {"byteorder": ">"},
    "big motorola": {"bigtiff": True, "byteorder": ">", "compression": "deflate", "tile": (16, 16)},
}


@pytest.mark.parametrize("name", KINDS)
@pytest.mark.parametrize("dtype", [np.uint8, np.uint16])
@pytest.mark.parametrize("channels", [1, 3, 4])
def test_tiffs_of_others(name, dtype, channels):
    pixels = image(41, 53, dtype, channels)
    stored = pixels[:, :, 0] if channels == 1 else pixels
    extra = {"extrasamples": ["unassalpha"]} if channels == 4 else {}
    back, _ = read_image(tiff(stored, **KINDS[name], **extra), "a.tif")
    assert back.dtype == dtype
    assert np.array_equal(back[:, :, :3], np.broadcast_to(pixels[:, :, :3], back[:, :, :3].shape))
    assert np.array_equal(back[:, :, 3], pixels[:, :, 3] if channels == 4 else np.full((41, 53), np.iinfo(dtype).max))


def test_premultiplied_tiff():
    stored = np.array([[[10, 20, 30, 60], [0, 0, 0, 0], [200, 100, 50, 255]]], np.uint8)
    back, _ = read_image(tiff(stored, extrasamples=["assocalpha"]), "a.tif")
    assert back.tolist() == [[[42, 85, 128, 60], [0, 0, 0, 0], [200, 100, 50, 255]]]


MODES = ("1", "L", "P", "CMYK", "RGB", "RGBA")
BY_LIBTIFF = [(mode, how) for mode in MODES for how in ("raw", "tiff_lzw", "packbits")]
BY_LIBTIFF += [(mode, "jpeg") for mode in ("L", "CMYK", "RGB")]  # JPEG has no other pixels


@pytest.mark.parametrize(("mode", "compression"), BY_LIBTIFF)
def test_tiffs_that_libtiff_must_read(mode, compression):
    picture = Image.fromarray(image(20, 30, channels=3 if mode == "P" else 4)).convert(mode)
    back, _ = read_image(by_pillow(picture, "TIFF", compression=compression), "a.tif")
    assert back.shape == (20, 30, 4)
    if compression != "jpeg":
        assert np.array_equal(back, np.asarray(picture.convert("RGBA")))


def test_what_is_lost_is_said():
    lzw = tiff(image(4, 4, np.uint16, 3), compression="none")
    planar = tiff(np.moveaxis(image(4, 4, np.uint16, 3), 2, 0).copy(), planarconfig="separate", photometric="rgb")
    assert read_image(lzw, "a.tif")[1].notes == ()
    with contextlib.suppress(FileError):
        assert "reduced" in read_image(planar, "a.tif")[1].notes[0]


@pytest.mark.parametrize("dtype", [np.float32, np.uint32, np.int16])
def test_other_samples_are_refused(dtype):
    with pytest.raises(FileError, match=r"a.tif: .*bits"):
        read_image(tiff(np.zeros((3, 3, 3), dtype)), "a.tif")


# ---- JPEG ----


def test_jpeg():
    picture = Image.fromarray(image(16, 24)[:, :, :3])
    back, meta = read_image(by_pillow(picture, "JPEG", quality=95), "a.jpg")
    assert meta.kind == "jpeg"
    assert np.array_equal(
        back[:, :, :3], np.asarray(Image.open(io.BytesIO(by_pillow(picture, "JPEG", quality=95))).convert("RGB"))
    )
    assert (back[:, :, 3] == 255).all()


@pytest.mark.parametrize("orientation", range(1, 9))
def test_pictures_are_turned_upright(orientation):
    from PIL import ImageOps

    picture = Image.fromarray(image(16, 24)[:, :, :3])
    exif = Image.Exif()
    exif[0x0112] = orientation
    jpeg = by_pillow(picture, "JPEG", exif=exif, quality=95)
    expected = np.asarray(ImageOps.exif_transpose(Image.open(io.BytesIO(jpeg))))
    assert np.array_equal(read_image(jpeg, "a.jpg")[0][:, :, :3], expected)
    turned = tiff(image(16, 24, np.uint16, 3), extratags=[(274, 3, 1, orientation, True)])
    upright = tiff(image(16, 24, np.uint16, 3))
    eight = Image.fromarray((read_image(upright, "a")[0][:, :, :3] >> 8).astype(np.uint8))
    eight.getexif()[0x0112] = orientation
    expected = np.asarray(ImageOps.exif_transpose(eight))
    assert np.array_equal(read_image(turned, "a.tif")[0][:, :, :3] >> 8, expected)


@pytest.mark.parametrize("mode", ["L", "CMYK"])
def test_jpegs_of_other_colours(mode):
    back, _ = read_image(by_pillow(Image.fromarray(image(16, 16)).convert(mode), "JPEG"), "a.jpg")
    assert back.shape == (16, 16, 4)


# ---- all kinds ----


def test_kind_is_known_by_content_and_from_a_path(tmp_path):
    file = io.BytesIO()
    write_png(file, image(3, 3))
    (tmp_path / "wrong.jpg").write_bytes(file.getvalue())
    pixels, meta = read_image(tmp_path / "wrong.jpg")
    assert meta.kind == "png"
    assert np.array_equal(pixels, image(3, 3))


@pytest.mark.parametrize("name", ["missing.png", ".", "a\0b"])
def test_places_that_cannot_be_read(tmp_path, name):
    with pytest.raises(FileError, match="cannot be read"):
        read_image(f"{tmp_path}/{name}")


def field(tag, kind, count, value):
    return struct.pack("<HHII", tag, kind, count, value)


def tiny(*fields, count=None):
    """A TIFF of given fields, by hand."""
    return b"II*\0\x08\0\0\0" + struct.pack("<H", len(fields) if count is None else count) + b"".join(fields) + bytes(4)


SIZE = (field(256, 4, 1, 2), field(257, 4, 1, 2), field(262, 3, 1, 1), field(258, 3, 1, 8))
HOSTILE = {
    "EPS": (b"%!PS-Adobe-3.0 EPSF-3.0\n", "expected a PNG, JPEG or TIFF"),
    "nothing": (b"", "expected a PNG"),
    "TIFF without a table": (b"II*\0\x08\0\0\0", "ends"),
    "TIFF with a table far away": (b"II*\0\xff\xff\xff\xff", "ends"),
    "TIFF of no tags": (tiny(), "0 tags"),
    "TIFF of 65,535 tags": (tiny(count=65535), "tags"),
    "TIFF without a size": (tiny(SIZE[2]), "no tag ImageWidth"),
    "TIFF of 4,294,967,295 columns": (tiny(field(256, 4, 1, 2**32 - 1), *SIZE[1:]), "expected 1 to"),
    "TIFF with 2^32 strip offsets": (tiny(*SIZE, field(273, 4, 2**32 - 1, 8)), "ends at byte"),
    "TIFF without strips": (tiny(*SIZE), "expected 1 of each"),
    "TIFF with strips beyond the end": (tiny(*SIZE, field(273, 4, 1, 10**6), field(279, 4, 1, 4)), "beyond the end"),
    "TIFF with a short strip": (tiny(*SIZE, field(273, 4, 1, 8), field(279, 4, 1, 3)), "found 3 bytes"),
    "TIFF of giant tiles": (
        tiny(*SIZE, *(field(tag, 4, 1, 200_000) for tag in (322, 323)), field(324, 4, 1, 8), field(325, 4, 1, 4)),
        "tiles of",
    ),
    "TIFF that is not deflate": (
        tiny(*SIZE, field(259, 3, 1, 8), field(273, 4, 1, 8), field(279, 4, 1, 30)), "damaged"
    ),
    "TIFF of an unknown compression": (tiny(*SIZE, field(259, 3, 1, 777)), "damaged TIFF"),
    "JPEG of three bytes": (b"\xff\xd8\xff", "damaged JPEG"),
}  # fmt: skip


@pytest.mark.parametrize("name", HOSTILE)
def test_hostile(name):
    data, expected = HOSTILE[name]
    with pytest.raises(FileError) as caught:
        read_image(data, "a.bin")
    assert str(caught.value).startswith("a.bin: ")
    assert expected in str(caught.value)
    assert "\n" not in str(caught.value)


def samples():
    picture = Image.fromarray(image(24, 24)[:, :, :3])
    file = io.BytesIO()
    write_tiff(file, (24, 24), 8, iter([image(24, 24)]))
    return {
        "jpeg": by_pillow(picture, "JPEG"),
        "tiff": file.getvalue(),
        "lzw": by_pillow(picture, "TIFF", compression="tiff_lzw"),
    }


@pytest.mark.parametrize("kind", ["jpeg", "tiff", "lzw"])
def test_truncated_files_are_refused(kind):
    data = samples()[kind]
    pixels = read_image(data, "a")[0]
    for length in range(0, len(data) - 2, max(1, len(data) // 61)):
        try:
            back, _ = read_image(data[:length], "a")
        except FileError:
            continue
        # What follows the pixels (a TIFF's profile) may be missing, the pixels may not.
        assert np.array_equal(back, pixels)


@settings(deadline=None, max_examples=150)
@given(st.sampled_from(["jpeg", "tiff", "lzw"]), st.lists(st.floats(0, 0.999), min_size=1, max_size=4))
def test_flipped_bits_raise_nothing_else(kind, places):
    data = bytearray(samples()[kind])
    for place in places:
        bit = int(place * 8 * len(data))
        data[bit // 8] ^= 1 << bit % 8
    with contextlib.suppress(FileError):
        read_image(bytes(data), "a", Limits(pixels=1 << 20))


def test_limits_hold_for_every_kind():
    picture = Image.fromarray(image(64, 64)[:, :, :3])
    for form in ("PNG", "JPEG", "TIFF"):
        with pytest.raises(FileError, match="64 x 64 pixels"):
            read_image(by_pillow(picture, form), "a", Limits(pixels=1000))


@pytest.mark.skipif(sys.platform == "win32", reason="pipes have no place among its files")
@pytest.mark.timeout(120)
def test_a_pipe_is_not_waited_for(tmp_path):
    path = tmp_path / "pipe.png"
    os.mkfifo(path)
    with pytest.raises(FileError, match=r"pipe\.png: not a regular file"):
        read_image(path)


def test_a_strip_that_holds_far_more_than_it_may_takes_no_memory():
    """200 MB of zeros behind 64 x 64 pixels of grey."""
    data = zlib.compress(bytes(200 << 20), 9)
    told = {256: 64, 257: 64, 258: 8, 259: 8, 262: 1, 273: 0, 277: 1, 278: 64, 279: len(data)}
    told[273] = 8 + 2 + 12 * len(told) + 4
    table = b"".join(struct.pack("<HHII", tag, 4, 1, value) for tag, value in told.items())
    file = struct.pack("<2sHIH", b"II", 42, 8, len(told)) + table + bytes(4) + data
    tracemalloc.start()
    try:
        picture, _ = read_image(file, "a.tif")
        most = tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()
    assert picture.shape == (64, 64, 4)
    assert not picture[:, :, :3].any()
    assert most < 16 << 20


@pytest.mark.parametrize("form", ["JPEG", "TIFF"])
def test_a_picture_that_nobody_wants_any_more_is_not_read_to_its_end(tmp_path, form):
    noise = np.random.default_rng(1).integers(0, 256, (700, 900, 3), np.uint8)
    Image.fromarray(noise).save(tmp_path / "a", form, quality=95)
    looks = []

    def cancelled():
        looks.append(1)
        return len(looks) > 2

    with pytest.raises(Cancelled):
        read_image(tmp_path / "a", cancelled=cancelled)
    assert len(looks) == 3
    assert np.array_equal(read_image(tmp_path / "a", cancelled=lambda: False)[0], read_image(tmp_path / "a")[0])


@pytest.mark.parametrize(("size", "told"), [(0xFFFFFFFF, "more pixels than"), (0, "its head is not that of a JPEG")])
def test_a_jpeg_whose_head_lies_is_told_in_plain_words(size, told):
    data = samples()["jpeg"]
    at = data.index(b"\xff\xc0") + 5
    with pytest.raises(FileError, match=f"^a: .*{told}") as caught:
        read_image(data[:at] + struct.pack(">I", size) + data[at + 4 :], "a")
    assert "<" not in str(caught.value)
