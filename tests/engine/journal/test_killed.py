"""`kill -9` of a process that paints: no stroke whose pen was lifted is lost, nor more than 50 ms of the one in hand;
its commands give the same pixels, and what it was writing is the old file or the new one."""

import collections
import random
import signal
import subprocess
import sys
import time
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest
from headless import EXAMPLE, EXPORTED, KINDS, OLD, SAVED, strokes
from PIL import Image

from engine.archive.opening import open_painting
from engine.journal import entries
from engine.keeping.unfinished import sweep_unfinished
from engine.painting import commands as c
from engine.painting.grown import settled
from engine.painting.recording import Header, Recording
from engine.painting.rendering import strips
from engine.session.replay import replay
from engine.studio.filing.recovering import recovered

HERE = Path(__file__).parent
IN_HAND = 0.05  # seconds of the stroke in hand that may be lost
WRITTEN = {"saved": SAVED, "exported": EXPORTED}  # by what a painter tells of them


def pixels(painting):
    """What is seen of a painting, grown to its end."""
    painting = settled(painting)
    rows = strips(painting.root, 0, painting.frame)
    return np.concatenate([rows_.copy() for rows_ in rows], axis=1)


@dataclass
class Told:
    """What a painter has told until it was killed: how often its pen was up, for how many commands it asked, the points
    of each stroke as (stroke, points, from when, to when), what it was at in the background, and all words that
    its lines began with."""

    ups: int
    asked: int
    points: list[tuple[int, int, float, float]]
    busy: str
    words: set[str]

    @classmethod
    def of(cls, text):
        lines = [line.split() for line in text.split("\n")[:-1]]
        words = collections.defaultdict(list)
        for line in lines:
            words[line[0] if line else ""].append(line[1:])
        ups, at = max((int(one) for (one,) in words["up"]), default=0), words["at"]
        points = [(int(stroke), int(count), float(began), float(ended)) for stroke, count, began, ended in at]
        busy = " ".join(words["now"][-1]) if words["now"] else ""
        return cls(ups, len(words["ask"]), points, busy, set(words))


def killed(folder, seed, after, *more):
    """What a painter had told when it was killed, some seconds after its journal was there."""
    process = subprocess.Popen(
        [sys.executable, HERE / "headless.py", folder, str(seed), *more], stdout=subprocess.PIPE, cwd=HERE.parents[2]
    )
    told = b""
    while not told.endswith(b"kept\n"):
        told += process.stdout.readline()
        assert process.poll() is None
    time.sleep(after)
    process.send_signal(signal.SIGKILL)
    lines = told + process.stdout.read()
    process.wait()
    process.stdout.close()
    return Told.of(lines.decode())


def commands_of(seed, ups, grows=False):
    """What was posted, as commands, until the pen was up so often."""
    out = []
    for n, (brush, points, more) in enumerate(strokes(seed, grows), 1):
        if n > ups:
            return out
        out.append(("stroke", brush, len(points)))
        if more is not None:
            out.append(("ask", more, 0))
    return out


def check(folder, seed, told, grows=False):
    """The commands that were recovered; all that were told are among them, with the pixels that they give."""
    (entry,) = [entry for entry in entries.listed(folder) if not entry.in_bin]
    assert not entry.alive
    found = recovered(entry.folder)
    ups, commands = told.ups, commands_of(seed, told.ups, grows)
    drawn = [command for command in found.session.log if isinstance(command, c.Stroke)]
    assert len(drawn) >= ups, (len(drawn), ups)
    posted = [row for row in commands if row[0] == "stroke"]
    for command, (_, brush, count) in zip(drawn, posted, strict=False):
        assert (command.brush, len(command.points)) == (brush, count)
    layers = [row[1].name for row in commands if isinstance(row[1], c.AddLayer)]
    names = [command.name for command in found.session.log if isinstance(command, c.AddLayer)]
    assert names[: len(layers) - 1] == layers[: len(layers) - 1]
    played = replay(Recording(Header(), tuple(found.session.log))).painting
    assert np.array_equal(pixels(played), pixels(found.session.painting))
    return tuple(found.session.log)


