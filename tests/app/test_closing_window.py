"""Closing the real window while a picture is still written."""

import os
import subprocess
import time

import pytest
from PIL import Image

from app.loop import _told
from engine.studio import results

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
    first = app.settled()
    app.do("keydown", "Return")
    time.sleep(0.7)  # longer than it takes until a key repeats
    app.do("keyup", "Return")
    second = app.settled()
    assert (first != second).any(), "no dialog of files"
    app.keys("ctrl+a")
    app.type(str(tmp_path / "large.png"))
    app.keys("Return")
    app.until(lambda screen: screen[60:760, 1000:1270].mean() > 50, (640, 790))
    assert not list(tmp_path.rglob("untitled*")), "a held key chose a file"
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


def test_what_fails_when_the_window_is_gone_is_told_on_the_terminal(capsys):
    class Worker:
        def __init__(self, *results):
            self.results = lambda: results

    assert _told(Worker(results.Note("written"), results.Pending(0))) == 0
    assert capsys.readouterr().err == ""
    assert _told(Worker(results.Note("a.png: no space left", bad=True))) == 1
    assert capsys.readouterr().err == "inkfall: a.png: no space left\n"
