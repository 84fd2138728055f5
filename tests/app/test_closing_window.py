"""Closing the real window while a picture is still written."""

import os
import subprocess
import time

import pytest
from PIL import Image
from xserver import let_keys_repeat

from app.loop import _told
from engine.studio import results

pytestmark = pytest.mark.window


def shown(app):
    """Whether its window is on the screen."""
    command = ["xdotool", "search", "--onlyvisible", "--name", "Inkfall"]
    return subprocess.run(command, env={**os.environ, "DISPLAY": app.display}, capture_output=True).returncode == 0


def test_the_window_goes_at_once_and_the_file_is_whole(program, tmp_path):
    app = program(module="held_export")
    app.stroke((400, 300), (700, 500))
    app.canvas()
    assert shown(app)
    app.keys("ctrl+e")
    app.box("Finer")
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
    app.fill(str(tmp_path / "held.png"))
    app.keys("Return")
    app.until_gone("name")
    assert not list(tmp_path.rglob("untitled*")), "a held key chose a file"
    app.keys("ctrl+q")
    app.click("Don’t save")
    while shown(app):  # and no longer than it writes
        time.sleep(0.02)
    assert app.process.poll() is None, "the program ended before all was written"
    assert not (tmp_path / "held.png").exists()
    (tmp_path / "leave").touch()
    assert app.process.wait(90) == 0
    with Image.open(tmp_path / "held.png") as picture:
        assert picture.size == (1024, 768)
        picture.load()


def test_what_fails_when_the_window_is_gone_is_told_on_the_terminal(capsys):
    class Worker:
        def __init__(self, *results):
            self.results = lambda: results

    assert _told(Worker(results.Note("written"), results.Pending(0))) == 0
    assert capsys.readouterr().err == ""
    assert _told(Worker(results.Note("a.png: no space left", bad=True))) == 1
    assert capsys.readouterr().err == "inkfall: a.png: no space left\n"
