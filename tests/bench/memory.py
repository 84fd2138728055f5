"""What 1,000 strokes leave in memory: the history against MyPaint's tiles, the process against what it knows it holds.

MyPaint's undo keeps every 64 x 64 tile that a stroke touched, 8 bytes a pixel; ours keeps residuals of all levels.
"""

from __future__ import annotations

import json
import math
import subprocess
import sys
from collections.abc import Iterator

import numpy as np

from bench import Figure
from bench.display import children, python
from engine.brush.dabs import Stroker
from engine.brush.mask import StrokeMask
from engine.brush.settings import Brush
from engine.canvas.layers import layers
from engine.canvas.tile_cache import TileCache
from engine.keeping.memory import resident
from engine.painting.commands import Stroke
from engine.session.history import History
from engine.session.session import Session

STROKES = 1000
PAINTED, BUDGET = 600, 512  # strokes at random; MB
LEVELS, ZOOMED = 40, 600  # levels; MiB that may be resident after them
SIDE, PIXEL = 64, 8  # of MyPaint's tiles: pixels, bytes of a pixel
CACHE = 64 << 20  # bytes of evaluated tiles that the session may keep
BRUSH = Brush(radius=12.0, hardness=0.7, opacity=0.8, colour="#305070")


def measure(small: bool = False) -> Iterator[Figure]:
    count = 10 if small else STROKES
    done = subprocess.run(
        python("-m", "bench.memory", str(count)), capture_output=True, text=True, env=children(), check=True
    )
    told = json.loads(done.stdout)
    per_stroke = f"{told['history'] / count / 1024:.0f} KiB a stroke; painting {told['painting'] >> 20} MiB"
    name = f"history, {count:,} strokes"
    bound = f"MyPaint's tiles, {told['tiles'] >> 20} MiB"
    yield Figure(name, told["history"] / 2**20, "MiB", bound, told["history"] / told["tiles"], 2.0, note=per_stroke)
    known = told["history"] + told["painting"] + told["cache"]
    note = f"resident memory; history, painting and {told['cache'] >> 20} MiB of evaluated tiles are known"
    bound = f"the {known >> 20} MiB it knows of"
    yield Figure("growth of the process", told["grown"] / 2**20, "MiB", bound, told["grown"] / known, 1.25, note=note)
    if not small:
        yield random_painting(PAINTED)
        yield zoomed(LEVELS)


def random_painting(count: int) -> Figure:
    """Painting at random through the engine's side, within a small budget."""
    command = python("-m", "bench.random_painting", str(count))
    environment = children() | {"INKFALL_MEMORY": str(BUDGET)}
    done = subprocess.run(command, capture_output=True, text=True, env=environment, check=True)
    told = [json.loads(line) for line in done.stdout.splitlines()]
    most, last = max(row["resident"] for row in told), told[-1]
    held = ", ".join(f"{name} {last[name] >> 20}" for name in ("records", "history", "cache"))
    held += f", on disk {last['disk'] >> 20}; {last['of files'] >> 20} of the resident are of files"
    note = f"the most that was resident; at the end, MiB: {held}; {last['steps']} steps can be taken back"
    bound, name = f"a budget of {BUDGET} MB and 250", f"{count} random strokes"
    return Figure(name, most / 2**20, "MiB", bound, most / 2**20 / (BUDGET + 250), 1.0, note=note)


def zoomed(levels: int) -> Figure:
    """Going through levels of four layers with three inks, in the window's size."""
    command = python("-m", "bench.zoom_memory", str(levels))
    done = subprocess.run(command, capture_output=True, text=True, env=children(), check=True)
    told = [json.loads(line) for line in done.stdout.splitlines()]
    most, last = max(row["resident"] for row in told), told[-1]
    note = f"the most that was resident; at the end {last['resident'] >> 20}, of evaluated tiles {last['cache'] >> 20}"
    bound = f"{ZOOMED} MiB"
    return Figure(f"zoom through {levels} levels", most / 2**20, "MiB", bound, most / 2**20 / ZOOMED, 1.0, note=note)


def paint(count: int) -> dict[str, int]:
    """Paints `count` strokes over a picture of 2048 x 1536; the bytes that then are held, by what holds them."""
    session = Session(cache=TileCache(CACHE), history=History())  # without its usual limit of bytes
    session.do(_stroke(0))  # kernels and libraries are loaded
    before, tiles = resident(), 0
    for number in range(1, count + 1):
        stroke = _stroke(number)
        session.do(stroke)
        tiles += _tiles_touched(stroke) * SIDE * SIDE * PIXEL
    painting = sum(layer.pyramid.nbytes for layer in layers(session.painting.root))
    return {
        "grown": max(0, resident() - before),
        "history": session.history.held,
        "painting": painting,
        "cache": session.cache.held,
        "tiles": tiles,
    }


def _stroke(number: int) -> Stroke:
    """A curl of some 300 px, its place and size from its number."""
    t = np.linspace(0.0, 1.0, 60)
    x = 100 + 617 * number % 1850 + (40 + number % 50) * np.sin(math.tau * t + number)
    y = 100 + 331 * number % 1340 + (30 + number % 70) * np.cos(1.5 * math.tau * t)
    points = np.zeros((len(t), 6))
    points[:, 0], points[:, 1], points[:, 2] = x.round(2), y.round(2), 0.4 + 0.6 * t
    return Stroke(0, (0, 0), points, BRUSH)


def _tiles_touched(stroke: Stroke) -> int:
    """How many tiles of MyPaint's size its coverage meets."""
    mask = StrokeMask(stroke.level, stroke.origin)
    mask.paint(Stroker(stroke.brush).add(stroke.points))
    count = 0
    for covered in mask.coverage().tiles.values():
        if not isinstance(covered, np.ndarray):
            count += 4 if covered else 0
        else:
            count += int(covered.reshape(2, SIDE, 2, SIDE).any(axis=(1, 3)).sum())
    return count


if __name__ == "__main__":
    print(json.dumps(paint(int(sys.argv[1]))))
