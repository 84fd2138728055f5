"""The symmetry in hand: about a place of the canvas, whatever the view, at any depth."""

import math
from dataclasses import replace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from immutables import Map

from app.actions.actions import ACTIONS, perform
from app.canvas.view import Place, View
from app.desk.desk import Desk
from app.desk.guides import symmetry
from app.desk.guides.guide_sight import clipped
from app.desk.guides.guide_state import Held
from app.input.events import PenEvent
from app.tools.guide_gestures import move_guide
from engine.numeric.address import Rect
from engine.painting.commands import Guide, Redo, Undo
from engine.studio.requests import Do, Save
from engine.studio.results import Scene

DEEP = 1 << 900


def desk_of(view=None):
    posted = []
    desk = Desk(view or View(Place(DEEP, -DEEP, 0), 40, 0.25, 800, 600, 0.7, True), posted.append)
    tell(desk)
    return desk, posted


def tell(desk, *guides):
    told = Scene(Rect(0, 0, 64, 64), (), None, False, False, False, None, guides=guides)
    desk.learn(scene=told)


@pytest.mark.parametrize("name", [name for name in symmetry.WAYS if name != "off"])
def test_a_way_that_is_chosen_is_the_way_that_it_is(name):
    desk, posted = desk_of()
    symmetry.choose(desk, name)
    (made,) = (request.command for request in posted)
    assert symmetry.way_of(made) == name
    tell(desk, made)
    symmetry.choose(desk, "off")
    off = posted[-1].command
    assert symmetry.way_of(off) == "off"
    tell(desk, off)
    symmetry.toggle(desk)
    assert posted[-1].command == made
    symmetry.choose(desk, name)
    assert posted[-1].command == made


@settings(deadline=None)
@given(
    st.floats(-3, 3),
    st.booleans(),
    st.integers(-60, 60),
    st.integers(2, 12),
    st.tuples(st.integers(60, 740), st.integers(60, 540)),
)
def test_copies_lie_where_the_screen_shows_them(angle, mirrored, level, count, at):
    """A copy of a point on the canvas is seen where the same copy on the screen is."""
    desk, posted = desk_of(View(Place(DEEP, DEEP, 0), level, 0.3, 800, 600, angle, mirrored))
    symmetry.choose(desk, "kaleidoscope")
    guide = replace(posted[-1].command, count=count)
    symmetry.set_symmetry(desk, guide)
    shown = desk.view.shown_level
    origin = desk.view.to_canvas(*at).pixel(shown)
    x, y = desk.view.to_canvas(*at).offset(shown, *origin)
    cx, cy = desk.view.to_screen(symmetry.centre_of(guide))
    seen = []
    for copy in symmetry.copies_at(desk, shown, origin):
        there = copy.moved(x, y)
        px, py = desk.view.pixel_to_screen(shown, *origin)
        a, b, c, d = desk.view.matrix()
        scale = desk.view.scale(shown)
        seen.append((px + (a * there[0] + b * there[1]) * scale, py + (c * there[0] + d * there[1]) * scale))
    drawn = [copy.moved(at[0] - cx, at[1] - cy) for copy in symmetry.on_screen(desk.view, guide)]
    drawn = [(cx + right, cy + down) for right, down in drawn]
    assert len(seen) == 2 * count - 1
    for place in drawn:
        assert min(math.dist(place, other) for other in seen) < 0.05


def test_where_the_centre_is_too_far_away_nothing_is_copied_and_that_is_said():
    desk, posted = desk_of()
    symmetry.choose(desk, "mirror")
    tell(desk, posted[-1].command)
    desk.view = replace(desk.view, level=80)
    far = desk.view.to_canvas(0, 0).moved(2.0**30, 0.0, desk.view.shown_level).pixel(desk.view.shown_level)
    assert symmetry.copies_at(desk, desk.view.shown_level, far) == ()
    assert "symmetry_here" in desk.message.offers
    symmetry.bring_here(desk)
    tell(desk, posted[-1].command)
    near = desk.view.to_canvas(20, 20).pixel(desk.view.shown_level)
    assert len(symmetry.copies_at(desk, desk.view.shown_level, near)) == 1


def drag(desk, *places):
    gesture = move_guide(desk, PenEvent("down", *places[0]))
    next(gesture)
    for place in places[1:]:
        gesture.send(PenEvent("move", *place))
    return gesture


