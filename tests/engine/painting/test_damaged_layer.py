"""A layer that has lost tiles: what its picture and the tiles that are left tell of them, within the frame and outside.

Brush strokes lie inside and outside the frame.  The blocks of one level of a pack are lost, or all of a pack.
"""

import io
import json
import struct
import zipfile

import numpy as np
import pytest

from engine.archive.opening import open_painting
from engine.archive.saving import Snapshot, save
from engine.canvas import layers
from engine.canvas.reading import layer_planes
from engine.canvas.tile_cache import TileCache
from engine.numeric.address import Rect
from engine.painting import commands as c
from engine.session.apply import Painting
from engine.session.damaged import open_or_salvage
from engine.session.session import Session

FRAME = Rect.at(-32, 0, 160, 128)
AROUND = FRAME.grown(96)
PACK = "inkfall/layers/{}/0.tiles"


def stroke(x, y, colour, **more):
    brush = {"radius": 16, "colour": colour, "hardness": 0.5, **more}
    points = [[0, 0], [30, 15, 0.7]]
    return {"do": "stroke", "level": more.pop("level", 0), "origin": [x, y], "points": points, "brush": brush}


COMMANDS = (
    stroke(0, 60, "#c04020"),
    stroke(110, 90, "#2060c0", radius=20),  # across the edge of the frame
    stroke(150, 40, "#20a030"),
    stroke(-90, 20, "#303030", radius=25, hardness=0.9),
    stroke(60, 130, "#102080", radius=10, opacity=0.5),
    {"do": "layer", "add": "rock"},
    stroke(20, 50, "#807060", ink=[{"texture": "rock", "amount": 0.7, "colour": "#ffffff", "period": 24}]),
    {"do": "layer", "add": "small"},
    stroke(10, 20, "#c04020", radius=9),
)
PAINT, ROCK, SMALL = 1, 2, 3  # the layers' numbers


@pytest.fixture(scope="module")
def saved(tmp_path_factory):
    """The file's bytes, and the painting."""
    session = Session(Painting(FRAME, 11), TileCache(64 << 20))
    for command in COMMANDS:
        session.do(c.parse(command))
    path = tmp_path_factory.mktemp("saved") / "a.ora"
    save(path, Snapshot(session.painting))
    return path.read_bytes(), open_painting(path).painting


def flipped(data, layer, level=None):
    """The file with a bit flipped in a layer's blocks of a level; in the head of its pack for None."""
    bad = bytearray(data)
    with zipfile.ZipFile(io.BytesIO(data)) as archive:
        start = data.index(b"inkfall\x03", archive.getinfo(PACK.format(layer)).header_offset)
    (length,) = struct.unpack_from("<I", data, start + 8)
    at = start + 12 + length
    head = json.loads(data[start + 12 : at])
    levels = [tile[0] for tile in head["tiles"]]
    if level is None:
        bad[start + 40] ^= 4
    for count, _, stored in head["blocks"]:
        own, levels = levels[:count], levels[count:]
        if level in own:
            bad[at + stored // 2] ^= 4
        at += stored
    assert bad != data
    return bytes(bad)


def salvaged(data, layer, folder, level=None):
    path = folder / "damaged.ora"
    path.write_bytes(flipped(data, layer, level))
    found = open_or_salvage(path)
    assert not found.native
    return found.painting


def seen(painting, layer, level, rect):
    """What a layer shows, premultiplied, in units of 1/255."""
    found = next(one for one in layers.layers(painting.root) if one.id == layer)
    planes = layer_planes(found, level, rect)
    if planes is None:
        return np.zeros((4, rect.height, rect.width))
    return 255.0 * np.minimum(np.maximum(planes, 0), planes[3:])


def worst(one, other, layer, level, rect):
    rect = rect.zoomed(level)
    return np.abs(seen(one, layer, level, rect) - seen(other, layer, level, rect)).max()


@pytest.mark.parametrize("level", [-7, -5, -4, -3, -1])
def test_outside_the_frame_a_lost_level_is_had_from_the_finer_ones(saved, tmp_path, level):
    data, whole = saved
    found = salvaged(data, PAINT, tmp_path, level)
    for seen_at in (level, -2, 0, 1):
        assert worst(found, whole, PAINT, seen_at, AROUND) < 3, seen_at


def test_of_a_lost_pack_the_picture_is_seen_from_afar_too(saved, tmp_path):
    data, whole = saved
    for layer in (ROCK, SMALL):
        found = salvaged(data, layer, tmp_path)
        for level in (0, -1, -2, -3, -4):
            assert worst(found, whole, layer, level, FRAME) < 2
    for level in (-8, 0, 1):  # all of it lay within the frame
        assert worst(found, whole, SMALL, level, AROUND) < 2


@pytest.mark.parametrize("level", [-4, -2, -1])
def test_without_ink_what_it_made_of_the_other_levels_is_had_within_the_frame(saved, tmp_path, level):
    data, whole = saved
    found = salvaged(data, ROCK, tmp_path, level)
    for seen_at in range(level, 1):
        assert worst(found, whole, ROCK, seen_at, FRAME) < 2


def test_what_is_whole_and_shows_what_it_should_stays(saved, tmp_path):
    """The coarsest level alone is lost, which nobody sees."""
    data, whole = saved
    found = salvaged(data, PAINT, tmp_path, -12)
    before, after = (next(layers.layers(painting.root)).pyramid.levels for painting in (whole, found))
    for level in range(-10, 1):
        assert set(before[level]) == set(after[level])
        assert all(np.array_equal(before[level][at].data, record.data) for at, record in after[level].items())
