"""The ground under all layers: seen and exported wherever nothing covers it, kept in files, never taken for paint."""

import json
import zipfile
from dataclasses import replace

import numpy as np
import pytest

from engine.archive.export import Picture, export
from engine.archive.manifest import FORMAT, MANIFEST, format_of
from engine.archive.opening import open_painting
from engine.archive.saving import Snapshot, save
from engine.canvas import layers
from engine.canvas.composite import composite
from engine.canvas.reading import layer_planes
from engine.checks.field_error import FieldError
from engine.files.images import read_image
from engine.numeric.address import Rect
from engine.painting import commands as c
from engine.painting.difference import areas
from engine.painting.recording import Header, Recording, parse_header, read, version_of, write
from engine.painting.value import first_painting, header_for
from engine.session.replay import replay
from engine.session.session import Session

FRAME = Rect(0, 0, 90, 70)
PAPER = "#f0e0c0"
COLOUR = np.array([0xF0, 0xE0, 0xC0, 0xFF])


def stroke(**brush):
    return {"do": "stroke", "points": [[20, 20], [50, 40]], "brush": {"radius": 9, "colour": "#204080", **brush}}


def done(*commands, paper=PAPER):
    session = Session(first_painting(Header(FRAME, paper=paper)))
    for command in commands:
        session.do(c.parse(command))
    return session


def picture(painting, rect=FRAME, level=0):
    return composite(painting.root, level, rect, layer_planes)


def over(below, above):
    return above + (1 - above[3]) * below


def test_what_is_painted_lies_over_it_and_is_as_it_was():
    bare, there = done(stroke(opacity=0.6), paper=None).painting, done(stroke(opacity=0.6)).painting
    ground = np.ones((4, 70, 90), np.float32) * (COLOUR / 255).astype(np.float32)[:, None, None]
    np.testing.assert_allclose(picture(there), over(ground, picture(bare)), atol=1e-6)
    (one,), (other,) = bare.root.children, there.root.children
    np.testing.assert_array_equal(layer_planes(one, 2, FRAME), layer_planes(other, 2, FRAME))
    assert picture(there, Rect.at(1 << 80, -5, 3, 2), 9)[:3, 0, 0] == pytest.approx(COLOUR[:3] / 255)


def test_blend_modes_mix_with_it():
    session = done(stroke(), {"do": "layer", "set": "Layer 1", "blend": "multiply"})
    middle = picture(session.painting)[:3, 30, 35]
    assert middle == pytest.approx(np.array([0x20, 0x40, 0x80]) / 255 * COLOUR[:3] / 255, abs=1e-3)


def test_it_is_exported_but_not_where_the_picture_is_to_be_clear(tmp_path):
    painting = done(stroke()).painting
    export(tmp_path / "a.png", Picture(painting))
    export(tmp_path / "clear.png", Picture(painting, transparent=True))
    export(tmp_path / "one.png", Picture(painting, layer="Layer 1"))
    whole, _ = read_image(tmp_path / "a.png", "a.png")
    clear, _ = read_image(tmp_path / "clear.png", "clear.png")
    alone, _ = read_image(tmp_path / "one.png", "one.png")
    assert (whole[0, 0] == COLOUR).all()
    assert not clear[0, 0].any()
    np.testing.assert_array_equal(clear, alone)


def test_a_file_keeps_it_and_shows_it_to_other_programs(tmp_path):
    painting = done(stroke()).painting
    save(tmp_path / "a.ora", Snapshot(painting))
    found = open_painting(tmp_path / "a.ora").painting
    assert found.paper == PAPER
    np.testing.assert_array_equal(picture(found), picture(painting))
    with zipfile.ZipFile(tmp_path / "a.ora") as file:
        told = json.loads(file.read(MANIFEST))
        stack = file.read("stack.xml").decode()
        for name in ("mergedimage.png", "Thumbnails/thumbnail.png", "data/paper.png"):
            file.extract(name, tmp_path)
            pixels, _ = read_image(tmp_path / name, name)
            assert (pixels[0, 0] == COLOUR).all()
    assert (told["inkfall"], told["paper"]) == (FORMAT, PAPER)
    assert stack.rindex("data/paper.png") > stack.rindex("data/L1.png")
    assert format_of(done(stroke(), paper=None).painting) < FORMAT


