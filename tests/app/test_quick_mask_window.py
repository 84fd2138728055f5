"""The selection painted by hand as a mask in the real window."""

import numpy as np
import pytest

pytestmark = pytest.mark.window
LINE = [(400 + 10 * i, 340) for i in range(25)]
ON, OFF = (520, 340), (520, 500)  # on the line, and beside it


def tinted(screen, at):
    red, green, blue = screen[at[1], at[0]].astype(int)
    return red - (green + blue) // 2 > 60


@pytest.mark.nightly
def test_the_brush_paints_what_is_selected_and_the_eraser_takes_it_away(program):
    app = program()
    app.settled()
    app.keys("1", *["bracketright"] * 16)
    empty = app.canvas()
    app.keys("q")
    app.box("mask tint")
    app.until(lambda screen: tinted(screen, ON) and tinted(screen, OFF))
    app.do("mousemove", *LINE[0], "mousedown", 1)
    for at in LINE[1:]:
        app.do("mousemove", *at)
    app.until(lambda screen: not tinted(screen, ON) and tinted(screen, OFF), LINE[-1])  # while the pen is down
    app.do("mouseup", 1)
    app.box("deselect")
    app.keys("e")
    app.box("mask tint")
    app.stroke((520, 300), (520, 320), (520, 380))
    app.until(lambda screen: tinted(screen, ON) and not tinted(screen, (430, 340)))
    app.keys("ctrl+z")  # one step a stroke
    app.until(lambda screen: not tinted(screen, ON))
    app.keys("q")
    app.until_gone("mask tint")
    app.until(lambda screen: not tinted(screen, OFF))
    ants = (np.abs(app.screen()[60:740, 270:970].astype(int) - empty).max(axis=2) > 24).sum()
    assert 200 < ants < 4000  # a thin rim
    app.keys("ctrl+z")
    app.until_gone("deselect")
    assert app.comes_to(empty)
