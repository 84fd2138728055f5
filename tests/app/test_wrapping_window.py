"""Painting a tile in the real window: what leaves it at one side comes in on the other, while the pen is down."""

import json

import numpy as np
import pytest

pytestmark = pytest.mark.window
WIDTH, HEIGHT = 256, 192
SQUARES = 20  # of 255: between those of paper without a colour
LINES = (
    {"inkfall": 1, "frame": [0, 0, WIDTH, HEIGHT], "seed": 1},
    {"do": "layer", "add": "Layer 1"},
    {"do": "stroke", "points": [[128, 96]], "brush": {"radius": 9, "colour": "#d04020"}},
)


@pytest.mark.nightly
def test_a_stroke_over_the_rim_is_seen_in_every_tile_while_it_is_painted(program, tmp_path):
    (tmp_path / "tile.jsonl").write_text("\n".join(map(json.dumps, LINES)) + "\n")
    app = program(str(tmp_path / "tile.jsonl"))
    app.settled()
    app.keys("1")
    app.until(lambda screen: 180 < dark_red(screen[60:740, 270:970]).sum() < 330)  # the view has come to rest
    once = app.canvas()
    app.keys("ctrl+alt+w")
    tiles = app.canvas_unlike(once)
    assert dark_red(tiles).sum() > 4 * dark_red(once).sum() > 0
    assert tiles.min(axis=2)[~dark_red(tiles)].mean() > 220  # on paper, which wraps as well
    dot = np.argwhere(dark_red(once)).mean(axis=0).astype(int)  # of the frame, the middle
    left, top = 270 + dot[1] - WIDTH // 2, 60 + dot[0] - HEIGHT // 2
    app.do("mousemove", left + 180, top + 78, "mousedown", 1)
    for i in range(1, 30):
        app.do("mousemove", left + 180 + 5 * i, top + 78 + i)
    end = slice(top + 100, top + 112), slice(left + 60, left + 70)  # where the pen is, a tile to the left
    live = app.until(lambda screen: screen[end].min() < 120, (left + 325, top + 107))[60:740, 270:970].astype(int)
    above = slice(0, top - 70)
    assert (live[above] != tiles[above]).any(axis=2).sum() > 500
    assert (live[above, :-WIDTH] == live[above, WIDTH:]).all()
    below = live[60 + 2 * HEIGHT : top - 70 + 2 * HEIGHT]
    assert np.abs(live[60 : top - 70] - below).max() < SQUARES  # the paper's repeat elsewhere
    app.do("mouseup", 1)
    painted = app.canvas()
    assert (painted[above, :-WIDTH] == painted[above, WIDTH:]).all()
    app.keys("ctrl+z")
    assert app.comes_to(tiles)
    app.keys("ctrl+z")
    assert app.comes_to(once)


def dark_red(picture):
    """Where the dot is."""
    return (picture[..., 0] > 170) & (picture[..., 1] < 110) & (picture[..., 2] < 90)