def waited(log, told):
    """When the first point was posted that is not there, and how long before the last, whatever else the processor had
    to do meanwhile: seconds by the monotonic clock; None if all are there."""
    drawn = [command for command in log if isinstance(command, c.Stroke)]
    missing = [
        ended
        for stroke, count, _, ended in told.points
        if stroke > told.ups and count > (len(drawn[stroke - 1].points) if len(drawn) >= stroke else 0)
    ]
    return (missing[0], told.points[-1][2] - missing[0]) if missing else None


def check_files(folder, log, told):
    """What was being written is what was there before, or the whole new file, and of this painting; nothing is left of
    what was not finished."""
    names = {path.name for path in folder.iterdir()}
    assert {SAVED, EXPORTED} <= names <= {SAVED, EXPORTED, EXAMPLE}
    new = {name for name in (SAVED, EXPORTED) if (folder / name).read_bytes() != OLD}
    assert new >= {name for word, name in WRITTEN.items() if word in told.words}
    if SAVED in new:
        opened = open_painting(folder / SAVED)
        commands = opened.recording.commands
        assert commands == log[: len(commands)]
        assert np.array_equal(pixels(replay(opened.recording).painting), pixels(opened.painting))
    if EXPORTED in new:
        with Image.open(folder / EXPORTED) as picture:
            assert picture.size == (1024, 768)
            picture.load()
    return len(new)


def forked(folder, count, seed, longest):
    """Has so many painters killed; how often the pen was lifted in all, and what they were at, a count each.  No stroke
    of them is lost."""
    folder.mkdir()
    words = [sys.executable, HERE / "forks.py", folder, str(count), str(seed), str(longest)]
    subprocess.run(words, check=True, cwd=HERE.parents[2])
    sweep_unfinished()
    strokes_seen, moments, late, short = 0, collections.Counter(), [0.0], []
    for k in range(count):
        text, _, when = (folder / f"p{k}.log").read_text().rpartition("\nkilled ")
        told = Told.of(text)
        log = check(folder / f"p{k}", k, told, KINDS[k % len(KINDS)] == "growing")
        check_files(folder / f"f{k}", log, told)
        if (lost := waited(log, told)) is not None:
            late.append(lost[1])
            short.append(float(when) - lost[0])
        strokes_seen += told.ups
        moments.update(told.busy.split() or ["painting"])
    print(strokes_seen, dict(moments), f"short: {sorted(round(1000 * one) for one in short)[-10:]} ms")
    assert max(late) <= IN_HAND, sorted(late)[-10:]
    return strokes_seen, moments


def test_no_stroke_is_lost_at_a_dozen_moments(tmp_path):
    """While the engine begins, paints, grows what is painted with an example, saves and exports."""
    seen, moments = forked(tmp_path / "p", 12, 12, 0.4)
    assert seen > 40
    assert set(moments) >= {"painting", "saving", "exporting"}


@pytest.mark.nightly
def test_no_stroke_is_lost_at_hundreds_of_moments(tmp_path):
    """Which with those of the window are five hundred."""
    seen, moments = forked(tmp_path / "p", 420, 13, 2.5)
    assert seen > 5000
    assert min(moments[kind] for kind in KINDS) > 40


@pytest.mark.nightly
@pytest.mark.parametrize("k", range(9))
def test_no_stroke_is_lost_where_the_folder_was_removed(tmp_path, k):
    """By another program, once or twice; the painter is killed when what is painted has been told anew."""
    told, kind, folder, log = random.Random(k), KINDS[k % len(KINDS)], tmp_path / "p", tmp_path / "log"
    (tmp_path / "f").mkdir()
    words = [sys.executable, HERE / "headless.py", folder, str(k), tmp_path / "f", "loaded", kind]
    with log.open("wb") as out:
        process = subprocess.Popen(words, stdout=out, cwd=HERE.parents[2])
        while b"up " not in log.read_bytes():
            time.sleep(0.05)
        for _ in range(told.choice((1, 2))):
            time.sleep(told.uniform(0.1, 1.2))
            subprocess.run(["rm", "-rf", folder], check=False)
        time.sleep(told.uniform(2.0, 4.0))
        process.send_signal(signal.SIGKILL)
        process.wait()
    check(folder, k, Told.of(log.read_text()), kind == "growing")


def test_no_stroke_is_lost_while_the_engine_loads(tmp_path):
    (tmp_path / "f").mkdir()
    check(tmp_path / "p", 0, killed(tmp_path / "p", 0, 0.4, tmp_path / "f", "at once"))
