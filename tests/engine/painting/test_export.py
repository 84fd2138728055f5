"""Export: any rectangle at any level, 8 and 16 bits, streamed."""

import tracemalloc

import numpy as np
import pytest
import tifffile
from PIL import Image

from engine.archive.export import Picture, export
from engine.canvas import layers
from engine.canvas.composite import composite
from engine.canvas.evaluate import evaluate_sparse
from engine.canvas.node_checks import LayerError
from engine.canvas.tile_cache import TileCache
from engine.files.fault import Cancelled, WriteError
from engine.files.images import read_image
from engine.numeric.address import Rect
from engine.numeric.colour import to_rgba8, to_rgba16
from engine.painting import commands as c
from engine.painting.rendering import bands, reach, rows_of, sheets, strips
from engine.session.apply import Painting
from engine.session.session import Session

FRAME = Rect.at(-20, -10, 500, 300)


@pytest.fixture(scope="module")
def painting():
    session = Session(Painting(FRAME, 3), TileCache(64 << 20))
    ink = [{"texture": "rock", "amount": 0.8, "colour": "#ffffff", "period": 16}]
    for layer, level, at, radius in (("a", -3, (5, 5), 20), ("b", 0, (90, 90), 60), ("c", 6, (64 * 90, 64 * 90), 150)):
        session.do(c.parse({"do": "layer", "add": layer}))
        brush = {"radius": radius, "colour": "#3070c0", "ink": ink, "opacity": 0.8}
        points = [[0, 0], [40, 30, 0.6]]
        session.do(c.parse({"do": "stroke", "level": level, "origin": list(at), "points": points, "brush": brush}))
    return session.painting


def whole(root, level, rect):
    """The picture in one piece."""

    def read(layer, level, place):
        found = evaluate_sparse(layer.pyramid, level, place, None)
        return None if found is None else found.rgba

    return composite(root, level, rect, read)


PLACES = [
    (0, None),
    (-4, None),
    (1, Rect.at(-7, 3, 700, 515)),
    (6, Rect.at(64 * 90 - 50, 64 * 90 - 40, 333, 130)),
    (12, Rect.at(4096 * 91 + 11, 4096 * 91 + 7, 90, 70)),
    (0, Rect.at(1 << 70, -(1 << 70), 8, 8)),
]


@pytest.mark.parametrize(("level", "rect"), PLACES)
@pytest.mark.parametrize("ending", ["png", "tif"])
@pytest.mark.parametrize("depth", [8, 16])
def test_the_picture_is_the_composite(painting, tmp_path, level, rect, ending, depth):
    path = tmp_path / f"a.{ending}"
    export(path, Picture(painting, level, rect, depth=depth))
    area = painting.frame.zoomed(level) if rect is None else rect
    expected = (to_rgba8 if depth == 8 else to_rgba16)(whole(painting.root, level, area))
    assert np.array_equal(read_image(path)[0], expected)
    if ending == "tif":
        assert np.array_equal(tifffile.imread(path), expected)
    elif depth == 8:
        assert np.array_equal(np.asarray(Image.open(path)), expected)


@pytest.mark.parametrize("width", [1, 127, 1500, 20000])
def test_strips_are_cut_from_one_picture(painting, width):
    rect = Rect.at(-33, 20, width, 300 if width < 20000 else 30)
    pieces = np.concatenate([s.copy() for s in strips(painting.root, 0, rect)], axis=1)
    assert np.array_equal(pieces, whole(painting.root, 0, rect))
    assert [b.height for b in bands(rect)] == [s.shape[1] for s in strips(painting.root, 0, rect)]


@pytest.mark.parametrize("cores", [1, 2, 5])
def test_rows_are_the_same_on_any_number_of_cores(painting, monkeypatch, cores):
    monkeypatch.setattr("engine.painting.rendering.os.cpu_count", lambda: cores)
    monkeypatch.setattr("engine.painting.rendering._HELD", 1 << 12)  # coarser levels are held in parts
    rect = Rect.at(-100, -37, 2500, 700)
    found = np.concatenate(list(rows_of(painting.root, 3, rect, to_rgba8)))
    assert np.array_equal(found, to_rgba8(whole(painting.root, 3, rect)))


