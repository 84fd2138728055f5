"""Small examples and what is painted with them, for the tests of paintings."""

from __future__ import annotations

import numpy as np
import platformdirs
import pytest
from PIL import Image

from engine.canvas.composite import composite
from engine.canvas.reading import layer_planes
from engine.canvas.tile_cache import TileCache
from engine.numeric.address import Rect
from engine.painting import commands as c
from engine.painting.grown import settled
from engine.session.apply import Painting
from engine.session.session import Session

FRAME = Rect.at(0, 0, 96, 80)
PLACES = ((-2, Rect.at(-4, -4, 40, 36)), (0, Rect.at(-16, -16, 144, 120)), (1, Rect.at(20, 20, 128, 96)))


def blob(kind: int, side: int = 40) -> np.ndarray:
    """Spots or stripes with a pale rim: uint8 RGBA (side, side, 4)."""
    random = np.random.default_rng(kind)
    y, x = np.mgrid[:side, :side] - (side - 1) / 2.0
    depth = side * 0.46 - np.hypot(x, y)
    dark = (x + kind * y) % 7 < 3
    colours = np.where(dark[..., None], (30, 60 + 40 * kind, 90), (200, 120, 40 * kind)).astype(float)
    colours += random.integers(-20, 21, (side, side, 1))
    colours = np.where((depth < 3)[..., None], 245, colours)
    pixels = np.dstack([colours, np.clip(120 + 60 * depth, 0, 255)]) * (depth > 0)[..., None]
    return np.clip(pixels, 0, 255).astype(np.uint8)


@pytest.fixture(scope="module")
def meadow(tmp_path_factory):
    """A folder with the examples a.png and b.png; analyses go to one of the tests' own."""
    folder = tmp_path_factory.mktemp("meadow")
    for kind, name in enumerate("ab", 1):
        Image.fromarray(blob(kind)).save(folder / f"{name}.png")
    before = platformdirs.user_cache_path
    platformdirs.user_cache_path = lambda name: folder / "cache" / name
    yield folder
    platformdirs.user_cache_path = before


def texture(name, path=None, **members):
    return c.parse({"do": "texture", "name": name, "maker": "example", "path": path or f"{name}.png", **members})


def stroke(points, level=0, seed=None, layer=None, **brush):
    rest = {name: value for name, value in (("seed", seed), ("layer", layer)) if value is not None}
    given = {"radius": 9, "dynamics": {}, "mode": "example", "example": "a", **brush}
    if given["mode"] != "example":
        given.pop("example")
    return c.parse({"do": "stroke", "level": level, "points": points, "brush": given, **rest})


def fresh(folder, **options) -> Session:
    """A session that has the examples "a" and "b"."""
    session = Session(Painting(FRAME, 7), TileCache(32 << 20), folder=folder, **options)
    session.do(texture("a"))
    session.do(texture("b"))
    return session


def pixels(painting, count=1, places=PLACES):
    """What the painting looks like, grown to the end, at several levels."""
    root = settled(painting, count).root
    return [composite(root, level, rect, layer_planes).copy() for level, rect in places]


def alike(one, other) -> bool:
    return all(np.array_equal(a, b) for a, b in zip(one, other, strict=True))
