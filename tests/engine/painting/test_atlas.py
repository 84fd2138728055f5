"""Where there is paint, as the window is told: in sight or not, the nearest, the map, and pictures of bookmarks."""

import numpy as np
import pytest

from engine.canvas.composite import composite
from engine.canvas.reading import layer_planes
from engine.canvas.tile_cache import TileCache
from engine.numeric.address import Rect
from engine.painting import commands as c
from engine.session.session import Session
from engine.studio import requests as q
from engine.studio import results
from engine.studio.atlas import depths
from engine.studio.atlas.atlas import Atlas
from engine.studio.atlas.miniature import miniature
from engine.studio.easel import Easel


def stroke(level, x, y, length=60, radius=8):
    rows = [[0, 0, 1], [length, 10, 1]]
    brush = {"radius": radius, "colour": "#204080", "hardness": 1, "dynamics": {}}
    return c.parse({"do": "stroke", "level": level, "origin": [x, y], "points": rows, "brush": brush})


DEEP = (61 << 30, 47 << 30)
COMMANDS = (
    stroke(0, 200, 300, 300, 20),
    stroke(30, *DEEP),
    stroke(5, (900 << 5), (100 << 5)),
    stroke(0, 90_000, -40_000),
)


@pytest.fixture(scope="module")
def easel():
    told = []
    easel = Easel(told.append)
    for command in COMMANDS:
        easel.carry_out(command)
    easel.told = told
    return easel


def asked(easel, *requests):
    """What the window is told, other than scenes."""
    atlas = Atlas(easel)
    del easel.told[:]
    for request in requests:
        atlas.handlers[type(request)](request)
    while atlas.pending:
        atlas.step()
    return easel.told


