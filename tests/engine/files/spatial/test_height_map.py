"""Height maps as other programs write them, and as no program should."""

import io

import numpy as np
import OpenEXR
import pytest
import tifffile
from hypothesis import given
from hypothesis import strategies as st
from PIL import Image

from engine.files.fault import FileError
from engine.files.spatial.exr_reader import read_exr
from engine.files.spatial.exr_writer import write_exr
from engine.files.spatial.geotiff_writer import write_geotiff
from engine.files.spatial.height_map import read_height_map

HEIGHTS = np.random.default_rng(4).normal(800, 300, (37, 53)).astype(np.float32)


def exr(heights, packing, path, **channels):
    told = channels or {"Y": heights}
    OpenEXR.File({"compression": packing, "type": OpenEXR.scanlineimage}, told).write(str(path))
    return path.read_bytes()


def tiff(heights, **how):
    file = io.BytesIO()
    tifffile.imwrite(file, heights, **how)
    return file.getvalue()


@pytest.mark.parametrize("packing", ["NO", "RLE", "ZIPS", "ZIP"])
@pytest.mark.parametrize("kind", [np.float32, np.float16, np.uint32])
def test_an_exr_of_another_writer_has_its_bits(tmp_path, packing, kind):
    heights = np.repeat(np.abs(HEIGHTS).astype(kind), 3, axis=1)
    data = exr(None, getattr(OpenEXR, f"{packing}_COMPRESSION"), tmp_path / "a.exr", Y=heights, A=heights[::-1].copy())
    found = read_exr(data, "a.exr")
    assert np.array_equal(found["Y"], heights.astype(np.float32))
    assert np.array_equal(found["A"], heights[::-1].astype(np.float32))
    assert np.array_equal(read_height_map(data, "a.exr").heights, heights.astype(np.float64))


@given(st.integers(0, 1 << 16), st.integers(0, 255), st.integers(0, 1 << 16))
def test_a_damaged_exr_is_told_in_one_line(place, byte, length):
    file = io.BytesIO()
    write_exr(file, (53, 37), "Y", [HEIGHTS[:, :, None]])
    data = bytearray(file.getvalue())
    data[place % len(data)] = byte
    for harmed in (bytes(data), file.getvalue()[: length % len(data)]):
        told = outcome(harmed)
        assert "\n" not in told


def outcome(data):
    """Returns what is told of an EXR that cannot be read, else the kinds of its channels."""
    try:
        return repr({channel.dtype for channel in read_exr(data, "a.exr").values()})
    except FileError as error:
        return str(error)


@pytest.mark.parametrize("packing", ["PIZ", "PXR24", "DWAA"])
def test_what_packs_with_losses_or_by_wavelets_is_named(tmp_path, packing):
    data = exr(HEIGHTS, getattr(OpenEXR, f"{packing}_COMPRESSION"), tmp_path / "a.exr")
    with pytest.raises(FileError, match=f"packed by {packing}; expected ZIP, ZIPS, RLE or none"):
        read_height_map(data, "a.exr")


MAPS = {
    "float32": HEIGHTS,
    "float64": HEIGHTS.astype(np.float64),
    "int16": HEIGHTS.astype(np.int16),
    "uint16": np.abs(HEIGHTS).astype(np.uint16),
    "int32": HEIGHTS.astype(np.int32),
}


@pytest.mark.parametrize("how", [{}, {"compression": "deflate"}, {"tile": (32, 32)}, {"byteorder": ">"}])
@pytest.mark.parametrize("kind", MAPS)
def test_a_tiff_of_one_channel_has_its_heights(kind, how):
    found = read_height_map(tiff(MAPS[kind], **how), "a.tif")
    assert np.array_equal(found.heights, MAPS[kind].astype(np.float64))
    assert (found.pixel, found.voids) == (None, 0)


def test_a_tiff_of_an_integer_predictor_or_of_another_packing_has_them():
    for how in ({"compression": "deflate", "predictor": 2}, {"compression": "lzma"}):
        assert np.array_equal(read_height_map(tiff(MAPS["int16"], **how), "a.tif").heights, MAPS["int16"])
    image = Image.fromarray(HEIGHTS)
    for predictor in (1, 3):
        for packing in ("tiff_lzw", "tiff_adobe_deflate"):
            file = io.BytesIO()
            image.save(file, "TIFF", compression=packing, tiffinfo={317: predictor})
            assert np.array_equal(read_height_map(file.getvalue(), "a.tif").heights, HEIGHTS)


def test_a_geotiff_tells_its_scale_and_where_it_has_no_data():
    heights = HEIGHTS.copy()
    file = io.BytesIO()
    write_geotiff(file, heights, 2.5, (1000.0, -40.0))
    assert read_height_map(file.getvalue(), "a.tif").pixel == 2.5
    heights[3:5, 7] = -9999.0
    heights[8, 8] = np.nan
    data = tiff(heights, extratags=[(42113, "s", 0, "-9999", True)])
    found = read_height_map(data, "a.tif")
    assert found.voids == 3
    assert found.ends == (float(HEIGHTS.min()), float(HEIGHTS.max()))
    assert read_height_map(tiff(np.array([[1, -32768], [2, 3]], np.int16)), "a.tif").voids == 1


def test_degrees_are_told_in_metres_and_other_units_not_at_all():
    keys = (1, 1, 0, 1, 1024, 0, 1, 2)
    tags = [(33550, "d", 3, (0.001, 0.001, 0.0), True), (34735, "H", len(keys), keys, True)]
    assert read_height_map(tiff(HEIGHTS, extratags=tags), "a.tif").pixel == pytest.approx(111.32)
    feet = (1, 1, 0, 2, 1024, 0, 1, 1, 3076, 0, 1, 9002)
    tags[1] = (34735, "H", len(feet), feet, True)
    assert read_height_map(tiff(HEIGHTS, extratags=tags), "a.tif").pixel is None


def test_a_picture_of_16_bits_tells_whole_steps(tmp_path):
    codes = np.random.default_rng(5).integers(0, 1 << 16, (9, 12), np.uint16)
    Image.fromarray(codes).save(tmp_path / "a.png")
    assert np.array_equal(read_height_map((tmp_path / "a.png").read_bytes(), "a.png").heights, codes)


@pytest.mark.parametrize(
    ("data", "message"),
    [
        (tiff(np.full((4, 4), np.nan, np.float32)), "found no height in it"),
        (tiff(np.zeros((4, 4, 3), np.float32), photometric="rgb"), "32 bits|several channels"),
        (tiff(HEIGHTS)[:900], "beyond the end of the file"),
        (b"no picture at all", "expected a PNG, JPEG or TIFF"),
    ],
)
def test_what_is_no_map_is_told_in_one_line(data, message):
    with pytest.raises(FileError, match=message) as told:
        read_height_map(data, "a.tif")
    assert "\n" not in str(told.value)
