"""Scales, turns and places of what is moved: what is exact stays exact, what is set back is as it was."""

import math
from fractions import Fraction

import pytest
from hypothesis import assume, example, given
from hypothesis import strategies as st

from app.canvas.view import Place, View
from app.desk.moving.box import INSIDE, SCALES, TURN, box_of, opposite, spot
from app.desk.moving.poses import Spin, exact, mirrored, respun, shifted, spin_of
from engine.canvas.placing.pose import UNMOVED, Pose, SourcePart
from engine.numeric.address import Rect
from engine.numeric.similarity import Dyadic

spins = st.builds(
    Spin, st.integers(-30, 30), st.floats(1.0, 2.0, exclude_max=True), st.floats(-180, 180, exclude_min=True)
)
exact_spins = st.builds(Spin, st.integers(-30, 30), st.just(1.0), st.sampled_from([-90.0, 0.0, 90.0, 180.0]))
places = st.builds(Dyadic.of, st.integers(-(1 << 40), 1 << 40), st.integers(-(1 << 40), 1 << 40), st.integers(-4, 20))
bools = st.booleans()


@given(spins, places, bools, places, spins, st.integers(-5, 60))
def test_what_it_is_turned_about_stays_where_it_is(spin, at, mirror, about, other, level):
    pose = respun(Pose(mirror=mirror), spin, at, level)
    assert pose.wrong() is None
    back = respun(pose, other, about, level)
    assert back.wrong() is None
    assert back.mirror is mirror
    # The place that was shown at `about` before is there still: told by the inverse, in rational numbers.
    c, t, n = pose.similarity.c, pose.similarity.t, pose.similarity.squared
    w = (about + -t) * c.conjugate
    source = [Fraction(v) * Fraction(2) ** (n[1] - w.e) / n[0] for v in (w.x, w.y)]
    d, u = back.similarity.c, back.similarity.t
    x = (d.x * source[0] - d.y * source[1]) * Fraction(2) ** -d.e + u.x * Fraction(2) ** -u.e
    y = (d.x * source[1] + d.y * source[0]) * Fraction(2) ** -d.e + u.y * Fraction(2) ** -u.e
    least = Fraction(2) ** -level
    assert abs(x - about.x * Fraction(2) ** -about.e) <= least
    assert abs(y - about.y * Fraction(2) ** -about.e) <= least


@given(exact_spins, spins, places, st.integers(0, 40), bools)
def test_what_is_set_back_to_quarters_and_powers_of_two_is_exact(spin, other, about, level, mirror):
    pose = respun(respun(Pose(mirror=mirror), other, about, level), spin, about, level)
    assert exact(pose, level)
    assert spin_of(pose) == spin
    assert pose.turned is None


@given(places, st.floats(-179, 179), st.integers(0, 30))
@example(Dyadic(0, 0), 0.0, 0)
@example(Dyadic(3 << 20, 5 << 20), 77.0, 0)
@example(Dyadic(3 << 20, 5 << 20), -141.0, 30)
def test_a_turn_and_back_is_no_turn(about, degrees, level):
    about = Dyadic.of(about.x >> 20, about.y >> 20, 0)  # on whole pixels, as the middle of a box with even sides is
    turned = respun(UNMOVED, spin_of(UNMOVED).turned(degrees), about, level)
    back = respun(turned, spin_of(turned).turned(0.0), about, level)
    assert back.similarity == UNMOVED.similarity


@given(spins, places, bools)
def test_a_spin_is_told_by_its_pose(spin, about, mirror):
    found = spin_of(respun(Pose(mirror=mirror), spin, about, 3))
    assert found.doublings == pytest.approx(spin.doublings, abs=1e-9)
    turned = abs(found.degrees - spin.degrees)
    assert min(turned, 360 - turned) < 1e-9


@given(spins, places, bools, bools)
def test_mirrored_twice_is_as_it_was(spin, about, mirror, across):
    pose = respun(Pose(mirror=mirror), spin, about, 4)
    once = mirrored(pose, about, across)
    assert once.mirror is not mirror
    assert mirrored(UNMOVED, about, across).similarity(about) == about
    assert mirrored(once, about, across).similarity == pose.similarity


