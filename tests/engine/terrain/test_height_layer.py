"""A layer of the role "height": no part of the picture, one at most, with a scale and a sea of its own."""

import json

import numpy as np
import pytest

from engine.archive.opening import open_painting
from engine.archive.saving import Snapshot, save
from engine.canvas import layers
from engine.checks.field_error import FieldError
from engine.numeric.address import Rect
from engine.painting import commands as c
from engine.painting.recording import version_of
from engine.painting.rendering import strips
from engine.painting.value import Painting, Refusal
from engine.session.session import Session
from engine.terrain.plane import land

FRAME = Rect.at(0, 0, 96, 64)
AT = Rect.at(48, 32, 1, 1)


def stroke(colour, layer):
    return {"do": "stroke", "points": [[48, 32]], "layer": layer, "brush": {"radius": 12, "colour": colour}}


@pytest.fixture
def session():
    made = Session(Painting(FRAME, 7))
    for command in (
        {"do": "layer", "add": "Colours"},
        stroke("#ff0000", "Colours"),
        {"do": "layer", "add": "Hills"},
        stroke("#ffffff", "Hills"),
        {"do": "layer", "set": "Hills", "role": "height", "scale": 30, "sea": 0.25},
    ):
        made.do(c.parse(json.loads(json.dumps(command))))
    return made


def test_it_is_the_land_and_no_part_of_the_picture(session):
    assert land(session.painting).height(0, AT)[0, 0] == pytest.approx(0.75 * 30)
    assert land(session.painting, scale=10, sea=0).height(0, AT)[0, 0] == pytest.approx(10)
    shown = next(strips(layers.pictured(session.painting.root), 0, AT))
    assert shown[:, 0, 0].tolist() == [1, 0, 0, 1]
    assert land(session.painting, "composite", scale=1.0).height(0, AT)[0, 0] == pytest.approx(0.2126)


def test_it_is_kept_in_files_and_taken_back(session, tmp_path):
    save(tmp_path / "a.ora", Snapshot(session.painting, session.recording()))
    opened = open_painting(tmp_path / "a.ora")
    hills = layers.find(opened.painting.root, "Hills")
    assert (hills.role, hills.scale, hills.sea) == ("height", 30.0, 0.25)
    assert list(opened.recording.commands) == list(session.log)
    assert (
        land(opened.painting).height(3, AT.zoomed(3)).tolist()
        == land(session.painting).height(3, AT.zoomed(3)).tolist()
    )
    session.do(c.parse({"do": "undo"}))
    assert layers.find(session.painting.root, "Hills").scale is None
    assert land(session.painting).source == "composite"


def test_another_one_takes_the_role(session):
    session.do(c.parse({"do": "layer", "set": "Colours", "role": "height"}))
    assert [node.role for node in layers.walk(session.painting.root)] == ["height", ""]
    assert land(session.painting).scale == FRAME.width / 6
    session.do(c.parse({"do": "undo"}))
    assert land(session.painting).source == "Hills"


def test_hills_are_not_merged_with_what_is_seen(session):
    with pytest.raises(ValueError, match="'Hills': found it a height"):
        session.do(c.parse({"do": "layer", "merge": "Hills"}))
    session.do(c.parse({"do": "layer", "add": "More"}))
    session.do(c.parse({"do": "layer", "set": "More", "role": "height"}))
    session.do(c.parse({"do": "layer", "set": "Hills", "role": "height", "scale": 5}))


@pytest.mark.parametrize("wrong", [{"scale": 0}, {"scale": "high"}, {"sea": 17}, {"role": "depth"}])
def test_what_is_no_height_is_refused(session, wrong):
    with pytest.raises((FieldError, Refusal)):
        session.do(c.parse({"do": "layer", "set": "Hills", **wrong}))


def test_it_is_of_version_2():
    command = c.parse({"do": "layer", "set": "Hills", "scale": 30.5, "sea": 0})
    assert version_of(command) == 2
    assert c.to_json(command) == {"do": "layer", "set": "Hills", "scale": 30.5, "sea": 0.0}
    assert np.isclose(command.scale, 30.5)
