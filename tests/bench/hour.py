"""Random painting in the real window for an hour, on a display of its own: `python -m bench.hour --minutes 60 --budget
1024`.

Prints one JSON object every 30 s: resident memory, what the program says it holds, and how long the window takes to
answer a ping; at the end what all of it comes to.
"""

from __future__ import annotations

import argparse
import json
import os
import queue
import signal
import subprocess
import sys
import tempfile
import threading
import time
from collections.abc import Iterator
from contextlib import suppress
from itertools import pairwise
from pathlib import Path
from statistics import mean
from typing import Any

from bench.display import display, python
from bench.pinging import Pinger
from engine.keeping.memory import PROGRAM, VARIABLE

EVERY = 0.25  # seconds from ping to ping
PATIENCE = 180.0  # seconds to the first answer: kernels may be compiled
PAUSE = 90.0  # seconds that it may take to end, its painting written
MEGABYTE = 1 << 20
BOUND = 100.0  # milliseconds of a ping, 95th percentile
STEADY = 1.05  # resident memory in the last quarter to that in the third, at most
KINDS = ("RssAnon", "RssFile", "RssShmem")


def main(minutes: float, budget: int | None, seed: int) -> Iterator[dict[str, Any]]:
    with tempfile.TemporaryDirectory() as folder, display() as environment:
        homes = {f"XDG_{kind}_HOME": f"{folder}/{kind.lower()}" for kind in ("CONFIG", "DATA", "STATE")}
        environment |= homes | ({} if budget is None else {VARIABLE: str(budget)})
        told: queue.Queue[dict[str, Any]] = queue.Queue()
        words = python("-X", "faulthandler", "-m", "bench.random_window", str(60 * minutes), str(seed), folder)
        program = subprocess.Popen(words, env=environment, stdout=subprocess.PIPE, text=True, cwd=folder)
        try:
            threading.Thread(target=_read, args=(program, told), daemon=True).start()
            first = told.get(timeout=PATIENCE)
            yield first
            yield from _watched(program, Pinger(environment["DISPLAY"], _window(environment)), told, first["budget"])
        finally:
            program.send_signal(signal.SIGKILL)
            program.wait()


def _watched(
    program: subprocess.Popen[str], pinger: Pinger, told: queue.Queue[dict[str, Any]], budget: int
) -> Iterator[dict[str, Any]]:
    """Pings the window until it has ended, and passes on what it tells."""
    began = time.monotonic()
    pings: list[float] = []
    every: list[float] = []
    rows: list[dict[str, Any]] = []
    closing = False
    while program.poll() is None and not closing:
        time.sleep(EVERY)
        took = 1000 * pinger.ping()
        while not told.empty():
            row = told.get()
            closing = closing or "closing" in row
            if "records" in row:
                row |= {"seconds": round(time.monotonic() - began, 1), **_resident(program.pid), **percentiles(pings)}
                row |= {"load": os.getloadavg()[0]}
                rows.append(row)
                pings = []
            yield row
        if not closing:
            pings.append(took)
            every.append(took)
    with suppress(subprocess.TimeoutExpired):
        program.wait(PAUSE)
    while not told.empty():
        yield told.get()
    yield verdict(rows, every, budget) | {"status": program.returncode}


def verdict(rows: list[dict[str, Any]], pings: list[float], budget: int) -> dict[str, Any]:
    """What `rows`, of which the program has told, and pings come to: whether it kept within a budget of MB and the
    program's own, grew no more in the second half of the time, and answered in time."""
    totals = [row["resident"] for row in rows] or [0.0]
    bounds = [len(totals) * quarter // 4 for quarter in range(5)]
    quarters = [mean(totals[at:end] or totals[-1:]) for at, end in pairwise(bounds)]
    most = budget + PROGRAM // MEGABYTE
    told: dict[str, Any] = {"most": max(totals), "allowed": most, "above": sum(total > most for total in totals)}
    told |= {"quarters": [round(total, 1) for total in quarters], **percentiles(pings)}
    small, steady = told["most"] <= most, quarters[3] <= STEADY * quarters[2]
    return told | {"small": small, "steady": steady, "answers": told["ping 95 %"] <= BOUND}


def percentiles(pings: list[float]) -> dict[str, float]:
    """What parts of the pings took at most, milliseconds."""
    ordered = sorted(pings) or [0.0]
    parts = {"ping 50 %": 0.5, "ping 95 %": 0.95, "ping 99 %": 0.99, "ping most": 1.0}
    return {name: round(ordered[int(part * (len(ordered) - 1))], 1) for name, part in parts.items()}


def _resident(pid: int) -> dict[str, float]:
    """MB of the process by kind, in all, and of the processes that it started."""
    own = _status(pid)
    children = Path(f"/proc/{pid}/task/{pid}/children").read_text().split()
    return {
        **own,
        "resident": round(sum(own.values()), 1),
        "children": round(sum(sum(_status(int(child)).values()) for child in children), 1),
    }


def _status(pid: int) -> dict[str, float]:
    try:
        lines = Path(f"/proc/{pid}/status").read_text().splitlines()
    except OSError:  # it has ended meanwhile
        return {}
    found = {line.partition(":")[0]: line.split()[1] for line in lines if line.startswith(KINDS)}
    return {kind: round(int(found[kind]) / 1024, 1) for kind in KINDS if kind in found}


def _window(environment: dict[str, str]) -> int:
    found = subprocess.run(
        ["xdotool", "search", "--sync", "--onlyvisible", "--class", "inkfall"],
        env=environment,
        capture_output=True,
        text=True,
        check=True,
        timeout=30,
    )
    return int(found.stdout.split()[0])


def _read(program: subprocess.Popen[str], told: queue.Queue[dict[str, Any]]) -> None:
    assert program.stdout is not None
    for line in program.stdout:
        told.put(json.loads(line))


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--minutes", type=float, default=60.0, help="how long it is painted")
    parser.add_argument("--budget", type=int, help="MB for paintings (default: the program's own)")
    parser.add_argument("--seed", type=int, default=5, help="of what is random")
    options = parser.parse_args()
    signal.signal(signal.SIGTERM, lambda number, frame: sys.exit(1))  # the window goes, too
    for row in main(options.minutes, options.budget, options.seed):
        print(json.dumps(row), flush=True)
