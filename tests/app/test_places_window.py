"""Places in the real window: bookmarks, the map, back and forward, a place typed, the way to the nearest paint."""

import time

import pytest
from driven import PATIENCE

from engine.archive.opening import open_painting
from engine.archive.saving import Snapshot, save
from engine.painting import commands as c
from engine.painting.places import middle_of
from engine.session.session import Session

pytestmark = pytest.mark.window
DEEP = 700 << 9, 500 << 9


def stroke(level, x, y):
    brush = {"radius": 12, "colour": "#204080", "hardness": 1}
    points = [[0, 0], [200, 40], [300, 0]]
    return c.parse({"do": "stroke", "level": level, "origin": [x, y], "points": points, "brush": brush})


@pytest.fixture
def painting(tmp_path):
    session = Session()
    for command in (stroke(0, 100, 100), stroke(9, *DEEP), c.Bookmark("mill", 6.0, (7000, 6000), (740, 390), 20.0)):
        session.do(command)
    save(tmp_path / "lake.ora", Snapshot(session.painting, session.recording()))
    return tmp_path / "lake.ora"


def shows(program, *names):
    """Waits until all of these are in sight."""
    end = time.monotonic() + PATIENCE
    while not set(names) <= {name for _, name in program.boxes()}:
        assert time.monotonic() < end, f"no {names} in {sorted(program.boxes())}"
        time.sleep(0.1)


@pytest.mark.nightly
def test_going_from_place_to_place(program, painting):
    window = program(str(painting))
    window.keys("j")
    shows(window, "bookmark mill", "spot 9")
    home = next(name for _, name in window.boxes() if name.startswith("status: Level"))
    window.click("bookmark mill")
    shows(window, "status: Level 6")
    window.keys("alt+Left")
    shows(window, home)
    window.park()
    window.do("click", 9)
    shows(window, "status: Level 6")
    window.do("click", 8)
    shows(window, home)
    window.click("spot 9")
    shows(window, "status: Level 9")
    window.settled()  # the flight has ended
    window.keys("ctrl+b")
    shows(window, "bookmark Place 1")
    window.do("mousemove", *window.at("bookmark mill"))
    window.click("rename")
    window.box("rename bookmark")
    window.type("wind mill")
    window.keys("Return")
    shows(window, "bookmark wind mill")
    window.click("status: Level 9")
    window.box("place")
    window.type(f"12, {5**30}, -7")
    window.keys("Return")
    shows(window, "status: Level 12", "No paint in sight")
    window.keys("ctrl+l")
    window.box("place")
    window.keys("Escape")
    window.until_gone("place")
    end = time.monotonic() + PATIENCE
    while any(name == "No paint in sight" for _, name in window.boxes()):
        assert time.monotonic() < end, "the key does not go to the whole painting"
        window.keys("Home")  # again, where the first came while the dialog was going
        time.sleep(0.5)
    window.do("mousemove", *window.at("bookmark wind mill"))
    window.click("remove bookmark")
    window.until_gone("bookmark wind mill")
    window.keys("ctrl+s")
    end = time.monotonic() + PATIENCE
    while list(open_painting(painting).painting.bookmarks) != ["Place 1"]:
        assert time.monotonic() < end
        time.sleep(0.2)
    mark = open_painting(painting).painting.bookmarks["Place 1"]
    assert 8.9 < mark.level <= 9.0  # all of the paint's tiles are seen
    x, y, exponent = middle_of(mark)
    assert abs((x >> exponent - 9) - DEEP[0] - 150) < 130
    assert abs((y >> exponent - 9) - DEEP[1] - 20) < 130
