"""Closing the real window while a picture is still written."""

import os
import subprocess
import time

import pytest
from PIL import Image

pytestmark = [pytest.mark.window, pytest.mark.timeout(180)]

LEVEL_4 = (670, 393)  # on the slider of the dialog
SIZE = (16384, 12288)


def shown(app):
    """Whether its window is on the screen."""
    command = ["xdotool", "search", "--onlyvisible", "--name", "Inkfall"]
    return subprocess.run(command, env={**os.environ, "DISPLAY": app.display}, capture_output=True).returncode == 0


def dialog(app):
    """Waits until one is there: it darkens what is behind it."""
    app.until(lambda screen: screen[60:760, 1000:1270].mean() < 50, (640, 790))


def test_the_window_goes_at_once_and_the_file_is_whole(program, tmp_path, monkeypatch):
    monkeypatch.setattr(Image, "MAX_IMAGE_PIXELS", None)
    app = program()
    app.stroke((400, 300), (700, 500))
    app.canvas()
    assert shown(app)
    app.keys("ctrl+e")
    dialog(app)
    app.click(LEVEL_4)
    app.keys("Return")  # where to
    time.sleep(1.0)
    app.keys("ctrl+a")
    app.type(str(tmp_path / "large.png"))
    app.keys("Return")
    time.sleep(1.0)
    app.keys("ctrl+q")
    dialog(app)
    app.click((676, 432))  # the changes are not saved
    end = time.monotonic() + 2.0
    while shown(app):
        assert time.monotonic() < end, "the window is still there"
    assert app.process.poll() is None, "nothing was left to be written"
    assert app.process.wait(90) == 0
    with Image.open(tmp_path / "large.png") as picture:
        assert picture.size == SIZE
        picture.verify()
