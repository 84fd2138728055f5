"""The numbers of guides, typed: each makes the guide so, and leaves the others as they are; new guides in sight."""

from fractions import Fraction

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from app.canvas.view import Place, View
from app.desk.desk import Desk
from app.desk.guides.assistants import ASSISTANTS, add_guide
from app.desk.guides.guide_numbers import NUMBERS
from app.desk.guides.guide_sight import RIM, handles, seen_point, sight_of
from app.desk.guides.reshaping import guide_at, places_of
from app.input.events import PenEvent
from app.tools.guide_gestures import move_guide
from engine.numeric.address import Rect
from engine.painting.guiding.guides import GUIDE_KINDS, Guide
from engine.studio.results import Scene

ORIGIN = ((1 << 70) + 5, -77)
ROWS = [(kind, n) for kind, rows in NUMBERS.items() for n in range(len(rows))]
SHAPE = ((10.0, 20.0), (170.0, 50.0), (-20.0, 180.0))


def number(text):
    return Fraction(text.rstrip("°").replace("−", "-"))


@pytest.mark.parametrize(("kind", "row"), ROWS)
@settings(max_examples=6)
@given(st.integers(1, 4000), st.integers(-90, 90))
def test_a_number_that_is_typed_is_what_is_read_and_the_others_stay(kind, row, value, away):
    guide = Guide(kind, kind, 3, (ORIGIN[0] + away, ORIGIN[1] - 9), SHAPE[: GUIDE_KINDS[kind].points])
    rows, points = NUMBERS[kind], places_of(guide, 3, ORIGIN)
    sign = rows[row].sign
    value = value % 181 if sign == "angle" else value + ORIGIN["y" in sign] if sign[0] in "xy" else value
    made = rows[row].write(points, ORIGIN, Fraction(value))
    told = guide_at(guide, made, 3, ORIGIN)
    if told is None:  # two vanishing points would be one
        assert kind == "perspective-2" or kind == "perspective-3"
        return
    after = places_of(told, 3, ORIGIN)
    assert number(rows[row].read(after, ORIGIN)) == pytest.approx(value, rel=1e-4, abs=0.01)
    for n, other in enumerate(rows):
        free = n == row or (sign in "wh" and other.sign == "angle" and kind == "grid")
        if not free:
            before = number(other.read(points, ORIGIN))
            assert number(other.read(after, ORIGIN)) == pytest.approx(before, rel=1e-4, abs=1.01), other.sign


@pytest.mark.parametrize(("kind", "sign"), [("ruler", "long"), ("grid", "w"), ("ellipse", "h"), ("grid", "h")])
@pytest.mark.parametrize("value", [0, -3, 1 << 60])
def test_lengths_that_are_none_are_refused(kind, sign, value):
    row = next(row for row in NUMBERS[kind] if row.sign == sign)
    points = [(Fraction(x), Fraction(y)) for x, y in SHAPE[: GUIDE_KINDS[kind].points]]
    assert row.write(points, ORIGIN, Fraction(value)) is None


def added(kind):
    posted = []
    desk = Desk(View(Place(200, 100, 0), 0, 0.0, 1280, 800), posted.append)
    desk.insets = (250.0, 24.0, 286.0, 26.0)
    desk.learn(ready=True, scene=Scene(Rect(0, 0, 64, 64), (), None, False, False, False, None))
    add_guide(desk, kind)
    (guide,) = (request.command for request in posted)
    desk.learn(scene=Scene(Rect(0, 0, 64, 64), (), None, False, False, False, None, guides=(guide,)))
    return desk, posted, guide


@pytest.mark.parametrize("kind", ASSISTANTS)
def test_the_handles_of_a_new_guide_are_in_sight_and_the_vanishing_points_of_two_or_three_are_not(kind):
    desk, _, guide = added(kind)
    x0, y0, x1, y1 = desk.free_area()
    places = handles(desk, guide)
    assert all(x0 + RIM <= x <= x1 - RIM and y0 + RIM <= y <= y1 - RIM for x, y in places)
    assert len({(round(x / RIM), round(y / RIM)) for x, y in places}) == len(places)
    points = [seen_point(sight_of(desk.view), guide, n) for n in range(len(guide.points))]
    inside = [0 <= x <= 1280 and 0 <= y <= 800 for x, y in points]
    assert inside == [kind not in ("perspective-2", "perspective-3")] * len(points)


def test_a_vanishing_point_out_of_sight_is_moved_by_its_handle_as_far_as_that_and_not_by_a_press():
    desk, posted, guide = added("perspective-2")
    before = places_of(guide, 0, (0, 0))
    x, y = handles(desk, guide)[1]
    for by in ((0, 0), (-30, 12)):
        gesture = move_guide(desk, PenEvent("down", x + 3, y - 2, button=1))
        next(gesture)
        gesture.send(PenEvent("move", x + 3 + by[0], y - 2 + by[1]))
        with pytest.raises(StopIteration):
            gesture.send(PenEvent("up", x + 3 + by[0], y - 2 + by[1], button=1))
    assert len(posted) == 2  # the press alone was no step
    after = places_of(posted[-1].command, 0, (0, 0))
    assert after[0] == before[0]
    assert [float(b - a) for a, b in zip(before[1], after[1], strict=True)] == [-30, 12]