def test_a_recording_keeps_it(tmp_path):
    session = done(stroke())
    write(session.recording(), tmp_path / "a.jsonl")
    found = read(tmp_path / "a.jsonl")
    assert found.header.paper == PAPER
    assert json.loads((tmp_path / "a.jsonl").read_text().splitlines()[0])["inkfall"] == 2
    assert first_painting(found.header).paper == PAPER
    assert "paper" not in Recording(Header()).header.to_json()


@pytest.mark.parametrize("paper", ["red", "#12345", 7, "#12345g", ["#ffffff"]])
def test_what_is_no_colour_is_refused(paper):
    with pytest.raises(FieldError, match=r"header\.paper"):
        parse_header({"inkfall": 2, "paper": paper})


def test_version_1_keeps_a_member_of_that_name_and_shows_nothing():
    header = parse_header({"inkfall": 1, "paper": "#ffffff"})
    assert header.paper is None
    again = parse_header(header.to_json(2))
    assert again.paper is None


def test_it_is_no_paint():
    """What is taken from the canvas, shown by a placement, or merged, has holes where nothing was painted."""
    texture = {"do": "texture", "name": "t", "maker": "canvas", "rect": [0, 0, 0, 90, 70]}
    session = done(
        stroke(),
        texture,
        {"do": "layer", "add": "p", "kind": "placement", "of": None, "rect": [0, 0, 0, 90, 70], "levels": -1},
    )
    placed = layers.find(session.painting.root, "p")
    assert not composite(layers.alone(placed, session.painting.root), 0, FRAME, layer_planes)[3, -1].any()
    bare = done(stroke(), texture, paper=None)
    np.testing.assert_array_equal(session.painting.textures["t"].source.data, bare.painting.textures["t"].source.data)
    session = done(stroke(), {"do": "layer", "add": "b"}, {"do": "layer", "flatten": None})
    assert session.painting.paper == PAPER
    assert not layer_planes(session.painting.root.children[0], 0, FRAME)[3, 0].any()


def test_it_is_changed_taken_back_kept_and_replayed(tmp_path):
    session = done(stroke(opacity=0.6), {"do": "paper", "colour": "#2080C0"}, stroke(radius=5))
    blue = picture(session.painting)
    np.testing.assert_array_equal(blue, picture(done(stroke(opacity=0.6), stroke(radius=5), paper="#2080c0").painting))
    assert (session.painting.paper, session.recording().header.paper) == ("#2080c0", PAPER)
    assert session.recording().header.to_json()["inkfall"] == 2
    assert version_of(session.log[1]) == 2
    save(tmp_path / "a.ora", Snapshot(session.painting, session.recording()))
    found = open_painting(tmp_path / "a.ora")
    assert found.recording is not None
    for painting in (found.painting, replay(found.recording).painting, replay(session.recording()).painting):
        np.testing.assert_array_equal(picture(painting), blue)
        assert header_for(painting).paper == PAPER
    session.do(c.Undo(2))
    np.testing.assert_array_equal(picture(session.painting), picture(done(stroke(opacity=0.6)).painting))
    session.do(c.parse({"do": "paper", "colour": None}))
    assert picture(session.painting)[3].min() == 0
    assert format_of(session.painting) < FORMAT


def test_a_paper_that_came_later_is_kept(tmp_path):
    session = done(stroke(), {"do": "paper", "colour": PAPER}, paper=None)
    write(session.recording(), tmp_path / "a.jsonl")
    assert "paper" not in (tmp_path / "a.jsonl").read_text().splitlines()[0]
    np.testing.assert_array_equal(
        picture(replay(read(tmp_path / "a.jsonl")).painting), picture(done(stroke()).painting)
    )


@pytest.mark.parametrize("wrong", [{}, {"colour": 3}, {"colour": "white"}, {"colour": "#12345"}])
def test_a_command_without_a_colour_is_refused(wrong):
    with pytest.raises(FieldError, match="#rrggbb"):
        c.parse({"do": "paper", **wrong})


def test_another_paper_is_seen_everywhere():
    painting = done(stroke()).painting
    other = replace(painting, root=replace(painting.root, paper=None))
    assert areas(painting, other)(0) is None
