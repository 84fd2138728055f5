"""Masks in the real window: painted on by the brush, seen alone, put aside, inverted."""

import numpy as np
import pytest

from engine.archive.saving import Snapshot, save
from engine.numeric.address import Rect
from engine.painting import commands as c
from engine.painting.recording import Header
from engine.painting.value import first_painting
from engine.session.session import Session

pytestmark = pytest.mark.window


def test_a_mask_is_painted_by_the_brush_and_seen_alone(program):
    app = program()
    app.settled()
    empty = app.canvas()
    app.stroke(*((380 + 12 * i, 400) for i in range(24)))
    painted = app.canvas_unlike(empty)
    app.click("mask_full")  # it is painted on from then on
    app.box("mask bar")
    app.stroke(*((500, 340 + 6 * i) for i in range(20)))
    hidden = app.canvas_unlike(painted)
    app.click("Alone")
    app.box("Painting")
    alone = app.canvas_unlike(hidden)
    middle = alone[alone.shape[0] // 2]
    assert (middle == 255).all(axis=-1).any()
    assert (np.ptp(middle.astype(int), axis=-1) == 0).mean() > 0.9
    app.click("Painting")
    assert app.comes_to(hidden)
    app.do("mousemove", *app.at("mask of Layer 1"), "click", 3)
    app.click("From the mask")
    app.box("deselect")
    app.keys("ctrl+z")
    app.until_gone("deselect")
    app.click("Done")
    app.until_gone("mask bar")
    app.keys("ctrl+z")
    assert app.comes_to(painted)


def test_a_copy_is_masked_by_the_brush_where_it_is_seen_and_what_it_shows_stays(program, tmp_path):
    session = Session(first_painting(Header(Rect(0, 0, 600, 400))))
    for command in (
        {"do": "layer", "add": "sky"},
        {"do": "stroke", "points": [[60, 60], [220, 300]], "brush": {"radius": 50, "colour": "#c05020"}},
        {"do": "layer", "add": "again", "kind": "placement", "of": "sky", "at": [560, 10], "mirror": True},
        {"do": "layer", "select": "again"},
    ):
        session.do(c.parse(command))
    save(tmp_path / "a.ora", Snapshot(session.painting))
    app = program(str(tmp_path / "a.ora"))

    def orange(screen, x, y):
        return np.abs(screen[y, x] - (192, 80, 32)).max() < 9

    app.until(lambda screen: orange(screen, 476, 400) and orange(screen, 720, 420))
    app.click("mask_full")
    app.box("mask bar")
    app.stroke(*((640 + 9 * i, 420) for i in range(20)))
    screen = app.until(lambda screen: not orange(screen, 720, 420))
    assert orange(screen, 476, 400)  # of what it shows nothing is hidden
    assert orange(screen, 720, 400)
    app.do("mousemove", *app.at("mask of again"), "click", 3)
    app.click("Apply mask")
    app.until_gone("mask of again")
