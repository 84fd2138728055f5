"""The lines of guides near a place: nearest points, vanishing points and cells, at any depth and distance."""

import math
from dataclasses import replace
from fractions import Fraction

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from app.desk.guides.reshaping import DRAGS, guide_at, places_of
from app.desk.guides.snap_curves import CURVES, Line, Oval, cell_place, exact, line_along, near, oval_of, through
from engine.painting.commands import Guide
from engine.painting.guiding.guides import GUIDE_KINDS

NUMBER = st.floats(-4000, 4000)
PLACE = st.tuples(NUMBER, NUMBER)
HUGE = st.integers(-(1 << 900), 1 << 900)
KINDS = [kind for kind in GUIDE_KINDS if kind != "symmetry"]


def guide(kind, *points, level=0, at=(0, 0)):
    return Guide(kind, kind, level, at, tuple(points))


@given(PLACE, st.floats(0, 6.3), PLACE)
def test_the_nearest_point_of_a_line_lies_on_it_at_right_angles(at, turn, place):
    line = through(at, (math.cos(turn), math.sin(turn)))
    x, y = line.nearest(*place)
    assert (x - at[0]) * line.dy - (y - at[1]) * line.dx == pytest.approx(0, abs=1e-8)
    assert (place[0] - x) * line.dx + (place[1] - y) * line.dy == pytest.approx(0, abs=1e-8)
    assert line.nearest(x, y) == pytest.approx((x, y), abs=1e-8)


@given(PLACE, st.floats(0, 6.3), st.floats(0.5, 3000), st.floats(0.5, 3000), PLACE)
def test_no_point_of_an_ellipse_is_nearer_than_the_nearest(centre, turn, long, wide, place):
    oval = Oval(*centre, math.cos(turn), math.sin(turn), long, wide)
    foot = oval.nearest(*place)
    u, v = (foot[0] - oval.x) * oval.dx + (foot[1] - oval.y) * oval.dy, 0.0
    v = (foot[1] - oval.y) * oval.dx - (foot[0] - oval.x) * oval.dy
    assert (u / long) ** 2 + (v / wide) ** 2 == pytest.approx(1, abs=1e-6)
    others = min(math.dist(place, oval.at(math.tau * k / 720)) for k in range(720))
    assert math.dist(place, foot) <= others + 1e-6 * max(long, wide)
    dx, dy = oval.direction(*foot)
    assert math.hypot(dx, dy) == pytest.approx(1)
    off = (place[0] - foot[0]) * dx + (place[1] - foot[1]) * dy
    assert off == pytest.approx(0, abs=1e-3 * (1 + math.dist(place, foot)))


@given(HUGE, HUGE, st.integers(-80, 80), PLACE, PLACE, PLACE)
def test_a_ruler_is_the_same_line_wherever_it_is_seen_from(x, y, deeper, first, second, away):
    """However far from where it was laid, and however deep: the point nearest to the origin is on it, exactly told."""
    assume(math.dist(first, second) > 1)
    ruler = guide("ruler", first, second, level=3, at=(x, y))
    level = 3 + deeper
    # an origin on the line, moved away a little, worked out in whole numbers
    dx, dy = Fraction(second[0] - first[0]), Fraction(second[1] - first[1])
    part = Fraction(x % 1001, 7)
    on = [
        (at + Fraction(p) + part * d) * Fraction(2) ** deeper for at, p, d in zip((x, y), first, (dx, dy), strict=True)
    ]
    origin = (round(on[0] + Fraction(away[0])), round(on[1] + Fraction(away[1])))
    (line,) = CURVES["ruler"](ruler, level, origin, (0.0, 0.0))
    there = float(on[0] - origin[0]), float(on[1] - origin[1])
    assert math.dist(line.nearest(*there), there) < 1e-6
    assert abs(line.dx * float(dy) - line.dy * float(dx)) < 1e-9 * math.hypot(dx, dy)


@given(HUGE, HUGE, st.integers(0, 200), PLACE)
def test_lines_to_a_vanishing_point_meet_there(x, y, deeper, at):
    made = guide("perspective-2", (0.0, 0.0), (900.0, 40.0), level=-7, at=(x, y))
    level, origin = -7 + deeper, (x - 30 << deeper, y + 500 << deeper)
    lines = CURVES["perspective-2"](made, level, origin, at)
    assert len(lines) == 3
    for number, line in enumerate(lines[:2]):
        assert line.nearest(*at) == pytest.approx(at, abs=1e-9)
        vx, vy = exact(made, number, level, origin)
        away = (vx - Fraction(at[0])) * Fraction(line.dy) - (vy - Fraction(at[1])) * Fraction(line.dx)
        assert abs(away) <= Fraction(1, 10**6) * max(abs(vx), abs(vy), 1)
    assert lines[2].dx * 900.0 + lines[2].dy * 40.0 == pytest.approx(0, abs=1e-9)