def test_its_handles_are_dragged_in_one_step_and_escape_gives_up():
    desk, posted = desk_of()
    symmetry.choose(desk, "kaleidoscope")
    before = posted[-1].command
    tell(desk, before)
    centre, end = symmetry.handles(desk, before)
    gesture = drag(desk, centre, (300.5, 200.0))
    assert symmetry.handles(desk, symmetry.guide_of(desk))[0] == pytest.approx((300.5, 200.0), abs=0.01)
    gesture.close()
    assert symmetry.guide_of(desk) == before
    assert len(posted) == 1
    desk.pointer.shift = True
    gesture = drag(desk, end, (centre[0] + 170, centre[1] + 20))
    with pytest.raises(StopIteration):
        gesture.send(PenEvent("up", centre[0] + 170, centre[1] + 20))
    assert len(posted) == 2
    turned = posted[-1].command
    assert isinstance(posted[-1], Do)
    assert isinstance(turned, Guide)
    x, y = symmetry.direction(turned)
    assert math.degrees(math.atan2(y, x)) / 15 == pytest.approx(round(math.degrees(math.atan2(y, x)) / 15), abs=1e-3)
    assert desk.guides.held == Held(turned, 0)
    timed = replace(turned, extra=Map({"time": 7.5}))  # as the journal has it
    tell(desk, timed)
    assert symmetry.guide_of(desk) == timed
    assert desk.guides.held is None


def test_lines_end_at_the_rims_of_the_screen():
    assert clipped(((50, 50), (1, 0)), (100, 80), 0.0) == ((50, 50), (100, 50))
    assert clipped(((-50, 40), (1, 0)), (100, 80), 0.0) == ((0, 40), (100, 40))
    assert clipped(((-50, 40), (-1, 0)), (100, 80), 0.0) is None
    assert clipped(((-50, 40), (-1, 0)), (100, 80)) == ((100, 40), (0, 40))
    assert clipped(((50, 200), (0.0, -1.0)), (100, 80), 0.0) == ((50, 80), (50, 0))


def test_steps_taken_back_leave_it_as_it_is_until_a_stroke_makes_it_the_paintings_again():
    desk, posted = desk_of()
    symmetry.choose(desk, "radial")
    made = posted[-1].command
    tell(desk, made)
    desk.learn(ready=True, scene=replace(desk.known.scene, can_undo=True, can_redo=True))
    for name, told in (("undo", Undo()), ("redo", Redo())):
        perform(desk, ACTIONS[name])
        assert posted[-1] == Do(told, over_symmetry=True)
    tell(desk)  # the steps before it was chosen
    assert symmetry.guide_of(desk) == made
    assert len(posted) == 3
    symmetry.restore(desk)
    assert posted[-1] == Do(made)
    symmetry.restore(desk)
    assert len(posted) == 4
    tell(desk, made)
    symmetry.toggle(desk)
    tell(desk, made)  # an older word: what the hand did last counts
    assert symmetry.way_of(symmetry.guide_of(desk)) == "off"
    desk.learn(scene=replace(desk.known.scene, serial=1))
    assert symmetry.guide_of(desk) == made  # another painting has its own


def test_a_save_after_steps_taken_back_stores_the_symmetry_of_the_hand(tmp_path):
    desk, posted = desk_of()
    symmetry.choose(desk, "radial")
    made = posted[-1].command
    tell(desk, made)
    desk.save(tmp_path / "a.ora")
    assert posted[-1] == Save(tmp_path / "a.ora")
    symmetry.keep(desk)
    tell(desk)
    desk.save(tmp_path / "a.ora")
    assert posted[-1] == Save(tmp_path / "a.ora", symmetry=made)
    desk.learn(scene=replace(desk.known.scene, serial=1))
    desk.save(tmp_path / "a.ora", sure=True)
    assert posted[-1] == Save(tmp_path / "a.ora", sure=True)


@pytest.mark.parametrize(("end", "way"), [((30, -40), "slanted"), ((100, 1), "level"), ((1, -100), "mirror")])
def test_an_axis_is_called_by_its_angle(end, way):
    assert symmetry.way_of(Guide("s", "symmetry", 0, (0, 0), ((0, 0), end), mirror=True)) == way
