"""Lasso, polygon, and the windows about what is selected, by hand in the real window."""

import time

import pytest

pytestmark = pytest.mark.window
MENU = 190, 11  # "Select", in the menu bar


def chip(app, good, seconds=90.0):
    """The size that the status line tells, once that is good: it is a text of digits and a cross between."""
    end = time.monotonic() + seconds
    while True:
        found = [name for _, name in app.boxes() if "×" in name and name[0].isdigit()]
        if len(found) == 1 and good(sides := size(found[0])):
            return sides
        assert time.monotonic() < end, f"found {found}"
        time.sleep(0.05)


def size(text):
    across, down = text.partition(",  feather")[0].split(" × ")
    return int(across.replace(",", "")), int(down.partition(", feather")[0].replace(",", ""))


def near(across, down, by=2):
    return lambda sides: abs(sides[0] - across) <= by and abs(sides[1] - down) <= by


@pytest.mark.nightly
def test_what_is_gone_round_is_selected_grown_kept_and_had_back(program):
    app = program()
    app.settled()
    app.keys("1", "o")
    app.stroke((400, 250), (600, 250), (600, 450), (400, 450), (400, 260))
    chip(app, near(200, 200, by=8))  # a loaded machine passes on few points of the path, which is rounder then
    app.keys("shift+o")
    for corner in ((400, 250), (700, 250), (700, 350), (400, 350)):
        app.click(corner)
    app.keys("Return")
    chip(app, near(300, 100))
    _keep(app, "the band")
    _menu(app, "Grow, shrink, feather…")
    app.click("Shrink", window="Change the selection")
    chip(app, near(284, 84))  # the rim shows what it would be
    app.click("Apply")
    app.until_gone("select amount")
    app.click("deselect")
    app.until_gone("deselect")
    _menu(app, "Kept selections…")
    app.click("Select", window="Kept selections")
    chip(app, near(300, 100))
    app.keys("ctrl+z", "ctrl+z")
    chip(app, near(284, 84))


def _menu(app, title):
    app.click(MENU)
    app.click(title)


def _keep(app, name):
    _menu(app, "Keep as…")
    app.box("selection name")
    app.type(name)  # into the field, which has the keyboard
    app.keys("Return")
    app.until_gone("selection name")
