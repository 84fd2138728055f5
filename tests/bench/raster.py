"""A soft, textured dab of each raster-op through to pixels, against memcpy of the bytes that it reads and writes."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import numpy as np

from bench import Figure
from bench.clock import best, copying
from engine.brush import edits
from engine.brush.covered import Scene
from engine.brush.dabs import Stroker
from engine.brush.mask import StrokeMask
from engine.brush.mixture import mixture
from engine.brush.ops import OPS
from engine.brush.settings import from_json
from engine.canvas import kernels
from engine.canvas.dither import NO_DITHER
from engine.numeric.address import TILE, Rect, TileKey
from engine.numeric.grid import FINE_STEP, snapped
from engine.texture.planes import Planes, plane_map

REPEATS = 9
WIDE = 250.0  # radius
EDGE = 6 * TILE  # of the picture it is painted on
FORMULA = "(colour - pic) * (0.5 + 0.5 * sin(x / 9 + 4 * luma))"
POINTWISE, AROUND, WRITTEN, FORETOLD = 12.0, 40.0, 120.0, 300.0  # how many copies one dab may take
LIMITS = {"smooth": AROUND, "sharpen": AROUND, "displace": AROUND, "gamma": AROUND, "predict": FORETOLD}


def measure(small: bool = False) -> Iterator[Figure]:
    repeats = 1 if small else REPEATS
    for name, row in OPS.items():
        given = {"layer": "x"} if name == "clone" else {}
        yield _dab(f"a dab of {row.label.lower()}", {"name": name} | given, repeats, LIMITS.get(name, POINTWISE))
    yield _dab("a dab of a formula", {"formula": FORMULA}, repeats, WRITTEN)


def _dab(name: str, op: dict[str, Any], repeats: int, limit: float) -> Figure:
    """Coverage, stamp and new pixels of the dab's tiles; the rock's own picture is already there, as after the first
    dab of a stroke."""
    shape = {"radius": WIDE, "hardness": 0.3, "colour": "#a06020"}
    brush = from_json({"mode": "raster", "op": op, "ink": [{"texture": "rock", "amount": 0.8}], **shape})
    ink = mixture(brush, {}, 0, 0)
    read = _reader(_picture())
    scene = Scene(read)
    olds: dict[TileKey, Planes] = {}
    new = np.ones((7, TILE, TILE), np.float32)
    marks = np.ones((TILE, TILE), np.uint8), np.ones((TILE, 2), np.int32)

    def own() -> None:
        mask = StrokeMask(0, (0, 0))
        mask.paint(Stroker(brush).add(np.array([[EDGE / 2, EDGE / 2, 0.7]])))
        edit = edits.edit(brush, mask, ink, False, read, scene=scene)
        for key in edit.tiles:
            old = olds.get(key)
            if old is None:
                data = np.concatenate([read(key.rect).data, np.full((3, TILE, TILE), 0.125, np.float32)])
                old = olds[key] = Planes(data, ink.inks)
            stamp = edit.stamp(key, old)
            if stamp is not None:
                planes = plane_map(stamp.inks, ink.inks)
                how = planes, stamp.plain, edit.spares_alpha, new, marks, FINE_STEP, NO_DITHER
                kernels.apply_stamp(old.data, stamp.keep, stamp.add, np.empty(0, np.float32), *how)

    own()
    moved = len(olds) * TILE * TILE * (2 * 4 + 2 * 7 * 4)  # coverage and seven planes, read and written
    taken, copy = best(repeats, own, copying(moved))
    return Figure(name, taken * 1e3, "ms", f"a copy of its {moved >> 20} MiB", taken / copy, limit)


def _picture() -> np.ndarray:
    """Opaque, smoothly coloured pixels: float32 (4, EDGE, EDGE)."""
    y, x = np.mgrid[0:EDGE, 0:EDGE] / EDGE
    return snapped(np.stack([x, y, 1.0 - 0.5 * (x + y), np.ones_like(x)]))


def _reader(picture: np.ndarray) -> Callable[[Rect], Planes]:
    margin = TILE  # more than any op looks around
    padded = np.pad(picture, ((0, 0), (margin, margin), (margin, margin)), mode="edge")

    def read(rect: Rect) -> Planes:
        return Planes(padded[:, rect.y0 + margin : rect.y1 + margin, rect.x0 + margin : rect.x1 + margin])

    return read
