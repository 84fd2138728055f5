"""Panels in the real window: none pushes another; they are dragged, hidden, floated and kept under names."""

import json

import pytest

pytestmark = pytest.mark.window


def ask(app, name):
    """A click with the right button, as slow as a hand's."""
    app.move_to(app.at(name))
    app.do("mousedown", 3)
    app.do("mouseup", 3)


@pytest.mark.nightly
def test_nothing_moves_under_the_pointer_and_panels_lie_where_they_were_put(program):
    app = program()
    app.settled()
    places = {name: app.box(name) for name in ("Radius", "Stabiliser", "Dry brush", "Layers", "Paint")}
    for mode in ("Change", "Erase", "Paint"):
        app.click(mode, "settings")
    app.click("drop", "ink")  # the ink is one texture shorter
    app.until_gone("curve Shaping of all")
    assert {name: app.box(name) for name in places} == places

    layers, canvas = app.box("Layers"), app.box("canvas")
    x, y = app.at("below ink")
    app.drag((x, y), (x, y - 60))
    app.do("mouseup", 1)
    app.wait_until(lambda: app.box("Layers")[1] < layers[1] - 40, "the edge does not move the panel below it")
    x, y = app.at("right edge")
    app.drag((x, y), (x - 100, y))
    app.do("mouseup", 1)
    app.wait_until(lambda: app.box("canvas")[2] < canvas[2] - 80, "the column is as wide as it was")

    x, y = app.at("Layers")
    app.drag((1060, y), (700, 300))
    app.do("mouseup", 1)
    app.wait_until(lambda: app.box("Layers")[0] < 760, "it does not float")
    ask(app, "Layers")
    app.click("To the left")
    app.wait_until(lambda: app.box("Layers")[0] < 240, "it is not in the column on the left")
    ask(app, "Colour")
    app.click("Hide")
    app.until_gone("Colour")

    app.click("View menu")
    app.click("Panels and workspaces…")
    app.click("workspace name")
    app.type("Mine")
    app.keys("Return")
    app.click("Swap the sides")
    app.wait_until(lambda: app.box("Layers")[0] > 900, "the sides are not swapped")
    app.click("Mine")
    app.wait_until(lambda: app.box("Layers")[0] < 240, "the workspace is not as it was kept")
    app.click("As at first")
    app.wait_until(lambda: app.box("Layers")[:2] == layers[:2], "the panels are not as at first")
    app.click("Mine")
    app.keys("Escape")
    path = app.folder / "config" / "inkfall" / "window.json"

    def kept():
        told = json.loads(path.read_text())
        return told.get("panels") and told.get("workspaces") == {"Mine": told["panels"]} and told["panels"]["hidden"]

    app.wait_until(lambda: kept() == ["colour"], "it is not kept")
    app.process.terminate()
    app.process.wait(90)
    app = program()
    app.wait_until(lambda: app.box("Layers")[0] < 240, "the next start does not remember")
    app.keys("F6", "Right", "Right", "Right", "Return")  # the tools by keys: the third picks colours
    app.box("What is seen")
    app.keys("Escape", "e")
    app.until_gone("What is seen")