@given(spins, st.integers(-99, 99), st.integers(-99, 99), st.integers(-3, 9))
def test_what_is_moved_keeps_its_turn(spin, x, y, level):
    pose = respun(UNMOVED, spin, Dyadic(0, 0), 2)
    there = shifted(pose, level, x, y)
    assert there.similarity.c == pose.similarity.c
    assert shifted(there, level, -x, -y).similarity == pose.similarity


@given(st.one_of(st.integers(-179, 180).map(float), st.floats(-180, 180, exclude_min=True)), places, bools)
@example(30.0, Dyadic(0, 0), False)
def test_what_is_half_as_large_halves_however_it_is_turned(degrees, about, mirror):
    pose = respun(Pose(levels=-1, mirror=mirror), Spin(-1, 1.0, degrees), about, 0)
    assert pose.similarity.halves
    assert pose.wrong() is None
    assert spin_of(pose).size == 1.0
    assert spin_of(pose).levels == -1


def test_turns_snap_to_quarters_and_by_steps_to_fifteen_degrees():
    spin = Spin(0, 1.0, 0.0)
    assert spin.turned(88.0).snapped_turn(False) == Spin(0, 1.0, 90.0)
    assert spin.turned(-178.0).snapped_turn(False) == Spin(0, 1.0, 180.0)
    assert spin.turned(80.0).snapped_turn(False).degrees == 80.0
    assert spin.turned(80.0).snapped_turn(True).degrees == 75.0
    assert spin.scaled(0.49).snapped_scale() == Spin(-1, 1.0, 0.0)
    assert not spin.scaled(0.7).snapped_scale().exact


@given(
    st.floats(-3, 3), st.floats(-2, 6), st.integers(-20, 20), st.integers(-20, 20), st.integers(100, 900),
    st.integers(100, 900),
)  # fmt: skip
def test_handles_of_what_is_larger_than_the_view_are_kept_within_it(angle, zoom, x, y, width, height):
    area = (240.0, 20.0, 1000.0, 770.0)
    view = View(Place(0, 0, 0), int(zoom // 1), zoom % 1, 1280, 800, angle)
    part = SourcePart(0, Rect.at(x - width, y - height, 2 * width, 2 * height))
    box = box_of(view, 1.0, part, UNMOVED, area)
    free = box_of(view, 1.0, part, UNMOVED)
    if not box.holds(620.0, 395.0):
        return
    for name, at in (*box.handles.items(), (TURN, box.turner)):
        assert 250 <= at[0] <= 990
        assert 60 <= at[1] <= 760
        was = free.turner if name == TURN else free.at(*SCALES[name])
        inside = 300 <= was[0] <= 940 and 120 <= was[1] <= 700
        assert not inside or math.dist(at, was) < 1e-6
        across, down = (was[0] - 620.0, was[1] - 395.0), (at[0] - 620.0, at[1] - 395.0)
        assert abs(across[0] * down[1] - across[1] * down[0]) <= 1e-6 * (math.hypot(*across) * math.hypot(*down) + 1)


@given(
    st.floats(-3, 3), st.floats(-2, 2), bools, spins, st.integers(-200, 200), st.integers(-200, 200),
    st.integers(1, 300), st.integers(1, 300),
)  # fmt: skip
def test_each_handle_is_where_it_is_taken_hold_of(angle, zoom, mirror, spin, x, y, width, height):
    level = round(zoom // 1)
    view = View(Place(x << 16, y << 16, 16), level, zoom - level, 800, 600, angle, mirror)
    part = SourcePart(0, Rect.at(x, y, width, height))
    spin = Spin(0, spin.size, spin.degrees)
    pose = respun(UNMOVED, spin, Dyadic.of(x, y), 8)
    box = box_of(view, 1.0, part, pose)
    for name, at in box.handles.items():
        assert box.grip(*at) == name
    assert box.grip(*box.turner) == TURN
    mx, my = box.middle
    sides = (abs(box.at(1, 0)[0] - mx), abs(box.at(1, 0)[1] - my), abs(box.at(0, 1)[0] - mx), abs(box.at(0, 1)[1] - my))
    assume(max(sides[:2]) > 20 and max(sides[2:]) > 20)
    assert box.grip(mx, my) == INSIDE
    assert box.grip(mx + 5000, my) == ""
    for name, (across, down) in SCALES.items():
        assert opposite(part, pose, name) == spot(part, pose, -across, -down)
