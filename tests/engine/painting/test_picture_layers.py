"""Pictures that are laid on layers of their own: a pixel on a pixel, at any level."""

import io
import json
import zipfile
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from PIL import Image

from engine.archive.export import Picture, export
from engine.archive.imports import open_image
from engine.archive.manifest import FORMAT
from engine.archive.opening import open_painting
from engine.archive.saving import Snapshot, save
from engine.canvas import layers
from engine.canvas.composite import composite
from engine.canvas.reading import layer_planes
from engine.files.images import read_image
from engine.numeric.address import Rect
from engine.numeric.arithmetic import COARSE, EVERYWHERE, FINE
from engine.numeric.grid import snapped_to, step_of
from engine.painting import commands as c
from engine.painting.capture import read_picture
from engine.painting.recording import version_of
from engine.painting.value import Painting, Refusal
from engine.session.replay import replay
from engine.session.session import Session

SIDES = 150, 97  # pixels


def shown(painting, level, rect):
    return composite(painting.root, level, rect, layer_planes)


def done(session, told):
    session.do(c.parse(told))
    return session


def export_of(session, folder, **more):
    export(folder / "out.png", Picture(session.painting, **more))
    return read_image(folder / "out.png")[0]


@pytest.fixture(scope="module", params=["opaque", "clear", "deep"])
def photo(request, tmp_path_factory):
    """A PNG without alpha, with alpha, or of 16 bits."""
    path = tmp_path_factory.mktemp("photo") / "photo.png"
    chance = np.random.default_rng(4)
    width, height = SIDES
    if request.param == "deep":
        Image.fromarray(chance.integers(0, 1 << 16, (height, width), np.uint16)).save(path)
    else:
        pixels = chance.integers(0, 256, (height, width, 4), np.uint8)
        if request.param == "opaque":
            pixels[..., 3] = 255
        Image.fromarray(pixels).save(path)
    return path


def laid(photo, level=0, at=(0, 0), grid=FINE):
    session = Session(Painting(Rect(0, 0, 300, 200), arithmetic=EVERYWHERE, grid=grid))
    session.do(c.parse({"do": "texture", "name": "Photo", "maker": "image", "path": str(photo)}))
    session.do(
        c.parse({"do": "layer", "add": "Sea", "kind": "picture", "texture": "Photo", "level": level, "at": list(at)})
    )
    return session


def test_it_is_what_opening_the_picture_gives(photo):
    ours, opened = laid(photo).painting, open_image(photo).painting
    for level, rect in ((0, Rect(-9, -9, 170, 120)), (-1, Rect(-3, -3, 90, 60)), (2, Rect(40, 40, 200, 180))):
        assert np.array_equal(shown(ours, level, rect), shown(opened, level, rect))
    assert ours.active == "Sea"


@settings(suppress_health_check=[HealthCheck.function_scoped_fixture], max_examples=12, deadline=None)
@given(
    level=st.sampled_from((-40, -1, 0, 1, 5, 600)),
    at=st.tuples(*(2 * [st.integers(-200, 200) | st.just(1 << 300)])),
    grid=st.sampled_from((FINE, COARSE)),
)
def test_its_pixels_are_those_of_the_file_wherever_it_lies(photo, level, at, grid):
    session = laid(photo, level, at, grid)
    planes = snapped_to(read_picture(str(photo), None), step_of(grid))
    rect = Rect.at(*at, *SIDES)
    assert np.array_equal(shown(session.painting, level, rect), planes)
    around = shown(session.painting, level, rect.grown(40))
    around[:, 40:-40, 40:-40] = 0
    assert not around.any()
    assert np.array_equal(shown(replay(session.recording()).painting, level, rect), planes)


