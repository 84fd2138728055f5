"""Saving and opening four layers of 4000 x 4000, and a sheet of ten, against MyPaint: on the very file, where it is
installed; what is painted also on the coarse grid.

Times are the processor's.  Opening includes the picture that a window shows first; most is put off until it is looked
at.  MyPaint's own times are of its core without its window, one thread, and without such a picture.  Where it is
missing, figures of another run stand in, as much longer as copying takes now; and for the size of its file, that of the
pictures in ours, which are what it saves.
"""

from __future__ import annotations

import json
import subprocess
import sys
import tempfile
import zipfile
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np

from bench import Figure
from bench.clock import processor, slowness
from bench.display import children, python
from engine.archive.imports import pasted
from engine.archive.opening import open_painting
from engine.archive.saving import Snapshot, save
from engine.canvas.layers import EMPTY, Layer, layers
from engine.canvas.store import Pyramid
from engine.keeping.memory import resident
from engine.numeric.address import Rect
from engine.numeric.arithmetic import COARSE, FINE
from engine.painting.commands import parse
from engine.painting.rendering import strips
from engine.session.apply import Painting, apply
from engine.texture.table import instance

SIDE = 4000
LAYERS = 4
REPEATS = 2
TIMES_FASTER = {"photographs": 4.0, "strokes": 3.0, "strokes with rock": 3.0}
TIMES_LARGER = {"photographs": 1.0, "strokes": 3.0, "strokes with rock": 3.0}
TIMES_LARGER_COARSELY = 2.0
COARSE_SHEET = 60e6  # bytes that a file of the sheet may have on the coarse grid
WINDOW = 1080  # pixels
# Seconds, and bytes where they are not those of our pictures, of another run on these very paintings; those of strokes
# without ink are as much less as with others.
MYPAINT = {
    "photographs": {"save": 7.2, "open": 3.6, "bytes": 98.9e6},
    "strokes": {"save": 2.9, "open": 1.5},
    "strokes with rock": {"save": 3.47, "open": 1.9, "bytes": 42.4e6},
}
BROAD = ((300, 12), (120, 30), (40, 80), (15, 150))  # radius and number of the strokes of each layer
SHEET = 2480, 3508  # pixels of A4 at 300 dots an inch
SHEET_LAYERS, SHEET_STROKES, SHEET_RADIUS = 10, 712, 60
SHEET_MEMORY = 426 << 20  # bytes that MyPaint takes with such a sheet open; of another run
PYTHON = Path("/usr/bin/python3")  # the one that Debian's MyPaint belongs to
MYPAINT_FOLDER = Path("/usr/lib/mypaint")
SCRIPT = """
import json, os, sys, time
sys.path.insert(0, sys.argv[1])
from lib.document import Document
document = Document(painting_only=True)
start = time.process_time()
document.load(sys.argv[2])
opened = time.process_time()
document.save(sys.argv[3])
print(json.dumps({"open": opened - start, "save": time.process_time() - opened, "bytes": os.path.getsize(sys.argv[3])}))
document.cleanup()
"""


def measure(small: bool = False) -> Iterator[Figure]:
    side = 200 if small else SIDE
    yield from _case("photographs", photographs(side), side, small)
    yield from _case("strokes", strokes(side, ink=False), side, small)
    yield from _case("strokes with rock", strokes(side), side, small)
    yield from _coarse_case("strokes", strokes(side, False, COARSE))
    yield from _coarse_case("strokes with rock", strokes(side, True, COARSE))
    yield from _sheet(20 if small else SHEET_STROKES)


def _case(name: str, painting: Painting, side: int, small: bool) -> Iterator[Figure]:
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "own.ora"
        repeats = 1 if small else REPEATS
        own = {
            "save": min(processor(lambda: save(file, Snapshot(painting))) for _ in range(repeats)),
            "open": min(processor(lambda: _seen(file, side)) for _ in range(repeats)),
            "bytes": file.stat().st_size,
        }
        theirs, note = _mypaint(name, file, Path(folder) / "theirs.ora")
    for what in ("save", "open"):
        bound = f"MyPaint's {theirs[what]:.2f} s"
        faster = theirs[what] / own[what]
        yield Figure(f"{what} {LAYERS} layers, {name}", own[what], "s", bound, faster, TIMES_FASTER[name], True, note)
    bound = f"MyPaint's {theirs['bytes'] / 1e6:.1f} MB"
    size, larger = own["bytes"], own["bytes"] / theirs["bytes"]
    yield Figure(f"size, {name}", size / 1e6, "MB", bound, larger, TIMES_LARGER[name], note=note)


def _coarse_case(name: str, painting: Painting) -> Iterator[Figure]:
    """The size of a painting on the coarse grid."""
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "own.ora"
        save(file, Snapshot(painting))
        size, (theirs, note) = file.stat().st_size, _mypaint(name, file, Path(folder) / "theirs.ora")
    bound, larger = f"MyPaint's {theirs['bytes'] / 1e6:.1f} MB", size / theirs["bytes"]
    yield Figure(f"size, {name}, grid 12", size / 1e6, "MB", bound, larger, TIMES_LARGER_COARSELY, note=note)


