"""Painting with examples in the real window: preview, growth, undo, swap, saving, a kill; a region of one’s own."""

import json
import shutil
import signal
import time
from pathlib import Path

import numpy as np
import pytest
from PIL import Image
from screens import changed

from engine.journal.entries import listed
from engine.painting.capture import read_picture
from engine.strokes.example_files import read_mask
from engine.strokes.example_region import followed

pytestmark = pytest.mark.window

OWN = {"my-wash": "wash-indigo", "my-felt": "felt"}  # copies under names of their own
CANVAS = (slice(60, 400), slice(280, 960))
BUNDLED = Path(__file__).parents[2] / "palettes" / "examples"
LINE = [(400 + 16 * i, 200 + (30 if i % 8 < 4 else -30)) for i in range(16)]
GROWS, GROWN = "something grows", "all has grown"


def grown(app):
    """How often all has grown; 0 while something grows."""
    text = app.log.read_text()
    return text.count(GROWN) if text.rfind(GROWN) > text.rfind(GROWS) else 0


def at_rest(app, before=0):
    """The canvas when all has grown, once more than `before`."""
    while True:
        until(lambda: grown(app) > before)
        times, picture = grown(app), shown(app)
        if grown(app) == times:
            return picture


def until(good, seconds=90.0):
    end = time.monotonic() + seconds
    while not good():
        assert time.monotonic() < end
        time.sleep(0.1)


def shown(app):
    app.park()
    return app.settled()[CANVAS].astype(int)


def now(app):
    return app.screen()[CANVAS].astype(int)


@pytest.fixture
def folder(tmp_path):
    """The artist's own examples."""
    made = tmp_path / "data" / "inkfall" / "examples"
    made.mkdir(parents=True)
    for name, bundled in OWN.items():
        for ending in (".png", ".mask.png", ".toml"):
            shutil.copy(BUNDLED / f"{bundled}{ending}", made / f"{name}{ending}")
    return made


def opened(app):
    app.do("mousemove", 640, 300)
    if not any(window == "strip" for window, _ in app.boxes()):  # left open when it ended, it is open again
        app.keys("p")
    until(lambda: "examples ready" in app.log.read_text(), 150.0)  # at the first start kernels are compiled
    thumbnail = app.part("My felt")
    until(lambda: app.screen()[thumbnail].std() > 20)
    return app


def choose(app, title):
    sample = app.part("sample")
    before = app.screen()[sample].astype(int)
    app.click(title)

    def is_shown():
        now = app.screen()[sample].astype(int)
        return changed(now, before) > 2000 and now.mean() > 128  # not dark, as while it is of another one

    until(is_shown)


def with_palette(program, *words):
    app = opened(program(*words))
    choose(app, "My wash")
    return app


def region_of(folder):
    return np.asarray(Image.open(folder / "my-wash.mask.png").convert("L")) > 127


def shown_region(app):
    picture = app.part("region")
    app.park()
    return app.settled()[picture].astype(int)


def until_unlike(app, picture):
    until(lambda: changed(shown_region(app), picture) > 300)
    return shown_region(app)


def test_a_stroke_grows_and_can_be_taken_back_and_swapped(program, folder):
    app = with_palette(program)
    empty = shown(app)
    app.do("mousemove", *LINE[0], "mousedown", 1)
    for point in LINE[1:]:
        app.do("mousemove", *point)
        time.sleep(0.02)
    until(lambda: changed(now(app), empty) > 6000)  # it is seen while the pen is down
    app.do("mouseup", 1)
    first = at_rest(app)

    # Taken back while it grows: as if it had not been.
    app.stroke(*[(x, y + 60) for x, y in LINE])
    until(lambda: changed(now(app), first) > 1500)
    app.keys("ctrl+z")
    until(lambda: np.array_equal(shown(app), first))
    app.keys("ctrl+shift+z")
    until(lambda: changed(shown(app), first) > 1500)
    app.keys("ctrl+z")
    until(lambda: np.array_equal(shown(app), first))

    # Another example for what is there; with Escape nothing happens.
    choose(app, "My felt")
    app.click("Swap")
    app.parked()  # Escape at once would come before the frame in which the click counts
    app.keys("Escape")
    app.click("Swap")
    app.parked()
    done = app.log.read_text().count(GROWN)
    app.click(LINE[8])
    swapped = at_rest(app, done)
    painted = changed(first, empty)
    assert changed(swapped, first) > 0.6 * painted
    red = (swapped[..., 0] - swapped[..., 2] > 60).sum()
    assert red > 0.5 * painted
    app.keys("ctrl+z")
    until(lambda: np.array_equal(shown(app), first))


