"""A photograph dropped on the palette of examples: what lies on its ground is found, corrected by a stroke and taken,
in the real window."""

import time

import numpy as np
import pytest
from dragging import Drag, window_of
from PIL import Image

from bench.composites import composites

pytestmark = pytest.mark.window


def until(good, seconds=90.0):
    end = time.monotonic() + seconds
    while not good():
        assert time.monotonic() < end
        time.sleep(0.1)


@pytest.mark.nightly
def test_what_lies_on_the_ground_of_a_dropped_photograph_is_cut_out(program):
    app = program()
    (picture,) = composites(128, ("three shapes on white",))
    photo = app.folder / "shells.png"
    Image.fromarray(picture.pixels[..., :3]).save(photo)
    app.do("mousemove", 640, 300)
    app.keys("p")
    Drag(app.display, window_of(app), photo).drop(*app.at("sample"))
    app.box("Take 3")
    shown = app.screen()[app.part("region")].astype(int)
    light, dark = shown[5:15, 5:15], picture.pixels[:10, :10, :3]
    assert light.mean() < 0.5 * dark.mean()  # the ground is dimmed
    app.click("Drop")
    ends = app.at("region", 0.26, 0.3), app.at("region", 0.3, 0.32)  # the largest
    app.do("mousemove", *ends[0], "mousedown", 1, "mousemove", *ends[1], "mouseup", 1)
    until(lambda: (app.screen()[app.part("region")].astype(int) != shown).any(axis=2).mean() > 0.005)
    app.do("mousemove", *ends[0])
    app.keys("ctrl+z")
    app.click("Take 3")  # asks: so many come into the palette only when that is wanted
    app.click("Not so many")
    app.click("Take 3")
    app.click("Add 3")
    made = app.folder / "data" / "inkfall" / "examples"
    until(lambda: len(list(made.glob("*.toml"))) == 3)
    app.until_gone("By hand")
    cut = [np.asarray(Image.open(made / f"shells{number}.png")) for number in ("", " 2", " 3")]
    assert sum((one[..., 3] > 127).sum() for one in cut) == pytest.approx(picture.mask.sum(), rel=0.04)
    assert "fault" not in app.log.read_text()
