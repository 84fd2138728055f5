"""Places: a view is its bookmark, and back; flights end where they lead; the trail; places that are typed."""

import math
from fractions import Fraction

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from app.canvas.standpoint import Standpoint, standpoint_at
from app.canvas.travel import Travel
from app.canvas.view import Place, View, place_of_pixel
from app.desk.desk import Desk
from app.desk.places import going
from app.desk.places.typed_place import place_text, typed_standpoint
from app.desk.places.visited import STAYED, Trail
from engine.checks.field_error import FieldError
from engine.files.strict_json import dumps, loads
from engine.numeric.address import Rect
from engine.painting import commands as c
from engine.studio import requests as q
from engine.studio.results import Scene, Sought, Spot

SIZE = (746.0, 431.0)
LEVELS = st.integers(-60, 4000)
FRACTIONS = st.integers(0, (1 << 40) - 1).map(lambda n: n / (1 << 40))  # what a level of four digits leaves room for


def exact(place: Place) -> tuple[Fraction, Fraction]:
    return Fraction(place.x) / Fraction(2) ** place.exponent, Fraction(place.y) / Fraction(2) ** place.exponent


@st.composite
def standpoints(draw, levels=LEVELS, fractions=FRACTIONS):
    """Any, to 2^-16 pixels: near the origin, and as far away as the level has frames."""
    level = draw(levels)
    limit = draw(st.sampled_from([1 << 20, 1 << 40, 1 << max(level, 0) + 36]))
    where = st.integers(-limit, limit)
    place = Place(draw(where), draw(where), level + 16)
    angle = draw(st.floats(-math.pi, math.pi))
    return Standpoint(place, level, draw(fractions), angle, draw(st.booleans()))


@given(standpoints(), st.tuples(st.integers(1, 5000), st.integers(1, 5000)))
@settings(deadline=None, max_examples=60)
def test_from_a_view_to_its_bookmark_and_back_is_the_identity(here, size):
    mark = here.bookmark("a", size)
    mark = c.parse(loads(dumps(c.to_json(mark))))  # as a file has it
    again = standpoint_at(mark, size)
    assert exact(again.place) == exact(here.place)
    assert (again.level, again.fraction, again.mirrored) == (here.level, here.fraction, here.mirrored)
    assert again.angle == pytest.approx(here.angle, abs=1e-12)
    assert again.bookmark("a", size).origin == mark.origin


@given(standpoints(), st.sampled_from([(1280, 800), (747.3, 431.2)]))
@settings(deadline=None, max_examples=40)
def test_what_is_in_the_middle_stays_there(here, size):
    view = here.seen_from(View(Place(0, 0, 0), 0, 0.0, 1280, 800), 500.5, 300.25)
    assert (view.level, view.fraction, view.angle, view.mirrored) == (
        here.level,
        here.fraction,
        here.angle,
        here.mirrored,
    )
    assert exact(Standpoint.of(view, 500.5, 300.25).place) == exact(here.place)


def test_a_bookmark_shows_its_rectangle_on_any_screen():
    mark = c.Bookmark("a", 2.0, (400, 200), (200, 100), 90.0)
    there = standpoint_at(mark, (1000, 800))
    view = there.seen_from(View(Place(0, 0, 0), 0, 0.0, 1000, 800), 500, 400)
    corners = [view.pixel_to_screen(2, x, y) for x, y in ((400, 200), (600, 300))]
    assert corners == [pytest.approx((750, -100), abs=0.01), pytest.approx((250, 900), abs=0.01)]


# --- flights ---------------------------------------------------------------------------------------------------------


@given(standpoints(st.integers(-60, 900)), standpoints(st.integers(-60, 900)))
@settings(deadline=None, max_examples=40)
def test_a_flight_begins_and_ends_where_it_should_without_a_leap(here, there):
    travel = Travel(here, there, 400.0)
    assert travel.at(0.0) == here
    assert travel.at(1.0) == there
    assert 0 < travel.seconds < 3
    screen = View(Place(0, 0, 0), 0, 0.0, 800, 400)
    for part, end in ((1e-6, here), (1 - 1e-6, there)):
        view = travel.at(part).seen_from(screen, 400, 200)
        assert view.to_screen(end.place) == pytest.approx((400, 200), abs=1.0)
        assert math.isclose(view.level + view.fraction, end.level + end.fraction, abs_tol=0.01)
    for part in (n / 50 for n in range(1, 50)):
        one, other = travel.at(part), travel.at(part + 1e-9)
        assert one.seen_from(screen, 400, 200).to_screen(other.place) == pytest.approx((400, 200), abs=0.5)


