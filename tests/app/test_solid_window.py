"""The panel of solids in the real window: an object is turned by a drag, and a slice through it is ink."""

import numpy as np
import pytest
from screens import changed

from engine.solids.cube_files import write_cube

pytestmark = pytest.mark.window


@pytest.mark.nightly
def test_a_solid_is_turned_and_its_slice_is_ink(program, tmp_path):
    kept = tmp_path / "data" / "inkfall" / "solids"
    kept.mkdir(parents=True)
    write_cube(kept / "rubble.png", np.random.default_rng(0).random((8, 8, 8, 3)).astype(np.float32))
    app = program()
    app.settled()
    app.keys("shift+t")
    place = app.part("object")
    seen = app.until(lambda screen: screen[place].std() > 25)
    app.drag(app.at("object", 0.45, 0.5), app.at("object", 0.55, 0.6))
    app.do("mouseup", 1)
    turned = app.until(lambda screen: changed(screen[place], seen[place]) > 3000)
    app.click("Wood")
    app.until(lambda screen: changed(screen[place], turned[place]) > 3000)
    wood = app.parked()
    app.click("cube")
    app.click("rubble")
    app.until(lambda screen: changed(screen[place], wood[place]) > 3000)
    app.click("Paint on it")
    app.drag(app.at("object", 0.45, 0.5), app.at("object", 0.5, 0.55))
    app.do("mouseup", 1)
    app.until(lambda screen: app.box("clean") and changed(screen[place], wood[place]) > 3000)
    app.keys("ctrl+z")
    mixer = slice(app.box("Ink mixer")[3], app.box("below ink")[1]), slice(*app.box("Ink mixer")[::2])
    before = app.parked()
    app.click("Use as ink")
    app.until(lambda screen: changed(screen[mixer], before[mixer]) > 300)
    app.keys("shift+t")
