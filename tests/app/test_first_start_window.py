"""The first start of the window, with no kernel compiled: who paints at once sees it, while brushes become ready."""

import re
import time

import numpy as np
import pytest
from driven import Stalled

FROM, TO = (500, 400), (620, 430)
PREPARING = re.compile(r"Preparing brushes, (\d+) of (\d+)$")


@pytest.fixture
def fresh(program, tmp_path, monkeypatch):
    """A program whose cache of kernels is empty, and whose engine is loaded."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    monkeypatch.delenv("NUMBA_CACHE_DIR", raising=False)
    return program(fresh=True)


def prepared(program, seconds=90.0):
    """The numbers that the status line tells."""
    end = time.monotonic() + seconds
    while True:
        told = [found for _, name in program.boxes() if (found := PREPARING.search(name))]
        if told:
            return int(told[0][1]), int(told[0][2])
        assert time.monotonic() < end, program.log.read_text()
        time.sleep(0.05)


def test_a_stroke_is_seen_long_before_all_brushes_are_ready(fresh):
    fresh.do("mousemove", *FROM, "mousedown", 1, "mousemove", *TO)
    fresh.wait_for("first paint")
    fresh.do("mouseup", 1)
    ready, of = prepared(fresh)
    assert 0 <= ready < of
    assert of >= 60
    events = [line.split(":")[0] for line in fresh.log.read_text().splitlines() if not line.startswith("box ")]
    assert [name for name in events if name in ("first frame", "first paint", "all brushes ready")] == [
        "first frame",
        "first paint",
    ]
    fresh.park()
    fresh.wait_until(lambda: sketched(fresh.screen().astype(int)), "it is not seen")
    fresh.process.kill()  # by itself it would wait for the stroke's kernels as long as a signal lets it


def sketched(screen):
    """Whether there is paint as far as the stabiliser came."""
    return np.abs(screen[FROM[1] - 3 : FROM[1] + 4, FROM[0] : FROM[0] + 12] - screen[600, 500]).max() > 60


def test_strokes_made_before_the_engine_is_loaded_are_painted(program):
    app = program(ready="first frame", fresh=True)
    with Stalled(app):  # however long that takes, the engine does not come before it
        app.do("mousemove", *FROM, "mousedown", 1, "mousemove", *TO, "mouseup", 1)
        app.do("mousemove", 500, 500, "mousedown", 1, "mousemove", 620, 530, "mouseup", 1)
        loaded = "engine ready" in app.log.read_text()
    assert painted(app) == [True, True]
    assert not loaded, "they came too late to tell anything"
    app.keys("ctrl+z")
    assert painted(app, [True, False]) == [True, False]


def painted(app, expected=(True, True), seconds=90.0):
    """Whether there is paint on the ways of the first and of the second stroke, as soon as it is as expected."""
    end = time.monotonic() + seconds
    while True:
        app.park()
        screen = app.screen().astype(int)
        found = [bool(np.abs(screen[y, 560] - screen[600, 500]).max() > 60) for y in (415, 515)]
        if found == list(expected) or time.monotonic() > end:
            return found
        time.sleep(0.2)