@pytest.mark.nightly
def test_saved_and_killed_while_it_grows(program, tmp_path, folder):
    path = tmp_path / "grown.ora"
    app = with_palette(program)
    app.stroke(*LINE)
    app.save_as(path)
    first = at_rest(app)

    # Killed while another stroke grows and is saved: the file is the one before, or all of the new one.
    choose(app, "My felt")
    app.stroke(*[(x + 430, y) for x, y in LINE[:6]])
    until(lambda: changed(now(app), first) > 1500)
    app.keys("ctrl+s")
    app.process.send_signal(signal.SIGKILL)
    app.process.wait(90)
    offered = [entry for entry in listed(tmp_path / "state" / "inkfall" / "paintings") if not entry.in_bin]
    for kept in ("config/inkfall/window.json", "state/inkfall/views.json"):  # this is about the paint, not its view
        (tmp_path / kept).unlink(missing_ok=True)
    again = program(str(path))
    again.wait_for("painting 1 shown")
    if offered:  # this is about the file
        again.click("Keep for later")
        again.until_gone("Keep for later")
    opened(again)
    apart = slice(0, 420)  # columns that the second stroke does not reach
    until(lambda: np.array_equal(shown(again)[:, apart], first[:, apart]))
    more = changed(shown(again), first)
    assert more > 1500 or (more == 0 and offered)


@pytest.mark.nightly
def test_a_region_is_painted_and_saved(program, folder):
    app = with_palette(program)
    before = region_of(folder)
    app.click("Region")
    picture = app.part("region")
    until(lambda: app.screen()[picture].std() > 20)
    seen = shown_region(app)
    app.stroke(*(app.at("region", *part) for part in ((0.01, 0.02), (0.08, 0.07), (0.11, 0.17))))
    first = until_unlike(app, seen)
    middle = app.at("region", 0.5, 0.36)
    for keys, expected in (("ctrl+z", seen), ("ctrl+shift+z", first)):
        app.do("mousemove", *middle)
        app.keys(keys)
        until(lambda expected=expected: np.array_equal(shown_region(app), expected))
    app.stroke(middle, app.at("region", 0.55, 0.41))  # in already: a step that changes nothing
    app.do("mousemove", *middle)
    app.keys("ctrl+z")
    app.click("Paint out")
    painted = shown_region(app)
    app.stroke(middle, app.at("region", 0.55, 0.46))
    until_unlike(app, painted)
    app.click("Save")
    until(lambda: not np.array_equal(region_of(folder), before))
    after = region_of(folder)
    assert after.shape == before.shape
    assert (after & ~before)[:50, :60].sum() > 500
    assert (before & ~after)[100:150, 140:180].sum() > 500
    assert not list(folder.glob("*.part"))
    # What was painted is told as the strokes that it was, which make the same region anew.
    told = json.loads((folder / "my-wash.region.json").read_text())
    assert [step["op"] for step in told["steps"]] == ["add", "subtract"]
    began, picture = read_mask(folder / "my-wash.base.png"), read_picture(str(folder / "my-wash.png"), None)
    assert np.array_equal(began, before)
    assert np.array_equal(followed(began, told["steps"], picture), after)


def test_ones_own_is_renamed_by_a_double_click_and_deleted(program, folder):
    app = opened(program())
    app.do("mousemove", *app.at("My wash"))
    while not any(name == "Rename" for _, name in app.boxes()):  # frames of a busy machine part the two clicks
        app.do("click", "--repeat", 2, "--delay", 80, 1)
        time.sleep(0.8)
    app.type("Zebra")
    app.keys("Return")
    until(lambda: 'title = "Zebra"' in (folder / "my-wash.toml").read_text())
    app.click("delete")
    until(lambda: not list(folder.glob("my-wash.*")))
    assert len(list(folder.glob("my-felt.*"))) == 3
