"""The dialogs in the real window: how they look, and that they do what is asked of them."""

import json
import time
import zipfile

import numpy as np
import pytest
from PIL import Image

pytestmark = pytest.mark.window

TEXT = 60  # grey levels by which letters are lighter than what they lie on


def margins(button):
    """Of each line of text in a picture of a button: the pixels to the left of it, and to the right."""
    light = button.astype(int).max(axis=-1)
    letters = light > np.median(light) + TEXT
    rows = np.flatnonzero(np.diff(np.r_[False, letters.any(axis=1), False].astype(int)))
    found = [np.flatnonzero(letters[top:bottom].any(axis=0)) for top, bottom in rows.reshape(-1, 2)]
    return [(int(line[0]), button.shape[1] - 1 - int(line[-1])) for line in found]


@pytest.mark.nightly
def test_sizes_of_a_new_painting_stand_in_the_middle_of_their_buttons(program):
    app = program()
    app.do("mousemove", 640, 300)
    app.keys("ctrl+n")
    app.box("Start")
    screen = app.settled()
    for name in ("Screen", "Square", "Wide", "A4, 150 dpi", "Start", "Cancel"):
        lines = margins(screen[app.part(name)])
        assert lines
        assert all(abs(left - right) <= 2 for left, right in lines), f"{name}: {lines}"
    app.click("Square")
    app.click("Smaller files")
    app.click("Start")
    app.until_gone("Start")
    assert app.process.poll() is None
    app.save_as(app.folder / "new.ora")
    with zipfile.ZipFile(app.folder / "new.ora") as file:
        manifest = json.loads(file.read("inkfall/manifest.json"))
    assert (manifest["frame"][2:], manifest["grid"]) == ([1024, 1024], 12)


def pictures(folder):
    """Some files to choose from: a red picture, a green one, and a folder with a blue one."""
    (folder / "more").mkdir()
    for name, colour in (("a.png", (220, 30, 30)), ("b.jpg", (30, 200, 30)), ("more/c.png", (40, 40, 230))):
        Image.new("RGB", (64, 48), colour).save(folder / name)


def colourful(screen, place):
    """How much the strongest channel of a part of the screen exceeds the weakest, at most, and which that is."""
    part = screen[place].reshape(-1, 3).astype(int)
    pixel = part[np.argmax(part.max(axis=1) - part.min(axis=1))]
    return int(pixel.max() - pixel.min()), int(pixel.argmax())


def test_files_are_chosen_by_their_pictures_and_a_slow_double_click(program):
    app = program()
    pictures(app.folder)
    app.do("mousemove", 640, 300)
    app.keys("ctrl+o")
    rows = {name: app.part(name, "Open") for name in ("a.png", "b.jpg")}
    for channel, name in enumerate(rows):
        app.until(lambda screen, name=name, channel=channel: colourful(screen, rows[name]) > (100, channel), (640, 20))
        assert colourful(app.screen(), rows[name])[1] == channel
    app.type("b.j")  # the field has the focus
    app.keys("ctrl+a", "BackSpace")
    app.click("more", "Open")
    app.do("mousemove", *app.at("c.png", window="Open"), "click", 1)
    end = time.monotonic() + 90
    while ("Open", "Cancel") in app.boxes():  # on a busy machine the clicks may come later than they are made
        assert time.monotonic() < end, "a slow double click chooses nothing"
        time.sleep(0.6)  # another click than the one before
        app.do("mousedown", 1, "mouseup", 1, "sleep", 0.4, "mousedown", 1, "mouseup", 1)
        time.sleep(0.6)
    app.wait_for("painting 1 shown")


def test_a_name_typed_at_once_is_the_files(program):
    app = program()
    pictures(app.folder)
    app.do("mousemove", 640, 300)
    app.keys("ctrl+o")
    app.box("a.png", "Open")
    app.type("a.png")
    app.keys("Return")
    app.wait_for("painting 1 shown")

    # Each file that is there is asked about before it is replaced.
    there = [app.folder / name for name in ("one.ora", "two.ora")]
    for path in there:
        path.write_bytes(b"old")
    app.keys("ctrl+shift+s")
    for path in there:
        app.click(path.name, "Save as")
        app.click("Save", "Save as")
        app.box("Replace")
        assert path.read_bytes() == b"old"
    app.click("Replace")
    app.until_gone("Replace")
    app.until_gone("Cancel")
    end = time.monotonic() + 90
    while there[1].read_bytes() == b"old":
        assert time.monotonic() < end
        time.sleep(0.05)
    assert there[0].read_bytes() == b"old"


def test_escape_closes_the_colour_of_the_paper_and_then_the_dialog(program):
    app = program()
    app.keys("ctrl+n")
    app.click("paper", "New painting")
    app.box("paper colour")
    app.keys("Escape")
    app.until_gone("paper colour")
    app.box("Start")
    app.keys("Escape")
    app.until_gone("Start")
