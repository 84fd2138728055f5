"""Ladders: one rectangle at many levels as Zarr, DeepZoom and TIFF, read by others."""

import json
import re
import sys
import threading
import xml.etree.ElementTree as ET

import numpy as np
import pytest
import tifffile
import zarr
from PIL import Image

from engine.archive.export import Picture
from engine.archive.ladder import deepzoom, ladder_files
from engine.archive.ladder.ladder_files import write_folder, write_tiff_ladder
from engine.archive.ladder.rungs import Ladder
from engine.canvas.composite import composite
from engine.canvas.node_checks import LayerError
from engine.canvas.tile_cache import TileCache
from engine.files.fault import Cancelled, WriteError
from engine.numeric.address import Rect
from engine.numeric.colour import to_rgba8, to_rgba16
from engine.painting import commands as c
from engine.painting.rendering import piece_reader
from engine.session.apply import Painting
from engine.session.session import Session

FRAME = Rect.at(-20, -10, 1100, 600)
ODD = Rect.at(77, 41, 1333, 1030)  # a corner that no coarser pixel has


@pytest.fixture(scope="module")
def painting():
    session = Session(Painting(FRAME, 3), TileCache(64 << 20))
    ink = [{"texture": "rock", "amount": 0.8, "colour": "#ffffff", "period": 16}]
    for layer, level, at, radius in (("a", -3, (5, 5), 20), ("b", 0, (90, 90), 60), ("c", 2, (1800, 900), 150)):
        session.do(c.parse({"do": "layer", "add": layer}))
        brush = {"radius": radius, "colour": "#3070c0", "ink": ink, "opacity": 0.8}
        points = [[0, 0], [400, 300, 0.6]]
        session.do(c.parse({"do": "stroke", "level": level, "origin": list(at), "points": points, "brush": brush}))
    return session.painting


def expected(painting, ladder):
    """Every rung in one piece, as the painting has that level."""
    for rung in ladder.rungs:
        planes = composite(painting.root, rung.level, rung.rect, piece_reader(rung.level, rung.rect))
        yield (to_rgba8 if ladder.depth == 8 else to_rgba16)(planes)


