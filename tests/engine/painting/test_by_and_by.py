"""A picture that contains itself, of more turns than a step makes: seen at once, finished while nothing else waits."""

import numpy as np
import pytest
from test_easel import Window

from engine.brush.settings import Brush
from engine.canvas.placing import portions
from engine.numeric.colour import to_premul8
from engine.painting import commands as c
from engine.studio import requests as q
from engine.studio import results, seen_plan
from engine.studio.seen_plan import TURNS
from engine.studio.sight import tile_rect

LEVEL, AT = 80, (60, 96)  # where all turns are: halved, and moved by (30, 48), it stays
TILES = [(LEVEL, (AT[0] << LEVEL - 8) - n, (AT[1] << LEVEL - 8) - n) for n in (0, 1)]


def opened():
    """A window that has thin paint in sight, over the place that all turns share."""
    window = Window()
    thin = {"radius": 20, "opacity": 0.02, "colour": "#e08020", "hardness": 1}
    for command in (
        {"do": "stroke", "points": [[0, 64], [128, 64]], "brush": {"radius": 120, "colour": "#305070", "hardness": 1}},
        {"do": "layer", "add": "itself", "kind": "placement", "of": None, "at": [30, 48], "levels": -1,
         "rect": [0, 0, 0, 128, 128]},
        {"do": "layer", "add": "over"},
        {"do": "layer", "move": "over", "to": 2},
        {"do": "stroke", "points": [[60, 96], [61, 96]], "brush": thin},
    ):  # fmt: skip
        window.studio.do(q.Do(c.parse(command)))
    window.look(*TILES)
    return window


def complete(window, tile):
    return to_premul8(window.studio.easel.picture(LEVEL, tile_rect(tile)))


def test_a_step_makes_some_turns_and_what_is_finished_is_the_picture_to_the_bit():
    window, wanted = opened(), [complete(opened(), tile) for tile in TILES]
    window.studio.step()
    window.studio.step()
    for tile, pixels in zip(TILES, wanted, strict=True):
        first = window.tiles[tile].astype(int)
        assert window.revisions[tile] == -1  # it is asked for again
        assert 1 < np.abs(first - pixels).max() < 200
    steps = 0
    while window.studio.pending:
        window.studio.step()
        steps += 1
    assert steps >= 2 * (LEVEL // TURNS - 1)
    for tile, pixels in zip(TILES, wanted, strict=True):
        np.testing.assert_array_equal(window.tiles[tile], pixels)
        assert window.revisions[tile] >= 0


@pytest.mark.parametrize("ends", [q.Finish(), q.Abandon()])
def test_a_stroke_over_it_is_seen_point_by_point_and_finished_where_the_pen_rests(ends):
    window = opened()
    window.look(TILES[0])
    window.studio.step()
    x, y = AT[0] << LEVEL, AT[1] << LEVEL
    window.studio.do(q.Begin(LEVEL, (x, y), Brush(radius=30.0, opacity=0.03, colour="#e01020"), "over"))
    for at in (5.0, 60.0):
        points = np.array([[at, at, 1.0, 0.0, 0.0, at], [at + 8, at, 1.0, 0.0, 0.0, at + 1]])
        window.studio.do(q.Points(points))
        for _ in range(2):
            window.studio.step()
    window.work()
    window.check(TILES[0])
    window.studio.do(ends)
    for _ in range(2):
        window.studio.step()
    window.studio.do(q.Do(c.parse({"do": "layer", "set": "over", "opacity": 0.9})))
    window.studio.step()
    window.studio.do(q.Do(c.Undo()))
    window.work()
    window.check(TILES[0])


def test_a_colour_is_picked_of_as_many_turns_as_one_can_wait_for(monkeypatch):
    """And what is shown there is gone on with after that, to the bit."""
    window, wanted = opened(), complete(opened(), TILES[0])
    made = []
    advanced = portions._advanced
    monkeypatch.setattr(portions, "_advanced", lambda work, turns: made.append(turns) or advanced(work, turns))
    monkeypatch.setattr(seen_plan, "_AT_ONCE", 2)
    window.studio.do(q.Pick(LEVEL, AT[0] << LEVEL, AT[1] << LEVEL))
    assert 1 <= len(made) <= 4
    assert set(made) == {TURNS}
    assert isinstance(window.other[-1], results.Picked)
    while window.studio.pending:
        window.studio.step()
    np.testing.assert_array_equal(window.tiles[TILES[0]], wanted)
