"""A process that has loaded the program, and forks off it whatever starts of `python -m MODULE WORDS` it is asked for.

Each line of standard input is JSON, each has a line for an answer: {"start": MODULE, "words", "cwd", "log",
"environment", "paths"} is answered by a process's number, {"poll": NUMBER} by its exit status, null while it runs.  It
has no thread, no window and no display of its own.  The child leaves the loop and becomes the program, to its end.
"""

from __future__ import annotations

import gc
import json
import os
import runpy
import sys
import threading
from typing import Any


def load() -> None:
    """Imports what the program imports by and by, and loads the commonest kernels."""
    import app.loop
    import app.window
    from engine.brush.settings import Brush
    from engine.studio.preparing import exercise, processes, waiting

    assert app.window, processes and waiting
    exercise.draw_once(Brush(radius=6.0))


def serve() -> dict[str, Any] | None:
    """Answers until nobody asks any more: None then, and in a child what it is to become."""
    for line in sys.stdin:
        asked = json.loads(line)
        if "start" in asked:
            child = os.fork()
            if child == 0:
                return dict(asked)
            tell(child)
        else:
            found, status = os.waitpid(asked["poll"], os.WNOHANG)
            tell(os.waitstatus_to_exitcode(status) if found else None)
    return None


def tell(answer: int | None) -> None:
    """Writes a line to whoever asked."""
    os.write(1, f"{json.dumps(answer)}\n".encode())


def become(asked: dict[str, Any]) -> None:
    """Makes of this process what `python -m` would have begun with, and runs it."""
    null = os.open(os.devnull, os.O_RDONLY)
    log = os.open(asked["log"], os.O_WRONLY | os.O_APPEND | os.O_CREAT, 0o600)
    for old, new in ((null, 0), (log, 1), (log, 2)):
        os.dup2(old, new)
    os.close(null)
    os.close(log)
    os.environ.clear()
    os.environ.update(asked["environment"])
    os.chdir(asked["cwd"])
    sys.path[:1] = [asked["cwd"], *asked["paths"]]
    sys.argv[1:] = asked["words"]
    runpy.run_module(asked["start"], run_name="__main__", alter_sys=True)


if __name__ == "__main__":
    load()
    assert len(os.listdir("/proc/self/task")) == threading.active_count() == 1, (
        "a process with threads cannot be forked"
    )
    gc.collect()
    gc.freeze()  # what all share stays shared: no child looks through it, in the end neither
    wanted = serve()
    if wanted is not None:
        become(wanted)
