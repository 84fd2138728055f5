"""Layers with what was painted on them with examples: what is written, compared, counted and told of them."""

from dataclasses import replace

import numpy as np
import pytest
from plantings import FRAME, meadow, stroke, texture  # noqa: F401

from app.cli.info import facts
from engine.archive import grounds
from engine.archive.imports import Opened
from engine.canvas import growth as growths
from engine.canvas import layers
from engine.canvas.composite import composite
from engine.canvas.evaluate import evaluate
from engine.canvas.reading import layer_planes
from engine.numeric.address import Rect
from engine.numeric.colour import to_rgba8
from engine.painting import commands as c
from engine.painting.difference import areas
from engine.painting.grown import settled
from engine.painting.rendering import folded_layers, reach, sheets, strips
from engine.session.apply import Around, Painting, apply
from engine.session.differing import difference
from engine.strokes.scenery import reader


@pytest.fixture(scope="module")
def states(meadow):  # noqa: F811
    """A painting before and after each of some commands, refined and not."""
    painting = Painting(FRAME, 3)
    found = [painting]
    told = (
        texture("a"),
        texture("b"),
        stroke([[20, 30], [60, 40]]),
        c.parse({"do": "layer", "add": "upper"}),
        stroke([[30, 20], [50, 60]], mode="paint", colour="#2060a0", hardness=0.4, layer="upper"),
        stroke([[40, 10], [45, 70]], example="b", layer="upper", depth=1),
        stroke([[60, 40], [64, 44]], level=1, mode="erase", radius=12, layer="upper"),
    )
    for command in told:
        painting = apply(painting, command, Around(folder=meadow))
        found += [painting, settled(painting)]
        painting = found[-1]
    return found


def picture(painting, level, rect):
    return composite(painting.root, level, rect, layer_planes)


@pytest.mark.parametrize("level", [-2, 0, 1, 3])
def test_outside_the_areas_nothing_changed(states, level):
    whole = Rect.at(-16, -16, 128, 112).zoomed(level)
    pictures = [picture(painting, level, whole) for painting in states]
    some = 0
    for n in range(1, len(states)):
        for m in {0, n - 1}:
            found = areas(states[m], states[n])(level)
            if found is None:  # layers were added
                continue
            left = (pictures[m] != pictures[n]).any(axis=0)
            some += left.any()
            for rect in found:
                left[rect.intersect(whole).slices(whole)] = False
            assert not left.any()
            assert areas(states[n], states[m])(level) is not None
    assert some > 3
    where = areas(states[-2], states[-1])
    assert where(level) is where(level)  # found but once, for all tiles on the screen


def test_strips_and_sheets_show_it(states):
    last = states[-1]
    upper = layers.find(last.root, "upper")
    assert upper.growth
    wanted = picture(last, 0, FRAME)
    strip = np.concatenate([part.copy() for part in strips(folded_layers(last.root), 0, FRAME)], axis=1)
    assert np.array_equal(strip, wanted)
    places = {layer.id: reach(layer, 0, FRAME) for layer in layers.layers(last.root)}
    for layer in layers.layers(last.root):
        shown = layer_planes(layer, 0, FRAME).any(axis=0)
        shown[places[layer.id].slices(FRAME)] = False
        assert not shown.any()
    own, merged = zip(*sheets(last.root, 0, FRAME, places), strict=True)
    assert np.array_equal(np.concatenate(merged), to_rgba8(wanted))
    rows = np.concatenate([known[upper.id] for known in own])
    assert np.array_equal(rows, to_rgba8(layer_planes(upper, 0, places[upper.id])))


def test_a_copied_layer_has_it_too(states):
    last = states[-1]
    twice = layers.duplicate(last.root, "upper", "again")
    assert layers.find(twice, "again").growth is layers.find(last.root, "upper").growth
    read = reader(last.root, "upper", 0, None)  # as a stroke that clones it does
    upper = layers.find(last.root, "upper")
    assert np.array_equal(read(FRAME).rgba, layer_planes(upper, 0, FRAME))
    assert not np.array_equal(read(FRAME).rgba, evaluate(upper.pyramid, 0, FRAME).rgba)


def test_a_picture_under_it_is_no_ground_any_more(states):
    pixels = np.full((80, 96, 4), 200, np.uint8)
    sheet = layers.Layer(1, "A", pyramid=grounds.lay_ground(pixels, 0, 0))
    assert grounds.whole(sheet, FRAME)
    growth = layers.find(states[-1].root, "upper").growth
    assert not grounds.whole(replace(sheet, growth=growth), FRAME)


def test_bytes_of_steps(states):
    root = states[-1].root
    assert difference(root, root) == (0, 0)
    fresh, grown = (painting.root for painting in states[5:7])  # the first stroke, before and after it is refined
    lost, gained = difference(fresh, grown)
    assert gained > lost >= 0
    assert difference(grown, fresh) == (gained, lost)
    upper = layers.find(root, "upper")
    without = layers.with_growth(root, "upper", ())
    assert difference(root, without) == (sum(tile.nbytes for tile in growths.tiles_of(upper.growth)), 0)


def test_info_tells_of_it(states):
    told = facts(Opened(states[-1]))
    rows = {row["name"]: row for row in told["layers"]}
    found = rows["upper"]["examples"]
    assert [(plot["name"], plot["depth"], plot["level"]) for plot in found] == [("b", 1.0, 0)]
    assert found[0]["pixels"] > 300
    assert "examples" in rows["Layer 1"]
