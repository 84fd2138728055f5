"""The first start, with no kernel compiled: from the process to the first dab, and to the last brush.

In the real window, where a stroke is begun as soon as its tools take one; without Xvfb or xdotool, in the engine alone.
"""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from threading import Timer

from bench import Figure, Skipped
from bench.display import available, children, display, python

DAB, ALL = 4.0, 40.0  # seconds that they may take on two cores
PATIENCE = 400.0  # seconds
POINTS = ((500, 590), (530, 600), (560, 620), (600, 630))  # of the stroke, pixels of the screen: below the start page
BUSY = "while True: pass"
PROGRAM = """
import json, os, sys, time
began = time.perf_counter()
import numpy as np
from app.desk import presets
from engine.brush.settings import Brush
from engine.studio import requests as q, results
from engine.studio.worker import Worker
found = presets.load_brushes(presets.bundled_folder())[0]
worker = Worker(lambda: None)
worker.post(q.Look(((0, 0, 0, -1),)))
worker.post(q.Begin(0, (0, 0), Brush()))
points = np.zeros((2, 6))
points[:, :2], points[:, 2] = [[20, 20], [90, 60]], 1.0
worker.post(q.Points(points))
told, dab, brushes = [], None, None
while dab is None or brushes is None:
    for result in worker.results():
        if isinstance(result, results.Ready):
            swatches = [q.Swatch(p.name, p.brush, (104, 44), textures=p.textures) for p in found]
            worker.post(q.Prepare(tuple(swatches)))
        if isinstance(result, results.Patch) and result.pixels.any() and dab is None:
            dab, worked = time.perf_counter() - began, time.process_time()
            worker.post(q.Finish())
        if isinstance(result, results.Prepared) and result.ready == result.of:
            brushes = time.perf_counter() - began
    time.sleep(0.005)
worker.close()
spent = os.times()
print(json.dumps([dab, worked, brushes, sum(spent[:4])]))
"""
Times = tuple[float, float, float, float]
# Seconds to the first dab, those that the program's own processor time took until then; seconds to the last brush, and
# the processor time of all processes until then.


def measure(small: bool = False) -> Iterator[Figure | Skipped]:
    """Both, on a quiet machine and with one core busy; `small` leaves out the waiting for all brushes."""
    if small:
        yield Skipped("first dab on an empty cache", "takes a minute")
        return
    shown = available() and shutil.which("xdotool") is not None
    for busy in (False, True):
        with tempfile.TemporaryDirectory() as folder, one_core_busy(busy):
            dab, worked, brushes, spent = in_window(Path(folder)) if shown else in_engine(Path(folder))
        where = "on an empty cache" + ", one core busy" * busy + ", without a window" * (not shown)
        note = f"{worked:.1f} s of a processor"
        yield Figure(f"first dab {where}", dab, "s", f"{DAB} s", dab / DAB, 1.0, note=note)
        note = f"{spent:.0f} s of the processors, on {os.cpu_count()} of them"
        yield Figure(f"all brushes ready {where}", brushes, "s", f"{ALL} s", brushes / ALL, 1.0, note=note)


@contextmanager
def one_core_busy(busy: bool) -> Iterator[None]:
    """Meanwhile another program computes, if `busy`."""
    other = subprocess.Popen([sys.executable, "-c", BUSY]) if busy else None
    try:
        yield
    finally:
        if other is not None:
            other.kill()
            other.wait()


def in_window(folder: Path) -> Times:
    """Those of the program, painted with by its pointer."""
    with display() as environment:
        homes = {f"XDG_{name}_HOME": str(folder / name) for name in ("CONFIG", "DATA", "STATE", "CACHE")}
        program = subprocess.Popen(
            python("-m", "app"),
            env={**environment, **homes, "NUMBA_CACHE_DIR": str(folder), "INKFALL_TRACE": "1"},
            stderr=subprocess.PIPE,
            text=True,
            start_new_session=True,
        )
        limit = Timer(PATIENCE, program.kill)
        limit.start()
        try:
            return _painted(program, environment)
        finally:
            limit.cancel()
            program.kill()
            program.wait()


def _painted(program: subprocess.Popen[str], environment: dict[str, str]) -> Times:
    moves = [word for x, y in POINTS for word in ("mousemove", str(x), str(y))]
    dab = worked = 0.0
    assert program.stderr is not None
    for line in program.stderr:
        event, _, told = line.partition(": ")
        if event == "engine ready":  # tools take no press before
            subprocess.run(["xdotool", *moves[:3], "mousedown", "1", *moves[3:]], env=environment, check=True)
        elif event == "first paint":
            dab, (worked, _) = _seconds(told), processors(program.pid)
            subprocess.run(["xdotool", "mouseup", "1"], env=environment, check=True)
        elif event == "all brushes ready":
            return dab, worked, _seconds(told), processors(program.pid)[1]
    raise OSError("the window has closed, or its brushes do not become ready")


def _seconds(told: str) -> float:
    """Those since the process began, of a line of the trace."""
    return float(told.split()[0]) / 1000.0


def processors(session: int) -> tuple[float, float]:
    """Processor seconds so far of a session's first process, and of all its processes; 0 where there is no /proc."""
    first = total = 0.0
    for path in Path("/proc").glob("[0-9]*/stat"):
        try:
            fields = path.read_text().rpartition(")")[2].split()
        except OSError:
            continue  # it has ended
        if int(fields[3]) == session:
            ticks = [int(ticks) / os.sysconf("SC_CLK_TCK") for ticks in fields[11:15]]
            total += sum(ticks)
            first = sum(ticks[:2]) if path.parent.name == str(session) else first
    return first, total


def in_engine(folder: Path) -> Times:
    """Those of the engine alone, on its thread."""
    environment = {**children(), "NUMBA_CACHE_DIR": str(folder)}
    done = subprocess.run(
        python("-c", PROGRAM), env=environment, capture_output=True, text=True, check=True, timeout=PATIENCE
    )
    dab, worked, brushes, spent = json.loads(done.stdout)
    return dab, worked, brushes, spent


if __name__ == "__main__":
    for figure in measure():
        print(figure)
