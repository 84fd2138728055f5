"""Saving in the real window: over what others have saved, from two windows, and earlier versions."""

import io
import json
import time
import zipfile

import numpy as np
import pytest
from PIL import Image
from xserver import started_screen

from engine.archive.saving import MERGED

WANTED = "expected a whole number from 1 to 100"
pytestmark = pytest.mark.window


@pytest.fixture
def other_display(display):
    process, name = started_screen()
    yield name
    process.terminate()
    process.wait(90)


def picture(path):
    with zipfile.ZipFile(path) as archive, Image.open(io.BytesIO(archive.read(MERGED))) as merged:
        return np.asarray(merged.convert("RGBA")).astype(int)


def until(good, seconds=90.0):
    end = time.monotonic() + seconds
    while not good():
        assert time.monotonic() < end
        time.sleep(0.05)


def saves(app, path):
    """Saves with the key, and waits until the file is another one."""
    before = path.stat().st_mtime_ns
    app.keys("ctrl+s")
    until(lambda: path.stat().st_mtime_ns != before)


def left_over(folder):
    """What a process left that was killed in a save, and preferences with a fault; the file beside."""
    (folder / "state" / "inkfall" / "writing").mkdir(parents=True)
    told = {"path": str(folder / "old.ora"), "process": 1}
    (folder / "state" / "inkfall" / "writing" / "1-a.json").write_text(json.dumps(told))
    (folder / "config" / "inkfall").mkdir(parents=True)
    (folder / "config" / "inkfall" / "preferences.toml").write_text("[kept]\nversions = 'all'\n")
    part = folder / ".old.ora.1.0123abcd.part"
    part.write_bytes(b"half")
    return part


def test_nothing_that_others_saved_is_lost_and_earlier_versions_are_at_hand(program, tmp_path, other_display):
    path = tmp_path / "untitled.ora"
    part = left_over(tmp_path)
    first = program()
    first.box(f"preferences.toml: [kept] versions: found 'all', {WANTED}", "status")
    assert not part.exists()
    first.stroke((400, 300), (700, 320))
    first.canvas()
    first.keys("ctrl+s")
    first.box("name", "Save as")
    first.settled()
    first.click("Save", "Save as")
    until(path.exists)
    one_stroke = first.canvas()
    saved = picture(path)
    second = program(str(path), on=other_display)
    second.box("Save as…", "status")
    second.stroke((400, 500), (700, 520))
    second.canvas()
    second.keys("ctrl+s")  # it is open in the first
    second.box("Overwrite")
    assert np.array_equal(picture(path), saved)
    second.click("Overwrite")
    until(lambda: not np.array_equal(picture(path), saved))
    theirs = path.read_bytes()

    first.keys("ctrl+s")  # nothing was painted, but the file is another one
    first.box("Open the other")
    assert path.read_bytes() == theirs
    first.click("Open the other")
    first.canvas_unlike(one_stroke)
    first.stroke((450, 200), (650, 220))
    first.canvas()
    saves(first, path)
    assert first.canvas_unlike(one_stroke) is not None

    first.click((22, 11))  # the menu File
    first.click("Earlier versions…")
    first.box("version 2")
    shows_pictures(first)
    first.click("version 2")
    first.click("Open")
    assert first.comes_to(one_stroke)
    first.keys("ctrl+s")
    first.box("name", "Save as")  # it is untitled
    first.keys("Escape")


def shows_pictures(app):
    """Waits until the cards have their pictures: the paper of the paintings is light."""
    app.until(lambda screen: all((screen[app.part(f"version {n}")] > 200).mean() > 0.2 for n in (1, 2)))