def test_it_is_one_step_of_undo_and_stays_with_the_painting(photo, tmp_path):
    copy = tmp_path / "copy.png"
    copy.write_bytes(photo.read_bytes())
    session = laid(copy, 1, (3, 5))
    before = shown(session.painting, 1, Rect(0, 0, 200, 200))
    copy.unlink()
    session.do(c.parse({"do": "undo"}))
    assert not layers.has(session.painting.root, "Sea")
    session.do(c.parse({"do": "redo"}))
    assert np.array_equal(shown(session.painting, 1, Rect(0, 0, 200, 200)), before)
    save(tmp_path / "sea.ora", Snapshot(session.painting, session.recording()))
    opened = open_painting(tmp_path / "sea.ora")
    assert np.array_equal(shown(opened.painting, 1, Rect(0, 0, 200, 200)), before)
    again = Session(Painting(arithmetic=EVERYWHERE))
    again.pictures = opened.pictures
    for command in opened.recording.commands:
        again.do(command)
    assert np.array_equal(shown(again.painting, 1, Rect(0, 0, 200, 200)), before)


@pytest.mark.parametrize(
    ("texture", "told"),
    [("Nothing", "layer 'Sea': found no texture 'Nothing', expected one that is a picture"),
     ("grit", "layer 'Sea': found a texture without a picture 'grit', expected one that is a picture")],
)  # fmt: skip
def test_what_is_no_picture_is_refused_in_a_line(texture, told):
    session = Session()
    session.do(c.parse({"do": "texture", "name": "grit", "maker": "rock"}))
    with pytest.raises(Refusal, match=f"^{told}$"):
        session.do(c.AddPicture("Sea", texture))
    assert len(session.log) == 1


def test_it_is_of_version_2_and_is_told_as_it_was():
    told = {"do": "layer", "add": "Sea", "kind": "picture", "texture": "Photo", "level": -3, "at": [4, -5]}
    command = c.parse(told)
    assert c.to_json(command) == told
    assert version_of(command) == 2


def test_a_reference_is_seen_while_one_paints_and_never_in_what_is_written(photo, tmp_path):
    session = laid(photo)
    plain = done(session, {"do": "layer", "add": "Paper", "to": 0, "group": None})
    bare = export_of(plain, tmp_path)
    done(session, {"do": "layer", "set": "Sea", "role": "reference"})
    reference = export_of(session, tmp_path)
    assert not np.array_equal(reference, bare)
    assert not reference.any()
    assert shown(session.painting, 0, Rect(0, 0, *SIDES)).any()  # on the canvas it is
    assert export_of(session, tmp_path, layer="Sea").any()  # and where it is asked for by name
    save(tmp_path / "sea.ora", Snapshot(session.painting, session.recording()))
    with zipfile.ZipFile(tmp_path / "sea.ora") as file:
        told = json.loads(file.read("inkfall/manifest.json"))
        assert told["inkfall"] == FORMAT
        assert 'name="Sea"' in file.read("stack.xml").decode()
        assert 'visibility="hidden"' in file.read("stack.xml").decode()
        merged = np.asarray(Image.open(io.BytesIO(file.read("mergedimage.png"))))
    assert not merged[..., 3].any()
    opened = open_painting(tmp_path / "sea.ora").painting
    assert layers.find(opened.root, "Sea") == replace(
        layers.find(session.painting.root, "Sea"), pyramid=layers.find(opened.root, "Sea").pyramid
    )
    done(session, {"do": "layer", "set": "Sea", "c": [0.6, 0.8]})
    assert not export_of(session, tmp_path).any()  # moved, it is one still
    done(session, {"do": "undo", "count": 2})
    assert np.array_equal(export_of(session, tmp_path), bare)


@pytest.mark.parametrize("none", [None, ""])
def test_taking_a_role_away_is_told_and_read_again(none):
    """Versions of one day wrote "" for it, and could not read their own recordings."""
    command = c.parse({"do": "layer", "set": "Sea", "role": none})
    assert c.to_json(command) == {"do": "layer", "set": "Sea", "role": None}
    assert c.parse(c.to_json(command)) == command
