"""The texture doctor in the real window: a picture is dropped, all makers are tried, and what suits it is painted
with."""

import numpy as np
import pytest
from dragging import Drag
from PIL import Image
from screens import changed
from test_dropping_window import window_of

from engine.makers.doctor.trying import TRIED

pytestmark = pytest.mark.window

LINE = [(340 + 20 * i, 240 + (25 if i % 6 < 3 else -25)) for i in range(26)]


def brown(part):
    """Tells whether the coloured pixels of a part are the pebbles': the brush was blue."""
    part = part.astype(int)
    coloured = part[np.abs(part[..., 0] - part[..., 2]) > 12]
    return len(coloured) > 300 and (coloured[:, 0] > coloured[:, 2]).mean() > 0.8


@pytest.fixture
def pebbles(tmp_path):
    """Dark round things on bright ground, lit from the left, darker towards the right."""
    rng, (y, x) = np.random.default_rng(4), np.mgrid[:128, :160]
    out = np.full((128, 160, 3), 220.0)
    for cy, cx, r in zip(*rng.uniform(0, 1, (2, 500)) * [[128], [160]], rng.uniform(3, 8, 500), strict=True):
        inside = (y - cy) ** 2 + (x - cx) ** 2 < r * r
        out[inside] = (110 - 60 * ((x - cx) / r)[inside])[:, None] * [1.0, 0.8, 0.6]
    out *= np.linspace(1.0, 0.35, 160)[None, :, None]
    Image.fromarray(out.astype(np.uint8)).save(tmp_path / "pebbles.png")
    return tmp_path / "pebbles.png"


@pytest.mark.nightly
def test_a_dropped_picture_gets_advice_and_is_painted_with(program, pebbles):
    app = program()
    app.settled()
    app.keys("l")  # no strip: the picture is for the canvas
    app.keys("l")
    Drag(app.display, window_of(app), pebbles).drop(600, 300)
    app.click("What suits it?", "Bring in a picture")
    where = "What suits this example?"
    cells = [app.part(f"doctor {way}", where) for way in TRIED]
    shown = app.until(lambda screen: all(screen[cell].std() > 6 for cell in cells))
    before = shown[cells[3]]
    app.click("Set straight", where)
    app.until(lambda screen: screen[cells[3]].std() > 6 and changed(screen[cells[3]], before) > 500)
    app.click("doctor objects", where)
    mixer = slice(app.box("Ink mixer")[3], app.box("below ink")[1]), slice(*app.box("Ink mixer")[::2])
    app.until(lambda screen: brown(screen[mixer]))  # it is on the brush
    empty = app.settled()
    app.stroke(*LINE)
    stroke = (slice(200, 290), slice(360, 800))
    app.until(lambda screen: changed(screen[stroke], empty[stroke]) > 1500 and brown(screen[stroke]))


@pytest.mark.nightly
def test_what_is_told_of_the_example_moves_none_of_the_pictures(program, tmp_path):
    y, x = np.mgrid[:128, :160]
    discs = (y % 20 - 10.0) ** 2 + (x % 20 - 10.0) ** 2 < 50
    shade = np.where(discs, 110 - 6 * (x % 20 - 10), 220)[..., None] * [1.0, 0.8, 0.6]  # quasi-periodic and structured
    Image.fromarray(shade.astype(np.uint8)).save(tmp_path / "discs.png")
    app = program()
    app.settled()
    app.do("mousemove", 600, 300)
    Drag(app.display, window_of(app), tmp_path / "discs.png").drop(600, 300)
    where = "What suits this example?"
    app.click("What suits it?", "Bring in a picture")
    cells = {way: app.box(f"doctor {way}", where) for way in ("example", *TRIED)}
    assert cells["scattered"][0] == cells["full"][0], "the columns are not below one another"
    example = app.part("doctor example", where)
    app.until(lambda screen: screen[example].std() > 6)
    assert [app.box(f"doctor {way}", where) for way in cells] == list(cells.values())
    app.click("Cancel", where)
    app.until_gone("doctor example")
