"""Selections as values: the area of outlines, how they join, their rims, at all levels."""

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from engine.canvas.selecting import outlines
from engine.canvas.selecting.joining import joined_with, shared
from engine.canvas.selecting.occupied import alpha_at, raster
from engine.canvas.selecting.rims import rim_moved
from engine.canvas.selecting.selection import EVERYTHING, Selection
from engine.checks.field_error import FieldError
from engine.numeric.address import Rect
from engine.numeric.pyramid import reduce

AROUND = Rect(-40, -40, 200, 200)
FAR = 1 << 90


def values(coverage, around=AROUND):
    return raster(coverage, around)


def selected(selection, level=0, around=AROUND):
    out = np.empty((around.height, around.width), np.float32)
    out[...] = selection.part(level, around)
    return out


corners = st.lists(st.tuples(st.floats(-30, 190), st.floats(-30, 190)), min_size=3, max_size=7)
boxes = st.builds(Rect.at, st.integers(-30, 80), st.integers(-30, 80), st.integers(1, 100), st.integers(1, 100))


def made(draw_level, rect, round_off):
    return (outlines.rounded_off if round_off else outlines.boxed)(draw_level, rect, "here")


@settings(max_examples=40, deadline=None)
@given(corners)
@example([(0.0, 0.0), (0.0, 0.0), (1.0, 2.225073858507203e-309)])
def test_an_outline_covers_the_area_that_it_goes_round(points):
    """Of a triangle and of any shape that goes round once; a shape that crosses itself covers no more than that."""
    table = np.array(points)
    got = values(outlines.outlined(0, (0, 0), table, "here"))
    x, y = table.T
    area = abs(float((x * np.roll(y, -1) - np.roll(x, -1) * y).sum())) / 2
    assert got.min() >= 0.0
    assert got.max() <= 1.0
    if len(points) == 3:
        assert got.sum() == pytest.approx(area, abs=0.05)
    assert (values(outlines.outlined(0, (0, 0), table[::-1], "here")) == got).all()


def test_each_pixel_of_an_outline_is_covered_by_its_part():
    """Against sixteen by sixteen points in each pixel."""
    table = np.array([[3.2, 5.1], [140.7, 20.9], [90.3, 150.2], [-20.5, 80.4]])
    got = values(outlines.outlined(0, (0, 0), table, "here"))
    fine = 16
    ys, xs = (np.arange(240 * fine) + 0.5) / fine - 40, (np.arange(240 * fine) + 0.5) / fine - 40
    inside = np.ones((240 * fine, 240 * fine), bool)
    for (ax, ay), (bx, by) in zip(table, np.roll(table, -1, axis=0), strict=True):
        inside &= (bx - ax) * (ys[:, None] - ay) - (by - ay) * (xs[None] - ax) >= 0
    expected = inside.reshape(240, fine, 240, fine).mean(axis=(1, 3))
    assert np.abs(got - expected).max() < 0.04


def test_an_outline_far_from_the_origin_is_the_one_near_it():
    table = np.array([[3.2, 5.1], [140.7, 20.9], [90.3, 150.2]])
    near = values(outlines.outlined(0, (0, 0), table, "here"))
    away = values(outlines.outlined(0, (FAR, -FAR), table, "here"), Rect(FAR - 40, -FAR - 40, FAR + 200, -FAR + 200))
    assert (near == away).all()


@settings(max_examples=40, deadline=None)
@given(boxes)
def test_an_ellipse_has_its_area_and_its_symmetries(rect):
    got = values(outlines.rounded_off(0, rect, "here"), rect)
    assert got.sum() == pytest.approx(np.pi / 4 * rect.area, rel=0.01, abs=0.05)
    assert np.abs(got - got[::-1]).max() < 4e-3
    assert np.abs(got - got[:, ::-1]).max() < 4e-3


@settings(max_examples=25, deadline=None)
@given(st.lists(st.tuples(st.sampled_from(["add", "subtract", "intersect"]), boxes, st.booleans()), max_size=5))
def test_selections_join_as_parts_of_each_pixel_do(steps):
    """At the level at which all are made; what is not selected is selected when it is inverted."""
    selection = joined_with(None, made(0, Rect(0, 0, 90, 70), False), "replace", 16)
    expected = selected(selection)
    for n, (op, rect, round_off) in enumerate(steps):
        coverage = made(0, rect, round_off)
        m = values(coverage)
        expected = {
            "add": expected + m - expected * m,
            "subtract": expected - expected * m,
            "intersect": expected * m,
        }[op]
        selection = joined_with(selection, coverage, op, 16)
        if n % 2:
            selection, expected = selection.inverted(), 1 - expected
        assert np.abs(selected(selection) - expected).max() < 1e-4


