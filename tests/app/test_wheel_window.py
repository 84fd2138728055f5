"""Harmonies, shades, the gamut mask and palettes of what is in view, in the real window."""

import json

import numpy as np
import pytest
from PIL import Image

from engine.files.swatches.palette_files import read_palette

pytestmark = pytest.mark.window


def kept_wheel(app):
    path = app.folder / "config" / "inkfall" / "desk.json"
    return json.loads(path.read_text())["wheel"] if path.exists() else {}


def test_a_mark_and_a_shade_are_picked_and_nothing_moves(program):
    app = program()
    app.settled()
    places = [app.box(name) for name in ("Lightness", "palette", "Layers")]
    now = app.part("now")
    app.click("harmony")
    app.click("Complement")
    before = app.parked()[now]
    app.click("harmony 1")
    turned = app.until(lambda screen: (np.abs(screen[now] - before) > 8).any())[now]
    assert turned[8, 8, 0] > turned[8, 8, 2], "across from blue is no blue"
    app.click("shade 6")
    app.until(lambda screen: screen[now][8, 8].sum() > turned[8, 8].sum() + 60)
    app.click("paper swatch")
    app.until(lambda screen: (screen[now][8, 8] == 255).all())
    assert [app.box(name) for name in ("Lightness", "palette", "Layers")] == places


def test_a_mask_holds_what_is_picked_and_its_corners_are_dragged_and_kept(program):
    app = program()
    app.settled()
    app.click("gamut mask")
    app.click("Muted")
    app.wait_until(lambda: kept_wheel(app).get("masked") is True, "the mask is not kept")
    app.keys("Escape")
    app.until_gone("Pick within the mask")
    now = app.part("now")
    app.click("gamut mask")
    app.click("Muted")  # turned to the hue: the same
    app.keys("Escape")
    app.until_gone("Pick within the mask")
    app.move_to(app.at("disc", 0.5, 0.97))
    app.do("mousedown", 1)
    app.do("mouseup", 1)
    muted = app.parked()[now][8, 8]
    app.click("gamut mask")
    app.click("Pick within the mask")
    app.wait_until(lambda: kept_wheel(app).get("masked") is False, "the mask is still on")
    app.keys("Escape")
    app.until_gone("Muted")
    app.move_to(app.at("disc", 0.5, 0.97))
    app.do("mousedown", 1)
    app.do("mouseup", 1)
    strong = app.until(lambda screen: np.ptp(screen[now][8, 8]) > np.ptp(muted))[now][8, 8]
    assert np.ptp(strong) > np.ptp(muted) + 10


def test_palettes_are_made_of_a_picture_and_of_what_is_in_view(with_stroke, tmp_path):
    app = with_stroke
    app.click("make palette")
    app.click("What is in view")
    app.box("swatch 1")
    app.wait_until((tmp_path / "config/inkfall/palettes/view.gpl").exists, "no palette of the view")
    Image.fromarray(np.repeat(np.array([[[200, 30, 40]], [[20, 60, 90]]], np.uint8), 8, 1)).save(tmp_path / "roof.png")
    app.click("make palette")
    app.click("A picture file…")
    app.box("name", "Make a palette of a picture")
    app.fill(str(tmp_path / "roof.png"))
    app.keys("Return")
    app.box("swatch 2")
    found = read_palette(tmp_path / "config/inkfall/palettes/roof.gpl")
    assert [tuple(round(255 * v) for v in rgb) for rgb, _ in found.colours] == [(20, 60, 90), (200, 30, 40)]
