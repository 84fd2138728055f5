"""Brushes of the artist's own are named, grouped, copied, kept when changed, and shared as one file that is checked."""

import io
import json
import zipfile
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from PIL import Image

from app.actions.actions import ACTIONS
from app.canvas.view import Place, View
from app.desk import presets
from app.desk.desk import Desk, Message
from app.desk.files import carried_out
from app.desk.holding import kept_desk
from app.desk.holding.desk_record import KeptDesk
from app.desk.holding.taking import take_preset
from app.desk.presets import Preset
from app.desk.sharing import preset_work as work
from app.desk.sharing.bundle import read_bundle, write_bundle
from engine.brush.settings import Brush, Component
from engine.painting.commands import parse
from engine.studio.faults import EXPECTED

BUNDLED, _ = presets.load_brushes(presets.bundled_folder())


@pytest.fixture
def desk(tmp_path, monkeypatch):
    monkeypatch.setattr(presets, "own_folder", lambda: tmp_path / "brushes")
    monkeypatch.setattr(kept_desk, "kept_file", lambda: tmp_path / "desk.json")
    made = Desk(View(Place(0, 0, 0), 0, 0.0, 1280, 800), [].append)
    made.known, made.kept = replace(made.known, presets=tuple(BUNDLED)), KeptDesk(("Gouache", "Pencil"))
    made.work = lambda job: carried_out(job).arrive(made)
    return made


def named(desk, name):
    return next(preset for preset in desk.known.presets if preset.name == name)


def on_disk():
    found, faults = presets.load_brushes(presets.own_folder())
    assert not faults
    return {preset.name: preset for preset in found}


def test_a_changed_brush_says_so_and_goes_back_or_is_kept(desk):
    take_preset(desk, named(desk, "Gouache"))
    assert not work.is_changed(desk)
    desk.hand.resize(2.0)
    desk.hand.colour = (0.0, 0.0, 1.0)
    assert not work.is_changed(desk), "size and colour are the hand's"
    desk.hand.change(opacity=0.5)
    assert work.is_changed(desk)
    work.take_back(desk)
    assert (work.is_changed(desk), desk.hand.brush.opacity, desk.hand.colour) == (False, 1.0, (0.0, 0.0, 1.0))
    desk.hand.change(opacity=0.5)
    work.keep_changes(desk)
    assert (desk.hand.preset, work.is_changed(desk)) == ("Gouache 2", False)
    assert named(desk, "Gouache").brush.opacity == 1.0
    desk.hand.change(opacity=0.25)
    work.keep_changes(desk)
    assert on_disk()["Gouache 2"].brush.opacity == named(desk, "Gouache 2").brush.opacity == 0.25
    assert on_disk()["Gouache 2"].textures == named(desk, "Gouache").textures
    assert sorted(on_disk()) == ["Gouache 2"]


@pytest.mark.parametrize(
    ("by", "told"),
    [({"example_detail": 1}, False), ({"depth": 0.0}, False), ({"depth": 2.0}, True), ({"flow": 0.5}, True)],
)
def test_an_example_as_large_as_the_view_asks_is_no_change(desk, by, told):
    take_preset(desk, Preset("Fox", Brush(mode="example", example="Fur")))
    desk.hand.change(**by)
    assert work.is_changed(desk) == told


def test_a_brush_is_copied_named_put_into_a_group_of_its_own_and_found_by_tags(desk):
    work.duplicate(desk, named(desk, "Gouache"))
    copy = named(desk, "Gouache 2")
    assert presets.is_own(copy)
    desk.kept = replace(desk.kept, favourites=("Pencil", "Gouache 2"))
    desk.work(work.ChangePreset(copy, replace(copy, name="Sea", group="Waves", tags=("wet", "blue"))))
    assert sorted(on_disk()) == ["Sea"]
    assert (on_disk()["Sea"].group, on_disk()["Sea"].tags) == ("Waves", ("wet", "blue"))
    assert [p.name for _, ps in presets.found(desk.known.presets, "", "blue wave") for p in ps] == ["Sea"]
    assert (desk.kept.favourites, desk.hand.preset) == (("Pencil", "Sea"), "Sea")
    desk.work(work.DeletePreset(named(desk, "Sea")))
    assert not on_disk()


def test_a_deleted_brush_comes_back_as_it_was_where_it_was(desk):
    for name in ("Pencil", "Gouache"):
        work.duplicate(desk, named(desk, name))
    mine, undo = named(desk, "Pencil 2"), ACTIONS["restore_brush"]
    before, told = desk.known.presets, mine.path.read_bytes()
    assert not undo.when(desk)
    desk.work(work.DeletePreset(mine))
    assert sorted(on_disk()) == ["Gouache 2"]
    assert (desk.message.text, desk.message.offers) == ("Deleted the brush “Pencil 2”", ("restore_brush",))
    desk.message = Message()  # it is gone; the action stays
    undo.do(desk)
    assert (desk.known.presets, mine.path.read_bytes()) == (before, told)
    assert not undo.when(desk)
    desk.work(work.DeletePreset(mine))
    work.duplicate(desk, named(desk, "Pencil"))  # another one under its name
    undo.do(desk)
    assert sorted(on_disk()) == ["Gouache 2", "Pencil 2", "Pencil 2 2"]


