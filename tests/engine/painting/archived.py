"""A painting with every kind of thing in it, for tests that save it, and paintings compared."""

import numpy as np
from PIL import Image

from engine.canvas import layers
from engine.canvas.evaluate import evaluate
from engine.canvas.tile_cache import TileCache
from engine.numeric.address import Rect
from engine.painting import commands as c
from engine.session.apply import Painting
from engine.session.session import Session

FRAME = Rect.at(-40, 10, 300, 200)
LEVELS = (-7, -3, 0, 1, 4, 60)


def stroke(x, y, level=0, **more):
    brush = {"radius": 30, "colour": "#c04020", "hardness": 0.5, **more}
    return {"do": "stroke", "level": level, "origin": [x, y], "points": [[0, 0], [40, 25, 0.7]], "brush": brush}


def session_of_all(folder):
    """A painting with every kind of thing in it, one of them a picture in a folder."""
    y, x = np.mgrid[0:24, 0:40]
    pixels = np.stack([x * 6, y * 10, x * 3 + y, 255 - x * 2], axis=-1).astype(np.uint8)
    Image.fromarray(pixels).save(folder / "leaf.png")
    session = Session(Painting(FRAME, 11), TileCache(64 << 20), folder=folder)
    rock = [{"texture": "rock", "amount": 0.7, "colour": "#ffffff", "period": 24}]
    deep = 60 << 60
    for command in (
        stroke(0, 60),
        {"do": "layer", "add": "ink & <stone> “ü”"},
        stroke(60, 80, ink=rock),
        {"do": "texture", "name": "leaf", "maker": "image", "path": "leaf.png"},
        {"do": "texture", "name": "fine", "maker": "stripes", "period": 6, "angle": 30},
        {"do": "layer", "add": "Group", "kind": "group", "group": None},
        {"do": "layer", "add": "inside", "group": "Group"},
        stroke(
            120, 100, ink=[{"texture": "leaf", "amount": 1, "period": 20}, {"texture": "fine", "colour": "#00ff00"}]
        ),
        {"do": "layer", "set": "Group", "opacity": 0.6, "blend": "multiply"},
        {"do": "layer", "add": "hidden", "group": None},
        stroke(20, 20, colour="#0000ff"),
        {"do": "layer", "set": "hidden", "visible": False, "locked": True},
        {"do": "layer", "add": "deep", "group": None},
        stroke(10, 10, level=-4, radius=9),
        stroke(deep, -deep, level=60, ink=rock),
        stroke(30, 40, level=3, mode="erase", radius=100),
        {"do": "layer", "add": "empty", "group": "Group"},
        {"do": "layer", "set": "inside", "alpha_locked": True, "blend": "screen", "opacity": 0.123456789},
        {"do": "layer", "select": "inside"},
        stroke(-4, 6, level=-5, radius=3),
    ):
        session.do(c.parse(command))
    return session


def places(painting):
    for level in LEVELS:
        frame = painting.frame.zoomed(level)
        yield level, Rect.at(frame.x0, frame.y0, min(frame.width, 200), min(frame.height, 150))
    yield 60, Rect.at(60 << 60, -(60 << 60), 90, 70)
    yield 62, Rect.at(60 << 62, -(60 << 62), 90, 70)


def assert_same(one, other):
    """Equal in every property, pixel and ink."""

    def facts(painting):
        return [
            (type(n), n.id, n.name, n.opacity, n.visible, n.blend, n.locked, getattr(n, "alpha_locked", n))
            if isinstance(n, layers.Layer)
            else (type(n), n.id, n.name, n.opacity, n.visible, n.blend, n.locked, n.isolated)
            for n in layers.walk(painting.root)
        ]

    assert facts(one) == facts(other)
    assert (one.frame, one.seed, one.active) == (other.frame, other.seed, other.active)
    assert {k: (t.kind, t.parameters) for k, t in one.textures.items()} == {
        k: (t.kind, t.parameters) for k, t in other.textures.items()
    }
    for a, b in zip(layers.layers(one.root), layers.layers(other.root), strict=True):
        for level, rect in places(one):
            p, q = evaluate(a.pyramid, level, rect), evaluate(b.pyramid, level, rect)
            assert p.inks == q.inks
            assert np.array_equal(p.data, q.data), (a.name, level)
