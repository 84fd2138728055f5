"""What is dragged, drawn by the card: where its sheets lie, and what they show."""

import math
from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from app.canvas.screen import Screen
from app.canvas.sheet_pass import MOVED, Quad, SheetPass, SheetPlan
from app.canvas.view import Place, View, dyadic_place
from app.desk.moving.sheet_state import Carried, SheetState
from engine.canvas.placing.pose import UNMOVED, Pose
from engine.numeric.address import Rect
from engine.numeric.similarity import Dyadic
from engine.studio.moving.sheet_records import AskSheets, AskShown, CarriedSheet, CarriedSheets, DropSheets, Shown

SIZE = 320, 240
QUARTERS = st.builds(
    Pose,
    at=st.tuples(st.integers(-90, 90), st.integers(-90, 90)),
    levels=st.integers(-2, 2),
    turn=st.integers(0, 3),
    mirror=st.booleans(),
)
ANY = st.builds(
    lambda pose, angle, scale: Pose(
        pose.at, 0, pose.levels, 0, (scale * math.cos(angle), scale * math.sin(angle)), pose.mirror
    ),
    QUARTERS,
    st.floats(0, 6),
    st.floats(0.6, 1.6),
)


def row(pose=UNMOVED, name="A"):
    return SimpleNamespace(name=name, shows=SimpleNamespace(pose=pose), visible=True)


def view(level=0, fraction=0.0, centre=Place(0, 0, 0), angle=0.0):  # noqa: B008  # frozen
    return View(centre, level, fraction, *SIZE, angle)


KNOWN = SimpleNamespace(scene=object())


def asked(at, one, rect=Rect(-20, -30, 40, 50)):  # noqa: B008  # frozen
    """A state that has its sheets, and what it posted."""
    state, posts = SheetState(), []
    for now in (0.0, 1.0):
        state.wants(posts.append, KNOWN, one, at, now)
    pixels = np.full((rect.height, rect.width, 4), 255, np.uint8)
    sheets = CarriedSheet(rect, None), CarriedSheet(rect, pixels), CarriedSheet(rect, None)
    state.come(CarriedSheets(posts[-1].number, at.shown_level, sheets))
    return state, posts


@settings(max_examples=40, deadline=None)
@given(QUARTERS, st.one_of(QUARTERS, ANY), st.sampled_from([(0, 0.0), (2, 0.3), (-3, 0.6), (300, 0.25)]), st.booleans())
def test_what_is_moved_is_seen_where_its_pose_takes_it(before, after, zoom, turned):
    level, fraction = zoom
    far = 7 << 301
    at = view(level, fraction, Place(far, -far, 300), 0.3 * turned)
    deep = Pose((after.at[0] + far, after.at[1] - far), 300, after.levels - 300, after.turn, after.turned, after.mirror)
    was = Pose((before.at[0] + far, before.at[1] - far), 300, before.levels - 300, before.turn, None, before.mirror)
    x, y = at.centre.pixel(at.shown_level)
    rect = Rect(x - 20, y - 30, x + 40, y + 50)
    state, _ = asked(at, row(was), rect)
    assert state.carry(KNOWN, row(was), at, Carried(deep, Dyadic.of(3, 5), False))
    quad = next(quad for quad in state.plan().quads if quad.sheet == MOVED)
    (cx, cy), (ax, ay), (bx, by) = quad.corner, quad.across, quad.down
    for u, v in ((0, 0), (1, 0), (0, 1), (1, 1)):
        corner = Dyadic.of(rect.x0 + u * rect.width, rect.y0 + v * rect.height, at.shown_level)
        wanted = at.to_screen(dyadic_place(deep.similarity(was.similarity.inverse()(corner))))
        np.testing.assert_allclose((cx + u * ax + v * bx, cy + u * ay + v * by), wanted, atol=0.51, rtol=1e-6)


def test_they_are_asked_for_once_the_view_rests_and_let_go_of_with_the_tool():
    state, posts = SheetState(), []
    state.wants(posts.append, KNOWN, row(), view(), 0.0)
    state.wants(posts.append, KNOWN, row(), view(1), 0.1)
    state.wants(posts.append, KNOWN, row(), view(1), 0.2)
    assert posts == []
    state.wants(posts.append, KNOWN, row(), view(1), 0.3)
    state.wants(posts.append, KNOWN, row(), view(1), 9.0)
    (one,) = posts
    assert isinstance(one, AskSheets)
    assert one.rect == view(1).visible(1)
    assert one.around.intersect(one.rect) == one.rect
    state.wants(posts.append, SimpleNamespace(scene=object()), row(), view(1), 9.1)
    state.wants(posts.append, KNOWN, None, view(1), 9.4)
    assert posts[1:] == [DropSheets()]


