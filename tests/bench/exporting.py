"""A large picture exported: 4 painted layers, 16384 x 2048 of a level three finer than the strokes, as a PNG.

Against isal alone deflating the same rows, which is the least that writing them can take.  CPU time of all threads.
"""

from __future__ import annotations

import tempfile
from collections.abc import Iterator
from pathlib import Path

import numpy as np
from isal import isal_zlib

from bench import Figure
from bench.clock import processor
from engine.archive.export import Picture, export
from engine.brush.settings import Brush
from engine.files.png_writer import LEVEL
from engine.numeric.address import Rect
from engine.numeric.colour import to_rgba8
from engine.painting.commands import AddLayer
from engine.painting.rendering import folded_layers, strips
from engine.painting.value import Painting
from engine.session.session import Session

SIDE, STROKES, LAYERS = 2048, 40, 4  # px of level 0
FINER = 3
PICTURE = Rect.at(0, 1024 << FINER, SIDE << FINER, 2048)
REPEATS = 2
LIMIT = 25 / 10.7  # CPU seconds of 32768 x 32768 pixels


def measure(small: bool = False) -> Iterator[Figure]:
    area = Rect.at(0, 1024 << FINER, 256, 128) if small else PICTURE
    painting = painted()
    root = folded_layers(painting.root)
    rows = np.concatenate([to_rgba8(strip) for strip in strips(root, FINER, area)])
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "a.png"
        times = []
        for _ in range(1 if small else REPEATS):
            own = processor(lambda: export(path, Picture(painting, FINER, area)))
            times.append((own, processor(lambda: isal_zlib.compress(rows, LEVEL))))
    own, bound = (min(column) for column in zip(*times, strict=True))
    name = f"a PNG of {area.width} x {area.height}, {LAYERS} layers of strokes"
    yield Figure(name, own / area.area * 1e9, "ns/pixel", "isal on the same rows", own / bound, LIMIT)


def painted() -> Painting:
    """Strokes of many colours over 2048 x 2048, on four layers in turn."""
    session, rng = Session(), np.random.default_rng(4)
    names = [f"layer {n}" for n in range(LAYERS)]
    for name in names:
        session.do(AddLayer(name))
    for n in range(STROKES):
        brush = Brush(radius=float(rng.uniform(10, 90)), hardness=0.4, colour=f"#{int(rng.integers(1 << 24)):06x}")
        live = session.begin(0, (0, 0), brush, names[n % LAYERS])
        live.add(np.column_stack([rng.uniform(0, SIDE, (12, 2)), rng.uniform(0.3, 1.0, 12)]))
        session.finish(live)
    return session.painting
