"""Paintings of our own brought into another one as a group: exactly, in one step, and for good."""

import numpy as np
import pytest
from immutables import Map

from engine.archive.opening import open_painting
from engine.archive.others import carried_painting
from engine.archive.saving import Snapshot, save
from engine.canvas import layers
from engine.canvas.composite import composite
from engine.canvas.placing.placement import Placement
from engine.canvas.reading import layer_planes
from engine.files.fault import FileError, TooMuch
from engine.files.layered import whole_file
from engine.files.layered.whole_file import as_bytes, as_pixels
from engine.numeric.address import Rect
from engine.numeric.arithmetic import EVERYWHERE
from engine.painting import commands as c
from engine.painting.capture import read_bytes
from engine.painting.layering.painting_member import NamedNode
from engine.painting.value import Painting, Refusal
from engine.session.replay import replay_torn
from engine.session.session import Session
from engine.texture.image import ImageSource

VIEW = Rect(-20, -20, 100, 90)
LINE = [[8, 12, 1], [40, 30, 1], [70, 50, 1]]
ROCK = {"radius": 12, "ink": [{"texture": "grit", "amount": 1, "colour": "#f0d0a0"}]}
LAKE = [
    {"do": "texture", "name": "grit", "maker": "rock", "period": 24},
    {"do": "layer", "add": "Sky"},
    {"do": "stroke", "brush": ROCK, "points": LINE, "seed": 3},
    {"do": "layer", "add": "Trees", "kind": "group"},
    {"do": "layer", "add": "Tree", "group": "Trees"},
    {"do": "stroke", "level": 2, "brush": {"radius": 40, "colour": "#206010"}, "points": [[90, 80, 1], [200, 90, 1]]},
    {"do": "select", "ellipse": [0, 15, 10, 40, 30]},
    {"do": "layer", "set": "Tree", "mask": True},
    {"do": "layer", "set": "Trees", "opacity": 0.5, "blend": "multiply"},
    {
        "do": "layer",
        "add": "Again",
        "group": None,
        "kind": "placement",
        "of": "Trees",
        "at": [10, 5],
        "levels": -1,
        "turn": 1,
    },
    {
        "do": "layer",
        "add": "Within",
        "group": None,
        "kind": "placement",
        "of": None,
        "rect": [0, 0, 0, 80, 60],
        "levels": -1,
    },
]


def played(commands, **about):
    session = Session(Painting(Rect(0, 0, 80, 60), arithmetic=EVERYWHERE, **about))
    for one in commands:
        session.do(c.parse(one))
    return session


@pytest.fixture(scope="module")
def lake(tmp_path_factory):
    """A painting, and its file."""
    session = played(LAKE)
    path = tmp_path_factory.mktemp("lake") / "lake.ora"
    save(path, Snapshot(session.painting, session.recording()))
    return session.painting, path


def bring(session, path, names, level=0, at=(0, 0)):
    session.do(c.parse({"do": "texture", "name": "Lake", "maker": "image", "path": str(path), "holds": "file"}))
    return session.do(c.AddPainting("lake", "Lake", names, level, at))


def named(painting, **other):
    def told(nodes):
        return tuple(
            NamedNode(other.get(n.name, n.name), told(n.children) if n.children is not None else None) for n in nodes
        )

    return told(carried_painting.names_of(painting.root))


def seen(painting, level, rect, name=None):
    root = painting.root if name is None else layers.alone(layers.find(painting.root, name), painting.root)
    return composite(root, level, rect, layer_planes)


@pytest.mark.parametrize(("level", "at"), [(0, (0, 0)), (0, (8, -4)), (2, (-16, 92))])
def test_a_painting_comes_in_exactly_at_all_levels(lake, level, at):
    painting, path = lake
    found = bring(played([{"do": "layer", "add": "Sky"}]), path, named(painting, Sky="Sky 2"), level, at)
    for finer in (0, 1, 3):
        rect = VIEW.zoomed(finer) if finer < 2 else Rect.at(200, 160, 200, 150)
        there = Rect.at(rect.x0 + (at[0] << finer), rect.y0 + (at[1] << finer), rect.width, rect.height)
        assert np.array_equal(seen(found, level + finer, there, "lake"), seen(painting, finer, rect))
    assert found.active == "lake"


def test_ink_masks_placements_and_textures_stay_what_they_are(lake):
    painting, path = lake
    session = played([{"do": "texture", "name": "grit", "maker": "rock", "period": 9}])
    found = bring(session, path, named(painting))
    sky, there = layers.find(found.root, "Sky"), layers.find(painting.root, "Sky")
    inks = {ink for layer in (sky, there) for _, record in layer.pyramid.all_records() for ink in record.inks}
    assert len(inks) == 1
    assert layers.find(found.root, "Tree").mask is not None
    again, within = layers.find(found.root, "Again"), layers.find(found.root, "Within")
    assert isinstance(again, Placement)
    assert again.of == layers.find(found.root, "Trees").id
    assert within.of == layers.find(found.root, "lake").id
    assert found.textures["grit"].parameters["period"] == 9
    assert found.textures["grit 2"].parameters["period"] == 24
    assert "Lake" in found.textures


