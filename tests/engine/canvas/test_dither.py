"""Strokes on the coarse grid: weak ones are neither lost nor banded, strong ones are flat, and the rest stays where it
is."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from strokes import ArrayEdit, fill

from engine.canvas import dither
from engine.canvas.commit import commit, preview
from engine.canvas.evaluate import evaluate
from engine.canvas.store import Pyramid
from engine.numeric.address import TILE, Rect, TileKey
from engine.numeric.arithmetic import COARSE
from engine.numeric.grid import FINE_STEP, step_of

COUNT, FINE_COUNT = 2.0**COARSE, 2.0**16
STEP_12 = step_of(COARSE)
WHOLE = Rect(0, 0, TILE, TILE)
WEAK = np.full((TILE, TILE), 0.99, np.float32)


def wash(x, y, alpha, colour, level=0):
    """A stroke of a colour, 0..1 a component, that covers `alpha` (h, w)."""
    alpha = np.rint(alpha * FINE_COUNT) / FINE_COUNT
    add = np.rint(alpha * np.array([*colour, 1.0])[:, None, None] * FINE_COUNT) / FINE_COUNT
    return ArrayEdit(level, x, y, (1 - alpha).astype(np.float32), add.astype(np.float32))


def ramp(width, height, opacity):
    """Coverage from nothing to an opacity."""
    return np.broadcast_to(np.linspace(0, opacity, width), (height, width))


@pytest.mark.parametrize("fill_it", [dither._sow.compiled, dither._sow.plain])
def test_noise_is_within_half_a_step_and_only_where_strokes_are_weak(fill_it):
    keep = np.full((40, 60), 0.99, np.float32)
    keep[:, 20:40], keep[:, 40:] = 15 / 16, -0.5
    out = np.full(keep.shape, 9, np.float32)
    fill_it(np.uint64(1 << 63), 5, 60, keep, STEP_12, out)
    weak = out[:, :20] / STEP_12
    assert not out[:, 20:].any()
    assert 0.49 < np.abs(weak).max() < 0.5
    assert abs(weak.mean()) < 0.03
    assert 0.27 < weak.std() < 0.31
    other = np.empty_like(out)
    dither._sow.plain(np.uint64(1 << 63), 5, 60, keep, STEP_12, other)
    assert np.array_equal(out, other)


def test_noise_goes_by_the_commit_the_level_and_the_place():
    key = TileKey(2, -5, 1 << 70)
    one = dither.dithering(STEP_12, 7, key, WHOLE, WEAK)
    for number, other in [(8, key), (7, key._replace(level=3)), (7, key._replace(x=-4)), (7, key._replace(y=1 << 71))]:
        assert abs(np.corrcoef(one.ravel(), dither.dithering(STEP_12, number, other, WHOLE, WEAK).ravel())[0, 1]) < 0.05
    part = Rect(30, 20, 90, 100)
    assert np.array_equal(dither.dithering(STEP_12, 7, key, part, WEAK[:80, :60]), one[20:100, 30:90])
    assert not dither.dithering(FINE_STEP, 7, key, WHOLE, WEAK).size


@settings(max_examples=8, deadline=None)
@given(st.integers(0, 1 << 32), st.integers(-2, 2), st.sampled_from([0.002, 0.01, 0.05, 0.5, 1.0]))
def test_strokes_leave_values_on_the_grid_alpha_above_colours_grey_grey_and_the_rest_alone(seed, level, opacity):
    rng = np.random.default_rng(seed)
    pyramid = Pyramid(grid=COARSE)
    for n in range(6):
        colour = np.repeat(rng.random(), 3) if n % 2 else (1.0, 1.0, 1.0)
        alpha = ramp(30, 25, rng.random()) if n == 0 else opacity * rng.random((25, 30))
        edit = wash(*(int(v) for v in rng.integers(-20, 20, 2)), alpha, colour, level)
        before, seen = pyramid, preview(pyramid, edit, Rect(-60, -60, 70, 70)).data
        pyramid = commit(pyramid, edit)
        after = evaluate(pyramid, level, Rect(-60, -60, 70, 70)).data
        assert np.array_equal(seen, after)
        untouched = np.ones((130, 130), bool)
        untouched[edit.rect.slices(Rect(-60, -60, 70, 70))] = edit.keep == 1
        assert np.array_equal(after[:, untouched], evaluate(before, level, Rect(-60, -60, 70, 70)).data[:, untouched])
        assert (after[:3] <= after[3]).all()
        assert (after[0] == after[1]).all()
        assert (after[1] == after[2]).all()
    for k in range(level - 3, level + 3):
        values = evaluate(pyramid, k, Rect(-60, -60, 70, 70)).data * COUNT
        assert np.array_equal(values, np.rint(values))


def test_what_covers_much_stays_flat():
    pyramid = commit(Pyramid(grid=COARSE), fill(0, -20, -20, 60, 60, (0.3, 0.6, 0.9)))
    pyramid = commit(pyramid, fill(0, -20, -20, 60, 60, (0.9, 0.1, 0.2), alpha=0.3))
    inner = evaluate(pyramid, 0, Rect(-20, -20, 40, 40)).rgba
    assert (inner == inner[:, :1, :1]).all()


def over_and_over(edit, count, pyramid):
    for _ in range(count):
        pyramid = commit(pyramid, edit)
    return pyramid


def runs(values):
    """The longest run of equal values along a row."""
    changes = np.diff(values, axis=1) != 0
    longest = 0
    for row in changes:
        at = np.flatnonzero(np.concatenate([[True], row, [True]]))
        longest = max(longest, int(np.diff(at).max()))
    return longest


@pytest.mark.parametrize(("opacity", "count"), [pytest.param(0.002, 300, marks=pytest.mark.nightly), (0.02, 40)])
def test_weak_strokes_come_to_where_they_would_without_rounding(opacity, count):
    """Without noise most of them would be lost: 0.002 of a difference of less than a sixteenth is less than half a
    step."""
    alpha = np.rint(ramp(256, 8, opacity) * FINE_COUNT) / FINE_COUNT
    ground = fill(0, 0, 0, 256, 8, (0.5, 0.5, 0.5))
    pyramid = over_and_over(wash(0, 0, alpha, (0.55, 0.45, 0.5)), count, commit(Pyramid(grid=COARSE), ground))
    got = evaluate(pyramid, 0, Rect(0, 0, 256, 8)).rgba
    start = np.rint(0.5 * FINE_COUNT) / FINE_COUNT
    for c, aim in ((0, 0.55), (1, 0.45)):
        exact = aim + (start - aim) * (1 - alpha) ** count
        error = (got[c] - exact) * 255
        assert abs(error.mean()) < 0.1  # of a level of 8 bits; without noise 4
        assert np.abs(error.mean(axis=0).reshape(16, 16).mean(axis=1)).max() < 0.35
        assert error.std() < 0.6
        exact_runs = runs(np.rint(exact * 255))
        assert runs(np.rint(got[c] * 255)) <= exact_runs + 8
    assert (got[3] == 1).all()


def test_a_weak_eraser_takes_everything_in_the_end():
    ground = commit(Pyramid(grid=COARSE), fill(0, 0, 0, 32, 32, (1.0, 0.5, 0.0), alpha=0.06))
    eraser = ArrayEdit(0, 0, 0, np.full((32, 32), 1 - 1 / 32, np.float32), np.zeros((4, 32, 32), np.float32))
    left = evaluate(over_and_over(eraser, 150, ground), 0, Rect(0, 0, 32, 32)).rgba
    assert left[3].max() * 255 < 1.0
    assert left[3].mean() * 255 < 0.2  # rounded to the nearest, 1 would stay


def test_detail_fades_under_weak_strokes_of_a_coarser_level_and_comes_out_of_it():
    detail = np.indices((32, 32)).sum(axis=0) % 2 * 0.04
    pyramid = commit(Pyramid(grid=COARSE), fill(0, -64, -64, 160, 160, (0.5, 0.5, 0.5)))
    pyramid = commit(pyramid, wash(0, 0, detail, (1.0, 1.0, 1.0)))
    rect, before = Rect(4, 4, 28, 28), pyramid
    pyramid = over_and_over(wash(-32, -32, np.full((80, 80), 1 / 32), (0.5, 0.5, 0.5), level=-1), 60, pyramid)
    strength = [evaluate(each, 0, rect).rgba[0].std() for each in (before, pyramid)]
    assert strength[1] < 0.2 * strength[0]  # rounded to the nearest, a fifth would stay
    mean = evaluate(pyramid, -1, Rect(2, 2, 14, 14)).rgba[0].mean()
    assert abs(mean - 0.5) * 255 < 0.6
