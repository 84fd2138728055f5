"""What is held of coarser levels while many rectangles are evaluated: the same values, within bounds."""

import weakref

import numpy as np
import pytest

from engine.archive import saving
from engine.archive.saving import Snapshot, save
from engine.canvas.evaluate import evaluate
from engine.canvas.layers import layers
from engine.numeric.address import Rect
from engine.painting import cascade
from engine.painting.cascade import Cascade
from engine.painting.commands import parse
from engine.painting.rendering import folded_layers
from engine.session.apply import Painting, apply

INKS = 12


def painted(inks, side, name="Layer 1"):
    """A layer's strokes across a square, each with a rock of its own."""
    ends = [[0, 0], [side, side]], [[0, side], [side, 0]]
    for number in range(inks):
        ink = [{"texture": "rock", "amount": 0.5, "period": 30 + number}]
        brush = {"radius": 30, "colour": "#806040", "ink": ink}
        yield {"do": "stroke", "points": ends[number % 2], "brush": brush, "layer": name}


def made(*commands, side):
    painting = Painting(Rect(0, 0, side, side), 3)
    for command in commands:
        painting = apply(painting, parse(command))
    return painting


def held(values):
    return [planes for _, planes in values._held.values() if planes is not None]


@pytest.mark.parametrize("inks", [0, 3, INKS])
def test_many_inks_are_held_within_the_bound(inks, monkeypatch):
    monkeypatch.setattr(cascade, "SMALL", 1 << 14)
    stroke = {"do": "stroke", "points": [[0, 0], [240, 240]], "brush": {"radius": 30}}
    pyramid = next(layers(folded_layers(made(stroke, *painted(inks, 240), side=240).root))).pyramid
    rect = Rect(0, 0, 240, 240)
    values = Cascade(pyramid, {0: rect}, cascade.SMALL)
    for y in range(0, 240, 80):
        part = Rect(0, y, 240, y + 80)
        np.testing.assert_array_equal(values.at(0, part).rgba, evaluate(pyramid, 0, part).rgba)
    assert values.inked == (inks > 0)
    assert 0 < max(planes.data.size for planes in held(values)) <= cascade.SMALL * 16


def test_a_save_lets_go_of_each_layer_when_its_tiles_are_made(tmp_path, monkeypatch):
    names = [f"Layer {n}" for n in range(1, 13)]
    added = [{"do": "layer", "add": name} for name in names]
    strokes = [stroke for name in names for stroke in painted(1, 60, name)]
    made_values, alive = weakref.WeakSet(), []

    def noted(*arguments):
        values = Cascade(*arguments)
        made_values.add(values)
        return values

    monkeypatch.setattr(saving, "Cascade", noted)
    painting = made(*added, *strokes, side=60)
    save(
        tmp_path / "p.ora", Snapshot(painting), lambda part: alive.append(sum(1 for each in made_values if held(each)))
    )
    assert 0 < max(alive) <= 8 < len(names)  # those that are worked on or wait for their turn