def test_a_flight_across_goes_out_and_in_again():
    here = Standpoint(Place(0, 0, 0), 8, 0.0)
    there = Standpoint(Place(1000, 0, 0), 8, 0.0)
    levels = [at.level + at.fraction for at in (Travel(here, there, 500.0).at(n / 40) for n in range(41))]
    assert min(levels) < 0.5
    assert levels[0] == levels[-1] == 8
    assert levels[1:20] == sorted(levels[1:20], reverse=True)


@pytest.fixture
def desk():
    posted = []
    desk = Desk(View(Place(512, 384, 0), 0, 0.0, 1280, 800), posted.append)
    desk.insets = (248.0, 27.0, 286.0, 26.0)
    return desk


def landed(desk):
    for _ in range(400):
        if not desk.glide.moving:
            return going.here(desk)
        desk.view = desk.glide.step(desk.view, 0.016)
    raise AssertionError("it never lands")


def test_back_and_forward_lead_through_where_one_went(desk):
    start = going.here(desk)
    marks = [c.Bookmark("a", 9.0, (3 << 12, 5), (700, 700), 30.0), c.Bookmark("b", 60.5, (7**20, 5**22), (640, 480))]
    ends = []
    for mark in marks:
        going.go_to_bookmark(desk, mark)
        ends.append(landed(desk))
    assert exact(ends[1].place) == exact(standpoint_at(marks[1], going.free_size(desk)).place)
    for by, expected in ((-1, ends[0]), (-1, start), (-1, start), (1, ends[0]), (1, ends[1]), (1, ends[1])):
        going.step(desk, by)
        here = landed(desk)
        assert exact(here.place) == exact(expected.place)
        assert (here.level, here.fraction, here.angle) == (expected.level, expected.fraction, expected.angle)


def test_a_press_ends_a_flight_where_it_is_and_the_wheel_goes_on_from_there(desk):
    going.go_to_bookmark(desk, c.Bookmark("a", 30.0, (7, 5), (700, 700)))
    desk.view = desk.glide.step(desk.view, 0.5)
    view = desk.view
    desk.glide.zoom(view, 0.25, 640, 400)
    assert 0 < landed(desk).level < 29


def scene(serial):
    return Scene(Rect(0, 0, 8, 8), (), None, False, False, False, None, serial=serial)


# --- the trail -------------------------------------------------------------------------------------------------------


def at(x, level=0):
    return Standpoint(Place(x << 16, 0, 16), level, 0.0)


def test_a_place_counts_when_one_stayed_there():
    trail, now = Trail(), 0.0
    for x, stays in ((0, 2.0), (3000, 0.1), (6000, 1.5 * STAYED), (9000, 0.5), (12000, 3.0)):
        for _ in range(4):
            trail.watch(at(x), now, 400)
            now += stays / 4
    trail.watch(at(15000), now, 400)
    assert trail.places == [at(0), at(6000), at(12000)]
    assert trail.step(at(15000), -1, 400) == at(12000)
    assert trail.step(at(12000), -1, 400) == at(6000)
    assert trail.step(at(6000), 1, 400) == at(12000)
    assert trail.step(at(12000), 1, 400) == at(15000)
    assert trail.step(at(15000), 1, 400) is None
    assert not trail.can_go_forward


def test_where_one_came_from_by_a_jump_is_not_counted_again(desk):
    """Standing long at both ends, there is still a way forward after a step back."""
    start, now = going.here(desk), 0.0
    mark = c.Bookmark("a", 9.0, (3 << 12, 5), (700, 700))
    for act in (lambda: going.go_to_bookmark(desk, mark), lambda: going.step(desk, -1)):
        for _ in range(3):
            going.watch(desk, now)
            now += 2 * STAYED
        act()
        landed(desk)
    for _ in range(3):
        going.watch(desk, now)
        now += 2 * STAYED
    assert exact(going.here(desk).place) == exact(start.place)
    assert desk.places.trail.can_go_forward
    assert len(desk.places.trail.places) == 2


def test_small_moves_make_no_new_place_and_new_ways_end_the_old():
    trail = Trail()
    for x in (0, 20, 40, 5000):
        trail.keep(at(x), 400)
    assert trail.places == [at(40), at(5000)]
    trail.step(at(5000), -1, 400)
    trail.keep(at(60), 400)
    assert trail.can_go_forward
    trail.keep(at(60, 3), 400)
    assert trail.places == [at(60), at(60, 3)]
    trail.forget()
    assert not trail.can_go_back
    assert trail.step(at(0), -1, 400) is None


