"""Edits made of plain arrays, textures with exact answers, and random strokes, for the tests of the canvas."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from engine.brush.stamp import Stamp
from engine.numeric.address import TILE, Rect
from engine.texture.planes import plane_map

COUNT = 65536.0


@dataclass(frozen=True)
class Grain:
    """White noise by place at every level below its base: an instance that any rectangle can be asked of."""

    base: int
    seed: int

    @property
    def key(self):
        return ("grain", self.base, self.seed)

    def appearance(self, level, rect):
        xs = ((np.arange(rect.width) + rect.x0 % 65521) % 65521).astype(np.uint64)[None, :]
        ys = ((np.arange(rect.height) + rect.y0 % 65521) % 65521).astype(np.uint64)[:, None]
        h = (xs * np.uint64(2654435761) ^ ys * np.uint64(40503) ^ np.uint64(self.seed * 7919 + level + 64)) * np.uint64(
            0x9E3779B97F4A7C15
        )
        return ((h >> np.uint64(40)).astype(np.float64) / 2**24 - 0.5).astype(np.float32)[None]

    def bandpass(self, level, rect):
        if level <= self.base:
            return None
        return self.appearance(level, rect)


@dataclass(frozen=True, eq=False)
class ArrayEdit:
    """v' = A v + B on one rectangle; A (h, w), B (4 + 3n, h, w) on the grid."""

    level: int
    x: int
    y: int
    keep: np.ndarray
    add: np.ndarray
    inks: tuple = ()
    spares_alpha: bool = False

    @property
    def rect(self):
        return Rect.at(self.x, self.y, self.keep.shape[1], self.keep.shape[0])

    @cached_property
    def tiles(self):
        return list(self.rect.tiles(self.level))

    def stamp(self, key, old):
        part = key.rect.intersect(self.rect)
        keep = np.ones((TILE, TILE), np.float32)
        add = np.zeros((self.add.shape[0], TILE, TILE), np.float32)
        keep[part.slices(key.rect)] = self.keep[part.slices(self.rect)]
        rows, columns = part.slices(key.rect)
        add[:, rows, columns] = self.add[:, *part.slices(self.rect)]
        return Stamp(keep, add, self.inks)


def solid(width, height, colour, alpha=1.0):
    """(A, B) of a flat colour, 0..1 a component, over a rectangle."""
    a = np.rint(alpha * COUNT) / COUNT
    add = np.empty((4, height, width), np.float32)
    for c, value in enumerate((*colour, 1.0)):
        add[c] = np.rint(a * value * COUNT) / COUNT
    return np.full((height, width), 1 - a, np.float32), add


def fill(level, x, y, width, height, colour=(0.6, 0.2, 0.4), alpha=1.0):
    return ArrayEdit(level, x, y, *solid(width, height, colour, alpha))


def random_stroke(rng, finest, half0, inks):
    """(level, x, y, A, B with a plane triple for every one of `inks`): hard, soft, textured, erasing or faint."""
    m = int(rng.integers(0, finest + 1))
    reach = int(half0 * 0.6 * 2**m)
    width, height = (int(rng.integers(1, max(2, min(40, reach)))) for _ in "xy")
    x, y = (int(rng.integers(-reach, max(reach - n, -reach) + 1)) for n in (width, height))
    kind = rng.choice(["hard", "soft", "textured", "erase", "faint"])
    ys, xs = np.mgrid[0:height, 0:width]
    r = np.hypot((xs + 0.5 - width / 2) / (width / 2), (ys + 0.5 - height / 2) / (height / 2))
    shapes = {
        "hard": np.ones((height, width)),
        "soft": np.clip(1.3 * (1 - r * r), 0, 1),
        "faint": 0.02 * np.clip(1 - r, 0, 1),
    }
    alpha = shapes.get(str(kind), np.clip(1 - r * r, 0, 1) * rng.uniform(0.3, 1))
    alpha = np.rint(alpha * COUNT) / COUNT
    add = np.zeros((4 + 3 * len(inks), height, width))
    if kind != "erase":
        for c, value in enumerate((*rng.random(3), 1.0)):
            add[c] = np.rint(alpha * value * COUNT) / COUNT
    usable = [i for i, ink in enumerate(inks) if ink.base <= m]
    if kind in ("textured", "hard") and usable:
        i = int(rng.choice(usable))
        for c in range(3):
            add[4 + 3 * i + c] = np.rint(alpha * rng.uniform(0, 0.3) * COUNT) / COUNT
    return m, x, y, (1 - alpha).astype(np.float32), add.astype(np.float32)


def as_raster_op(rng, keep, add):
    """A stroke's (A, B) with the same coverage w as those of a raster-op of slope up to +-2: A = 1 + w f', B small."""
    w = 1 - keep
    gain = float(rng.choice([-2.0, -1.0, 0.25, 0.5]))
    keep = np.rint((1 + w * gain) * COUNT) / COUNT
    add = np.rint(add * 0.2 * COUNT) / COUNT
    add[3:] = 0
    return keep.astype(np.float32), add.astype(np.float32)


def spread_planes(planes, inks):
    """The data of `Planes` as a stack with exactly `inks`, in that order."""
    out = np.zeros((4 + 3 * len(inks), *planes.data.shape[1:]), np.float32)
    for c, source in enumerate(plane_map(planes.inks, tuple(inks))):
        if source >= 0:
            out[c] = planes.data[source]
    return out
