"""Paintings saved and opened: equal everywhere, readable by others, and what happens when others touched the file."""

import hashlib
import io
import json
import zipfile

import numpy as np
import pytest
from archived import FRAME, assert_same, places, session_of_all, stroke
from PIL import Image
from sown import opened, rewritten

from engine.archive import opening
from engine.archive.manifest import FORMAT
from engine.archive.members import LOST
from engine.archive.opening import open_painting
from engine.archive.saving import Snapshot, save, shown_level
from engine.canvas import layers
from engine.canvas.attenuate import fold
from engine.canvas.composite import composite
from engine.canvas.evaluate import evaluate
from engine.canvas.tile_cache import TileCache
from engine.files.stack_xml import parse_stack
from engine.numeric.address import Rect
from engine.numeric.colour import to_rgba8
from engine.painting import commands as c
from engine.painting.rendering import strips
from engine.session.apply import Painting
from engine.session.session import Session


@pytest.fixture(scope="module")
def session(tmp_path_factory):
    return session_of_all(tmp_path_factory.mktemp("pictures"))


@pytest.fixture(scope="module")
def saved(session, tmp_path_factory):
    path = tmp_path_factory.mktemp("saved") / "a.ora"
    save(path, Snapshot(session.painting, session.recording()))
    return path


# ---- ours ----


def test_round_trip(session, saved):
    found = open_painting(saved)
    assert found.native
    assert found.notes == ()
    assert_same(session.painting, found.painting)
    assert found.painting.textures["leaf"].source.data is not None


def test_pixels_are_there_to_compare(session):
    """The comparison above is not of empty pictures."""
    for layer in layers.layers(session.painting.root):
        seen = sum(evaluate(layer.pyramid, *place).rgba.any() for place in places(session.painting))
        assert seen or layer.name == "empty"
    deep = layers.find(session.painting.root, "deep")
    assert max(deep.pyramid.levels) == 60
    assert evaluate(deep.pyramid, 60, Rect.at(60 << 60, -(60 << 60), 90, 70)).inks


def test_painting_goes_on_after_opening_as_it_would_have_without(session, saved):
    """Records come back with nothing pending, so later strokes weaken them as they would have the old ones."""
    reopened = Session(open_painting(saved).painting, TileCache(64 << 20))
    straight = Session(session.painting, TileCache(64 << 20))
    for command in (stroke(0, 60, colour="#00ff00", opacity=0.5), stroke(2, 2, level=-4, mode="erase", opacity=0.7)):
        reopened.do(c.parse({**command, "layer": "deep"}))
        straight.do(c.parse({**command, "layer": "deep"}))
    assert_same(straight.painting, reopened.painting)


def test_the_recording_comes_back(session, saved):
    recording = open_painting(saved).recording
    assert list(recording.lines()) == list(session.recording().lines())
    assert recording.folder == saved.parent


def test_the_same_painting_gives_the_same_bytes(session, saved, tmp_path):
    again = tmp_path / "b.ora"
    save(again, Snapshot(session.painting, session.recording()))
    assert again.read_bytes() == saved.read_bytes()
    reopened = open_painting(saved)
    save(again, Snapshot(reopened.painting, reopened.recording))
    assert open_painting(again).native
    assert_same(reopened.painting, open_painting(again).painting)


def test_a_painting_with_nothing_in_it(tmp_path):
    painting = Painting(Rect.at(0, 0, 1, 1), -3)
    save(tmp_path / "a.ora", Snapshot(painting))
    found = open_painting(tmp_path / "a.ora")
    assert found.native
    assert found.recording is None
    assert_same(painting, found.painting)


@pytest.mark.parametrize(("level", "place"), [(c.LEVEL_LIMIT, 1 << 4100), (-c.LEVEL_LIMIT, 3)])
def test_the_farthest_levels(tmp_path, level, place):
    session = Session(Painting(Rect.at(0, 0, 30, 20), 1), TileCache(1 << 24))
    session.do(c.parse(stroke(place, -place, level=level)))
    save(tmp_path / "a.ora", Snapshot(session.painting))
    found = open_painting(tmp_path / "a.ora")
    assert found.native
    one, two = (next(layers.layers(p.root)).pyramid for p in (session.painting, found.painting))
    assert min(one.levels) < level
    rect = Rect.at(place, -place, 60, 60)
    assert np.array_equal(evaluate(one, level, rect).data, evaluate(two, level, rect).data)
    assert evaluate(two, level, rect).data.any()


