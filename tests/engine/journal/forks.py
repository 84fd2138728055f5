"""Painters without a window, forked off one process that has loaded the engine, each killed while it paints.

`python forks.py FOLDER COUNT SEED [LONGEST]`: painter K paints into FOLDER/pK and saves and exports to FOLDER/fK; it is
killed at a random moment of its first LONGEST seconds, or of the first thereafter at which it does what its kind is
about.  What it has told lies in FOLDER/pK.log, and then "killed T", by the monotonic clock.
"""

from __future__ import annotations

import os
import random
import signal
import sys
import threading
import time
from pathlib import Path

import headless

from engine.brush.settings import Brush
from engine.studio import warming
from engine.studio.preparing import exercise, waiting

PATIENCE = 90.0  # seconds that one waits for what a painter is to do, at most
GROWS = 3.0  # likewise; what it has painted with an example may have grown by then
DURING = 0.03  # seconds that it may have been at it


def killed(child: int, log: Path, kind: str, told: random.Random, longest: float) -> None:
    """Kills a painter at a random moment."""
    after = told.uniform(0.02, longest)
    while not (log.exists() and b"kept\n" in (text := log.read_bytes()) and b"up " in text):
        time.sleep(0.005)  # its first stroke is drawn, and its journal is there
    time.sleep(after)
    end = time.monotonic() + (GROWS if kind == "growing" else PATIENCE)
    while kind not in ("painting", *at(log).split()) and time.monotonic() < end:
        time.sleep(0.001)
    time.sleep(told.uniform(0.0, DURING))
    when = time.monotonic()
    os.kill(child, signal.SIGKILL)
    os.waitpid(child, 0)
    with log.open("a") as file:
        file.write(f"\nkilled {when}\n")  # the line before may be torn


def at(log: Path) -> str:
    """What a painter has told last that it does in the background."""
    return log.read_text().rpartition("\nnow ")[2].partition("\n")[0] if "\nnow " in log.read_text() else ""


def main(folder: str, count: str, seed: str, longest: str = "0.7") -> None:
    exercise.draw_once(Brush(radius=6.0))  # loads the kernels
    warming.paint_once()
    assert waiting
    assert threading.active_count() == 1, "a process with threads cannot be forked"
    told = random.Random(int(seed))
    for k in range(int(count)):
        kind, when = headless.KINDS[k % len(headless.KINDS)], told.choice(("at once", "loaded"))
        log, files = Path(folder) / f"p{k}.log", Path(folder) / f"f{k}"
        files.mkdir()
        for name in (headless.SAVED, headless.EXPORTED):
            (files / name).write_bytes(headless.OLD)
        child = os.fork()
        if child == 0:
            os.dup2(os.open(log, os.O_WRONLY | os.O_CREAT | os.O_APPEND, 0o600), 1)
            headless.main(str(Path(folder) / f"p{k}"), str(k), str(files), when, kind)
        killed(child, log, kind, told, float(longest))


if __name__ == "__main__":
    main(*sys.argv[1:])
