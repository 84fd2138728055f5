"""Saving and opening four layers of 4000 x 4000, against MyPaint: on the very file, where it is installed.

Opening includes the picture that a window shows first; some is put off until it is looked at.  MyPaint's own times are
of its core without its window, one thread, and without such a picture.  Where it is missing, figures of another run
stand in, as much longer as copying takes now.
"""

from __future__ import annotations

import json
import subprocess
import tempfile
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np

from bench import Figure
from bench.clock import seconds, slowness
from engine.archive.imports import pasted
from engine.archive.opening import open_painting
from engine.archive.saving import Snapshot, save
from engine.canvas.layers import EMPTY, Layer, layers
from engine.numeric.address import Rect
from engine.painting.commands import parse
from engine.painting.rendering import strips
from engine.session.apply import Painting, apply
from engine.texture.table import instance

SIDE = 4000
LAYERS = 4
REPEATS = 2
TIMES_FASTER = 4.0
WINDOW = 1080  # pixels
MYPAINT = {"save": 5.4, "open": 3.1, "bytes": 83e6}  # four layers as the first case; of another run
PYTHON = Path("/usr/bin/python3")  # the one that Debian's MyPaint belongs to
MYPAINT_FOLDER = Path("/usr/lib/mypaint")
SCRIPT = """
import json, os, sys, time
sys.path.insert(0, sys.argv[1])
from lib.document import Document
document = Document(painting_only=True)
start = time.perf_counter()
document.load(sys.argv[2])
opened = time.perf_counter()
document.save(sys.argv[3])
print(json.dumps({"open": opened - start, "save": time.perf_counter() - opened, "bytes": os.path.getsize(sys.argv[3])}))
document.cleanup()
"""


def measure(small: bool = False) -> Iterator[Figure]:
    side = 200 if small else SIDE
    yield from _case("photographs", photographs(side), side, small)
    yield from _case("strokes", strokes(side), side, small)


def _case(name: str, painting: Painting, side: int, small: bool) -> Iterator[Figure]:
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "own.ora"
        repeats = 1 if small else REPEATS
        own = {
            "save": min(seconds(lambda: save(file, Snapshot(painting))) for _ in range(repeats)),
            "open": min(seconds(lambda: _seen(file, side)) for _ in range(repeats)),
            "bytes": file.stat().st_size,
        }
        theirs, note = _mypaint(file, Path(folder) / "theirs.ora")
    for what in ("save", "open"):
        bound = f"MyPaint's {theirs[what]:.2f} s"
        faster = theirs[what] / own[what]
        yield Figure(f"{what} {LAYERS} layers, {name}", own[what], "s", bound, faster, TIMES_FASTER, True, note)
    bound = f"MyPaint's {theirs['bytes'] / 1e6:.1f} MB"
    yield Figure(f"size, {name}", own["bytes"] / 1e6, "MB", bound, own["bytes"] / theirs["bytes"], 1.0, note=note)


def _seen(file: Path, side: int) -> None:
    """Opens a file and makes the picture of all of it that fits into a window."""
    painting, level = open_painting(file).painting, 0
    while side >> -level > WINDOW:
        level -= 1
    for _ in strips(painting.root, level, painting.frame.zoomed(level)):
        pass


def _mypaint(file: Path, out: Path) -> tuple[dict[str, float], str]:
    """What MyPaint needs to open our file and to save it anew."""
    if PYTHON.exists() and MYPAINT_FOLDER.exists():
        command = [str(PYTHON), "-c", SCRIPT, str(MYPAINT_FOLDER), str(file), str(out)]
        done = subprocess.run(command, capture_output=True, text=True, timeout=600)
        if done.returncode == 0:
            return json.loads(done.stdout.splitlines()[-1]), "MyPaint measured in the same run, on the same file"
    slow = slowness()
    scaled = {**MYPAINT, "save": MYPAINT["save"] * slow, "open": MYPAINT["open"] * slow}
    return scaled, f"its figures of another run, as copying takes {slow:.2f} x as long; another picture"


def photographs(side: int) -> Painting:
    """Four layers, each all over a picture with the grain of a photograph: some 20 MB as PNG."""
    return _of([pasted(_bands(side, seed), 0, 0) for seed in range(LAYERS)], side)


def _bands(side: int, seed: int) -> Iterator[np.ndarray]:
    """Rock in three colours with the noise of a sensor, uint8 RGBA, in bands of rows."""
    rng = np.random.default_rng(seed)
    rocks = [instance("rock", {"period": 900, "roughness": 0.9, "seed": 10 * seed + c}, 0, 0) for c in range(3)]
    for y in range(0, side, 500):
        rect = Rect(0, y, side, min(y + 500, side))
        out = np.full((rect.height, rect.width, 4), 255, np.uint8)
        for c, rock in enumerate(rocks):
            grain = rng.standard_normal((rect.height, rect.width), np.float32)
            out[..., c] = (128 + 90 * rock.appearance(0, rect)[0] + 0.6 * grain).clip(0, 255)
        yield out


def strokes(side: int) -> Painting:
    """Four layers of strokes, as one paints: broad ones of rock below, finer ones above, much left empty on top."""
    pyramids = []
    for number, (radius, count) in enumerate(((300, 12), (120, 30), (40, 80), (15, 150))):
        rng = np.random.default_rng(number)
        painting = Painting(Rect(0, 0, side, side))
        ink = [{"texture": "rock", "amount": 0.4, "colour": "#e0d0b0", "period": 200}] if number < 2 else []
        for _ in range(count if side == SIDE else 2):
            at, way = rng.random(2) * side, np.cumsum(rng.normal(0, radius, (12, 2)), axis=0)
            colour = f"#{int(rng.integers(1 << 24)):06x}"
            brush = {"radius": radius, "hardness": 0.5, "colour": colour, "ink": ink}
            points = (at + way).clip(0, side).round(1).tolist()
            painting = apply(painting, parse({"do": "stroke", "points": points, "brush": brush}))
        pyramids.append(next(layers(painting.root)).pyramid)
    return _of(pyramids, side)


def _of(pyramids: list, side: int) -> Painting:
    sheets = tuple(Layer(i + 1, f"Layer {i + 1}", pyramid=pyramid) for i, pyramid in enumerate(pyramids))
    return Painting(Rect(0, 0, side, side), root=replace(EMPTY, children=sheets), active=sheets[0].name)