@pytest.mark.parametrize(("frame", "level"), [((0, 0, 1 << 40, 1 << 33), -26), ((0, 0, 40000, 10), -1)])
def test_a_frame_too_large_for_a_picture_is_shown_smaller(tmp_path, frame, level):
    painting = Session(Painting(Rect.at(*frame), 1), TileCache(1 << 24))
    painting.do(c.parse(stroke(0, 0, level=level)))
    assert shown_level(painting.painting.frame) == level
    if level < -1:
        return  # a picture of 32,768 pixels each way takes a while
    save(tmp_path / "a.ora", Snapshot(painting.painting))
    assert open_painting(tmp_path / "a.ora").painting.frame == Rect.at(*frame)
    assert Image.open(io.BytesIO(zipfile.ZipFile(tmp_path / "a.ora").read("mergedimage.png"))).size == (20000, 5)


# ---- for others ----


@pytest.fixture(scope="module")
def members(saved):
    with zipfile.ZipFile(saved) as file:
        assert file.testzip() is None
        return {name: file.read(name) for name in file.namelist()}


def test_layout(saved, members):
    data = saved.read_bytes()
    assert data[30:54] == b"mimetypeimage/openraster"
    assert {"stack.xml", "mergedimage.png", "Thumbnails/thumbnail.png", "inkfall/manifest.json"} <= set(members)
    assert all(n.startswith(("data/L", "inkfall/", "Thumb")) for n in members if "/" in n)
    with zipfile.ZipFile(saved) as file:
        assert {info.compress_type for info in file.infolist()} == {0, 8}
        assert {info.date_time for info in file.infolist()} == {(1980, 1, 1, 0, 0, 0)}


def test_merged_picture_and_thumbnail(session, members):
    merged = np.asarray(Image.open(io.BytesIO(members["mergedimage.png"])))
    pieces = [to_rgba8(planes) for planes in strips(session.painting.root, 0, FRAME)]
    assert np.array_equal(merged, np.concatenate(pieces))
    assert merged[..., 3].any()
    thumbnail = Image.open(io.BytesIO(members["Thumbnails/thumbnail.png"]))
    assert thumbnail.size == (256, 171)


def test_small_frames_keep_their_size_as_thumbnails(tmp_path):
    save(tmp_path / "a.ora", Snapshot(Painting(Rect.at(0, 0, 40, 30), 1)))
    with zipfile.ZipFile(tmp_path / "a.ora") as file:
        assert Image.open(io.BytesIO(file.read("Thumbnails/thumbnail.png"))).size == (40, 30)


def test_layers_as_others_see_them_make_the_merged_picture(session, members):
    """The tree of stack.xml with its PNGs, composited from 8 bits, is the merged picture within rounding."""
    from engine.archive.imports import read_raster
    from engine.files.zip_reader import ZipArchive

    file = io.BytesIO()
    with zipfile.ZipFile(file, "w") as out:
        for name, data in members.items():
            if not name.startswith("inkfall/"):
                out.writestr(name, data)
    found = read_raster(ZipArchive(file, "a.ora"))
    assert [n.name for n in layers.walk(found.painting.root)] == [n.name for n in layers.walk(session.painting.root)]
    assert found.painting.active == "inside"
    size = Rect(0, 0, FRAME.width, FRAME.height)
    ours = np.concatenate([to_rgba8(p.copy()) for p in strips(session.painting.root, 0, FRAME)]).astype(int)
    theirs = np.concatenate([to_rgba8(p.copy()) for p in strips(found.painting.root, 0, size)]).astype(int)
    premultiplied = [np.dstack([p[..., :3] * p[..., 3:] / 255, p[..., 3:]]) for p in (ours, theirs)]
    assert np.abs(premultiplied[0] - premultiplied[1]).max() <= 3