def test_it_is_one_step_is_saved_opened_and_played_again(lake, tmp_path):
    painting, path = lake
    own = tmp_path / "own.ora"
    own.write_bytes(path.read_bytes())
    session = played([{"do": "layer", "add": "Ground"}])
    before, count = session.painting, session.history.undo_count
    bring(session, own, named(painting), 1, (4, 6))
    own.unlink()
    assert session.history.undo_count == count + 1
    shown = [seen(session.painting, level, VIEW) for level in (0, 1, 4)]
    session.do(c.Undo())
    assert session.painting.root is before.root
    session.do(c.Redo())
    save(tmp_path / "both.ora", Snapshot(session.painting, session.recording()))
    opened = open_painting(tmp_path / "both.ora")
    (tmp_path / "both.ora").unlink()
    assert opened.native
    assert opened.notes == ()
    again = replay_torn(opened.recording, pictures=opened.pictures)[0].painting
    for one in (opened.painting, again, replayed(session)):
        for level, picture in zip((0, 1, 4), shown, strict=True):
            assert np.array_equal(seen(one, level, VIEW), picture)


def replayed(session):
    pictures = {t.source.sha: t.source for t in session.painting.textures.values() if t.source}
    return replay_torn(session.recording(), pictures=pictures)[0].painting


def test_what_is_told_of_it_without_its_paint_has_its_layers(lake):
    painting, path = lake
    session = played([])
    bring(session, path, named(painting))
    session.do(c.parse({"do": "stroke", "layer": "Tree", "brush": {"radius": 3}, "points": LINE}))
    assert session.steps.count == 2
    told = {node.name: node.id for node in layers.walk(session.steps._now.painting.root)}
    assert told == {node.name: node.id for node in layers.walk(session.painting.root)}


@pytest.mark.parametrize("high", [False, True])
def test_heights_come_in_as_such_unless_there_are_some(tmp_path, high):
    land = [{"do": "layer", "add": "Land"}, {"do": "layer", "set": "Land", "role": "height"}]
    session = played(land)
    save(tmp_path / "land.ora", Snapshot(session.painting, session.recording()))
    found = bring(played(land if high else []), tmp_path / "land.ora", named(session.painting, Land="Hills"))
    hills = layers.find(found.root, "Hills")
    assert (hills.role, hills.visible) == (("", False) if high else ("height", True))
    assert [node.role for node in layers.layers(found.root)].count("height") == 1


@pytest.mark.parametrize(
    ("names", "line"),
    [
        ((), "found other layers told than its painting has"),
        ((NamedNode("Sky", ()),) * 4, "found other layers told"),
    ],
)
def test_names_that_do_not_fit_are_refused(lake, names, line):
    session = played([])
    with pytest.raises(Refusal, match=line):
        bring(session, lake[1], names)
    assert layers.EMPTY is session.painting.root


def test_another_grid_a_missing_texture_and_a_picture_are_refused_in_a_line(lake, tmp_path):
    painting, path = lake
    with pytest.raises(Refusal, match=r"found values on 2\^-16, expected 2\^-12"):
        bring(played([], grid=12), path, named(painting))
    with pytest.raises(Refusal, match="found no texture 'Lake'"):
        played([]).do(c.AddPainting("lake", "Lake", named(painting)))
    broken = tmp_path / "broken.ora"
    broken.write_bytes(path.read_bytes()[:900])
    with pytest.raises(Refusal, match=r"Lake: .*(end|directory|zip)"):
        bring(played([]), broken, named(painting))


def test_a_newer_painting_is_not_brought_in_by_halves(lake, monkeypatch):
    painting, path = lake
    monkeypatch.setattr("engine.archive.opening.FORMAT", 1)
    with pytest.raises(Refusal, match="a newer Inkfall wrote this file"):
        bring(played([]), path, named(painting))


@pytest.mark.parametrize("size", [0, 1, 3063, 3064, 3065, 70_000])
def test_bytes_are_held_as_a_picture(size):
    data = bytes(np.random.default_rng(size).integers(0, 256, size, np.uint8))
    source = ImageSource.of_raster("a", as_pixels(data))
    assert as_bytes(source.straight()) == data


def test_other_pictures_hold_no_bytes():
    assert as_bytes(np.zeros((4, 30, 4), np.uint8)) is None
    assert as_bytes(np.full((4, 1024, 4), 255, np.uint8)) is None


def test_a_file_that_is_too_large_is_told_before_it_is_read(tmp_path, monkeypatch):
    (tmp_path / "a.ora").write_bytes(bytes(3000))
    monkeypatch.setattr(whole_file, "MOST", 2999)
    with pytest.raises(TooMuch, match="expected at most"):
        read_bytes("a.ora", tmp_path)
    with pytest.raises(FileError):
        read_bytes("b.ora", tmp_path)


def test_the_command_is_told_as_it_is_read():
    names = NamedNode("a"), NamedNode("b", (NamedNode("c"), NamedNode("d", ())))
    command = c.AddPainting("lake", "Lake", names, 3, (1 << 70, -2), extra=Map({"time": 5}))
    told = c.to_json(command)
    assert told["children"] == ["a", {"name": "b", "children": ["c", {"name": "d", "children": []}]}]
    assert c.parse(told) == command