def around(level, x, y, side=700):
    return q.Seek(level, Rect.at(x - side // 2, y - side // 2, side, side))


@pytest.mark.parametrize(
    "seek",
    [
        around(0, 512, 384),
        around(-4, 32, 20),
        around(30, *DEEP),
        around(28, DEEP[0] >> 2, DEEP[1] >> 2),
        around(9, 300 << 9, 302 << 9),
    ],
)
def test_paint_in_sight_is_seen(easel, seek):
    (found,) = asked(easel, around(0, 9, 9), seek)
    assert found == results.Sought(seek.level, seek.area, True)


@pytest.mark.parametrize(
    ("seek", "level", "near"),
    [
        (around(0, 300, 3000), 0, (300, 300)),
        (around(30, DEEP[0] + 4000, DEEP[1]), 30, DEEP),
        (around(33, (61 << 33) + 9000, 47 << 33), 30, DEEP),
        (around(0, 89_000, -38_000), 0, (90_000, -40_000)),
        (around(0, 3**90, 5**80), 0, (300, 300)),
        (around(5, 950 << 5, 100 << 5), 5, (900 << 5, 100 << 5)),
    ],
)
def test_the_nearest_paint_is_found(easel, seek, level, near):
    (found,) = asked(easel, seek)
    assert not found.in_sight
    own, x, y = found.nearest
    assert own == level
    assert abs(x - near[0]) < 400
    assert abs(y - near[1]) < 400
    planes = easel.picture(own, Rect.at(x, y, 1, 1))
    assert planes[3, 0, 0] > 0


def test_where_nothing_is_painted_there_is_nothing_to_find():
    told = []
    easel = Easel(told.append)
    easel.told = told
    seek, size = around(0, 0, 0), (320, 240)
    found, picture, chart = asked(easel, seek, q.AskMap(size))
    assert found == results.Sought(0, seek.area, False)
    assert picture.ident == "map"
    assert chart == results.PaintMap(-1, Rect.at(0, 0, 512, 384), ())


def test_the_map_shows_the_frame_and_tells_of_deep_and_far_paint(easel):
    picture, chart = asked(easel, q.AskMap((320, 240)))
    assert (chart.level, chart.area) == (-1, Rect.at(0, 0, 512, 384))
    assert picture.pixels.shape == (384, 512, 4)
    assert picture.pixels[152:158, 110:240, 3].min() == 255
    assert {spot.level for spot in chart.spots} == {0, 5, 30}
    (deep,) = [spot for spot in chart.spots if spot.level == 30]
    assert deep.rect.meets(Rect.at(*DEEP, 60, 10))
    assert deep.rect.width <= 3 * 128
    assert [spot for spot in chart.spots if spot.level == 0 and spot.rect.x0 > 80_000]


def test_hidden_paint_is_nowhere(easel):
    easel.carry_out(c.SetLayer("Layer 1", visible=False))
    try:
        assert asked(easel, around(0, 512, 384))[0].nearest is None
        assert asked(easel, q.AskMap((320, 240)))[1].spots == ()
    finally:
        easel.carry_out(c.Undo())


def test_pictures_of_bookmarks_are_made_once_for_each_state(easel):
    atlas = Atlas(easel)
    marks = c.Bookmark("a", 0.0, (0, 0), (1024, 768)), c.Bookmark("b", 30.0, DEEP, (100, 50))
    made = []
    for _ in range(2):
        del easel.told[:]
        atlas.handlers[q.AskMiniatures](q.AskMiniatures(marks, (128, 96)))
        while atlas.pending:
            atlas.step()
        made.append([(picture.ident, picture.pixels.shape) for picture in easel.told])
    assert made == [[("place a", (96, 128, 4)), ("place b", (64, 128, 4))], []]
    easel.carry_out(c.AddLayer("another"))
    atlas.handlers[q.AskMiniatures](q.AskMiniatures(marks, (128, 96)))
    assert atlas.pending == 2
    easel.carry_out(c.Undo())


@pytest.fixture(scope="module")
def picture():
    session = Session(cache=TileCache(64 << 20))
    for command in (stroke(0, 100, 100), stroke(0, 140, 60, 10, 30)):
        session.do(command)

    def read(layer, level, rect):
        return layer_planes(layer, level, rect, session.cache)

    return lambda level, rect: composite(session.painting.root, level, rect, read)


def test_a_picture_of_a_whole_level_is_that_of_the_painting(picture):
    found = miniature(c.Bookmark("a", 0.0, (60, 20), (120, 100)), (120, 100), picture)
    assert np.allclose(found, picture(0, Rect.at(60, 20, 120, 100)), atol=1e-5)
    found = miniature(c.Bookmark("a", 1.0, (120, 40), (240, 200)), (120, 100), picture)
    assert np.allclose(found, picture(0, Rect.at(60, 20, 120, 100)), atol=1e-5)


def test_a_picture_is_turned_and_mirrored_as_the_view(picture):
    whole = picture(0, Rect.at(60, 20, 100, 100))
    for angle, mirrored, expected in (
        (90.0, False, np.rot90(whole, -1, (1, 2))),
        (180.0, False, whole[:, ::-1, ::-1]),
        (0.0, True, whole[:, :, ::-1]),
        (-90.0, True, np.rot90(whole[:, :, ::-1], 1, (1, 2))),
    ):
        found = miniature(c.Bookmark("a", 0.0, (60, 20), (100, 100), angle, mirrored), (100, 100), picture)
        assert np.allclose(found, expected, atol=1e-4)


def drained(work):
    """What a generator returns, and how many pauses it made."""
    pauses = 0
    while True:
        try:
            next(work)
            pauses += 1
        except StopIteration as end:
            return end.value, pauses


def test_far_flung_paint_is_gone_through_in_pieces():
    """However much there is: 20,000 places, each far from all others, and none holds the engine's thread."""
    finest = {0: {(x * 7919, (x * x) % 9973) for x in range(20_000)}}
    near, pauses = drained(depths.nearest_tiles(finest, 0, Rect.at(7919 * 128 * 5000, 0, 700, 700)))
    assert near[0] == (0, (7919 * 5000, (5000 * 5000) % 9973))
    assert pauses >= 4
    found, pauses = drained(depths.spots(finest, -12, 22))
    assert pauses >= 12
    assert 150 <= len(found) <= 300
    assert sum(spot.tiles for spot in found) == 20_000


def test_paint_at_more_levels_than_a_map_has_marks_is_mapped():
    finest = {level: {(0, 0), (-1, -1)} for level in range(400)}
    found, _ = drained(depths.spots(finest, 0, 22))
    assert sorted({spot.level for spot in found}) == list(range(400))


def test_what_a_placement_shows_of_a_hidden_layer_is_found():
    told = []
    easel = Easel(told.append)
    easel.told = told
    for command in (
        {"do": "layer", "add": "a"},
        {"do": "stroke", "layer": "a", "points": [[0, 0], [60, 10]], "brush": {"radius": 8, "colour": "#204080"}},
        {"do": "layer", "add": "there", "kind": "placement", "of": "a", "at": [50_000, 700], "turn": 1},
        {"do": "layer", "set": "a", "visible": False},
    ):
        easel.carry_out(c.parse(command))
    (far,) = asked(easel, around(0, 40_000, 0))
    assert not far.in_sight
    level, x, y = far.nearest
    assert abs(level) <= 1
    assert abs((x << 1 >> level + 1) - 50_000) < 100
    assert abs((y << 1 >> level + 1) - 730) < 100
    (near,) = asked(easel, around(0, 50_000, 700))
    assert near.in_sight
    *_, marks = asked(easel, q.AskMap((200, 150)))
    assert marks.spots
