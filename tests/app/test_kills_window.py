"""The real window, killed at random moments while it is painted in, while an example grows, while it saves and while it
exports: nothing that was finished is lost.

INKFALL_KILLS: how many times each; INKFALL_KILLS_SEED: of what is random; `-s` shows the figures of each, which also go
to the file INKFALL_KILLS_TOLD.  "Short": how long before the kill the first point was posted that is not there; "behind
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
from driven import PATIENCE, Program
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
KILLS = int(os.environ.get("INKFALL_KILLS", "20"))
SEED = int(os.environ.get("INKFALL_KILLS_SEED", "1"))
DOINGS = {  # what is steered to, and how many seconds after it began the program is killed, at most
    "painting": 4.0,
    "growing": 1.0,
    "saving": 0.15,
    "exporting": 0.15,
}
LOOK = 0.002  # seconds from one look at what the program tells to the next
GROWS = "something grows"
POSTED, DROPPED = "a stroke is posted", "a stroke is dropped"
IN_HAND = 0.05  # seconds of the stroke in hand that may be lost
EXAMPLES = Path(__file__).parents[2] / "palettes/examples"
OWN = "wash-indigo", "felt"  # bundled examples that the artist has as “My wash” and “My felt”


class Hand:
    """Paints, undoes, saves and exports at random, until the window is gone; mostly what is to be met."""

    def __init__(self, app: Program, chance: random.Random, meets: str) -> None:
        self._app, self._chance, self._meets = app, chance, meets
        self.moved = 0.0  # when the pointer was last moved with its button down, seconds since 1970
        self.down = False
        self.killed = 0.0, 0.0  # when, by the monotonic clock and since 1970

    def work(self) -> None:
        while self._app.process.poll() is None:
            what = self._chance.random()
            if what < 0.5 or self._meets == "growing":
                self._stroke()
            if what < 0.1:
                self._app.keys("ctrl+z")
            elif what < 0.2 or (self._meets == "saving" and what < 0.8):
                self._app.keys("ctrl+s", "Return")
            elif what < 0.25 or (self._meets == "exporting" and what < 0.8):
                self._app.keys("ctrl+e", "Return", "Return", "Return")  # and once more where it was exported before

    def _stroke(self) -> None:
        points = [(self._chance.randint(300, 940), self._chance.randint(80, 380)) for _ in range(4)]
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


def killed(app: Program, chance: random.Random, meets: str) -> Hand:
    """Kills the program at a random moment once it does what is to be met; the hand that painted in it."""
    hand = Hand(app, chance, meets)
    after, end = chance.uniform(0.0 if meets != "painting" else 0.05, DOINGS[meets]), time.monotonic() + 20

    def kill() -> None:
        while doing(told(app)) != meets and time.monotonic() < end and meets != "painting":
            time.sleep(LOOK)
        time.sleep(after)
        hand.killed = time.monotonic(), time.time()
        app.process.kill()

    beside = threading.Thread(target=kill)
    beside.start()
    hand.work()
    beside.join()
    app.process.wait(90)
    return hand


def told(app: Program) -> str:
    """What the program has told, in whole lines."""
    return app.log.read_text(errors="replace").rpartition("\n")[0]


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
    session.do(c.parse({"do": "texture", "name": "bread", "maker": "example", "path": str(EXAMPLES / "bread.png")}))
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
    """What goes on in the background at the end of what is told."""
    writes = [line for line in log.splitlines() if " files are being written" in line][-1:]
    if any("its own" in line for line in writes):
        return "saving"
    if any(line[:2] not in ("0 ", "") for line in writes):
        return "exporting"
    return "growing" if log.rfind(GROWS) > log.rfind("all has grown") else "painting"


@pytest.fixture
def own_examples(tmp_path):
    """The artist's own examples, which are first in the list."""
    folder = tmp_path / "data" / "inkfall" / "examples"
    folder.mkdir(parents=True)
    for bundled in OWN:
        for ending in (".png", ".mask.png", ".toml"):
            shutil.copy(EXAMPLES / f"{bundled}{ending}", folder / f"my-{bundled}{ending}")


def take_example(app: Program, chance: random.Random) -> None:
    """Paints with one of the artist's own examples from now on."""
    app.do("mousemove", 640, 300)
    app.keys("p")
    app.wait_for("examples ready")  # which they are made once they are in sight
    end = time.monotonic() + PATIENCE
    while GROWS not in told(app):  # a click before the panel is at rest is of no effect
        assert time.monotonic() < end, told(app)[-2000:]
        app.click(f"My {chance.choice(OWN).replace('-', ' ')}")
        app.stroke((420, 150), (560, 240), (700, 160))
        time.sleep(1.0)


@pytest.mark.parametrize("number", range(KILLS))
@pytest.mark.parametrize("meets", DOINGS)
@pytest.mark.usefixtures("own_examples")
def test_a_kill_loses_nothing_that_was_finished(display, tmp_path, lake, meets, number, monkeypatch):
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "state"))
    chance = random.Random(f"{SEED} {meets} {number}")
    words, before = [], 0
    if chance.random() < 0.5:
        shutil.copy(lake, tmp_path)
        words, before = ["lake.ora"], len(strokes(documents.opened(lake).session()))
    app = Program(display, tmp_path, *words)
    if words:
        app.wait_for("painting 1 shown")
    if meets == "growing":
        take_example(app, chance)
    hand = killed(app, chance, meets)
    log = told(app)
    posted = log.count(POSTED)
    sweep_unfinished()
    assert not list(tmp_path.glob(".*.part"))
    for picture in tmp_path.glob("*.png"):
        with Image.open(picture) as opened:
            opened.load()
    file = tmp_path / (words[0] if words else "untitled.ora")
    whole = documents.opened(file) if file.exists() else None
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
    line = f"{meets} {number}: {posted} finished, {kept - before} there, {doing(log)}"
    if session is not None:
        again = replay(session.recording())
        for level in (0, 1):
            assert np.array_equal(shown(session, level), shown(again, level)), f"level {level} is another picture"
        lost = in_hand(log, session, kept, before)
        if lost:
            line += f", {(hand.killed[0] - lost[0][1]) * 1000:.0f} ms short"
            assert lost[-1][0] - lost[0][1] <= IN_HAND
        if hand.down and kept == before + posted + 1 and strokes(session)[-1].extra.get("time"):
            last = strokes(session)[-1]
            line += f", {(hand.moved - last.extra['time'] - last.points[-1, 5]) * 1000:.0f} ms behind the pointer"
    print(line, flush=True)
    if "INKFALL_KILLS_TOLD" in os.environ:
        with Path(os.environ["INKFALL_KILLS_TOLD"]).open("a") as file:
            file.write(line + "\n")
    app.do("mouseup", 1)
