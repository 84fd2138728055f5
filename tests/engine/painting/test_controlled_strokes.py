"""Strokes with examples that have control channels: the pixels follow what is told, and hang on the recording alone."""

import io
import itertools
import json

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from PIL import Image
from plantings import alike, fresh, meadow, pixels, stroke, texture

from engine.archive.opening import open_painting
from engine.archive.saving import Snapshot, save
from engine.canvas import layers
from engine.canvas.growth import settling
from engine.files.fault import FileError
from engine.numeric.address import Rect
from engine.painting import commands as c
from engine.painting import recording as r
from engine.painting.value import Refusal
from engine.session.replay import replay
from engine.strokes.example_textures import channels_of, exemplar_of
from engine.texture.example import tiles

__all__ = ["meadow"]

MAPS = {
    "orientation": {"strokes": [{"points": [[4, 20], [36, 20]]}], "turns": 8},
    "rim": {"width": 9},
    "glow": {"strokes": [{"points": [[20, 20]], "brush": {"radius": 9, "colour": "#ffffff"}}], "weight": 0.5},
}
FOLLOWS = {"orientation": "stroke", "glow": 0.75}
WAY = [[14, 14], [60, 20], [70, 60], [30, 64]]


@pytest.fixture
def session(meadow):
    found = fresh(meadow)
    found.do(texture("c", "a.png", maps=MAPS, levels=3))
    return found


def follow(points, **brush):
    return stroke(points, **{"example": "c", "control": FOLLOWS, **brush})


def told(session, layer="Layer 1"):
    """What channels tell of the pixels of the only plot: uint8 (channels, 96, 96), 0 outside it, and the mask."""
    (plot,) = layers.find(session.painting.root, layer).growth
    place = Rect.at(0, 0, 96, 96)
    mask = tiles.gathered(plot.region.masks[0], place, np.zeros((1, 96, 96), np.uint8))[0] > 0
    return tiles.gathered(plot.region.told[0], place, np.zeros((2, 96, 96), np.uint8)), mask


def test_pixels_are_told_which_way_the_stroke_runs(session):
    session.do(follow([[10, 20], [80, 20]]))
    session.do(follow([[60, 40], [60, 90]], control={"orientation": "stroke", "glow": 0.0}))
    planes, mask = told(session)
    assert set(planes[0, 12:28, 12:50][mask[12:28, 12:50]]) == {0}
    assert set(planes[1, 20, 12:50]) == {191}
    assert set(planes[0, 45:88, 60]) == {64}
    assert set(planes[1, 45:88, 60]) == {0}
    assert not planes[:, ~mask].any()
    session.do(follow([[80, 20], [10, 20]]))  # the other way, over what is there
    assert set(told(session)[0][0, 20, 14:76]) == {128}
    session.do(c.Undo())
    assert np.array_equal(told(session)[0], planes)


def test_copies_run_as_they_lie(session):
    session.do(
        c.parse(
            {
                "do": "stroke",
                "points": [[10, 10], [40, 10]],
                "copies": [[1, 0, 90, 30, True], [0, 1, 80, 40, False]],
                "brush": {"mode": "example", "example": "c", "radius": 5, "dynamics": {}, "control": FOLLOWS},
            }
        )
    )
    planes, mask = told(session)
    assert mask[40, 70]
    assert planes[0, 40, 70] == 128
    assert mask[60, 70]
    assert planes[0, 60, 70] == 64


@settings(deadline=None, max_examples=4)
@given(data=st.data())
def test_however_it_is_drawn_it_is_what_its_recording_gives(meadow, data):
    session = fresh(meadow)
    session.do(texture("c", "a.png", maps=MAPS, levels=3))
    session.do(follow([[10, 70], [80, 50]], control={"glow": 0.2}))
    command = follow(WAY, radius=data.draw(st.sampled_from([4, 11])))
    live = session.begin(0, (0, 0), command.brush)
    for part in np.split(command.points, sorted(data.draw(st.sets(st.integers(1, 3))))):
        live.add(part)
        live.bed.follow()
        for grown in itertools.islice(settling(live.bed.growth), data.draw(st.integers(0, 9))):
            live.bed.follow(grown)
    shown = pixels(session.finish(live))
    text = "\n".join(session.recording().lines()).encode()
    assert json.loads(text.splitlines()[0])["inkfall"] == 2
    again = replay(r.read_from(io.BytesIO(text), "log", session.folder))
    assert alike(shown, pixels(again.painting, 2))
    session.do(c.Undo())
    assert alike(pixels(session.do(command)), shown)


