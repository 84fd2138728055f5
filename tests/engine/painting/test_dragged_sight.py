"""While something is dragged, only what shows it is made anew, and all that is seen is what a whole look shows."""

from functools import cache

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from engine.canvas.placing.pose import Pose
from engine.numeric.colour import to_premul8
from engine.painting import commands as c
from engine.painting.layering.placing_members import Placing
from engine.studio import requests as q
from engine.studio.masked.mask_requests import ShowMask
from engine.studio.moving.move_requests import AskExtent, Extent, Try
from engine.studio.results import Patch, Same
from engine.studio.sight import tile_rect
from engine.studio.studio import Studio

BRUSH = {"radius": 14, "colour": "#306080", "opacity": 0.8}
TILES = [(level, x, y) for level in (-1, 0, 1) for x in range(-1, 2) for y in range(-1, 1)]
COMMANDS = (
    {"do": "stroke", "points": [[-240, -200], [240, 200]], "brush": {"radius": 60}},
    {"do": "layer", "add": "Part"},
    {"do": "stroke", "points": [[10, 10], [60, 40]], "brush": BRUSH},
    {"do": "stroke", "level": 3, "points": [[300, 400], [340, 410]], "brush": BRUSH},
    {"do": "layer", "add": "Clipped"},
    {"do": "stroke", "points": [[0, 30], [90, 20]], "brush": {"radius": 9, "colour": "#c02010"}},
    {"do": "layer", "set": "Clipped", "clip": True, "blend": "multiply"},
    {"do": "layer", "add": "Group", "kind": "group"},
    {"do": "layer", "add": "Inner", "group": "Group"},
    {"do": "stroke", "level": -2, "points": [[-20, -10], [-12, -2]], "brush": {"radius": 5, "colour": "#20a040"}},
    {"do": "layer", "set": "Group", "opacity": 0.6},
    {"do": "layer", "add": "Again", "kind": "placement", "of": "Inner", "at": [90, 30], "c": [0.8, 0.6], "group": None},
    {"do": "layer", "add": "Top"},
    {"do": "stroke", "points": [[-100, 20], [100, 60]], "brush": {"radius": 6, "colour": "#f0e040"}},
)
CHOSEN = {"do": "select", "ellipse": [0, 5, 0, 60, 50], "feather": 4}


class Screen:
    """A studio whose tiles are kept as a window keeps them; `made`: how many pixels were sent."""

    def __init__(self, *commands):
        self.tiles, self.made, self.extents = {}, 0, []
        self.studio = Studio(self._take, lambda request: None)
        for command in commands:
            self.studio.do(q.Do(c.parse(command)))

    def _take(self, result):
        if isinstance(result, Patch):
            _, pixels = self.tiles.setdefault(result.tile, [0, np.zeros((256, 256, 4), np.uint8)])
            pixels[result.area.y0 : result.area.y1, result.area.x0 : result.area.x1] = result.pixels
            self.tiles[result.tile][0] = result.revision
            self.made += result.area.area
        elif isinstance(result, Same):
            for key in result.tiles:
                self.tiles[key][0] = result.revision
        elif isinstance(result, Extent):
            self.extents.append(result)

    def see(self, tiles=TILES):
        self.made = 0
        self.studio.look(q.Look(tuple((*key, self.tiles.get(key, (-1,))[0]) for key in tiles)))
        while self.studio.pending:
            self.studio.step()

    def reach(self, name, selected=False, level=0):
        self.studio.do(AskExtent(name, level, selected))
        while not self.extents:
            self.studio.step()
        return self.extents.pop().part

    def right(self, tiles=TILES):
        for key in tiles:
            whole = to_premul8(self.studio.easel.picture(key[0], tile_rect(key)))
            np.testing.assert_array_equal(self.tiles[key][1], whole, err_msg=str(key))


@cache
def screen():
    return Screen(*COMMANDS)


shifts = st.tuples(st.integers(-90, 90), st.integers(-90, 90))
poses = st.one_of(
    st.builds(Pose, shifts, st.integers(-1, 3), st.integers(-1, 1), st.integers(0, 3), mirror=st.booleans()),
    st.builds(Pose, shifts, turned=st.tuples(st.floats(0.5, 1.1), st.floats(-1, 1).filter(lambda v: abs(v) > 1e-3))),
)
tries = st.one_of(
    st.none(), st.tuples(poses, st.just(False), st.sampled_from([None, "cut", "copy"])),
    st.tuples(poses, st.booleans(), st.none()),
)  # fmt: skip


def check_dragged(name, dragged, tiles):
    held, part = screen(), None
    held.studio.do(q.Do(c.parse(CHOSEN)))
    held.see(tiles)
    for one in (*dragged, None):
        pose, copy, part = (None, False, part) if one is None else one
        part = None if name in ("Group", "Again") else part
        held.reach(name, part is not None)
        held.studio.do(Try(name, None if pose is None else Placing.at_pose(pose), copy, part))
        held.see(tiles)
        held.right(tiles)


@pytest.mark.parametrize("name", ["Part", "Clipped", "Group", "Again"])
def test_what_is_seen_while_something_is_dragged_is_what_a_whole_look_shows(name):
    ways = (Pose((30, 9)), False, "cut"), (Pose((5, -9), turned=(0.7, 0.4)), False, "cut"), (Pose((7, 7)), True, None)
    check_dragged(name, ways, [(0, 0, 0), (0, -1, 0), (1, 0, 0)])


@pytest.mark.nightly
@settings(deadline=None, max_examples=100)
@given(st.sampled_from(["Part", "Clipped", "Group", "Again", "Top"]), st.lists(tries, min_size=1, max_size=4))
def test_it_is_so_however_it_is_dragged(name, dragged):
    check_dragged(name, dragged, TILES)


@pytest.mark.parametrize("part", [None, "cut", "copy"])
@pytest.mark.parametrize("turned", [None, (0.8, 0.6)])
def test_only_what_shows_it_is_made_anew(part, turned):
    held = Screen(*COMMANDS[:3], CHOSEN)
    held.see()
    assert held.made == len(TILES) << 16
    held.reach("Part", part is not None)
    for x in (3, 7):
        held.studio.do(Try("Part", Placing.at_pose(Pose((x, 5), turned=turned)), selected=part))
        held.see()
        assert 0 < held.made < 80_000
        held.right()


@pytest.mark.parametrize(
    "commands",
    [
        [{"do": "layer", "add": "More", "kind": "placement", "of": "Part", "at": [-90, -90]}],
        [{"do": "layer", "set": "Part", "blend": "dst-in"}],
        [{"do": "layer", "set": "Part", "wrap": [0, 0, 0, 120, 90]}],
    ],
)
def test_what_changes_more_than_its_place_is_seen_whole(commands):
    held = Screen(*COMMANDS[:3], *commands)
    held.see()
    held.reach("Part")
    for x in (3, 70):
        held.studio.do(Try("Part", Placing.at_pose(Pose((x, 5))), copy=True))
        held.see()
        held.right()


def test_a_mask_that_is_seen_alone_goes_as_its_layer_is_dragged():
    held = Screen(*COMMANDS[:3], CHOSEN, {"do": "layer", "set": "Part", "mask": True})
    held.studio.do(ShowMask("Part"))
    held.see()
    held.right()
    held.reach("Part")
    for pose in (Pose((3, 3)), None):
        held.studio.do(Try("Part", None if pose is None else Placing.at_pose(pose)))
        held.see()
        held.right()
