"""The real window, killed at random moments while it paints, saves and exports, some of it painted with an example:
nothing that was finished is lost.

INKFALL_KILLS: how many times; INKFALL_KILLS_SEED: of what is random; `-s` shows the figures of each, which also go to
the file INKFALL_KILLS_TOLD.  "Short": how long before the kill the first point was posted that is not there; "behind
the pointer": by how much the stroke in hand lacks what the pointer did, frames included.
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
from PIL import Image

from engine.brush.settings import Brush
from engine.canvas.composite import composite
from engine.canvas.reading import layer_planes
from engine.journal.entries import listed
from engine.keeping.unfinished import sweep_unfinished
from engine.numeric.address import Rect
from engine.painting import commands as c
from engine.painting.grown import settled
from engine.painting.value import Painting
from engine.session.replay import replay
from engine.session.session import Session
from engine.studio.filing import documents
from engine.studio.filing.recovering import recovered

pytestmark = [pytest.mark.window, pytest.mark.nightly, pytest.mark.timeout(0)]
KILLS = int(os.environ.get("INKFALL_KILLS", "80"))
SEED = int(os.environ.get("INKFALL_KILLS_SEED", "1"))
LATEST = 4.0  # seconds after which it is killed, at most
POSTED, DROPPED = "a stroke is posted", "a stroke is dropped"
IN_HAND = 0.05  # seconds of the stroke in hand that may be lost
EXAMPLE = Path(__file__).parents[2] / "palettes/examples/bread.png"


class Hand:
    """Paints, undoes and saves at random, until the window is gone."""

    def __init__(self, app: Program, chance: random.Random) -> None:
        self._app, self._chance = app, chance
        self.moved = 0.0  # when the pointer was last moved with its button down, seconds since 1970
        self.down = False
        self.killed = 0.0, 0.0  # when, by the monotonic clock and since 1970

    def work(self) -> None:
        while self._app.process.poll() is None:
            what = self._chance.random()
            if what < 0.7:
                self._stroke()
            elif what < 0.8:
                self._app.keys("ctrl+z")
            elif what < 0.9:
                self._app.keys("ctrl+s", "Return")
            else:
                self._app.keys("ctrl+e", "Return", "Return", "Return")  # and once more where it was exported before

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

    def kill() -> None:
        hand.killed = time.monotonic(), time.time()
        app.process.kill()

    timer = threading.Timer(chance.uniform(0.05, LATEST), kill)
    timer.start()
    hand.work()
    timer.join()
    app.process.wait(10)
    return hand


def shown(session, level: int) -> np.ndarray:
    """The picture of a painting's frame."""
    painting = settled(session.painting)
    area = Rect(
        *(side << level for side in (painting.frame.x0, painting.frame.y0, painting.frame.x1, painting.frame.y1))
    )
    return composite(painting.root, level, area, lambda layer, at, rect: layer_planes(layer, at, rect, session.cache))


def strokes(session) -> list[c.Stroke]:
    return [command for command in session.log if isinstance(command, c.Stroke)]


@pytest.fixture(scope="module")
def lake(tmp_path_factory):
    """A painting that was saved, with what is painted with an example."""
    path, session = tmp_path_factory.mktemp("lake") / "lake.ora", Session(Painting())
    points = np.array([[100.0, 100, 1, 0, 0, 0], [700, 500, 1, 0, 0, 1]])
    points.flags.writeable = False
    session.do(c.parse({"do": "texture", "name": "bread", "maker": "example", "path": str(EXAMPLE)}))
    session.do(c.Stroke(0, (0, 0), points, Brush(radius=60.0, mode="example", example="bread")))
    session.do(c.Stroke(0, (40, 90), points, Brush(radius=9.0)))
    documents.save(path, session.painting, session.recording())
    return path


def in_hand(log: str, session, kept: int, before: int) -> list[tuple[float, float]]:
    """From when to when points of the stroke in hand were posted: of those that are not there."""
    finished = log.count(POSTED)
    lines = log[max(log.rfind(POSTED), log.rfind(DROPPED)) :].splitlines()
    posted = [tuple(map(float, line.split()[1:])) for line in lines if line.startswith("points ")]
    there = len(strokes(session)[-1].points) if kept == before + finished + 1 else 0
    totals = itertools.accumulate(count for count, _, _ in posted)
    return [(began, ended) for total, (_, began, ended) in zip(totals, posted, strict=True) if total > there]


def doing(log: str) -> str:
    """What went on in the background when it was killed."""
    writes = [line for line in log.splitlines() if " files are being written" in line][-1:]
    saves, exports = any("its own" in line for line in writes), any(line[:2] not in ("0 ", "") for line in writes)
    return " saving" if saves else " exporting" if exports else " painting"


@pytest.mark.parametrize("number", range(KILLS))
def test_a_kill_loses_nothing_that_was_finished(display, tmp_path, lake, number, monkeypatch):
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "state"))
    chance = random.Random(SEED * 100_003 + number)
    words, before = [], 0
    if chance.random() < 0.5:
        shutil.copy(lake, tmp_path)
        words, before = ["lake.ora"], len(strokes(documents.opened(lake).session()))
    app = Program(display, tmp_path, *words)
    if words:
        app.wait_for("painting 1 shown")
    hand = killed(app, chance)
    log = app.log.read_text(errors="replace").rpartition("\n")[0]
    posted = log.count(POSTED)
    sweep_unfinished()
    assert not list(tmp_path.glob(".*.part"))
    for picture in tmp_path.glob("*.png"):
        with Image.open(picture) as opened:
            opened.load()
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
    told = f"kill {number}: {posted} finished, {kept - before} there,{doing(log)}"
    if session is not None:
        again = replay(session.recording())
        for level in (0, 1):
            assert np.array_equal(shown(session, level), shown(again, level)), f"level {level} is another picture"
        lost = in_hand(log, session, kept, before)
        if lost:
            told += f", {(hand.killed[0] - lost[0][1]) * 1000:.0f} ms short"
            assert lost[-1][0] - lost[0][1] <= IN_HAND
        if hand.down and kept == before + posted + 1 and strokes(session)[-1].extra.get("time"):
            last = strokes(session)[-1]
            told += f", {(hand.moved - last.extra['time'] - last.points[-1, 5]) * 1000:.0f} ms behind the pointer"
    print(told, flush=True)
    if "INKFALL_KILLS_TOLD" in os.environ:
        with Path(os.environ["INKFALL_KILLS_TOLD"]).open("a") as file:
            file.write(told + "\n")
    app.do("mouseup", 1)
