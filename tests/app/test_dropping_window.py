"""Files dropped on the real window: onto the palette of examples, and on the canvas."""

import os
import subprocess
import time

import numpy as np
import pytest
from dragging import Drag
from PIL import Image

pytestmark = [pytest.mark.window, pytest.mark.timeout(180)]

REGION = (slice(459, 766), slice(258, 745))  # of the screen: where the region is painted


@pytest.fixture
def stone(tmp_path):
    """A picture with a place that needs escaping, grey on white."""
    folder = tmp_path / "my pictures ü"
    folder.mkdir()
    y, x = np.mgrid[:80, :120]
    inside = ((x - 60) / 50.0) ** 2 + ((y - 40) / 32.0) ** 2 < 1.0
    pixels = np.where(inside[..., None], 90 + (x * y % 60)[..., None], 255) * np.ones(3)
    Image.fromarray(pixels.astype(np.uint8)).save(folder / "A 100% stone.png")
    return folder / "A 100% stone.png"


def window_of(app):
    words = ["xdotool", "search", "--onlyvisible", "--pid", str(app.process.pid)]
    environment = {**os.environ, "DISPLAY": app.display}
    found = subprocess.run(words, capture_output=True, text=True, check=True, env=environment, timeout=30)
    return int(found.stdout.split()[-1])


def until(good, seconds=60.0):
    end = time.monotonic() + seconds
    while not good():
        assert time.monotonic() < end
        time.sleep(0.1)


def test_a_picture_dropped_while_the_palette_is_open_is_an_example(program, stone):
    app = program()
    app.do("mousemove", 640, 300)
    app.keys("p")
    app.settled()
    before = app.screen()[REGION].astype(int)
    Drag(app.display, window_of(app), stone).drop(600, 600)
    made = app.folder / "data" / "inkfall" / "examples"
    until(lambda: len(list(made.glob("*.toml"))) == 1)
    assert {path.name for path in made.iterdir()} == {f"A 100- stone{end}" for end in (".png", ".mask.png", ".toml")}
    until(lambda: (np.abs(app.screen()[REGION].astype(int) - before).max(axis=2) > 60).mean() > 0.2)


def test_a_picture_dropped_on_the_canvas_is_opened(program, stone):
    app = program()
    app.settled()
    Drag(app.display, window_of(app), stone).drop(600, 300)
    app.wait_for("painting 1 shown")
    assert not (app.folder / "data" / "inkfall" / "examples").exists()