@given(st.floats(4000, 1 << 23), st.floats(4000, 1 << 23), st.integers(9, 400), st.floats(0, 6.28))
def test_an_ellipse_without_end_is_its_tangent(long, wide, deeper, turn):
    made = guide("ellipse", (0.5, 0.25), (long + 0.5, 0.25), (0.5, wide + 0.25), at=(1 << 600, -3))
    x, y = 0.5 + long * math.cos(turn), 0.25 + wide * math.sin(turn)
    # pixels of the level of a point that is very near the ellipse, from whole numbers
    scale = Fraction(2) ** deeper
    origin = (round(((1 << 600) + Fraction(x)) * scale), round((-3 + Fraction(y)) * scale))
    curve = oval_of(made, deeper, origin)
    foot = curve.nearest(0.0, 0.0)
    off = math.ldexp(1e-9 * max(long, wide), deeper)  # what floats make of the point on the ellipse
    assert math.hypot(*foot) <= off * 1e3 + 2
    assert isinstance(curve, Line if math.ldexp(max(long, wide), deeper) > 1 << 32 else Oval)
    dx, dy = curve.direction(*foot)
    tx, ty = -long * math.sin(turn), wide * math.cos(turn)
    assert abs(dx * ty - dy * tx) < 1e-4 * math.hypot(tx, ty)


@given(HUGE, st.integers(0, 90), PLACE, st.floats(0.1, 3), st.floats(3, 500))
def test_a_place_snaps_to_the_lines_of_its_cell(x, deeper, at, turn, size):
    u = (size * math.cos(turn), size * math.sin(turn))
    v = (-size * math.sin(turn + 0.4), size * math.cos(turn + 0.4))
    made = guide("grid", (0.0, 0.0), u, v, at=(x, 5))
    origin = ((x << deeper) + 37, (5 << deeper) - 11)
    along, across = CURVES["grid"](made, deeper, origin, at)
    for line, way in ((along, u), (across, v)):
        assert abs(line.dx * way[1] - line.dy * way[0]) < 1e-9 * size
        gap = math.dist(line.nearest(*at), at)
        assert gap <= math.ldexp(size, deeper) / 2 * 1.001
    a, b = cell_place(made, deeper, origin)
    assert a * Fraction(u[0]) + b * Fraction(v[0]) == Fraction(37, 1 << deeper)
    foot = along.nearest(*at)
    moved = replace(made, at=(0, 0))
    row = cell_place(moved, 0, (0, 0))
    assert row == (0, 0)
    det = u[0] * v[1] - u[1] * v[0]
    exact_row = b + Fraction(foot[1] * u[0] - foot[0] * u[1]) / Fraction(det) / (1 << deeper)
    assert abs(exact_row - round(exact_row)) < Fraction(1, 10**4)


@pytest.mark.parametrize("kind", KINDS)
@given(HUGE, st.integers(-40, 40), PLACE, st.integers(0, 2), st.booleans())
def test_dragging_a_point_brings_it_to_the_pointer_and_leaves_a_guide(kind, x, deeper, there, number, even):
    points = ((0.5, 0.25), (160.0, 12.0), (-20.0, 130.0))[: GUIDE_KINDS[kind].points]
    made = guide(kind, *points, level=deeper, at=(x, -x))
    number = min(number, len(points) - 1)
    level, origin = deeper + 4, ((x << 4) + 30, (-x << 4) - 50)
    before = places_of(made, level, origin)
    target = (Fraction(there[0]), Fraction(there[1]))
    found = DRAGS[kind](before, number, target, even)
    after = guide_at(made, found, level, origin)
    if after is None:
        return
    assert (after.kind, after.name) == (kind, kind)
    got = places_of(after, level, origin)
    for point, other in zip(got, found, strict=True):
        assert max(abs(a - b) for a, b in zip(point, other, strict=True)) < Fraction(1, 1000)
    free = not even and not (kind == "ellipse" and number == 2) and not (kind == "perspective-1" and number == 1)
    if free:
        assert near(got[number]) == pytest.approx(there, abs=0.01)
    if kind == "ellipse" and number:  # its axes are at right angles
        u, v = ([float(a - b) for a, b in zip(got[n], got[0], strict=True)] for n in (1, 2))
        assert abs(u[0] * v[0] + u[1] * v[1]) < 1e-3 * (1 + math.hypot(*u) * math.hypot(*v))


def test_a_line_is_told_by_its_point_nearest_to_the_origin():
    line = line_along((Fraction(1 << 300), Fraction(7)), (3.0, 0.0))
    assert line == (0.0, 7.0, 1.0, 0.0)