@pytest.mark.parametrize("columns", [34, 512])
@pytest.mark.parametrize("together", [1, 1 << 23])
def test_sheets_are_cut_from_the_pictures_of_the_layers(painting, monkeypatch, columns, together):
    monkeypatch.setattr("engine.painting.rendering._SHEET_COLUMNS", columns)
    monkeypatch.setattr("engine.painting.rendering.TOGETHER", together)
    frame = Rect.at(-21, -7, 401, 295)
    names = {layer.id: layer.name for layer in layers.layers(painting.root)}
    places = {id: reach(layers.find(painting.root, name), 0, frame) for id, name in names.items()}
    bands_of = list(sheets(painting.root, 0, frame, places))
    merged = np.concatenate([merged for _, merged in bands_of])
    assert np.array_equal(merged, to_rgba8(whole(painting.root, 0, frame)))
    for id, name in names.items():
        parts = [known[id] for known, _ in bands_of if id in known]
        alone = whole(layers.alone(layers.find(painting.root, name), painting.root), 0, places[id])
        assert np.array_equal(np.concatenate(parts), to_rgba8(alone)) if parts else places[id].empty


def test_one_layer(painting, tmp_path):
    export(tmp_path / "a.png", Picture(painting, layer="b"))
    expected = whole(layers.alone(layers.find(painting.root, "b"), painting.root), 0, FRAME)
    assert np.array_equal(np.asarray(Image.open(tmp_path / "a.png")), to_rgba8(expected))
    with pytest.raises(LayerError, match="nobody"):
        export(tmp_path / "b.png", Picture(painting, layer="nobody"))


@pytest.mark.parametrize("level", [-5, -1, 0, 1])
def test_reach_holds_all_that_shows(painting, level):
    frame = painting.frame.zoomed(level)
    for layer in layers.layers(painting.root):
        place = reach(layer, level, frame)
        found = evaluate_sparse(layer.pyramid, level, frame, None)
        if found is None:
            continue
        rest = found.rgba.copy()
        rows, columns = place.slices(frame)
        rest[:, rows, columns] = 0
        assert not rest.any()


def test_wrong_requests(painting, tmp_path):
    for path, picture in (
        ("a.bmp", Picture(painting)),
        ("a", Picture(painting)),
        ("a.png", Picture(painting, depth=32)),
        ("a.png", Picture(painting, rect=Rect.at(0, 0, 0, 5))),
        ("a.png", Picture(painting, rect=Rect.at(0, 0, 1 << 40, 5))),
        ("missing/a.png", Picture(painting)),
    ):
        with pytest.raises(WriteError) as caught:
            export(tmp_path / path, picture)
        assert str(caught.value).startswith(str(tmp_path / path))
    assert list(tmp_path.iterdir()) == []


def test_progress_and_cancel(painting, tmp_path):
    seen = []
    export(tmp_path / "a.png", Picture(painting, 2), progress=seen.append)
    assert seen == sorted(seen)
    assert seen[-1] == 1
    for ending in ("png", "tif"):
        with pytest.raises(Cancelled):
            export(tmp_path / f"b.{ending}", Picture(painting, 2), cancelled=lambda: len(seen) > 0)
    assert [p.name for p in tmp_path.iterdir()] == ["a.png"]


@pytest.mark.parametrize("ending", ["png", "tif"])
def test_memory_does_not_grow_with_the_picture(painting, tmp_path, ending):
    """4000 x 4000 with 16 bits is 128 MB of pixels, 256 MB of planes; a strip of it is a sixteenth."""
    tracemalloc.start()
    try:
        export(tmp_path / f"a.{ending}", Picture(painting, 3, Rect.at(0, 0, 4000, 4000), depth=16))
        assert tracemalloc.get_traced_memory()[1] < 80 << 20
    finally:
        tracemalloc.stop()
