"""After getting ready, painting with examples needs no kernel that is not there."""

import json
import os
import subprocess
import sys
from pathlib import Path

from engine.studio import requests as q
from engine.studio import results
from engine.studio.warming import Warming

ROOT = Path(__file__).parents[3]
# Of files: they are not read or written while the pen waits.
ELSEWHERE = (
    "engine.files.png_reader",
    "engine.archive.tilecode_kernels",
    "engine.numeric.colour",
    "engine.canvas.rising.span_values",
)
PROGRAM = """
import json, sys, time
from pathlib import Path
sys.path.insert(0, sys.argv[1])
import numpy as np
import platformdirs
from numba.core.dispatcher import Dispatcher
from PIL import Image
from plantings import blob, texture
from test_easel import Window
from engine.brush.settings import Brush
from engine.numeric.address import Rect
from engine.painting import commands as c
from engine.studio import requests as q, results

folder = Path(sys.argv[2])
platformdirs.user_cache_path = lambda name: folder / "cache" / name

def known():
    return {
        (f.py_func.__module__, f.py_func.__name__, str(signature))
        for module in list(sys.modules.values()) if module.__name__.startswith("engine.")
        for named in list(vars(module).values())
        for f in [getattr(named, "compiled", named)] if isinstance(f, Dispatcher)
        for signature in f.overloads
    }

def paint(window, brushes):
    studio, tiles = window.studio, tuple((level, x, 0) for level in (-2, -1, 0, 1, 2) for x in (-1, 0))
    for brush in brushes:
        studio.do(q.Begin(0, (0, 0), brush))
        for x in range(0, 160, 20):
            points = np.zeros((2, 6))
            points[:, 2] = 1.0
            points[:, :2] = (x, 40), (x + 10, 44)
            studio.do(q.Points(points))
            studio.step()
        studio.do(q.Finish())
        window.look(*tiles)
        window.work()
    studio.do(q.Do(c.Undo()))
    window.work()

window = Window()
paint(window, [Brush(radius=9.0), Brush(radius=9.0, mode="erase")])
for _ in range(2):
    window.studio.do(q.GetReady())
while not any(isinstance(r, results.GotReady) for r in window.other):
    time.sleep(0.05)
before = known()
for kind, name in enumerate("ab", 1):
    Image.fromarray(blob(kind, 90)).save(folder / f"{name}.png")
    window.studio.do(q.Do(texture(name, str(folder / f"{name}.png"))))
grows = Brush(radius=19.0, mode="example", hardness=1.0)
from dataclasses import replace
paint(window, [
    replace(grows, example="a"),
    replace(grows, example="b", depth=1.0),
    replace(grows, example="b", example_detail=1, radius=30.0),
    Brush(radius=5.0, mode="erase", depth=0.0),
    Brush(radius=3.0, mode="erase"),
])
window.studio.do(q.Do(c.Swap(0, (80, 60), "a")))
window.work()
told = [r.text for r in window.other if isinstance(r, results.Note)]
count = sum(isinstance(r, results.GotReady) for r in window.other)
print(json.dumps([sorted(known() - before), told, count]))
"""


def test_nothing_is_compiled_by_the_first_stroke(tmp_path):
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join((str(ROOT), str(ROOT / "tests")))}
    words = [sys.executable, "-c", PROGRAM, str(Path(__file__).parent), str(tmp_path)]
    done = subprocess.run(words, capture_output=True, text=True, env=environment, timeout=280, check=False)
    assert done.returncode == 0, done.stderr
    missing, told, count = json.loads(done.stdout.splitlines()[-1])
    assert not [kernel for kernel in missing if kernel[0] not in ELSEWHERE]
    assert not told
    assert count == 1


def test_a_program_that_ends_meanwhile_tells_no_fault(monkeypatch):
    sent = []
    monkeypatch.setattr("concurrent.futures.thread._shutdown", True)  # as when the interpreter ends
    warming = Warming(sent.append)
    warming.handlers[q.GetReady](q.GetReady())
    warming._thread.join(90.0)
    assert sent == [results.GotReady()]
