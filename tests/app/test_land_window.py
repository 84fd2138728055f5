"""The painting as land in the real window: it is flown over, turned, and painted on."""

import json

import pytest
from screens import changed

pytestmark = pytest.mark.window

ROWS = (
    {"inkfall": 1, "frame": [0, 0, 400, 300], "seed": 7},
    {"do": "layer", "add": "Height"},
    {"do": "layer", "set": "Height", "role": "height", "scale": 80, "sea": 0},
    {"do": "stroke", "points": [[150, 120], [260, 140]], "brush": {"radius": 60, "colour": "#ffffff", "hardness": 0.1}},
)


def test_land_is_flown_over_turned_and_painted_on(program, tmp_path):
    path = tmp_path / "hill.jsonl"
    path.write_text("".join(json.dumps(row) + "\n" for row in ROWS))
    app = program(str(path))
    app.settled()
    middle = app.part("canvas")
    flat = app.parked()
    app.keys("ctrl+t")
    land = app.until(lambda screen: changed(screen[middle], flat[middle]) > 20000 and screen[middle].std() > 8)
    at = app.at("canvas", 0.5, 0.55)
    app.do("mousemove", *at, "click", 4, "click", 4)
    near = app.until(lambda screen: changed(screen[middle], land[middle]) > 20000)
    app.do("mousedown", 2, "mousemove_relative", 60, 10, "mouseup", 2)
    turned = app.until(lambda screen: changed(screen[middle], near[middle]) > 20000)
    app.click("Soft airbrush")
    app.drag(app.at("canvas", 0.4, 0.6), app.at("canvas", 0.6, 0.62))
    app.do("mouseup", 1)
    app.until(lambda screen: changed(screen[middle], turned[middle]) > 300)
    app.keys("ctrl+t")
    app.until(lambda screen: changed(screen[middle], turned[middle]) > 20000)
