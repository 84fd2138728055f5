"""The real window, killed at random moments while it paints and saves: nothing that was finished is lost.

INKFALL_KILLS: how many times; INKFALL_KILLS_SEED: of what is random; `-s` shows the figures of each, which also go to
the file INKFALL_KILLS_TOLD.  "Short": by how much the stroke in hand lacks what the pointer did, frames included.
"""

import itertools
import os
import random
import shutil
import threading
import time
from pathlib import Path

import numpy as np
import pytest
from driven import Program

from engine.canvas.composite import composite
from engine.canvas.reading import layer_planes
from engine.journal.entries import listed
from engine.numeric.address import Rect
from engine.painting import commands as c
from engine.session.replay import replay
from engine.studio.filing import documents
from engine.studio.filing.recovering import recovered

pytestmark = [pytest.mark.window, pytest.mark.nightly, pytest.mark.timeout(0)]
KILLS = int(os.environ.get("INKFALL_KILLS", "100"))
SEED = int(os.environ.get("INKFALL_KILLS_SEED", "1"))
LATEST = 4.0  # seconds after which it is killed, at most
POSTED = "a stroke is posted"


class Hand:
    """Paints, undoes and saves at random, until the window is gone."""

    def __init__(self, app: Program, chance: random.Random) -> None:
        self._app, self._chance = app, chance
        self.moved = 0.0  # when the pointer was last moved with its button down, seconds since 1970
        self.down = False

    def work(self) -> None:
        while self._app.process.poll() is None:
            what = self._chance.random()
            if what < 0.8:
                self._stroke()
            else:
                self._app.keys("ctrl+z" if what < 0.9 else "ctrl+s")

    def _stroke(self) -> None:
        points = [(self._chance.randint(300, 940), self._chance.randint(120, 680)) for _ in range(4)]
        self._app.do("mousemove", *points[0], "mousedown", 1)
        self.down = True
        for start, end in itertools.pairwise(points):
            for part in (0.25, 0.5, 0.75, 1.0):
                if self._app.process.poll() is not None:
                    return  # the button stays down
                place = [round(a + (b - a) * part) for a, b in zip(start, end, strict=True)]
                self._app.do("mousemove", *place)
                self.moved = time.time()
        self._app.do("mouseup", 1)
        self.down = False


def killed(app: Program, chance: random.Random) -> Hand:
    """Kills the program at a random moment while it is painted in; the hand that did."""
    hand = Hand(app, chance)
    timer = threading.Timer(chance.uniform(0.05, LATEST), app.process.kill)
    timer.start()
    hand.work()
    timer.join()
    app.process.wait(10)
    return hand


def shown(session, level: int) -> np.ndarray:
    """The picture of a painting's frame."""
    painting = session.painting
    area = Rect(
        *(side << level for side in (painting.frame.x0, painting.frame.y0, painting.frame.x1, painting.frame.y1))
    )
    return composite(painting.root, level, area, lambda layer, at, rect: layer_planes(layer, at, rect, session.cache))


def strokes(session) -> list[c.Stroke]:
    return [command for command in session.log if isinstance(command, c.Stroke)]


@pytest.fixture(scope="module")
def lake(display, tmp_path_factory):
    """A painting that was saved."""
    folder = tmp_path_factory.mktemp("lake")
    app = Program(display, folder)
    app.stroke((400, 300), (700, 500))
    app.save_as(folder / "lake.ora")
    app.process.kill()
    app.process.wait(10)
    return folder / "lake.ora"


@pytest.mark.parametrize("number", range(KILLS))
def test_a_kill_loses_nothing_that_was_finished(display, tmp_path, lake, number):
    chance = random.Random(SEED * 100_003 + number)
    words, before = [], 0
    if chance.random() < 0.5:
        shutil.copy(lake, tmp_path)
        words, before = ["lake.ora"], len(strokes(documents.opened(lake).session()))
    app = Program(display, tmp_path, *words)
    if words:
        app.wait_for("painting 1 shown")
    hand = killed(app, chance)
    posted = app.log.read_text(errors="replace").count(POSTED)
    whole = documents.opened(tmp_path / "lake.ora") if words else None
    assert whole is None or not whole.notes, whole.notes
    entries = [entry for entry in listed(tmp_path / "state" / "inkfall" / "paintings") if not entry.in_bin]
    assert len(entries) <= 1
    if not entries:  # all of it was saved, or nothing was painted
        found = whole.session() if whole is not None else None
        kept, missing, session = len(strokes(found)) if found else 0, [], found
    else:
        assert not entries[0].alive
        had = recovered(entries[0].folder)
        session, missing, kept = had.session, had.missing, len(strokes(had.session))
        assert had.known
    missing = [line for line in missing if not line.startswith("the end of the last stroke")]
    assert not missing
    assert before + posted <= kept <= before + posted + 1, f"{posted} strokes were finished, {kept - before} are there"
    late = None
    if session is not None:
        again = replay(session.recording())
        for level in (0, 1):
            assert np.array_equal(shown(session, level), shown(again, level)), f"level {level} is another picture"
        if hand.down and kept == before + posted + 1 and strokes(session)[-1].extra.get("time"):
            last = strokes(session)[-1]
            late = hand.moved - (last.extra["time"] + last.points[-1, 5])
    told = f"kill {number}: {posted} finished, {kept - before} there" + (
        f", {late * 1000:.0f} ms short" if late else ""
    )
    print(told, flush=True)
    if "INKFALL_KILLS_TOLD" in os.environ:
        with Path(os.environ["INKFALL_KILLS_TOLD"]).open("a") as file:
            file.write(told + "\n")
    app.do("mouseup", 1)