def test_stack_says_what_each_layer_is(session, members):
    image = parse_stack(members["stack.xml"], "a")
    assert (image.width, image.height) == (300, 200)
    assert image.ours["manifest"] == "inkfall/manifest.json"
    group = next(e for e in image.root.children if e.name == "Group")
    assert (group.opacity, group.op, group.isolated) == (0.6, "svg:multiply", True)
    for entry in image.root.layers():
        assert hashlib.sha256(members[entry.src]).hexdigest() == entry.ours["sha256"]
        assert entry.x >= 0
        assert entry.y >= 0


def test_the_manifest_names_every_member(members):
    manifest = json.loads(members["inkfall/manifest.json"])
    assert set(manifest["members"]) == set(members) - {"inkfall/manifest.json"}
    for name, (size, sha) in manifest["members"].items():
        assert size == len(members[name])
        assert sha == hashlib.sha256(members[name]).hexdigest()


# ---- what other programs leave of it ----


def test_zipped_anew_it_is_still_ours(session, members, tmp_path):
    found = opened(rewritten(dict(reversed(members.items()))), tmp_path)
    assert found.native
    assert_same(session.painting, found.painting)


@pytest.mark.parametrize("drop", [("inkfall/",), ("inkfall/layers/1/",), ("inkfall/manifest",), ("inkfall/recording",)])
def test_members_that_are_gone_are_told(members, tmp_path, drop):
    found = opened(rewritten(members, drop=drop), tmp_path)
    assert not found.native
    assert found.notes[0] == LOST
    assert len(list(layers.layers(found.painting.root))) == 6
    assert found.painting.frame == Rect(0, 0, 300, 200)


def test_another_program_painted_on_a_layer(session, members, tmp_path):
    name = next(n for n in members if n.startswith("data/L"))
    picture = Image.open(io.BytesIO(members[name]))
    picture.putpixel((0, 0), (1, 2, 3, 255))
    file = io.BytesIO()
    picture.save(file, "PNG")
    found = opened(rewritten(members, {name: file.getvalue()}), tmp_path)
    assert not found.native
    assert "another program changed" in found.notes[0]
    assert name in found.notes[0]
    top = next(e for e in parse_stack(members["stack.xml"], "a").root.layers() if e.src == name)
    layer = layers.find(found.painting.root, top.name)
    pixel = evaluate(layer.pyramid, 0, Rect.at(top.x, top.y, 1, 1)).rgba
    assert to_rgba8(pixel).tolist() == [[[1, 2, 3, 255]]]


def test_another_program_rearranged_the_layers(members, tmp_path):
    found = opened(rewritten(members, {"stack.xml": members["stack.xml"].replace(b"0.6", b"0.5")}), tmp_path)
    assert not found.native
    assert "stack.xml" in found.notes[0]
    assert layers.find(found.painting.root, "Group").opacity == 0.5


def test_other_merged_pictures_change_nothing(session, members, tmp_path):
    found = opened(rewritten(members, {"mergedimage.png": b"", "Thumbnails/thumbnail.png": b""}), tmp_path)
    assert found.native
    assert_same(session.painting, found.painting)


def test_a_newer_format_shows_its_pictures(members, tmp_path):
    manifest = json.loads(members["inkfall/manifest.json"]) | {"inkfall": FORMAT + 1}
    found = opened(rewritten(members, {"inkfall/manifest.json": json.dumps(manifest).encode()}), tmp_path)
    assert not found.native
    assert found.notes[0] == opening.NEWER


def test_a_recording_that_is_too_long_is_left_out(members, tmp_path):
    found = opened(rewritten(members), tmp_path, log=100)
    assert found.native
    assert found.recording is None
    assert "left out" in found.notes[0]


def test_pending_attenuation_is_settled_in_the_file(session, saved):
    """What was painted over from a coarser level is stored as it looks."""
    deep = layers.find(session.painting.root, "deep").pyramid
    assert deep.last is not None
    found = layers.find(open_painting(saved).painting.root, "deep").pyramid
    assert found.last is None
    assert fold(found).levels == found.levels


def test_composite_of_the_reopened_frame(session, saved):
    def read(layer, level, rect):
        return evaluate(layer.pyramid, level, rect).rgba

    one, two = session.painting.root, open_painting(saved).painting.root
    assert np.array_equal(composite(one, 0, FRAME, read), composite(two, 0, FRAME, read))
