"""Pictures put away on disk: they read as arrays do, and a painting is the same whether its picture is there or not."""

import errno

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from immutables import Map

from engine.archive.opening import open_painting
from engine.archive.saving import Snapshot, save
from engine.canvas import ground
from engine.canvas.evaluate import evaluate
from engine.files.fault import FileError
from engine.files.png_writer import write_png
from engine.keeping import disk_raster
from engine.keeping.disk_raster import DiskBytes, DiskRaster
from engine.numeric.address import Rect
from engine.numeric.arithmetic import EVERYWHERE
from engine.painting.commands import AddPicture, DefineTexture
from engine.painting.value import Painting
from engine.session.paging import Paging
from engine.session.session import Session
from engine.texture import image

SIDES = st.integers(0, 9)
PLACE = Rect(-40, -30, 360, 330)


@settings(deadline=None, max_examples=50)
@given(
    st.integers(1, 8), st.integers(1, 8), SIDES, SIDES, SIDES, SIDES, st.sampled_from([np.uint8, np.uint16, np.float32])
)
def test_parts_are_read_and_written_as_those_of_an_array(height, width, top, bottom, left, right, kind):
    rng = np.random.default_rng(height * 9 + width)
    away, here = DiskRaster((height, width, 4), kind), np.zeros((height, width, 4), kind)
    rows = slice(min(top, height), min(max(top, bottom), height))
    given = rng.integers(0, 99, here[rows].shape).astype(kind)
    away[rows] = here[rows] = given
    columns = slice(left, max(left, right))
    assert np.array_equal(away[0:height, columns], here[:, columns])
    assert np.array_equal(away[top:bottom, columns], here[top:bottom, columns])
    assert (away.shape, away.dtype, len(away)) == (here.shape, here.dtype, height)


def test_rows_of_another_width_are_refused():
    with pytest.raises(ValueError, match="expected"):
        DiskRaster((4, 5, 4), np.uint8)[0:2] = np.zeros((2, 6, 4), np.uint8)


def test_bytes_put_away_are_read_as_they_were():
    away = DiskBytes()
    assert [away.write(piece) for piece in (b"ab", memoryview(b"cde"))] == [2, 3]
    with away.opened() as one, away.opened() as other:
        assert one.read(3) == b"abc"
        assert (len(away), other.seek(0, 2), other.seek(-1, 1)) == (5, 5, 4)
        assert (other.read(), one.read(9)) == (b"e", b"de")


@pytest.fixture(params=[np.uint8, np.uint16])
def pictured(request, tmp_path):
    rng, top = np.random.default_rng(2), np.iinfo(request.param).max
    pixels = rng.integers(0, top, (300, 310, 4), request.param)
    pixels[20:280, 20:300, 3] = top
    pixels[:9, :, 3] = 0
    with open(tmp_path / "p.png", "wb") as file:
        write_png(file, pixels)
    return tmp_path


def laid(folder):
    session = Session(Painting(Rect(0, 0, 300, 200), arithmetic=EVERYWHERE))
    session.do(DefineTexture("p", "image", Map({"path": str(folder / "p.png")})))
    return session.do(AddPicture("L", "p", 0, (-17, -9)))


def put_away(patch):
    """Has every picture put away, and every level of it."""
    patch.setattr(disk_raster, "_PART", 1 << 60)
    patch.setattr(image, "_NARROW", 1)
    patch.setattr(image, "_BANDED", 1)
    patch.setattr(image, "_HELD", {})
    patch.setattr(ground, "_DENSE", 64)
    patch.setattr("engine.archive.grounds.LAID", 64)


def seen(painting):
    pyramid = painting.root.children[0].pyramid
    values = [evaluate(pyramid, level, PLACE.zoomed(level)) for level in (0, -1, -2, -3, -4)]
    records = {key: record.data.tobytes() for key, record in pyramid.all_records()}
    return [value.data.tobytes() for value in values], records


def test_a_layer_of_a_picture_on_disk_is_that_of_one_in_memory(pictured, monkeypatch):
    here = laid(pictured)
    save(pictured / "here.ora", Snapshot(here))
    put_away(monkeypatch)
    away = laid(pictured)
    assert isinstance(away.textures["p"].source.pixels, DiskRaster)
    assert away.textures["p"].source.sha == here.textures["p"].source.sha
    assert -3 in away.root.children[0].pyramid.ground.values
    assert seen(away) == seen(here)
    save(pictured / "away.ora", Snapshot(away))
    assert (pictured / "away.ora").read_bytes() == (pictured / "here.ora").read_bytes()
    assert seen(open_painting(pictured / "away.ora").painting) == seen(here)


def test_a_full_disk_is_told_in_a_line(pictured, monkeypatch):
    put_away(monkeypatch)

    def full(*_):
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr(DiskRaster, "__setitem__", full)
    with pytest.raises(FileError, match="No space left on device"):
        laid(pictured)


def test_making_records_smaller_makes_none_that_nobody_asked_for(pictured):
    painting, paging = laid(pictured), Paging()
    pyramid = painting.root.children[0].pyramid
    kept = [record for key, record in pyramid.all_records() if key.level == 0 and not record.there]
    assert kept
    assert kept[0].data.any()
    paging.want(painting.root, 0, 1 << 40)
    paging.step(1 << 40)
    assert [record.there for record in kept] == [True, *[False] * (len(kept) - 1)]
    assert not isinstance(kept[0].held, np.ndarray)
