"""Painting with examples in the real window: preview, growth, undo, swap, saving, a kill; a region of one’s own."""

import signal
import time

import numpy as np
import pytest
from PIL import Image

pytestmark = [pytest.mark.window, pytest.mark.timeout(240)]

INDIGO, FELT = (368, 526), (672, 614)
REGION_TAB, SWAP = (830, 437), (925, 755)
CANVAS = (slice(60, 400), slice(280, 960))
THUMBNAIL = (slice(500, 550), slice(345, 390))
LINE = [(360 + 16 * i, 200 + (40 if i % 8 < 4 else -40)) for i in range(30)]
GROWN = "all has grown"


def click(app, at):
    app.do("mousemove", *at)
    time.sleep(0.25)
    app.do("click", 1)


def grown(app):
    return app.log.read_text().count(GROWN)


def until(good, seconds=60.0):
    end = time.monotonic() + seconds
    while not good():
        assert time.monotonic() < end
        time.sleep(0.1)


def shown(app):
    app.do("mousemove", 640, 790)
    return app.settled(calm=3)[CANVAS].astype(int)


def now(app):
    return app.screen()[CANVAS].astype(int)


def changed(a, b):
    return int((np.abs(a - b).max(axis=-1) > 12).sum())


def detail(picture):
    """How much neighbouring pixels of what is painted differ."""
    return float(np.abs(np.diff(picture[120:160, 100:600], axis=1)).mean())


def with_palette(program, *words):
    app = program(*words)
    app.do("mousemove", 640, 300)
    app.keys("p")
    until(lambda: app.screen()[THUMBNAIL].std() > 20)
    click(app, INDIGO)
    return app


def saved_as(app, path):
    app.keys("ctrl+s")
    time.sleep(0.5)
    app.keys("ctrl+a")
    app.type(str(path))
    app.keys("Return")


def test_a_stroke_grows_and_can_be_taken_back_and_swapped(program):
    app = with_palette(program)
    empty = shown(app)
    app.stroke(*LINE)
    until(lambda: changed(now(app), empty) > 15_000)
    preview = now(app)
    assert grown(app) == 0
    until(lambda: grown(app) == 1)
    first = shown(app)
    assert detail(first) > 1.3 * detail(preview)

    # Taken back while it grows: as if it had not been.
    app.stroke(*[(x, y + 60) for x, y in LINE])
    until(lambda: changed(now(app), first) > 3000)
    app.keys("ctrl+z")
    until(lambda: np.array_equal(shown(app), first))
    app.keys("ctrl+shift+z")
    until(lambda: changed(shown(app), first) > 3000)
    app.keys("ctrl+z")
    until(lambda: np.array_equal(shown(app), first))

    # Another example for what is there; with Escape nothing happens.
    click(app, FELT)
    click(app, SWAP)
    app.keys("Escape")
    click(app, SWAP)
    done = grown(app)
    click(app, LINE[15])
    until(lambda: grown(app) > done)
    swapped = shown(app)
    painted = changed(first, empty)
    assert changed(swapped, first) > 0.6 * painted
    red = (swapped[..., 0] - swapped[..., 2] > 60).sum()
    assert red > 0.5 * painted
    app.keys("ctrl+z")
    until(lambda: np.array_equal(shown(app), first))


def test_saved_and_killed_while_it_grows(program, tmp_path):
    path = tmp_path / "grown.ora"
    app = with_palette(program)
    app.stroke(*LINE)
    saved_as(app, path)
    until(path.exists)
    until(lambda: grown(app) == 1)
    first = shown(app)
    app.keys("ctrl+q")
    assert app.process.wait(20) == 0

    again = program(str(path))
    again.wait_for("painting 1 shown")
    again.do("mousemove", 640, 300)
    again.keys("p")
    until(lambda: np.array_equal(shown(again), first))
    click(again, INDIGO)
    again.stroke(*[(x, y + 60) for x, y in LINE])
    until(lambda: changed(now(again), first) > 3000)
    again.keys("ctrl+s")
    again.process.send_signal(signal.SIGKILL)
    again.process.wait(10)

    after = program(str(path))
    after.wait_for("painting 1 shown")
    after.do("mousemove", 640, 300)
    after.keys("p")
    until(lambda: changed(shown(after), first) < 100 or changed(shown(after), first) > 3000)  # the old one or the new


def test_a_region_is_painted_and_saved_as_ones_own(program, tmp_path):
    app = with_palette(program)
    folder = tmp_path / "data" / "inkfall" / "examples"
    click(app, REGION_TAB)
    time.sleep(0.4)
    before = app.settled().astype(int)
    corner = (300, 360)
    app.stroke(corner, (330, 380), (340, 420))
    until(lambda: changed(app.screen()[350:440, 295:360].astype(int), before[350:440, 295:360]) > 300)
    app.stroke((500, 500), (520, 520))
    app.do("mousemove", 500, 500)
    app.keys("ctrl+z")
    click(app, (867, 755))
    until(lambda: (folder / "wash-indigo.toml").exists())
    until(lambda: "wash-indigo.mask.png" in {path.name for path in folder.iterdir()})
    mask = np.asarray(Image.open(folder / "wash-indigo.mask.png").convert("L")) > 127
    bundled = np.asarray(Image.open(folder / "wash-indigo.png").convert("RGBA"))
    assert mask.shape == bundled.shape[:2]
    assert mask[10, 10:20].any()
    assert mask[150, 150]
    assert not mask[-3, -3]
