"""Invariant 1: whatever was visited, evicted, undone or redone on the way, every level equals the dense reference."""

import numpy as np
import pytest
from dense import Dense
from strokes import ArrayEdit, Grain, as_raster_op, random_stroke, spread_planes

from engine.canvas.attenuate import fold
from engine.canvas.commit import commit, preview
from engine.canvas.evaluate import evaluate
from engine.canvas.store import Pyramid
from engine.canvas.tile_cache import TileCache
from engine.numeric.address import Rect
from engine.texture.planes import merged
from engine.texture.table import instance

NOISE = (Grain(0, 1), Grain(1, 2), Grain(2, 3))
TEXTURES = merged(
    (),
    (
        instance("rock", {"period": 8}, 0, 3),
        instance("squares", {"period": 3, "angle": 30}, 1, 3),
        instance("sawtooth", {"period": 5.5, "phase": 0.3}, 2, 3),
    ),
)
COARSEST, FINEST = -16, 4
WIDE, NARROW = (
    12,
    8,
)  # half the canvas's side at level 0: at the finest, what is painted spreads over 4 or 2 tiles' width
CASES = [(0, WIDE, NOISE, 16), (7, NARROW, TEXTURES, 16), (2, NARROW, NOISE, 16), (8, NARROW, NOISE, 12)]
LATER = [(6, WIDE, TEXTURES, 16), *((n, NARROW, NOISE, 16) for n in (1, 3, 4, 5))]
LATER += [(9, WIDE, NOISE, 12), *((n, NARROW, TEXTURES, 12) for n in (10, 11, 12))]
MORE = [pytest.param(*case, marks=pytest.mark.nightly) for case in LATER]


def compare(pyramid, dense, cache, inks):
    for k, h in dense.half.items():
        got = spread_planes(evaluate(pyramid, k, Rect(-h, -h, h, h), cache), inks)
        np.testing.assert_array_equal(got, dense.v[k], err_msg=f"level {k}")


def visit(pyramid, rng, cache, half):
    for _ in range(int(rng.integers(0, 12))):
        k = int(rng.integers(-6, FINEST + 3))
        reach = half << max(k, 0)
        x, y = (int(rng.integers(-reach, reach)) for _ in "xy")
        evaluate(pyramid, k, Rect.at(x, y, int(rng.integers(1, 300)), int(rng.integers(1, 200))), cache)


@pytest.mark.parametrize(("seed", "half", "inks", "grid"), [*CASES, *MORE])
def test_every_level_equals_the_dense_reference(seed, half, inks, grid):
    rng = np.random.default_rng(seed)
    cache = TileCache(int(rng.choice([0, 3 << 20, 64 << 20])))
    dense = Dense(COARSEST, FINEST, half, inks, grid)
    states, references = [Pyramid(grid=grid)], [dense.snapshot()]
    unvisited = [states[0]]
    for n in range(40):
        if rng.random() < 0.15 and len(states) > 1:
            back = int(rng.integers(1, min(4, len(states))))
            states, references, unvisited = states[:-back], references[:-back], unvisited[:-back]
            dense.restore(references[-1])
        m, x, y, keep, add = random_stroke(rng, FINEST, half, inks)
        spares_alpha = bool(rng.random() < 0.2)
        if spares_alpha:
            keep, add = as_raster_op(rng, keep, add)
        edit = ArrayEdit(m, x, y, keep, add, inks, spares_alpha)
        shown = preview(states[-1], edit, edit.rect, cache)
        states.append(commit(states[-1], edit, cache))
        unvisited.append(commit(unvisited[-1], edit))
        dense.paint(m, x, y, keep, add, spares_alpha)
        dense.commits = states[-1].commits
        references.append(dense.snapshot())
        committed = evaluate(states[-1], m, edit.rect, cache)
        np.testing.assert_array_equal(spread_planes(shown, inks), spread_planes(committed, inks))
        visit(states[-1], rng, cache, half)
        if rng.random() < 0.3:
            states[-1] = fold(states[-1])
        if rng.random() < 0.2:
            cache.clear()
        if n % 8 == 7:
            compare(states[-1], dense, cache, inks)
    compare(states[-1], dense, cache, inks)
    compare(unvisited[-1], dense, None, inks)
