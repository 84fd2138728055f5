"""The region of an example without a window: painted in and out, taken back, found by transparency and by colour."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from app.desk.region_mask import STEPS, Mask, alike, shown, smoothed
from engine.numeric.address import Rect


def made(height=40, width=60, inside=False):
    pixels = np.zeros((height, width, 4), np.uint8)
    pixels[..., 3] = 255
    return Mask(pixels, np.full((height, width), inside))


def stroke(mask, *points):
    mask.begin(*points[0])
    for point in points[1:]:
        mask.to(*point)


def test_a_stroke_is_round_and_has_no_gaps():
    mask = made()
    mask.radius = 5.0
    stroke(mask, (10.0, 20.0), (50.0, 20.0))
    rows, columns = np.nonzero(mask.inside)
    assert (rows.min(), rows.max(), columns.min(), columns.max()) == (15, 24, 5, 54)
    assert mask.inside[20, 5:55].all()
    assert not mask.inside[15, 5]  # round ends
    assert abs(mask.inside.sum() - (400 + np.pi * 25)) < 25


def test_painting_out_undoes_painting_in_but_for_what_was_there():
    mask = made()
    mask.inside[:, :20] = True
    before = mask.inside.copy()
    mask.way = "in"
    stroke(mask, (15.0, 20.0), (45.0, 20.0))
    mask.way = "out"
    stroke(mask, (45.0, 20.0), (15.0, 20.0))
    assert not mask.inside[20, 20:].any()
    mask.step(-1)
    mask.step(-1)
    assert (mask.inside == before).all()
    assert not mask.history.can_undo
    mask.step(1)
    assert mask.inside[20, 40]


def test_steps_that_were_taken_back_are_gone_after_a_new_one_and_are_not_kept_for_ever():
    mask = made(8, 8)
    mask.put(~mask.inside)
    mask.step(-1)
    mask.put(np.ones_like(mask.inside))
    assert not mask.history.can_redo
    for _ in range(STEPS + 20):
        mask.put(~mask.inside)
    steps = 0
    while mask.history.can_undo:
        mask.step(-1)
        steps += 1
    assert steps == STEPS


def test_a_stroke_that_is_dropped_leaves_nothing():
    mask = made()
    stroke(mask, (10.0, 10.0), (30.0, 30.0))
    mask.abandon()
    assert not mask.inside.any()
    assert not mask.history.can_undo
    assert not mask.history.can_redo


@pytest.mark.parametrize("points", [[(-500.0, -500.0), (-400.0, -300.0)], [(1e4, 3.0)], [(-20.0, 20.0), (90.0, 20.0)]])
def test_a_stroke_may_leave_the_picture(points):
    mask = made()
    stroke(mask, *points)
    assert mask.inside.any() == (points[0][0] == -20.0)


def test_a_clicked_colour_leaves_with_what_is_alike():
    mask = made(inside=True)
    mask.pixels[:, :20, :3] = (200, 100, 50)
    mask.pixels[:, 20:30, :3] = (210, 100, 50)
    mask.pixels[:, 50:, :3] = (200, 100, 50)
    mask.way, mask.tolerance, mask.joined = "colour", 0.01, True
    mask.begin(5.5, 5.5)
    assert not mask.inside[:, :20].any()
    assert mask.inside[:, 20:].all()
    mask.tolerate(0.05, True)  # the same click again
    assert not mask.inside[:, :30].any()
    assert mask.inside[:, 30:].all()
    mask.tolerate(0.05, False)
    assert not mask.inside[:, 50:].any()
    mask.step(-1)
    assert mask.inside.all()
    mask.begin(-3.0, 5.0)  # beside the picture
    assert not mask.history.can_undo


def test_holes_are_another_colour_than_any_paint():
    pixels = np.zeros((4, 4, 4), np.uint8)
    pixels[:2, :, 3] = 255
    pixels[2:, :, :3] = 77  # the colour of nothing does not count
    assert alike(pixels, 0, 0, 0.1, False).sum() == 8
    assert alike(pixels, 0, 3, 0.1, True).sum() == 8


def test_smoothing_takes_specks_and_pinholes_and_keeps_the_rest():
    inside = np.zeros((60, 60), bool)
    inside[10:50, 10:50] = True
    clean = inside.copy()
    inside[30, 30] = False
    inside[3, 3] = True
    found = smoothed(inside)
    assert found[30, 30]
    assert not found[3, 3]
    assert (found != clean).sum() < 40  # corners
    assert smoothed(np.ones((5, 9), bool)).all()
    assert not smoothed(np.zeros((5, 9), bool)).any()


def test_what_is_outside_is_dimmed_and_the_edge_is_light():
    mask = made()
    mask.pixels[..., :3] = 200
    mask.inside[10:30, 10:30] = True
    seen = shown(mask, Rect(0, 0, 60, 40)).astype(int)
    assert (seen[12:28, 12:28] == 200).all()
    assert (seen[0:8] < 100).all()
    assert (seen[15, 9] > 200).all()


@settings(deadline=None, max_examples=25)
@given(st.lists(st.tuples(st.integers(0, 59), st.integers(0, 39)), min_size=2, max_size=6), st.booleans())
def test_a_part_of_the_picture_looks_as_it_does_in_the_whole(points, inside):
    mask = made(inside=inside)
    mask.pixels[..., :3] = np.random.default_rng(1).integers(0, 255, (40, 60, 3))
    mask.pixels[::3, ::2, 3] = 90
    mask.radius, mask.way = 4.0, "out" if inside else "in"
    before = shown(mask, Rect(0, 0, 60, 40))
    mask.dirty = None
    stroke(mask, *points)
    after = shown(mask, Rect(0, 0, 60, 40))
    box = mask.dirty
    assert (shown(mask, box) == after[box.slices(Rect(0, 0, 60, 40))]).all()
    before[box.slices(Rect(0, 0, 60, 40))] = shown(mask, box)
    assert (before == after).all()