def test_what_cannot_be_written_is_told_and_nothing_is_lost(desk, monkeypatch):
    work.duplicate(desk, named(desk, "Pencil"))
    copy = named(desk, "Pencil 2")

    def full(*_):
        raise OSError(28, "No space left on device", "brushes")

    monkeypatch.setattr(presets, "save_brush", full)
    desk.work(work.ChangePreset(copy, replace(copy, name="Other")))
    assert desk.message.bad
    assert desk.message.text == "The brush was not changed: brushes: the disk is full"
    assert named(desk, "Pencil 2") == on_disk()["Pencil 2"]


@pytest.fixture
def pictured(tmp_path):
    picture = tmp_path / "from" / "bark.png"
    picture.parent.mkdir()
    Image.fromarray(np.arange(48, dtype=np.uint8).reshape(4, 4, 3)).save(picture)
    texture = parse({"do": "texture", "name": "bark", "maker": "image", "path": str(picture)})
    brush = Brush(radius=7.0, ink=(Component("bark", 0.5, "#804020"),))
    return Preset("Größe / bark", brush, None, "Trees", (texture,), True, ("old",))


def test_a_shared_brush_is_the_same_elsewhere_with_its_pictures(pictured, tmp_path):
    path, folder = tmp_path / "bark.inkbrush", tmp_path / "own"
    write_bundle(pictured, path)
    first = path.read_bytes()
    write_bundle(pictured, path)
    assert path.read_bytes() == first
    (tmp_path / "from" / "bark.png").unlink()
    for name in ("Größe / bark", "Größe / bark 2"):
        found = read_bundle(path, folder, {preset.name for preset in presets.load_brushes(folder)[0]})
        assert found.name == name
        assert replace(found, path=None, textures=(), name="") == replace(pictured, textures=(), name="")
        picture = found.textures[0].arguments["path"]
        assert picture.startswith(str(folder))
        assert np.asarray(Image.open(picture)).sum() == sum(range(48))
        assert found in presets.load_brushes(folder)[0]
    assert not [left for left in folder.iterdir() if left.name.startswith(".")]


@pytest.mark.parametrize("preset", BUNDLED, ids=lambda preset: preset.name)
def test_every_bundled_brush_can_be_shared(preset, tmp_path):
    write_bundle(preset, tmp_path / "a.inkbrush")
    found = read_bundle(tmp_path / "a.inkbrush", tmp_path / "own", set())
    assert (found.name, found.brush, found.group) == (preset.name, preset.brush, preset.group)


def zipped(members):
    held = io.BytesIO()
    with zipfile.ZipFile(held, "w") as archive:
        for name, data in members.items():
            archive.writestr(name, data)
    return held.getvalue()


def told(**textures):
    return json.dumps({"name": "A", "brush": {"ink": [{"texture": "t"}]}, "textures": [{"name": "t", **textures}]})


PICTURE = {"maker": "image", "path": "files/0.png"}
HOSTILE = {
    "empty": b"",
    "no archive": b"PK\3\4" + b"x" * 100,
    "no brush": zipped({"a": b""}),
    "no object": zipped({"brush.json": b"[]"}),
    "no json": zipped({"brush.json": b"{"}),
    "deep": zipped({"brush.json": b"[" * 100_000}),
    "not finite": zipped({"brush.json": b'{"brush": {"radius": 1e999}}'}),
    "brush of the wrong kind": zipped({"brush.json": b'{"brush": 3}'}),
    "tags": zipped({"brush.json": b'{"tags": "a", "brush": {}}'}),
    "no such picture": zipped({"brush.json": told(**PICTURE)}),
    "outside": zipped({"brush.json": told(maker="image", path="../../secret.png"), "../../secret.png": b""}),
    "absolute": zipped({"brush.json": told(maker="image", path="/etc/passwd")}),
    "no picture": zipped({"brush.json": told(**PICTURE), "files/0.png": b"no picture"}),
    "nested": zipped({"brush.json": told(maker="mix", path="files/0.png", pattern="/etc/passwd"), "files/0.png": b""}),
    "huge": zipped({"brush.json": b" " * (2 << 20)}),
}


@pytest.mark.parametrize("data", HOSTILE.values(), ids=HOSTILE)
def test_a_hostile_file_is_refused_in_a_line_and_leaves_nothing(data, tmp_path, desk):
    path = tmp_path / "bad.inkbrush"
    path.write_bytes(data)
    work.bring_preset(desk, path)
    assert desk.message.bad
    assert desk.message.text.startswith("No brush was brought in: ")
    assert "\n" not in desk.message.text
    assert "fault" not in desk.message.text
    assert not list(presets.own_folder().iterdir() if presets.own_folder().exists() else ())


@settings(max_examples=60, deadline=None)
@given(st.data())
def test_a_damaged_file_is_refused_or_gives_a_brush_never_half_of_one(tmp_path_factory, data):
    folder = tmp_path_factory.mktemp("damaged")
    held = bytearray(zipped({"brush.json": told(maker="rock"), "files/0.png": b"1234"}))
    for _ in range(data.draw(st.integers(1, 4))):
        held[data.draw(st.integers(0, len(held) - 1))] = data.draw(st.integers(0, 255))
    (folder / "a.inkbrush").write_bytes(held)
    try:
        found = read_bundle(folder / "a.inkbrush", folder / "own", set())
    except EXPECTED:
        assert not (folder / "own").exists() or not list((folder / "own").iterdir())
    else:
        assert presets.load_brushes(folder / "own")[0] == [found]