def assembled(path, about):
    """The rungs of a DeepZoom, the largest first, put together by what its .dzi says."""
    root = ET.fromstring(about)
    tile, overlap = int(root.get("TileSize")), int(root.get("Overlap"))
    size = root.find("{*}Size")
    width, height = int(size.get("Width")), int(size.get("Height"))
    files = path.with_name(f"{path.stem}_files")
    for level in range((max(width, height) - 1).bit_length(), -1, -1):
        out, seen = np.zeros((height, width, 4), np.uint8), 0
        for y in range(-(-height // tile)):
            for x in range(-(-width // tile)):
                pixels = np.asarray(Image.open(files / str(level) / f"{x}_{y}.{root.get('Format')}"))
                left, above = x * tile - overlap * (x > 0), y * tile - overlap * (y > 0)
                assert pixels.shape[1] == min((x + 1) * tile + overlap, width) - left
                assert pixels.shape[0] == min((y + 1) * tile + overlap, height) - above
                part = out[above : above + pixels.shape[0], left : left + pixels.shape[1]]
                known = part.any(2)
                assert np.array_equal(part[known], pixels[known])  # where neighbours overlap they agree
                part[:] = pixels
                seen += 1
        assert len(list((files / str(level)).iterdir())) == seen
        yield out
        width, height = -(-width // 2), -(-height // 2)


@pytest.mark.parametrize(("level", "rect"), [(0, None), (1, ODD)])
@pytest.mark.parametrize("depth", [8, 16])
def test_a_zarr_holds_every_level_as_the_painting_has_it(painting, tmp_path, level, rect, depth):
    path = tmp_path / "a.zarr"
    picture = Picture(painting, level, rect, depth=depth)
    write_folder(path, picture)
    ladder = ladder_files.ladder_of(path, picture, ladder_files.FOLDERS[".zarr"])
    group = zarr.open_group(path, mode="r")
    about = group.attrs["ome"]
    (scales,) = about["multiscales"]
    assert about["version"] == "0.5"
    assert [axis["name"] for axis in scales["axes"]] == ["c", "y", "x"]
    pictures = list(expected(painting, ladder))
    assert len(pictures) == len(scales["datasets"]) > 1
    assert pictures[0].any()
    for rung, dataset, pixels in zip(ladder.rungs, scales["datasets"], pictures, strict=True):
        array = group[dataset["path"]]
        assert array.metadata.dimension_names == ("c", "y", "x")
        assert np.array_equal(array[:], pixels.transpose(2, 0, 1))
        scale, translation = (step[step["type"]] for step in dataset["coordinateTransformations"])
        for n, corner, own in ((1, picture.area.y0, rung.rect.y0), (2, picture.area.x0, rung.rect.x0)):
            side = 2**rung.step
            assert scale[n] == side
            assert translation[n] == own * side + side / 2 - corner - 0.5
            assert abs(own * side - corner) <= side / 2


@pytest.mark.parametrize(("level", "rect"), [(0, None), (1, ODD)])
def test_deepzoom_is_read_by_what_it_says_of_itself(painting, tmp_path, level, rect):
    path = tmp_path / "a $TOLD<b>.dzi"
    picture = Picture(painting, level, rect)
    write_folder(path, picture)
    ladder = ladder_files.ladder_of(path, picture, ladder_files.FOLDERS[".dzi"])
    pictures = list(expected(painting, ladder))
    found = list(assembled(path, path.read_text()))
    assert len(found) == len(pictures)
    for one, other in zip(found, pictures, strict=True):
        assert np.array_equal(one, other)
    page = path.with_suffix(".html").read_text()
    told = json.loads(re.search(r"const told = (.*);\n", page)[1])
    assert told["files"] == "a $TOLD<b>_files"
    assert "<title>a $TOLD&lt;b&gt;</title>" in page
    assert told["size"] == [picture.area.width, picture.area.height]
    assert [rung["size"] for rung in told["rungs"]] == [[p.shape[1], p.shape[0]] for p in pictures]
    assert sorted(p.name for p in tmp_path.iterdir()) == [f"a $TOLD<b>{end}" for end in (".dzi", ".html", "_files")]


@pytest.mark.parametrize("depth", [8, 16])
def test_a_tiff_holds_every_level(painting, tmp_path, depth):
    path = tmp_path / "a.tif"
    picture = Picture(painting, 1, ODD, depth=depth)
    write_tiff_ladder(path, picture)
    ladder = Ladder.of("a", 1, ODD, depth, 512, 512)
    pictures = list(expected(painting, ladder))
    with tifffile.TiffFile(path) as file:
        assert file.is_bigtiff
        assert len(file.pages) == 1
        (series,) = file.series
        assert len(series.levels) == len(pictures) == 3
        for level, pixels in zip(series.levels, pictures, strict=True):
            assert np.array_equal(level.asarray(), pixels)
    assert np.array_equal(tifffile.imread(path), pictures[0])
    if depth == 8:
        assert np.array_equal(np.asarray(Image.open(path)), pictures[0])


def test_blocks_grow_with_the_picture_and_share_nothing():
    for side, block in ((1, 512), (2048, 512), (2049, 1024), (16385, 2048), (1 << 20, 4096)):
        assert Ladder.of("a", 0, Rect.at(0, 0, side, 5), 8, 512, 512).block == block
    ladder = Ladder.of("a", 7, Rect.at(-(5**60), 5**50, 3000, 1000), 8, 512, 512)
    for rung in ladder.rungs:
        seen = np.zeros(rung.size[::-1], int)
        for block in ladder.blocks():
            if block.rung == rung.step:
                assert block.rect.x0 % ladder.block == block.rect.y0 % ladder.block == 0
                seen[block.rect.slices(Rect.at(0, 0, *rung.size))] += 1
        assert (seen == 1).all()
    assert [rung.size for rung in ladder.rungs] == [(3000, 1000), (1500, 500), (750, 250), (375, 125)]


def test_what_is_not_painted_takes_no_room(painting, tmp_path):
    write_folder(tmp_path / "a.zarr", Picture(painting, 0, Rect.at(1 << 50, 0, 1500, 1500)))
    assert sorted({p.name for p in (tmp_path / "a.zarr").rglob("*") if p.is_file()}) == ["zarr.json"]


def test_a_former_export_is_replaced_and_nothing_else_is(painting, tmp_path):
    small, large = Picture(painting, 0, Rect.at(0, 0, 9, 7)), Picture(painting, 0, Rect.at(0, 0, 600, 20))
    for name, stays in (("a.zarr", "a.zarr"), ("b.dzi", "b_files"), ("c.dzi", "c.html"), ("d.zarr", "d.zarr")):
        write_folder(tmp_path / name, large)
        write_folder(tmp_path / name, small)
        for path in tmp_path.glob(f"{stays}*"):  # what is there is not ours any more
            if stays == "c.html":
                path.write_text("<h1>mine</h1>")
            elif path.is_dir():
                (path / "zarr.json").unlink(missing_ok=True)
                (path / "mine.txt").touch()
        before = {p: p.stat().st_mtime_ns for p in tmp_path.rglob("*")}
        with pytest.raises(WriteError, match="expected none or"):
            write_folder(tmp_path / name, large)
        assert {p: p.stat().st_mtime_ns for p in tmp_path.rglob("*")} == before
    assert np.asarray(Image.open(tmp_path / "b_files" / "4" / "0_0.png")).shape == (7, 9, 4)
    assert not (tmp_path / "b_files" / "10").exists()


@pytest.mark.parametrize("name", ["a.zarr", "a.dzi", "a.tif"])
def test_nothing_half_written_is_left(painting, tmp_path, name):
    write = write_tiff_ladder if name.endswith(".tif") else write_folder
    picture, seen = Picture(painting, 1), []
    with pytest.raises(Cancelled):
        write(tmp_path / name, picture, seen.append, lambda: bool(seen))
    assert list(tmp_path.iterdir()) == []
    write(tmp_path / name, picture, seen.append)
    before = sorted(tmp_path.rglob("*"))
    with pytest.raises(Cancelled):
        write(tmp_path / name, Picture(painting, 2), None, lambda: True)
    assert sorted(tmp_path.rglob("*")) == before
    assert seen[1:] == sorted(seen[1:])
    assert seen[-1] == 1.0
    assert not [thread for thread in threading.enumerate() if thread.name.startswith("inkfall export")]


def test_wrong_requests(painting, tmp_path):
    for name, picture in (
        ("a.png", Picture(painting)),
        ("a.zarr", Picture(painting, depth=32)),
        ("a.dzi", Picture(painting, rect=Rect.at(0, 0, 0, 5))),
        ("a.zarr", Picture(painting, rect=Rect.at(0, 0, 1 << 40, 5))),
        ("missing/a.dzi", Picture(painting)),
    ):
        with pytest.raises(WriteError) as caught:
            write_folder(tmp_path / name, picture)
        assert str(caught.value).startswith(str(tmp_path / name))
    with pytest.raises(LayerError, match="nobody"):
        write_folder(tmp_path / "a.zarr", Picture(painting, layer="nobody"))
    assert list(tmp_path.iterdir()) == []


def test_what_is_missing_is_told(painting, tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "zarr", None)
    with pytest.raises(WriteError, match=r"export to .zarr needs: pip install inkfall\[cluster\]"):
        write_folder(tmp_path / "a.zarr", Picture(painting))


def test_tiles_of_deepzoom_hold_a_pixel_of_their_neighbours():
    ladder = Ladder.of("a", 0, Rect.at(0, 0, 2000, 700), 8, deepzoom.DZI_TILE, 1)
    first, second = (
        block for block in ladder.blocks() if block.rung == 0 and block.rect.y0 == 0 and block.rect.x0 < 999
    )
    assert deepzoom.overlapped(ladder, first) == Rect(0, 0, 511, 511)
    assert deepzoom.overlapped(ladder, second) == Rect(509, 0, 1021, 511)
