"""A 1920 x 1080 view evaluated from its parent level, against a copy of the bytes that it reads and writes."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from bench import Figure
from bench.clock import best, copying
from engine.canvas.evaluate import evaluate, step
from engine.canvas.layers import layers
from engine.canvas.store import Pyramid
from engine.numeric.address import Rect
from engine.painting.commands import parse
from engine.session.apply import Painting, apply
from engine.texture.planes import Planes

VIEW = Rect.at(64, 64, 1920, 1080)
SMALL = Rect.at(64, 64, 128, 64)
STRIP = 120  # rows at a time, as tiles of the screen are some 256
REPEATS = 15
ROCK = {"texture": "rock", "amount": 0.5, "colour": "#d0b090", "period": 64}
STRIPES = {"texture": "stripes", "amount": 0.3, "colour": "#80c040", "period": 24}
SQUARES = {"texture": "squares", "amount": 0.3, "colour": "#4060c0", "period": 40}
TURNED = [
    {"texture": "stripes", "amount": 0.3, "colour": "#80c040", "period": 24, "angle": 33},
    {"texture": "sawtooth", "amount": 0.3, "colour": "#c04060", "period": 30, "angle": 70},
    {"texture": "squares", "amount": 0.3, "colour": "#4060c0", "period": 40, "angle": 12},
]
ROCKS = [{**ROCK, "seed": seed, "period": 48 + 16 * seed} for seed in range(3)]
CASES: tuple[tuple[str, list[dict[str, Any]], float], ...] = (
    ("view, rock, stripes, squares", [ROCK, STRIPES, SQUARES], 8.0),
    ("view, three turned waves", TURNED, 8.0),
    ("view, three rocks", ROCKS, 8.0),
    ("view, colour alone", [], 4.0),
)


def measure(small: bool = False) -> Iterator[Figure]:
    for name, inks, limit in CASES:
        yield _figure(name, inks, limit, small)


def _figure(name: str, inks: list[dict[str, Any]], limit: float, small: bool) -> Figure:
    view = SMALL if small else VIEW
    pyramid = _painted(inks)
    above = Rect((view.x0 >> 1) - 1, (view.y0 >> 1) - 1, (view.x1 >> 1) + 1, (view.y1 >> 1) + 1).evened()
    parent = evaluate(pyramid, 0, above)
    moved = parent.data.nbytes + parent.data.shape[0] * view.area * 4
    own, copy = best(1 if small else REPEATS, lambda: evaluated(pyramid, parent, above, view), copying(moved))
    return Figure(name, own * 1e3, "ms", f"a copy of its {moved >> 20} MiB", own / copy, limit)


def evaluated(pyramid: Pyramid, parent: Planes, above: Rect, view: Rect) -> int:
    """The view, strip by strip; the number of its planes."""
    planes = 0
    for y in range(view.y0, view.y1, STRIP):
        shown = step(pyramid, parent, above, 1, Rect(view.x0, y, view.x1, min(y + STRIP, view.y1)))
        assert shown is not None
        planes = len(shown.data)
    return planes


def _painted(inks: list[dict[str, Any]]) -> Pyramid:
    """A layer covered with ink at level 0."""
    brush = {"radius": 400, "hardness": 1, "colour": "#604020", "ink": inks, "spacing": 0.5}
    stroke = parse({"do": "stroke", "points": [[0, 300], [1100, 300]], "brush": brush})
    painting = apply(Painting(), stroke)
    return next(iter(layers(painting.root))).pyramid