@pytest.mark.parametrize("inverse", [False, True])
def test_what_two_selections_share_keeps_the_finer_rim_of_the_first(inverse):
    fine = joined_with(None, made(3, Rect(100, 100, 500, 420), True), "replace", 16)
    got = shared(fine.pyramid, made(0, Rect(0, 0, 64, 64), False), inverse)
    there = Rect(90, 90, 400, 400)
    expected = selected(Selection(fine.pyramid, inverse), 3, there)
    assert (selected(Selection(got), 3, there) == expected).all()
    assert not selected(Selection(got), 0, Rect(70, 0, 90, 60)).any()


@settings(max_examples=25, deadline=None)
@given(boxes, st.integers(1, 20))
def test_growing_and_shrinking_move_the_rim(rect, by):
    bigger = values(rim_moved(made(0, rect, False), float(by), 0.0, 16, "here"), AROUND)
    assert bigger[:, : max(0, rect.x0 - by - AROUND.x0)].sum() == 0
    assert (values(made(0, rect, False)) <= bigger).all()
    back = rim_moved(rim_moved(made(0, rect, False), float(by), 0.0, 16, "here"), -float(by), 0.0, 16, "here")
    assert np.abs(values(back) - values(made(0, rect, False))).max() <= 0.5
    smaller = values(rim_moved(made(0, rect, False), -float(by), 0.0, 16, "here"))
    inner = Rect(rect.x0 + by, rect.y0 + by, rect.x1 - by, rect.y1 - by)
    assert smaller.sum() == inner.area if not inner.empty else not smaller.any()


def test_distances_are_those_of_the_plain_form():
    from engine.canvas.selecting.rims import _distances

    rng = np.random.default_rng(3)
    for chance in (0.001, 0.02, 0.4):
        marks = rng.random((37, 61)) < chance
        marks[5, 7] = True
        out = np.empty(marks.shape, np.int64)
        _distances(marks, 12, out)
        at = np.argwhere(marks)
        ys, xs = np.mgrid[:37, :61]
        plain = ((ys[..., None] - at[:, 0]) ** 2 + (xs[..., None] - at[:, 1]) ** 2).min(axis=2)
        near = plain <= 144
        assert (out[near] == plain[near]).all()
        assert (out[~near] > 144).all()


@pytest.mark.parametrize("feather", [1.5, 6.0, 16.0, 40.0])
def test_a_feathered_rim_has_its_middle_where_it_was(feather):
    rect = Rect(0, 0, 128, 128)
    coverage = rim_moved(made(0, rect, False), 0.0, feather, 16, "here")
    selection = joined_with(None, coverage, "replace", 16)
    row = selected(selection, 0, Rect(-100, 64, 64, 65))[0]
    assert (np.diff(row) >= -1e-3).all()
    assert row[99:101].mean() == pytest.approx(0.5, abs=0.02)
    assert row[100 - int(3 * feather) - 3] < 0.01 if feather < 30 else True


def test_a_selection_is_at_coarser_levels_the_mean_and_at_finer_ones_as_smooth():
    selection = joined_with(None, made(0, Rect(0, 0, 128, 100), True), "replace", 16)
    fine = selected(selection, 0, Rect(-8, -8, 136, 120))
    coarse = selected(selection, -1, Rect(-4, -4, 68, 60))
    assert np.abs(reduce(fine[None])[0] - coarse)[2:-2, 2:-2].max() < 1e-3
    assert selected(selection, 40, Rect(64 << 40, 50 << 40, (64 << 40) + 9, (50 << 40) + 9)).min() == 1.0


def test_what_is_covered_is_found_at_every_level_and_refused_where_it_is_too_much():
    selection = joined_with(None, made(0, Rect(FAR, 0, FAR + 5, 7), False), "replace", 16)
    for level in (-7, 0, 2):
        found = alpha_at(selection.pyramid, level, "here")
        at = Rect(FAR, 0, FAR + 5, 7).zoomed(level).grown(12)
        assert (raster(found, at) == selected(selection, level, at)).all()
        assert found.tiles
    with pytest.raises(FieldError, match="take a coarser level"):
        alpha_at(selection.pyramid, 40, "here")


def test_everything_is_selected_everywhere():
    assert EVERYTHING.everything
    assert selected(EVERYTHING).min() == 1.0
    assert not EVERYTHING.inverted().everything
