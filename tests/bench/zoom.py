"""A continuous zoom through 40 levels at 1280 x 800 over the demo: the engine's work by level, a window's frames."""

from __future__ import annotations

import json
import subprocess
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from app.canvas.screen import cells
from app.canvas.view import Place, View, place_of_pixel
from bench import Figure, Skipped
from bench.display import NEEDED, ROOT, available, display, python
from engine.archive.saving import Snapshot, save
from engine.painting.commands import parse
from engine.painting.recording import read
from engine.session.apply import Painting, apply
from engine.session.replay import replay
from engine.session.session import Session
from engine.studio.requests import Look
from engine.studio.results import Patch
from engine.studio.studio import Studio

LEVELS = 40
PACE = 4.0  # levels a second
WIDTH, HEIGHT = 1280, 800
SMOOTH = 0.016  # seconds of a frame
DEMO = ROOT / "palettes" / "demo"
INK = [
    {"texture": "rock", "amount": 0.7, "colour": "#d0b090", "period": 90},
    {"texture": "squares", "amount": 0.3, "colour": "#4060c0", "period": 40, "angle": 30},
]


def measure(small: bool = False) -> Iterator[Figure | Skipped]:
    painting, place = _simple() if small or not (DEMO / "demo.json").exists() else _demo()
    levels = 2 if small else LEVELS
    times = engine(painting, place, levels)
    name = f"zoom, the engine's {levels} levels"
    worst, mean = max(times), sum(times) / len(times)
    note = f"work of the slowest level from nothing; on average {mean * 1e3:.0f} ms"
    bound = f"the {1e3 / PACE:.0f} ms a level is shown at {PACE:.0f} levels a second"
    yield Figure(name, worst * 1e3, "ms", bound, worst * PACE, 1.0, note=note)
    if not available():
        yield Skipped("zoom, frames of the window", f"needs {NEEDED}")
        return
    told = window(painting, place, levels)
    late, count = told["late"], told["frames"]
    note = f"median {told['median'] * 1e3:.1f} ms, slowest {told['worst'] * 1e3:.0f} ms; the place reached was sharp "
    note += f"{told['sharp'] * 1e3:.0f} ms after the zoom; {told['renderer']}"
    name = f"zoom, frames over {SMOOTH * 1e3:.0f} ms"
    yield Figure(name, late, "frames", f"all {count} frames", late / count, 0.01, note=note)
    spent = told["spent"]
    if spent:
        note = "of the window's thread and the busiest of a software renderer, however long others held the processor"
        name = "zoom, processor time of a frame"
        yield Figure(name, spent * 1e3, "ms", f"{SMOOTH * 1e3:.0f} ms", spent / SMOOTH, 1.0, note=note)


def _demo() -> tuple[Painting, Place]:
    """The demo and the deepest place that it shows."""
    level, x, y, width, height = json.loads((DEMO / "demo.json").read_text())["zoom"][-1]
    session = replay(read(DEMO / "demo.jsonl"))
    return session.painting, place_of_pixel(level, x + width // 2, y + height // 2)


def _simple() -> tuple[Painting, Place]:
    brush = {"radius": 300, "colour": "#604020", "ink": INK}
    stroke = {"do": "stroke", "points": [[100, 300], [1200, 500]], "brush": brush}
    return apply(Painting(), parse(stroke)), place_of_pixel(0, 640, 400)


def engine(painting: Painting, place: Place, levels: int) -> list[float]:
    """Seconds that the worker's side takes for the tiles of each level on the screen, coming from the one before."""
    patches = 0

    def sent(result: object) -> None:
        nonlocal patches
        patches += isinstance(result, Patch)

    studio = Studio(sent, lambda request: None)  # no file is written
    studio.easel.show(Session(painting), None)
    times = []
    for level in range(levels + 1):
        wanted = tuple((*tile, -1) for tile in cells(View(place, level, 0.0, WIDTH, HEIGHT), level))
        patches = 0
        start = time.perf_counter()
        studio.look(Look(wanted))
        while studio.step():
            pass
        times.append(time.perf_counter() - start)
        assert patches == len(wanted)
    studio.close()
    return times[1:]


def window(painting: Painting, place: Place, levels: int) -> dict[str, Any]:
    """The same zoom in the real window on a display of its own; see `zooming`."""
    with tempfile.TemporaryDirectory() as folder, display() as environment:
        file = Path(folder) / "zoom.ora"
        save(file, Snapshot(painting))
        where = (str(v) for v in (place.x, place.y, place.exponent, levels, levels / PACE))
        done = subprocess.run(
            python("-m", "bench.zooming", str(file), *where),
            env={**environment, "XDG_CONFIG_HOME": folder},
            capture_output=True,
            text=True,
        )
    if done.returncode != 0:
        raise OSError(f"the window that zooms: {(done.stderr.strip().splitlines() or ['ended'])[-1]}")
    return json.loads(done.stdout.splitlines()[-1])
