"""What it takes of memory to make paint of what was grown over many inks: `python -m bench.flattening [INKS]`.

A layer of 1800 x 1800 pixels with so many inks, each with a period of its own, is covered by regions of an example,
and these are made paint.  Prints one JSON object: MB that the process held before, and at most meanwhile, processor
seconds, and a sum over all that is stored then: the same whatever the pieces are.
"""

from __future__ import annotations

import hashlib
import json
import sys
import threading
import time
from dataclasses import replace
from typing import Any

import numpy as np

from bench.five_textures import exemplar
from engine.canvas import growth as growths
from engine.canvas.flatten import flattened
from engine.canvas.layers import Layer, layers
from engine.canvas.store import Pyramid
from engine.canvas.tile_cache import TileCache
from engine.keeping.memory import give_back, resident
from engine.numeric.address import Rect
from engine.painting import commands as c
from engine.session.session import Session

SIDE = 1800  # pixels that are covered with paint, and then with examples
NAMES = ("orange-peel", "bread")
CACHE = 256 << 20  # bytes
SAMPLE = 0.005  # seconds


def main(inks: int) -> dict[str, Any]:
    layer = grown(painted(inks))
    give_back()
    before, start, most, over = resident(), time.process_time(), [0], threading.Event()
    sampler = threading.Thread(target=_sample, args=(most, over), daemon=True)
    sampler.start()
    flat = flattened(layer, TileCache(CACHE))
    spent = time.process_time() - start
    over.set()
    sampler.join()
    told = {"inks": inks, "before": before >> 20, "most": most[0] >> 20, "grown": (most[0] - before) >> 20}
    return told | {"records": flat.pyramid.nbytes >> 20, "seconds": round(spent, 2), "sum": digest(flat.pyramid)}


def painted(inks: int) -> Layer:
    """The paint: broad strokes to and fro, each of an ink of its own."""
    session = Session()
    for number in range(inks):
        ink = [{"texture": "rock", "amount": 0.5, "colour": "#d0b090", "period": 60 + number}]
        y = SIDE * (number + 0.5) / inks
        told = {"radius": 260.0, "hardness": 0.6, "opacity": 0.7, "colour": "#506070", "ink": ink}
        session.do(c.parse({"do": "stroke", "points": [[0, y], [SIDE, y]], "brush": told}))
    return next(iter(layers(session.painting.root)))


def grown(layer: Layer) -> Layer:
    """The layer with two regions of examples over it, grown to the end."""
    growth: growths.Growth = ()
    for number, name in enumerate(NAMES):
        y, x = np.mgrid[:SIDE, :SIDE]
        mask = (x - SIDE // 2) ** 2 + (y - SIDE // 2) ** 2 < (SIDE * (0.5 - 0.1 * number)) ** 2
        example = exemplar(name, 96)
        growth = growths.laid(growth, float(number), 0, name, name, example, number, Rect.at(0, 0, SIDE, SIDE), mask)
    return replace(layer, growth=growths.settled(growth))


def digest(pyramid: Pyramid) -> str:
    """A sum over all records of a pyramid."""
    total = hashlib.sha256()
    for key, record in pyramid.all_records():
        total.update(repr((key, record.rect, [ink.key for ink in record.inks], record.data.dtype.str)).encode())
        total.update(record.data.tobytes())
    return total.hexdigest()[:16]


def _sample(most: list[int], over: threading.Event) -> None:
    while not over.wait(SAMPLE):
        most[0] = max(most[0], resident())


if __name__ == "__main__":
    print(json.dumps(main(int(sys.argv[1]) if len(sys.argv) > 1 else 20)))
