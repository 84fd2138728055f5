"""Films of paintings with selections, masks, tiles, placements, moves, fills and merges: the last frame is what the
recording gives when it is played."""

import numpy as np
import pytest
from test_shooting import FRAME, SIZE, recorded, seen, stroke

from engine.film.aim import aim_at
from engine.film.shooting import Film, Shooting
from engine.numeric.address import Rect
from engine.session.replay import replay
from engine.studio.filing.filming import making_of

PAINTED = [
    {"do": "layer", "add": "Tile"},
    {"do": "layer", "set": "Tile", "wrap": [0, 0, 0, 64, 64]},
    stroke([[50, 10], [80, 50]], 12, brush={"colour": "#305070"}),
    {"do": "layer", "add": "Paint"},
    {"do": "select", "ellipse": [0, 20, 10, 80, 60], "feather": 4},
    stroke([[10, 40], [150, 40]], 30, brush={"colour": "#c02010"}),
    {"do": "fill", "like": {"at": [60, 20]}, "open": True, "brush": {"colour": "#20a040", "opacity": 0.5}},
    {"do": "layer", "set": "Paint", "selected": "cut", "at": [30, 10], "level": 0},
    {"do": "layer", "set": "Paint", "mask": True},
    {"do": "undo", "count": 2},
    {"do": "redo"},
    {"do": "layer", "set": "Paint", "mask": True},
    {"do": "select", "none": True},
    {"do": "layer", "add": "Again", "kind": "placement", "of": "Paint", "at": [40, -20], "c": [0.8, 0.5]},
    {"do": "layer", "set": "Paint", "at": [5, 8], "turn": 0},
    stroke([[300, 200], [360, 220]], 5, level=2, layer="Paint", brush={"colour": "#f0e020"}),
]


@pytest.fixture(scope="module")
def painting():
    return replay(recorded(PAINTED)).painting


def of(painting, level, rect):
    return np.floor(seen(painting, level, rect) * 255.0 + 0.5).transpose(1, 2, 0)


def last_frame(*aims, seconds=4.0):
    film = Film(aims, SIZE, 4.0, seconds, making_of(recorded(PAINTED)))
    return [frame.copy() for frame in Shooting(film).frames(2)][-1]


def test_a_replay_ends_with_what_is_played(painting):
    assert painting.selection is None
    assert np.array_equal(last_frame(aim_at(0, FRAME, SIZE)), of(painting, 0, FRAME))


def test_a_flight_while_it_is_made_ends_with_it_too(painting):
    place = Rect.at(180, 120, *SIZE)
    assert np.array_equal(last_frame(aim_at(0, FRAME, SIZE), aim_at(2, place, SIZE)), of(painting, 2, place))