def test_it_is_saved_and_opened(session, tmp_path):
    session.do(follow(WAY))
    session.do(follow([[50, 5], [52, 74]], radius=5, control={"orientation": 0.5}))
    wanted, place = pixels(session.painting), tmp_path / "a.ora"
    save(place, Snapshot(session.painting))
    found = open_painting(place)
    assert found.notes == ()
    assert alike(wanted, pixels(found.painting))
    one, other = (layers.find(p.root, "Layer 1").growth[0].region for p in (session.painting, found.painting))
    for a, b in zip(one.told, other.told, strict=True):
        assert set(a) == set(b)
        assert all(np.array_equal(a[key].data, b[key].data) for key in a)
    assert channels_of(found.painting.textures["c"]) == channels_of(session.painting.textures["c"])


def test_another_example_takes_over_what_it_has_channels_for(session, meadow):
    session.do(texture("d", "b.png", maps={"orientation": {"strokes": [], "turns": 8}}, levels=3))
    session.do(follow(WAY))
    before = told(session)[0]
    session.do(c.Swap(0, (20, 15), "d"))
    (plot,) = layers.find(session.painting.root, "Layer 1").growth
    after = tiles.gathered(plot.region.told[0], Rect.at(0, 0, 96, 96), np.zeros((1, 96, 96), np.uint8))
    assert np.array_equal(after[0], before[0])
    session.do(c.Swap(0, (20, 15), "a"))
    assert layers.find(session.painting.root, "Layer 1").growth[0].region.told == ()


def test_a_texture_or_nothing_tells(session):
    session.do(
        c.parse(
            {
                "do": "texture",
                "name": "ramp",
                "maker": "gradient",
                "from": [0, 0],
                "to": [96, 0],
                "ramp": [[0, "#000000"], [1, "#ffffff"]],
            }
        )
    )
    session.do(follow([[10, 20], [80, 20]], control={"glow": "ramp", "nothing of the example": 1}))
    planes, _ = told(session)
    assert abs(int(planes[1, 20, 24]) - 64) <= 2
    assert abs(int(planes[1, 20, 72]) - 191) <= 2
    usual = exemplar_of(session.painting.textures["c"]).control.usual
    assert set(planes[0, 20, 12:78]) == {usual[0]}
    with pytest.raises(Refusal, match=r"brush\.control\.glow"):
        session.do(follow([[1, 1]], control={"glow": "no such texture"}))


def test_a_parameter_file_names_maps(meadow):
    Image.new("L", (40, 40), 128).save(meadow / "half.png")
    (meadow / "c.toml").write_text('levels = 3\n[maps]\nsize = "half.png"\n[maps.rim]\nwidth = 8\n')
    session = fresh(meadow)
    session.do(texture("c", "a.png", params="c.toml"))
    own = session.painting.textures["c"]
    assert [one.name for one in channels_of(own)] == ["size", "rim"]
    assert exemplar_of(own).control.usual == (128,)
    recorded = session.recording().commands[-1]
    (meadow / "half.png").unlink()  # the recording keeps its picture's sha, and says what is missing
    with pytest.raises((Refusal, FileError), match=r"half\.png"):
        fresh(meadow).do(recorded)


@pytest.mark.parametrize(
    ("maps", "told"),
    [
        ([], r"maps: found \[\], expected an object of at most 4 maps"),
        ({"rim": {"turns": 8}}, r'maps\.rim\.turns: found 8, expected none: it belongs to "orientation"'),
        ({"rim": {"wide": 8}}, r"maps\.rim\.wide: found an unknown member, expected one of path, strokes"),
        ({"orientation": {"turns": 99}}, r"maps\.orientation\.turns: found 99, expected .* 36"),
        ({"size": 3}, r"maps\.size: found 3, expected a path, or an object"),
        ({"size": "b.wrong.png"}, r"b\.wrong\.png: found 5 x 4 pixels, expected 40 x 40 as the example"),
        ({"size": {"strokes": [{"points": 3}]}}, r"maps\.size\.strokes\[0\]\.points: found 3"),
    ],
)
def test_what_is_wrong_with_maps_is_told_in_one_line(meadow, maps, told):
    Image.new("L", (5, 4)).save(meadow / "b.wrong.png")
    with pytest.raises((Refusal, FileError), match=told):
        fresh(meadow).do(texture("c", "a.png", maps=maps))
