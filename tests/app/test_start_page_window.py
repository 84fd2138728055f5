"""The first start shows a page, which goes as soon as one paints, and comes back with what was there."""

import json

import numpy as np
import pytest

pytestmark = pytest.mark.window


def kept_by(app):
    return json.loads((app.folder / "config" / "inkfall" / "window.json").read_text("utf-8"))


def test_a_press_beside_the_page_closes_it_and_paints_and_it_never_comes_again(program):
    app = program(first=True)
    app.box("Play with the lake")
    left, top, right, _ = app.box("canvas")
    at = left + 60, top + 120
    assert app.box("lake picture")[1] > at[1] + 60
    app.stroke(*((at[0] + 3 * i, at[1] + i) for i in range(10)))
    app.until_gone("Play with the lake")
    app.until(lambda screen: np.ptp(screen[at[1] : at[1] + 9, at[0] : at[0] + 27].max(axis=-1)) > 90)
    app.click("Soft airbrush")
    app.do("mousemove", (left + right) // 2, top + 30)
    app.wait_until(lambda: kept_by(app)["brush"]["name"] == "Soft airbrush", "the brush is not kept")
    app.process.terminate()
    app.process.wait(90)
    again = program(first=True)
    again.box("Close", "A painting that was not closed")
    again.keys("Escape")
    again.until_gone("Close")
    assert not [key for key in again.boxes() if key[0] == "start"]
    again.click("Help menu")
    again.click("Start page")
    again.box("Recover 1 painting…")
    again.keys("Escape")
    again.until_gone("Play with the lake")
    told = kept_by(again)
    assert told["welcomed"]
    assert told["brush"]["name"] == "Soft airbrush"


@pytest.mark.nightly
def test_the_view_of_a_painting_and_what_was_exported_last_come_back(with_stroke):
    app = with_stroke
    path = app.folder / "lake.ora"
    app.save_as(path)
    app.do("mousemove", 500, 380)
    app.wheel(6)
    seen = app.canvas()
    app.keys("ctrl+e")
    app.click("A file for each layer")
    app.keys("Escape")
    app.until_gone("A file for each layer")
    app.keys("ctrl+n")
    app.click("Start", "New painting")
    app.until_gone("Start")
    app.wait_for("painting 1 shown")
    empty = app.canvas_unlike(seen)
    app.click("File menu")
    app.click("Open recent")
    app.box("lake.ora")
    app.click("lake.ora")
    app.wait_for("painting 2 shown")
    app.canvas_unlike(empty)
    assert app.comes_to(seen)
    app.wait_until(lambda: kept_by(app)["export"]["apart"], "what was exported is not kept")
