"""Layers that began as a picture: the file holds the picture and what was painted since, and opens the same."""

import zipfile

import numpy as np
import pytest
from PIL import Image

from engine.archive.imports import open_image
from engine.archive.members import Members
from engine.archive.opening import open_painting
from engine.archive.saving import Snapshot, save
from engine.canvas import layers
from engine.canvas.evaluate import evaluate
from engine.files.fault import FileError
from engine.files.strict_json import loads
from engine.numeric.address import Rect
from engine.painting import commands as c
from engine.session.session import Session


@pytest.fixture
def picture(tmp_path):
    rng = np.random.default_rng(5)
    pixels = rng.integers(0, 256, (300, 420, 4), np.uint8)
    pixels[40:90, 30:200, 3] = 0
    Image.fromarray(pixels).save(tmp_path / "field.png")
    return tmp_path / "field.png"


def stroke(x, y, **brush):
    told = {"do": "stroke", "level": 0, "points": [[x, y], [x + 150, y + 60]], "brush": brush}
    return c.parse(told)


def same(one, other):
    a, b = (layers.find(p.root, "field").pyramid for p in (one, other))
    assert {k: sorted(v) for k, v in a.levels.items()} == {k: sorted(v) for k, v in b.levels.items()}
    for level in (-9, -3, 0, 2):
        at = Rect(-40, -40, 500, 400).zoomed(level)
        assert np.array_equal(evaluate(a, level, at).data, evaluate(b, level, at).data), level


def stored(path):
    with zipfile.ZipFile(path) as file:
        return {info.filename: file.read(info) for info in file.infolist()}


def test_a_picture_is_in_the_file_once(picture, tmp_path):
    painting = open_image(picture).painting
    save(tmp_path / "a.ora", Snapshot(painting))
    members = stored(tmp_path / "a.ora")
    assert not [name for name in members if name.startswith("inkfall/layers")]
    assert members["data/L1.png"] == layers.find(painting.root, "field").pyramid.ground.pixels
    found = open_painting(tmp_path / "a.ora")
    assert found.native
    same(painting, found.painting)
    save(tmp_path / "b.ora", Snapshot(found.painting))
    assert (tmp_path / "b.ora").read_bytes() == (tmp_path / "a.ora").read_bytes()


def test_paint_on_a_picture_comes_back_and_goes_on(picture, tmp_path):
    session = Session(open_image(picture).painting)
    session.do(stroke(60, 60, radius=40, colour="#20c040", hardness=0.3))
    session.do(stroke(40, 200, radius=60, mode="erase"))
    save(tmp_path / "a.ora", Snapshot(session.painting))
    found = open_painting(tmp_path / "a.ora").painting
    same(session.painting, found)
    again = Session(found)
    for one in (session, again):
        one.do(stroke(10, 120, radius=30, colour="#ff2000", opacity=0.5))
    same(session.painting, again.painting)


def test_tiles_that_paint_made_superfluous_stay_away(picture, tmp_path):
    session = Session(open_image(picture).painting)
    session.do(stroke(150, 150, radius=600, mode="erase", hardness=1.0))
    save(tmp_path / "a.ora", Snapshot(session.painting))
    assert loads(stored(tmp_path / "a.ora")["inkfall/manifest.json"])["layers"][0]["ground"]["gone"]
    same(session.painting, open_painting(tmp_path / "a.ora").painting)


def test_a_ground_that_was_changed_is_seen(picture, tmp_path, monkeypatch):
    session = Session(open_image(picture).painting)
    session.do(stroke(60, 60, radius=40))
    save(tmp_path / "a.ora", Snapshot(session.painting))
    members = stored(tmp_path / "a.ora")
    members["inkfall/layers/1/ground.png"] = members["mergedimage.png"]
    with zipfile.ZipFile(tmp_path / "b.ora", "w") as file:
        for name, data in members.items():
            file.writestr(name, data)
    found = open_painting(tmp_path / "b.ora")
    assert not found.native
    assert "another program changed" in found.notes[0]
    monkeypatch.setattr(Members, "overtaken", lambda self: "")
    members["inkfall/layers/1/ground.png"] = b"no picture"
    with zipfile.ZipFile(tmp_path / "c.ora", "w") as file:
        for name, data in members.items():
            file.writestr(name, data)
    with pytest.raises(FileError, match=r"c\.ora"):
        open_painting(tmp_path / "c.ora")
