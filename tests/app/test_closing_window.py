"""Closing the real window while a picture is still written."""

import os
import subprocess
import time

import pytest
from PIL import Image
from xserver import let_keys_repeat

from app.desk.exporting.export_state import FINER
from app.loop import _told
from engine.studio import results

pytestmark = pytest.mark.window

LEVEL_4 = (4 - FINER[0] + 0.5) / (FINER[1] - FINER[0] + 1)  # its part of the slider's width
SIZE = (16384, 12288)


def shown(app):
    """Whether its window is on the screen."""
    command = ["xdotool", "search", "--onlyvisible", "--name", "Inkfall"]
    return subprocess.run(command, env={**os.environ, "DISPLAY": app.display}, capture_output=True).returncode == 0


def test_the_window_goes_at_once_and_the_file_is_whole(program, tmp_path, monkeypatch):
    monkeypatch.setattr(Image, "MAX_IMAGE_PIXELS", None)
    app = program()
    app.stroke((400, 300), (700, 500))
    app.canvas()
    assert shown(app)
    app.keys("ctrl+e")
    app.click(app.at("Finer", LEVEL_4))
    app.settled()
    let_keys_repeat(app.display, True)
    try:
        app.do("keydown", "Return")
        time.sleep(0.7)  # longer than it takes until a key repeats
        app.do("keyup", "Return")
    finally:
        let_keys_repeat(app.display, False)
    app.box("name", "Export picture")
    app.settled()
    app.fill(str(tmp_path / "large.png"))
    app.keys("Return")
    app.until_gone("name")
    assert not list(tmp_path.rglob("untitled*")), "a held key chose a file"
    app.keys("ctrl+q")
    app.click("Don’t save")
    while shown(app):  # and no longer than it writes
        time.sleep(0.02)
    assert app.process.poll() is None, "the window is there until all is written"
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
