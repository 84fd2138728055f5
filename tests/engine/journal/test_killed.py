"""`kill -9` of a process that paints: no stroke whose pen was lifted is lost, and its commands give the same pixels."""

import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest
from headless import strokes

from engine.journal import entries
from engine.painting import commands as c
from engine.painting.recording import Header, Recording
from engine.painting.rendering import strips
from engine.session.replay import replay
from engine.studio.filing.recovering import recovered

HERE = Path(__file__).parent


def pixels(painting):
    """What is seen of a painting."""
    rows = strips(painting.root, 0, painting.frame)
    return np.concatenate([rows_.copy() for rows_ in rows], axis=1)


def killed(folder, seed, after, *more):
    """How often the pen was up, and how many commands were asked for, when it was killed."""
    process = subprocess.Popen(
        [sys.executable, HERE / "headless.py", folder, str(seed), *more], stdout=subprocess.PIPE, cwd=HERE.parents[2]
    )
    told = process.stdout.readline()
    time.sleep(after)
    process.send_signal(signal.SIGKILL)
    lines = (told + process.stdout.read()).decode().split("\n")
    process.wait()
    process.stdout.close()
    ups = [int(line[3:]) for line in lines[:-1] if line.startswith("up ")]
    return max(ups, default=0), sum(line.startswith("ask ") for line in lines[:-1])


def commands_of(seed, ups):
    """What was posted, as commands, until the pen was up so often."""
    out = []
    for n, (brush, points, more) in enumerate(strokes(seed), 1):
        if n > ups:
            return out
        out.append(("stroke", brush, len(points)))
        if more is not None:
            out.append(("ask", more, 0))
    return out


def check(folder, seed, ups, asked):
    """How many commands were recovered; all that were told are among them, with the pixels that they give."""
    (entry,) = [entry for entry in entries.listed(folder) if not entry.in_bin]
    assert not entry.alive
    found = recovered(entry.folder)
    drawn = [command for command in found.session.log if isinstance(command, c.Stroke)]
    assert len(drawn) >= ups, (len(drawn), ups)
    posted = [row for row in commands_of(seed, ups) if row[0] == "stroke"]
    for command, (_, brush, count) in zip(drawn, posted, strict=False):
        assert (command.brush, len(command.points)) == (brush, count)
    layers = [row[1] for row in commands_of(seed, ups) if isinstance(row[1], c.AddLayer)]
    told = [command.name for command in found.session.log if isinstance(command, c.AddLayer)]
    assert told[: len(layers) - 1] == [command.name for command in layers][: len(layers) - 1]
    played = replay(Recording(Header(), tuple(found.session.log))).painting
    assert np.array_equal(pixels(played), pixels(found.session.painting))
    return len(found.session.log)


def forked(folder, count, seed, longest):
    """Has so many painters killed; how often the pen was lifted in all.  No stroke of them is lost."""
    folder.mkdir()
    words = [sys.executable, HERE / "forks.py", folder, str(count), str(seed), str(longest)]
    subprocess.run(words, check=True, cwd=HERE.parents[2])
    strokes_seen = 0
    for k in range(count):
        lines = (folder / f"p{k}.log").read_text().split("\n")[:-1]
        ups = max((int(line[3:]) for line in lines if line.startswith("up ")), default=0)
        check(folder / f"p{k}", k, ups, sum(line.startswith("ask ") for line in lines))
        strokes_seen += ups
    return strokes_seen


def test_no_stroke_is_lost_at_thirty_moments(tmp_path):
    assert forked(tmp_path / "p", 30, 12, 0.6) > 100


@pytest.mark.nightly
@pytest.mark.timeout(7200)
def test_no_stroke_is_lost_at_five_hundred_moments(tmp_path):
    """While the engine begins, paints, saves and writes checkpoints."""
    assert forked(tmp_path / "p", 500, 13, 2.5) > 5000


def test_no_stroke_is_lost_while_the_engine_loads(tmp_path):
    ups, asked = killed(tmp_path / "p", 0, 0.4, tmp_path / "saved.ora", "at once")
    check(tmp_path / "p", 0, ups, asked)
