"""Preferences in the real window: in force at once, and at the next start."""

import pytest

pytestmark = pytest.mark.window


def test_the_scale_and_the_pen_are_changed_and_kept(program):
    app = program()
    app.settled()
    app.keys("ctrl+comma")
    app.box("Ignore touch")
    app.settled()
    app.click("Ignore touch")
    app.click("Display", "Preferences")
    app.box("scale")
    wide = app.box("canvas")[0]
    app.click("scale")
    app.click("125 %")
    app.wait_until(lambda: app.box("canvas")[0] > wide * 1.2, "the panels are as they were")
    path = app.folder / "config" / "inkfall" / "preferences.toml"
    app.wait_until(lambda: path.exists() and "scale = 1.25" in path.read_text(), "it is not kept")
    assert set(path.read_text().split("\n")) == {"[display]", "scale = 1.25", "[pen]", "ignore_touch = true", ""}
    app.process.terminate()
    app.process.wait(90)
    app = program()
    assert app.box("canvas")[0] > wide * 1.2
