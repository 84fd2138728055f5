"""Where panels and canvas meet, in the real window on a screen whose scale is no whole number."""

import os
import subprocess

import numpy as np
import pytest
from xserver import need, started_screen

from app import theme

pytestmark = pytest.mark.window


@pytest.fixture
def scaled():
    """A display of its own, 1.1 pixels to a point."""
    need("Xvfb", "xdotool", "xprop")
    process, name = started_screen("1440x900")
    words = ["xprop", "-root", "-f", "RESOURCE_MANAGER", "8s", "-set", "RESOURCE_MANAGER", "Xft.dpi:\t105.6\n"]
    subprocess.run(words, check=True, env={**os.environ, "DISPLAY": name}, timeout=90)
    yield name
    process.terminate()
    process.wait(90)


def test_a_stroke_begins_on_the_canvas_and_nowhere_on_a_panel(program, scaled):
    app = program(on=scaled)
    empty = app.canvas()
    grey = app.screen()[400, 640:] == round(255 * theme.look.panel[0])
    panel = 640 + int(np.flatnonzero(grey.all(axis=-1))[0])  # the first pixel of the right one
    assert 1080 < panel < 1100
    app.stroke((panel, 400), (700, 400), (600, 420))
    assert np.array_equal(app.canvas(), empty)
    app.stroke((panel - 1, 400), (700, 400), (600, 420))
    app.canvas_unlike(empty)
