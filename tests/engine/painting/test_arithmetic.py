"""The arithmetic in which a painting is worked out: which one it has, and that it keeps it for ever."""

import io
import json
from dataclasses import replace

import everything
import numpy as np
import pytest

from engine.archive.opening import open_painting
from engine.archive.saving import Snapshot, save
from engine.canvas.evaluate import evaluate
from engine.canvas.layers import layers
from engine.files.fault import FileError
from engine.numeric.address import Rect
from engine.numeric.arithmetic import EVERYWHERE, LIBRARY
from engine.painting import commands as c
from engine.painting import recording as r
from engine.painting.grown import settled
from engine.session.replay import replay
from engine.session.session import Session
from engine.strokes.example_textures import exemplar_of
from engine.studio import requests as q
from engine.studio.studio import Studio
from engine.texture.table import KINDS, from_key, instance

FRAME = {"frame": [0, 0, 64, 48]}
ROCK = {"radius": 9, "ink": [{"texture": "rock", "period": 11.3, "roughness": 0.3}]}
STROKE = {"do": "stroke", "points": [[8, 8], [50, 40]], "brush": ROCK}
BOOKMARK = {"do": "bookmark", "name": "here", "level": 0, "origin": [0, 0], "size": [64, 48]}


def recording(header, *commands, folder=None):
    lines = "\n".join(map(json.dumps, [{**FRAME, **header}, *commands]))
    return r.read_from(io.BytesIO(lines.encode()), "a.jsonl", folder)


def plots(painting):
    return [plot for layer in layers(painting.root) for plot in layer.growth]


def told(found):
    """The header that a recording is written with."""
    return json.loads(next(iter(found.lines())))


def inks(painting):
    """The keys of all ink that lies on a painting."""
    rect = Rect(0, 0, 64, 48)
    return [ink.key[0] for layer in layers(painting.root) for ink in evaluate(layer.pyramid, 0, rect).inks]


@pytest.mark.parametrize(
    ("header", "arithmetic"),
    [
        ({"inkfall": 1}, LIBRARY),
        ({"inkfall": 1, "arithmetic": 2}, LIBRARY),  # unknown to version 1, and so without a meaning
        ({"inkfall": 2}, EVERYWHERE),
        ({"inkfall": 2, "arithmetic": 1}, LIBRARY),
        ({"inkfall": 2, "arithmetic": 2}, EVERYWHERE),
    ],
)
def test_the_version_tells_the_arithmetic_unless_the_header_does(header, arithmetic):
    found = recording(header, STROKE)
    assert found.header.arithmetic == arithmetic
    painting = replay(found).painting
    assert painting.arithmetic == arithmetic
    assert inks(painting) == ["rock" if arithmetic == LIBRARY else "rock#2"]


@pytest.mark.parametrize("value", [0, 3, True, "2", None, 1.5])
def test_another_arithmetic_is_refused(value):
    with pytest.raises(FileError, match=r"header\.arithmetic"):
        recording({"inkfall": 2, "arithmetic": value})


@pytest.mark.parametrize("version", [1, 2])
@pytest.mark.parametrize("more", [(), (BOOKMARK,)])
def test_a_painting_keeps_its_arithmetic_whatever_is_done_and_wherever_it_goes(tmp_path, version, more):
    session = replay(recording({"inkfall": version}, STROKE, *more))
    written = session.recording()
    header = told(written)
    assert header["inkfall"] == (2 if version == 2 or more else 1)
    assert ("arithmetic" in header) == (version == 1 and bool(more))
    again = r.read_from(io.BytesIO("\n".join(written.lines()).encode()), "b.jsonl")
    assert again.header.arithmetic == session.painting.arithmetic == version
    save(tmp_path / "a.ora", Snapshot(session.painting, written))
    opened = open_painting(tmp_path / "a.ora")
    assert opened.painting.arithmetic == version
    assert opened.recording.header.arithmetic == version
    assert inks(opened.painting) == inks(session.painting)
    on = Session(opened.painting, log=opened.recording.commands)
    session.do(c.parse({**STROKE, "points": [[40, 6], [5, 40]]}))
    on.do(c.parse({**STROKE, "points": [[40, 6], [5, 40]]}))
    rect = Rect(0, 0, 64, 48)
    one, other = (evaluate(next(layers(p.root)).pyramid, 0, rect) for p in (session.painting, on.painting))
    assert np.array_equal(one.data, other.data)
    assert one.inks == other.inks
    assert on.base.arithmetic == version