def test_what_was_let_go_is_seen_until_the_engine_has_shown_it_and_no_longer():
    state, posts = asked(view(), row())
    carried = Carried(Pose((5, 5)), Dyadic.of(0, 0), False)
    assert not state.carry(KNOWN, row(name="B"), view(), carried)
    assert not state.carry(SimpleNamespace(scene=object()), row(), view(), carried)
    assert not state.carry(KNOWN, row(), view(1), carried)
    assert state.carry(KNOWN, row(), view(), carried)
    state.end(posts.append)
    assert posts[-1] == AskShown(posts[-1].number)
    state.shown(Shown(posts[-1].number - 1))
    assert state.plan() is not None
    state.wants(posts.append, KNOWN, row(), view(), 50.0)
    state.shown(Shown(posts[-1].number))
    assert state.plan() is None


def test_sheets_that_cannot_be_told_apart_carry_nothing():
    state, posts = asked(view(), row())
    state.come(CarriedSheets(posts[-1].number, 0, None))
    assert not state.carry(KNOWN, row(), view(), Carried(UNMOVED, Dyadic.of(0, 0), False))


@pytest.mark.parametrize("twice", [False, True])
def test_the_card_shows_them_over_one_another_pixel_for_pixel_where_they_are_moved_by_pixels(context, twice):
    rng, at, rect = np.random.default_rng(3), view(), Rect(-30, -20, 50, 40)
    pixels = rng.integers(0, 256, (3, rect.height, rect.width, 4), dtype=np.uint8)
    pixels[..., 3] = 255
    pixels[2, :, 20:] = 0
    state, posts = asked(at, row())
    state.come(CarriedSheets(posts[-1].number, 0, tuple(CarriedSheet(rect, one) for one in pixels)))
    assert state.carry(KNOWN, row(), at, Carried(Pose((7, -4)), Dyadic.of(0, 0), twice))
    screen, drawn = Screen(context), SheetPass(context)
    target = context.simple_framebuffer(SIZE)
    target.use()
    target.clear()
    paper = screen.bare(at, rect, (0, 0, 0, 0), None)
    assert (len(paper.paper), paper.light) == (4, None)
    screen.draw(paper)
    drawn.draw(state.plan(), at, (0, 0, 0, 0))
    found = np.frombuffer(target.read(), np.uint8).reshape(SIZE[1], SIZE[0], 3)[::-1]
    target.release()
    drawn.keep(None)
    wanted = (pixels[1] if twice else pixels[0])[..., :3].copy()
    wanted[:-4, 7:] = pixels[1, 4:, :-7, :3]
    wanted[:, :20] = pixels[2, :, :20, :3]
    x, y = SIZE[0] // 2 + rect.x0, SIZE[1] // 2 + rect.y0
    np.testing.assert_array_equal(found[y : y + rect.height, x : x + rect.width], wanted)


@pytest.mark.parametrize(("alpha", "beside", "hidden"), [(255, 0, True), (255, 1, False), (254, 0, False)])
def test_no_paper_is_drawn_where_an_opaque_sheet_covers_it_and_nobody_sees_that(context, alpha, beside, hidden):
    rng, at = np.random.default_rng(5), view()
    x, y = SIZE[0] // 2, SIZE[1] // 2
    rect = Rect(beside - x, -y, SIZE[0] - x, SIZE[1] - y)
    pixels = rng.integers(0, 255, (3, rect.height, rect.width, 4), dtype=np.uint8)
    pixels[..., 3], pixels[2], pixels[0, 3, 3] = 255, 0, alpha
    plan = SheetPlan(
        CarriedSheets(1, 0, tuple(CarriedSheet(rect, one) for one in pixels)),
        tuple(
            Quad(n, (float(beside + 9 * (n == 1)), 0.0), (float(rect.width), 0.0), (0.0, float(rect.height)))
            for n in range(3)
        ),
    )
    screen, drawn = Screen(context), SheetPass(context)
    assert drawn.hides(plan, at) is hidden
    pictures = []
    for left_out in (hidden, False):
        target = context.simple_framebuffer(SIZE)
        target.use()
        screen.draw(screen.bare(at, rect, (0, 0, 0, 0), None, left_out))
        drawn.draw(plan, at, (0, 0, 0, 0))
        pictures.append(target.read())
        target.release()
    drawn.keep(None)
    assert pictures[0] == pictures[1]
