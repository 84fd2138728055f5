"""What was painted with examples becomes paint of the same pixels."""

import numpy as np
import pytest
from planted import around, planted
from strokes import ArrayEdit, Grain, fill, random_stroke

from engine.canvas import growth as growths
from engine.canvas.commit import commit
from engine.canvas.evaluate import evaluate
from engine.canvas.flatten import flattened
from engine.canvas.layers import Layer
from engine.canvas.reading import layer_ink, layer_planes
from engine.canvas.store import Pyramid
from engine.canvas.tile_cache import TileCache
from engine.numeric.address import Rect

WHOLE = Rect.at(-96, -96, 192, 192)


def painted(growth):
    """A layer with faint, textured paint under a growth."""
    random = np.random.default_rng(4)
    pyramid = commit(Pyramid(), fill(0, -80, -60, 100, 120, (0.2, 0.7, 0.4), 0.8))
    inks = (Grain(0, 3),)
    for _ in range(4):
        level, x, y, keep, add = random_stroke(random, 1, 100, inks)
        pyramid = commit(pyramid, ArrayEdit(level, x, y, keep, add, inks))
    return Layer(1, "A", pyramid=pyramid, growth=growth)


@pytest.mark.parametrize(("key", "finest"), [("a", 0), ("b+1", 1)])
def test_no_pixel_changes_at_the_finest_level(key, finest):
    layer = painted(growths.settled(planted(planted((), 0, 0, 40, key), 20, 30, 30, key.replace("b", "c"), depth=1.0)))
    flat = flattened(layer, TileCache(1 << 24))
    assert flat.growth == ()
    assert flat.pyramid.uid == layer.pyramid.uid
    whole = WHOLE.zoomed(finest)
    assert np.array_equal(layer_planes(flat, finest, whole), layer_planes(layer, finest, whole))
    for level in (-2, finest + 1):  # coarser means are of all together, and finer paint keeps what shows through
        there = WHOLE.zoomed(level)
        difference = np.abs(layer_planes(flat, level, there) - layer_planes(layer, level, there))
        assert difference.max() < 0.25
        assert difference.mean() < 0.004


def test_plots_of_several_levels():
    growth = planted(planted((), 0, 0, 30, "a", level=0), 0, 0, 60, "b", level=1, depth=1.0)
    layer = painted(growth)
    flat = flattened(layer)
    top = growths.planes(growths.settled(growth[1:]), 1, around(0, 0, 60))
    opaque = top[3] == 1
    assert opaque.sum() > 3000
    assert np.array_equal(layer_planes(flat, 1, around(0, 0, 60))[:, opaque], top[:, opaque])


def test_a_layer_without_any_stays():
    layer = painted(())
    assert flattened(layer).pyramid is layer.pyramid
    assert np.array_equal(layer_planes(layer, 0, WHOLE), evaluate(layer.pyramid, 0, WHOLE).rgba)
    far = painted(growths.settled(planted((), 5000, 0, 10)))
    cache = TileCache(1 << 24)
    held = layer_planes(far, 0, WHOLE, cache)
    assert np.array_equal(held, evaluate(far.pyramid, 0, WHOLE).rgba)
    assert layer_planes(Layer(1, "A"), 0, WHOLE) is None


def test_ink_is_covered_too():
    layer = painted(growths.settled(planted((), 0, 0, 40)))
    own, seen = evaluate(layer.pyramid, 0, WHOLE), layer_ink(layer, 0, WHOLE)
    assert seen.inks == own.inks
    assert np.array_equal(seen.rgba, layer_planes(layer, 0, WHOLE))
    alpha = growths.planes(layer.growth, 0, WHOLE)[3]
    assert own.data[4:].any()
    assert not seen.data[4:, alpha == 1].any()
    assert np.array_equal(seen.data[4:, alpha == 0], own.data[4:, alpha == 0])
