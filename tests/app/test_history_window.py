"""The history in the real window: steps with pictures, looking, jumping, and what was painted at a place."""

import numpy as np
import pytest

pytestmark = pytest.mark.window


def line(app, y):
    app.stroke(*((340 + 18 * n, y) for n in range(28)))


def canvas(app):
    """The free part of the canvas while the strip is open."""
    return app.canvas()[:370]


def test_steps_are_looked_at_jumped_to_and_asked_for(program):
    app = program()
    app.settled()
    app.keys("ctrl+h")
    app.box("Steps")
    pictures = [canvas(app)]
    for n in range(3):
        line(app, 150 + 70 * n)
        app.box(f"step {n + 1}")
        pictures.append(canvas(app))
    app.click("step 1")
    app.until(lambda screen: np.array_equal(screen[60:430, 270:970], pictures[1]))
    app.box("step 3")  # it can be done again
    app.do("mousemove", *app.at("step 2"), "click", 3)
    app.box("Back to now")
    app.until(lambda screen: np.array_equal(screen[60:430, 270:970], pictures[2]))
    app.stroke((400, 330), (600, 340))
    app.box("Back to now", "status")  # nothing is painted on what is only looked at
    app.click("Back to now", "strip")
    app.until(lambda screen: np.array_equal(screen[60:430, 270:970], pictures[1]))
    app.keys("ctrl+shift+z", "ctrl+shift+z")
    app.until(lambda screen: np.array_equal(screen[60:430, 270:970], pictures[3]))
    app.keys("w")
    app.click((500, 220))
    app.box("stroke 0")
    assert not [name for _, name in app.boxes() if name == "stroke 1"]
    app.click("What came before")
    app.until(lambda screen: np.array_equal(screen[60:430, 270:970], pictures[1]))
    app.click("Use this brush")
    app.keys("ctrl+h")  # closing it shows the painting as it is
    app.until_gone("Steps")
    app.keys("ctrl+h")
    app.box("Steps")
    app.until(lambda screen: np.array_equal(screen[60:430, 270:970], pictures[3]))
