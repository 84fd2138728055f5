"""`kill -9` of a process that paints: no stroke whose pen was lifted is lost, and its commands give the same pixels."""

import random
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


@pytest.mark.parametrize("seed", range(3))
def test_no_stroke_is_lost(tmp_path, seed):
    when = ("at once", "loaded", "loaded")[seed]
    ups, asked = killed(tmp_path / "p", seed, (0.4, 0.3, 1.5)[seed], tmp_path / "saved.ora", when)
    check(tmp_path / "p", seed, ups, asked)


@pytest.mark.nightly
@pytest.mark.timeout(7200)
def test_no_stroke_is_lost_at_any_of_many_moments(tmp_path):
    """At random moments while the engine loads, paints, saves and writes checkpoints."""
    told, strokes_seen = random.Random(13), 0
    for seed in range(250):
        when = told.choice(("at once", "loaded", "loaded"))
        ups, asked = killed(tmp_path / f"p{seed}", seed, told.uniform(0.02, 3.0), tmp_path / "saved.ora", when)
        check(tmp_path / f"p{seed}", seed, ups, asked)
        strokes_seen += ups
    assert strokes_seen > 5000
