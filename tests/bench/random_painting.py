"""Random painting through the engine's side, as a window would ask for it, and what holds memory meanwhile:
`python -m bench.random_painting STROKES`.

Prints one JSON object a line: after every 50 strokes, bytes by what holds them.
"""

from __future__ import annotations

import json
import math
import os
import sys
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from app.canvas.view import View, place_of_pixel
from engine.brush.settings import Brush
from engine.canvas.layers import layers
from engine.keeping.memory import resident
from engine.keeping.spill import spill
from engine.painting import commands as c
from engine.studio import requests as q
from engine.studio.studio import Studio

WIDTH, HEIGHT = 1280, 800
TELL = 50  # strokes
INK = [{"texture": "rock", "amount": 0.6, "colour": "#d0b090", "period": 64}]


def main(count: int) -> Iterator[dict[str, int]]:
    rng = np.random.default_rng(5)
    studio = Studio(lambda result: None, lambda request: None)
    for name in ("Middle", "Top"):
        studio.do(q.Do(c.AddLayer(name)))
    level = 0
    for number in range(count + 1):
        if number % TELL == 0 or number == count:
            yield _held(studio, number)
        if number == count:
            break
        if rng.random() < 0.15:
            level = min(6, max(-3, level + int(rng.integers(-1, 2))))
        place = place_of_pixel(0, *rng.integers(200, 1500, 2).tolist())
        view = View(place, level, 0.0, WIDTH, HEIGHT)
        _look(studio, view)
        seen = view.visible(level)
        studio.do(q.Begin(level, (seen.x0, seen.y0), _brush(rng)))
        studio.do(q.Points(_points(rng)))
        studio.do(q.Finish())
        if rng.random() < 0.1:
            studio.do(q.Do(c.Undo(1)))
        while studio.step():
            pass
    studio.close()


def _look(studio: Studio, view: View) -> None:
    seen = view.visible(view.shown_level)
    side = q.SCREEN_TILE
    columns, rows = (range(a // side - 1, (b - 1) // side + 2) for a, b in ((seen.x0, seen.x1), (seen.y0, seen.y1)))
    studio.look(q.Look(tuple((view.shown_level, x, y, -1) for y in rows for x in columns)))
    while studio.step():
        pass


def _brush(rng: np.random.Generator) -> Brush:
    told = {
        "radius": float(rng.choice([1.5, 3.0, 6.0, 9.0, 9.0, 30.0, 80.0])),
        "hardness": 0.6,
        "colour": "#" + "".join(f"{v:02x}" for v in rng.integers(0, 256, 3)),
        "ink": INK if rng.random() < 0.3 else [],
    }
    command = c.parse({"do": "stroke", "points": [[0, 0]], "brush": told})
    assert isinstance(command, c.Stroke)
    return command.brush


def _points(rng: np.random.Generator) -> np.ndarray:
    t = np.linspace(0.0, 1.0, 40)
    points = np.zeros((40, 6))
    points[:, 0] = rng.uniform(100, 1180) + rng.uniform(30, 250) * np.sin(math.tau * t + rng.uniform(0, 6))
    points[:, 1] = rng.uniform(100, 700) + rng.uniform(30, 250) * np.cos(1.5 * math.tau * t)
    points[:, 2] = 0.4 + 0.6 * t
    return points


def _held(studio: Studio, number: int) -> dict[str, int]:
    session = studio.easel.session
    return {
        "strokes": number,
        "resident": resident(),
        "of files": of_files(),
        "disk": spill().held,
        "history": session.history.held,
        "cache": session.cache.held,
        "records": sum(layer.pyramid.nbytes for layer in layers(session.painting.root)),
        "steps": session.history.undo_count,
    }


def of_files() -> int:
    """Returns how many of the resident bytes are pages of files, which others share; 0 where the system does not
    tell."""
    try:
        return int(Path("/proc/self/statm").read_text("ascii").split()[2]) * os.sysconf("SC_PAGE_SIZE")
    except (OSError, ValueError, AttributeError):
        return 0


if __name__ == "__main__":
    for row in main(int(sys.argv[1])):
        print(json.dumps(row), flush=True)