def _seen(file: Path, side: int) -> Painting:
    """Opens a file and makes the picture of all of it that fits into a window."""
    painting, level = open_painting(file).painting, 0
    while side >> -level > WINDOW:
        level -= 1
    for _ in strips(painting.root, level, painting.frame.zoomed(level)):
        pass
    return painting


def _sheet(count: int) -> Iterator[Figure]:
    """A4 at 300 dots an inch, ten layers: the file, and what a process holds with it open."""
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "sheet.ora"
        save(file, Snapshot(sheet(count, COARSE)))
        coarse = file.stat().st_size
        save(file, Snapshot(sheet(count)))
        done = subprocess.run(
            python("-m", "bench.files", str(file)), capture_output=True, text=True, env=children(), check=True
        )
        held, size, pictures = int(done.stdout), file.stat().st_size, _pictures(file)
    name, bound = f"a sheet of {SHEET_LAYERS} layers", f"its pictures alone, {pictures / 1e6:.1f} MB"
    yield Figure(f"size, {name}", size / 1e6, "MB", bound, size / pictures, 3.0)
    bound = f"{COARSE_SHEET / 1e6:.0f} MB"
    yield Figure(f"size, {name}, grid 12", coarse / 1e6, "MB", bound, coarse / COARSE_SHEET, 1.0)
    bound, note = f"MyPaint's {SHEET_MEMORY / 1e6:.0f} MB", "resident memory; MyPaint's of another run"
    yield Figure(f"memory, {name} open", held / 1e6, "MB", bound, held / SHEET_MEMORY, 1.4, note=note)


def _pictures(file: Path) -> int:
    """Counts the bytes of the pictures of a file that any program opens: what it holds of it."""
    with zipfile.ZipFile(file) as archive:
        return sum(member.file_size for member in archive.infolist() if not member.filename.startswith("inkfall/"))


def _mypaint(name: str, file: Path, out: Path) -> tuple[dict[str, float], str]:
    """What MyPaint needs to open our file and to save it anew."""
    if PYTHON.exists() and MYPAINT_FOLDER.exists():
        command = [str(PYTHON), "-c", SCRIPT, str(MYPAINT_FOLDER), str(file), str(out)]
        done = subprocess.run(command, capture_output=True, text=True, timeout=600)
        if done.returncode == 0:
            return json.loads(done.stdout.splitlines()[-1]), "MyPaint measured in the same run, on the same file"
    slow = slowness()
    scaled = {what: found if what == "bytes" else found * slow for what, found in MYPAINT[name].items()}
    return {"bytes": _pictures(file), **scaled}, f"its figures of another run, as copying takes {slow:.2f} x as long"


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


def strokes(side: int, ink: bool = True, grid: int = FINE) -> Painting:
    """Four layers of strokes, as one paints: broad ones below, of rock where there is ink, finer ones above, much left
    empty on top."""
    rock = [{"texture": "rock", "amount": 0.4, "colour": "#e0d0b0", "period": 200}]
    pyramids = []
    for number, (radius, count) in enumerate(BROAD):
        brush = {"radius": radius, "hardness": 0.5, "ink": rock if ink and number < 2 else []}
        pyramids.append(_painted((side, side), number, count if side == SIDE else 2, brush, grid))
    return _of(pyramids, side)


def sheet(count: int, grid: int = FINE) -> Painting:
    """Ten layers of so many strokes of several widths."""
    each, radii = -(-count // SHEET_LAYERS), SHEET_RADIUS * 0.75 ** np.arange(SHEET_LAYERS)
    found = [
        _painted(SHEET, number, each, {"radius": float(radius), "hardness": 0.7}, grid)
        for number, radius in enumerate(radii)
    ]
    return _of(found, *SHEET)


def _painted(size: tuple[int, int], seed: int, count: int, brush: dict, grid: int) -> Pyramid:
    """A layer of strokes at random."""
    rng, radius = np.random.default_rng(seed), brush["radius"]
    painting = Painting(Rect(0, 0, *size), grid=grid)
    for _ in range(count):
        at, way = rng.random(2) * size, np.cumsum(rng.normal(0, radius, (12, 2)), axis=0)
        own = {**brush, "colour": f"#{int(rng.integers(1 << 24)):06x}"}
        points = (at + way).clip(0, size).round(1).tolist()
        painting = apply(painting, parse({"do": "stroke", "points": points, "brush": own}))
    return next(layers(painting.root)).pyramid


def _of(pyramids: list, width: int, height: int | None = None) -> Painting:
    sheets = tuple(Layer(i + 1, f"Layer {i + 1}", pyramid=pyramid) for i, pyramid in enumerate(pyramids))
    frame = Rect(0, 0, width, height or width)
    return Painting(frame, root=replace(EMPTY, children=sheets), active=sheets[0].name, grid=sheets[0].pyramid.grid)


if __name__ == "__main__":
    held = _seen(Path(sys.argv[1]), max(SHEET))  # while memory is looked at
    print(resident())
