"""The engine's first start, with no kernel compiled: from its process to the first dab, and to the last brush."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import tempfile
from collections.abc import Iterator

from bench import Figure, Skipped
from bench.display import children, python

DAB, ALL = 4.0, 40.0  # seconds that they may take on two cores
BUSY = "while True: pass"
PROGRAM = """
import json, os, sys, time
began = time.perf_counter()
import numpy as np
from app.desk import presets
from engine.brush.settings import Brush
from engine.studio import requests as q, results
from engine.studio.worker import Worker
found = presets.load(presets.bundled_folder())[0]
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
            dab = time.perf_counter() - began
            worker.post(q.Finish())
        if isinstance(result, results.Prepared) and result.ready == result.of:
            brushes = time.perf_counter() - began
    time.sleep(0.005)
worker.close()
spent = os.times()
print(json.dumps([dab, brushes, spent.user + spent.system + spent.children_user + spent.children_system]))
"""


def measure(small: bool = False) -> Iterator[Figure | Skipped]:
    """Both, on a quiet machine and with one core busy; `small` leaves out the waiting for all brushes."""
    if small:
        yield Skipped("first dab on an empty cache", "takes a minute")
        return
    for busy in (False, True):
        dab, brushes, spent = first_start(busy)
        where = "on an empty cache" + ", one core busy" * busy
        yield Figure(f"first dab {where}", dab, "s", f"{DAB} s", dab / DAB, 1.0)
        note = f"{spent:.0f} s of the processors, on {os.cpu_count()} of them"
        yield Figure(f"all brushes ready {where}", brushes, "s", f"{ALL} s", brushes / ALL, 1.0, note=note)


def first_start(busy: bool) -> tuple[float, float, float]:
    """Seconds to the first dab and to the last brush, and those that the processors worked."""
    with tempfile.TemporaryDirectory() as folder:
        other = subprocess.Popen([sys.executable, "-c", BUSY]) if busy else None
        try:
            done = subprocess.run(
                python("-c", PROGRAM),
                env={**children(), "NUMBA_CACHE_DIR": folder},
                capture_output=True,
                text=True,
                check=True,
            )
        finally:
            if other is not None:
                other.kill()
                other.wait()
    dab, brushes, spent = json.loads(done.stdout)
    return dab, brushes, spent
