"""Painters without a window, forked off one process that has loaded the engine, each killed while it paints.

`python forks.py FOLDER COUNT SEED [LONGEST]`: painter K paints into FOLDER/pK, is killed at a random moment of its
first LONGEST seconds, and what it has told lies in FOLDER/pK.log.
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
from engine.studio.preparing import exercise, waiting


def main(folder: str, count: str, seed: str, longest: str = "0.7") -> None:
    exercise.draw_once(Brush(radius=6.0))  # loads the kernels
    assert waiting
    assert threading.active_count() == 1, "a process with threads cannot be forked"
    told = random.Random(int(seed))
    for k in range(int(count)):
        after, when = told.uniform(0.02, float(longest)), told.choice(("at once", "loaded"))
        log = Path(folder) / f"p{k}.log"
        child = os.fork()
        if child == 0:
            os.dup2(os.open(log, os.O_WRONLY | os.O_CREAT, 0o600), 1)
            headless.main(str(Path(folder) / f"p{k}"), str(k), str(Path(folder) / "saved.ora"), when)
        while not (log.exists() and log.stat().st_size):
            time.sleep(0.005)  # its first stroke is drawn
        time.sleep(after)
        os.kill(child, signal.SIGKILL)
        os.waitpid(child, 0)


if __name__ == "__main__":
    main(*sys.argv[1:])
