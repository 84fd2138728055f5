"""Files that are slow to open, or never end, in the real window: one paints on, gives them up, or asks no more."""

import os
import time

import numpy as np
import pytest
from driven import PATIENCE

pytestmark = pytest.mark.window

HEADER = b'{"inkfall": 1, "frame": [0, 0, 600, 400], "seed": 3}\n'
STROKE = b'{"do": "stroke", "points": [[30, 30], [560, 350]], "brush": {"radius": 30, "colour": "#c03020"}}\n'
VIEW = b'{"do": "view", "level": 0, "origin": [0, 0], "size": [600, 400]}\n'


def slow(path, count):
    """A recording that takes a while: it looks at the same place again and again."""
    path.write_bytes(HEADER + STROKE + VIEW * count)
    return path


def opens(app, path, modified=True):
    app.keys("ctrl+o")
    if modified:
        app.click("Don’t save")
    app.click(path.name, "Open")
    app.click("Open", "Open")
    app.until_gone("name")


def unlike(app, picture):
    """The middle of the canvas when it shows something else and rests, while the status line counts."""
    app.park()
    end, looks = time.monotonic() + PATIENCE, [picture]
    while np.array_equal(looks[-1], picture) or any(not np.array_equal(looks[-1], look) for look in looks[-4:]):
        assert time.monotonic() < end, "the canvas stays as it was"
        time.sleep(0.2)
        looks.append(app.screen()[60:740, 270:970])
    return looks[-1]


@pytest.mark.nightly
def test_painting_goes_on_while_a_file_is_opened(program, tmp_path):
    os.mkfifo(tmp_path / "pipe.png")
    app = program("pipe.png")
    app.box("pipe.png: not a regular file")
    app.park()
    empty = app.screen()[60:740, 270:970]
    endless = slow(tmp_path / "endless.jsonl", 2_000_000)
    opens(app, endless, modified=False)
    app.box("Opening endless.jsonl")
    app.stroke((400, 300), (700, 500))
    unlike(app, empty)
    assert app.box("Opening endless.jsonl")
    app.keys("Escape")
    app.until_gone("Opening endless.jsonl")
    one = unlike(app, empty)
    opens(app, slow(tmp_path / "slow.jsonl", 100_000))
    app.box("Opening slow.jsonl")
    app.stroke((400, 500), (700, 300))  # nobody was asked about this one
    app.click("Cancel", "Unsaved changes")
    app.until_gone("Opening slow.jsonl")
    two = unlike(app, one)
    opens(app, slow(tmp_path / "short.jsonl", 10))
    app.wait_for("painting 1 shown")
    unlike(app, two)
    opens(app, endless)
    app.box("Opening endless.jsonl")
    app.click("Stop")
    app.until_gone("Opening endless.jsonl")
    opens(app, endless)
    app.box("Opening endless.jsonl")
    app.keys("ctrl+q")
    app.click("Don’t save")
    assert app.process.wait(90) == 0