def test_another_painting_begins_a_trail_anew(desk):
    desk.places.trail.keep(at(0), 400)
    desk.places.seek(desk.post, 0, Rect(0, 0, 9, 9), scene(0))
    desk.places.trail.keep(at(5000), 400)
    desk.places.seek(desk.post, 0, Rect(0, 0, 9, 9), scene(1))
    assert not desk.places.trail.places


# --- typed places ----------------------------------------------------------------------------------------------------


@given(standpoints(), LEVELS)
@settings(deadline=None, max_examples=40)
def test_a_place_that_is_copied_and_typed_is_the_same_pixel(here, elsewhere):
    text = place_text(here, here.level)
    other = Standpoint(Place(5, 7, 0), elsewhere, 0.25, 1.0)
    there = typed_standpoint(f"  {text} ", other, elsewhere, SIZE)
    assert there.place.pixel(here.level) == here.place.pixel(here.level)
    assert there.level == here.level
    assert there.fraction == (0.25 if elsewhere == here.level else 0.0)
    assert place_text(there, here.level) == text


def test_the_forms_of_a_typed_place():
    here = Standpoint(Place(5, 7, 0), 3, 0.25, 1.0)
    assert typed_standpoint("Level 12", here, 3, SIZE) == Standpoint(here.place, 12, 0.0, 1.0)
    assert typed_standpoint("−2.5", here, 3, SIZE) == Standpoint(here.place, -3, 0.5, 1.0)
    assert typed_standpoint("[12; 4096 -2048]", here, 3, SIZE).place.pixel(12) == (4096, -2048)
    assert exact(typed_standpoint("1, 3.5, -2.25", here, 3, SIZE).place) == (Fraction(7, 4), Fraction(-9, 8))
    whole = typed_standpoint("2, 0, 0, 746, 431", here, 3, SIZE)
    assert (whole.level, whole.fraction, whole.angle) == (2, 0.0, 0.0)


@pytest.mark.parametrize(
    "text", ["", "here", "1, 2", "1,2,3,4", "5000", "1, 2, x", "1, 1e9, 2", "1,2,3,0,5", "3, " + "9" * 2590 + ", 1"]
)
def test_what_is_no_place_is_told(desk, text):
    with pytest.raises(FieldError):
        typed_standpoint(text, Standpoint(Place(0, 0, 0), 0, 0.0), 0, SIZE)
    assert going.go_to_typed(desk, text).startswith("Expected ")
    assert not desk.glide.moving


# --- paint that is not in sight --------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("level", "nearest", "expected"),
    [
        (0, (0, 3000, 0), 0),  # across
        (2, (0, 900, 0), 2),  # near enough to be seen from here
        (60, (0, 900, 0), 0),  # too deep
        (0, (9, 1 << 18, 1 << 17), 9),  # too small
        (0, (0, 1 << 90, 0), 0),  # far
    ],
)
def test_the_nearest_paint_comes_into_the_middle(desk, level, nearest, expected):
    desk.view = View(Place(512, 384, 0), level, 0.0, 1280, 800)
    area = Rect(0, 0, 700, 700)
    desk.places.seek(desk.post, level, area, None)
    desk.places.seek(desk.post, level, area, None)
    assert desk.post.__self__ == [q.Seek(level, area)]
    desk.places.sought = Sought(level, area, True)
    assert not desk.places.lost
    desk.places.sought = Sought(level, area, False, nearest)
    assert desk.places.lost
    going.go_to_nearest(desk)
    there = landed(desk)
    assert there.place.pixel(nearest[0]) == nearest[1:]
    assert (there.level, there.fraction) == (expected, 0.0)
    desk.places.seek(desk.post, level, area.grown(1), None)
    assert not desk.places.lost


def test_paint_of_the_map_is_seen_whole(desk):
    corner = 5**30
    going.go_to_spot(desk, Spot(40, Rect.at(corner, -corner, 256, 128), 2))
    there = landed(desk)
    assert there.place.pixel(40) == (corner + 128, 64 - corner)
    assert (there.level, there.fraction) == (40, 0.0)
    going.go_to_spot(desk, Spot(40, Rect.at(corner, corner, 9000, 128), 70))
    assert landed(desk).level == 36
    assert place_of_pixel(0, 0, 0) == Place(0, 0, 0)