@pytest.mark.parametrize("arithmetic", [LIBRARY, EVERYWHERE])
def test_what_is_learnt_from_pictures_is_learnt_in_the_paintings_arithmetic(tmp_path, arithmetic):
    """Also where the painting is opened again, and where its texture was defined anew since."""
    everything.pictures(tmp_path)
    grown = {"do": "texture", "name": "t", "maker": "example", "path": "blob.png", "channels": "luminance", "levels": 2}
    stroke = {"do": "stroke", "points": [[20, 20], [40, 24]], "brush": {"mode": "example", "example": "t", "radius": 7}}
    matched = {"do": "texture", "name": "m", "maker": "match", "path": "colour.png", "iterations": 1, "levels": 1}
    header = {"inkfall": 2, "arithmetic": arithmetic}
    session = replay(recording(header, grown, stroke, matched, {**grown, "channels": "colour"}, folder=tmp_path))
    whole = settled(session.painting, 1)
    assert [plot.region.exemplar.arithmetic for plot in plots(whole)] == [arithmetic]
    save(tmp_path / "a.ora", Snapshot(whole, session.recording()))
    opened = open_painting(tmp_path / "a.ora").painting
    assert [plot.region.exemplar.arithmetic for plot in plots(opened)] == [arithmetic]
    assert exemplar_of(opened.textures["t"]).arithmetic == arithmetic
    mine, theirs = (painting.textures["m"] for painting in (whole, opened))
    assert theirs.arithmetic == mine.arithmetic == arithmetic
    assert np.array_equal(theirs.source.data, mine.source.data)


def test_a_new_painting_in_the_window_has_the_newest(tmp_path):
    studio = Studio(lambda result: None, lambda request: None)
    try:
        assert studio.easel.session.painting.arithmetic == EVERYWHERE
        studio.do(q.New(Rect(0, 0, 64, 48), 5))
        assert studio.easel.session.painting.arithmetic == EVERYWHERE
        studio.do(q.Do(c.parse(STROKE)))
        written = studio.easel.session.recording()
        assert told(written)["inkfall"] == 2
        assert inks(replay(written).painting) == inks(studio.easel.session.painting) == ["rock#2"]
    finally:
        studio.close()


@pytest.mark.parametrize("kind", [name for name, row in KINDS.items() if not row.pictured])
def test_keys_tell_the_arithmetic(kind):
    """Those of version 1 are as they were; a kind that it makes no difference to has one key."""
    first, own = (instance(kind, {"period": 9.3}, 2, 7, arithmetic=number) for number in (LIBRARY, EVERYWHERE))
    assert first.key[0] == kind
    assert own.key[1:] == first.key[1:]
    assert own.key[0] == (kind if kind == "white" else f"{kind}#2")
    for made in (first, own):
        assert from_key(json.loads(json.dumps(made.key)), {}) == made
    if kind != "white":
        assert first != own
        assert replace(own, arithmetic=LIBRARY) == first


def test_a_texture_that_needs_no_definition_is_found_by_its_name_and_others_are_told():
    with pytest.raises(FileError) as told_to:
        replay(recording({"inkfall": 2}, {**STROKE, "brush": {"ink": [{"texture": "nothing"}]}}))
    assert str(told_to.value).count("rock") == 1
