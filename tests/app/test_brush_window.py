"""The brush panel in the real window: what is chosen there changes what a stroke does."""

import json
import time

import numpy as np
import pytest

pytestmark = pytest.mark.window

WAVE = [(380 + 12 * i, 400 + (30 if i % 8 < 4 else -30)) for i in range(24)]


@pytest.mark.nightly
def test_a_formula_written_in_the_panel_changes_paint_and_lays_none(program):
    app = program()
    empty = app.canvas()
    below, shown = app.box("group")[3], app.boxes()
    listed = [box for (window, _), box in shown.items() if window == "brushes" and box[1] > below]
    assert len(listed) >= 8, sorted(shown)  # at 1280 x 800, wholly or in part
    assert shown["settings", "Grow"][2] <= shown["settings", "Opacity"][2]  # what it does has room for all its words
    assert shown["settings", "Grow"][2] - shown["settings", "Grow"][0] > 30
    app.keys(*["bracketright"] * 12)
    app.stroke((380, 360), (800, 360))
    painted = app.canvas_unlike(empty)
    bare = np.abs(painted - empty).max(axis=-1) == 0
    assert 2000 < (~bare).sum() < 100_000

    app.click("Change")
    app.click("operation")
    app.click("Formula…")
    app.click("formula")
    app.fill("0 - pic * 0.7")
    app.keys("Return")
    before = app.canvas()
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
    app.click("On stroke")
    app.click((app.box("Hardness")[2] - 12, app.at("Wet paint")[1]))
    app.click("save brush")
    app.box("name")
    app.fill("My pen")
    app.keys("Return")
    path = tmp_path / "config" / "inkfall" / "brushes" / "my-pen.json"
    end = time.monotonic() + 90
    while not path.exists():
        assert time.monotonic() < end
        time.sleep(0.1)
    kept = json.loads(path.read_text("utf-8"))
    assert kept["name"] == "My pen"
    assert kept["brush"]["radius"] > 3
    assert kept["brush"]["fixed"] == "stroke"
    assert kept["brush"]["wet"]["mixing"] == "pigment"


def blueness(picture):
    """By how much blue exceeds red where it does so most."""
    return int((picture[..., 2].astype(int) - picture[..., 0]).max())


@pytest.mark.nightly
def test_pictures_of_brushes_with_examples_come_when_they_are_in_sight(program):
    app = program()
    app.click("all brushes")
    indigo = app.part("Indigo wash")
    end = time.monotonic() + 90
    while blueness(app.screen()[indigo]) < 60:
        assert time.monotonic() < end, "no picture of the indigo wash"
        time.sleep(0.2)
    app.keys("Escape")
    houses_are_painted(app)


def houses_are_painted(app):
    """A brush that places things has their own colours, red roofs and pale walls, and covers no more than they do."""
    app.click("Find", window="brushes")
    app.fill("houses")
    app.keys("Return")
    bare = app.canvas()
    app.stroke(*[(340 + 30 * i, 400 + (20 if i % 4 < 2 else -10)) for i in range(20)])

    def built(screen):
        seen = screen[60:740, 270:970]
        laid = np.abs(seen - bare).max(axis=-1) > 10
        red, green, blue = seen[laid].T
        return 8000 < laid.sum() < 80_000 and min((red - green > 50).mean(), (blue > 120).mean()) > 0.05

    app.until(built)


def test_while_brushes_are_read_the_list_says_so(program):
    app = program()
    app.box("Pencil")
    told = app.log.read_text()
    assert '["brushes", "Loading brushes"' in told
    assert "No brush is called so" not in told
    app.click("Find")
    app.type("zzzz")
    app.box("No brush is called so")
