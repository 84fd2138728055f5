"""A zoom through 40 levels at 1280 x 800, and what it leaves in memory: `python -m bench.zoom_memory LEVELS`.

Prints one JSON object a line, after each level: bytes resident, and bytes of evaluated tiles.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Iterator

from app.canvas.view import View, place_of_pixel
from bench.zoom import HEIGHT, INK, WIDTH
from engine.keeping.memory import resident
from engine.painting.commands import parse
from engine.studio.requests import SCREEN_TILE, Do, Look
from engine.studio.studio import Studio

LAYERS = 4


def main(levels: int) -> Iterator[dict[str, int]]:
    studio = Studio(lambda result: None, lambda request: None)
    for n in range(LAYERS):
        if n:
            studio.do(Do(parse({"do": "layer", "add": f"Layer {n + 1}"})))
        brush = {"radius": 300, "colour": "#604020", "ink": INK}
        studio.do(Do(parse({"do": "stroke", "points": [[100, 300 + n], [1200, 500 - n]], "brush": brush})))
    place = place_of_pixel(0, 640, 400)
    for level in range(levels + 1):
        seen = View(place, level, 0.0, WIDTH, HEIGHT).visible(level)
        columns, rows = (
            range(a // SCREEN_TILE, (b - 1) // SCREEN_TILE + 1) for a, b in ((seen.x0, seen.x1), (seen.y0, seen.y1))
        )
        studio.look(Look(tuple((level, x, y, -1) for y in rows for x in columns)))
        while studio.step():
            pass
        yield {"level": level, "resident": resident(), "cache": studio.easel.session.cache.held}
    studio.close()


if __name__ == "__main__":
    for row in main(int(sys.argv[1])):
        print(json.dumps(row), flush=True)
