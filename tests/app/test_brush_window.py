"""The brush panel in the real window: what is chosen there changes what a stroke does."""

import json
import time

import numpy as np
import pytest

pytestmark = [pytest.mark.window, pytest.mark.timeout(240)]

WAVE = [(380 + 12 * i, 400 + (30 if i % 8 < 4 else -30)) for i in range(24)]
ALL, INDIGO = (226, 110), (slice(180, 208), slice(580, 675))
RASTER, OPS, FORMULA, FIELD, SAVE = (171, 434), (100, 463), (50, 782), (100, 492), (229, 83)


def press(app, at):
    """A click as slow as a hand's, for lists that look where the pointer is first."""
    app.do("mousemove", *at)
    time.sleep(0.3)
    app.do("mousedown", 1)
    time.sleep(0.15)
    app.do("mouseup", 1)
    time.sleep(0.4)


def test_a_formula_written_in_the_panel_changes_paint_and_lays_none(program):
    app = program()
    empty = app.canvas()
    app.keys(*["bracketright"] * 12)
    app.stroke((380, 360), (800, 360))
    painted = app.canvas_unlike(empty)
    bare = np.abs(painted - empty).max(axis=-1) == 0
    assert 2000 < (~bare).sum() < 100_000

    press(app, RASTER)
    press(app, OPS)
    press(app, FORMULA)  # the last of the list
    press(app, FIELD)
    app.keys("ctrl+a")
    app.type("0 - pic * 0.7")
    app.keys("Return")
    before = app.canvas(calm=8)
    assert np.array_equal(before, painted)
    app.stroke(*WAVE)
    after = app.canvas_unlike(painted)
    darker = (painted - after).max(axis=-1) > 5
    assert darker.sum() > 100
    assert np.array_equal(after[bare], painted[bare])
    assert (after[darker].sum(axis=-1) < painted[darker].sum(axis=-1)).all()
    app.keys("ctrl+z")
    assert app.comes_to(painted)


def test_a_brush_is_saved_under_a_name_and_there_again(program, tmp_path):
    app = program()
    app.settled()
    app.keys(*["bracketright"] * 5)
    press(app, SAVE)
    app.keys("ctrl+a")
    app.type("My pen")
    app.keys("Return")
    path = tmp_path / "config" / "inkfall" / "brushes" / "my-pen.json"
    end = time.monotonic() + 20
    while not path.exists():
        assert time.monotonic() < end
        time.sleep(0.1)
    kept = json.loads(path.read_text("utf-8"))
    assert kept["name"] == "My pen"
    assert kept["brush"]["radius"] > 3


def blueness(picture):
    return int((picture[..., 2].astype(int) - picture[..., 0]).max())


def test_pictures_of_brushes_with_examples_come_when_they_are_in_sight(program):
    app = program()
    press(app, ALL)
    end = time.monotonic() + 60
    while blueness(app.screen()[INDIGO]) < 60:
        assert time.monotonic() < end, "no picture of the indigo wash"
        time.sleep(0.2)
