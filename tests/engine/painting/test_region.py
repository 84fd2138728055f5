"""A region painted on the engine's thread: steps, taken back and again, seen as they are, told as they were."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from immutables import Map

from engine.numeric.address import Rect
from engine.strokes.example_region import followed
from engine.studio import results
from engine.studio.textures import texture_requests as tq
from engine.studio.textures import texture_results as tr
from engine.studio.textures.region_strokes import KEPT, Regions, over_paper, region_picture

HEIGHT, WIDTH = 40, 60
WHOLE = Rect(0, 0, WIDTH, HEIGHT)
EVERYTHING, INVERT, SMOOTH = Map({"all": True}), Map({"invert": True}), Map({"smooth": True})


class Post:
    """The engine's side of the post, and what came of it: the scene and the picture as the window has them."""

    def __init__(self, steps=(), first=None):
        random = np.random.default_rng(1)
        self.picture = np.ones((4, HEIGHT, WIDTH), np.float32)
        self.picture[:3] = random.integers(0, 255, (3, HEIGHT, WIDTH)).astype(np.float32) / 255
        self.picture[:, ::3, ::2] *= np.float32(0.35)
        self.first = np.zeros((HEIGHT, WIDTH), bool) if first is None else first
        self.regions, self.sent = Regions(self._take), []
        self.scene, self.seen = None, np.zeros((HEIGHT, WIDTH, 3), np.uint8)
        self(tq.RegionOpen("a", self.picture, self.first, steps))

    def __call__(self, *requests):
        for request in requests:
            self.regions.handlers[type(request)](request)
        while self.regions.pending:
            self.regions.step()
        return self.scene

    def _take(self, result):
        self.sent.append(result)
        if isinstance(result, tr.RegionScene):
            self.scene = result
        else:
            self.seen[result.area.slices(WHOLE)] = result.pixels

    def do(self, *steps):
        return self(*(tq.RegionDo("a", step) for step in steps))

    def stroke(self, *points, op="add", radius=4.0, kept=True):
        rows = [np.array([[x, y, 1.0, 0.0, 0.0, 0.0]]) for x, y in points]
        return self(
            tq.RegionBegin("a", op, radius),
            *map(tq.RegionPoints, rows),
            tq.RegionEnd(kept),
        )

    def meant(self):
        """What the steps mean to whoever replays them."""
        return followed(self.first, self.scene.steps, self.picture)


def test_a_stroke_is_a_step_that_is_taken_back_and_again():
    post = Post()
    one = post.stroke((10, 20), (50, 20))
    assert one.inside[20, 10:50].all()
    assert (one.can_undo, one.can_redo, one.modified, len(one.steps)) == (True, False, True, 1)
    back = post(tq.RegionTravel("a", -1))
    assert not back.inside.any()
    assert (back.can_undo, back.can_redo, back.modified, back.steps) == (False, True, False, ())
    again = post(tq.RegionTravel("a", 1))
    assert np.array_equal(again.inside, one.inside)
    assert again.steps == one.steps


def test_a_stroke_is_seen_before_the_pen_lifts_and_leaves_nothing_if_it_is_dropped():
    post = Post()
    before = post.seen.copy()
    post(
        tq.RegionBegin("a", "add", 4.0),
        tq.RegionPoints(np.array([[30.0, 20.0, 1, 0, 0, 0]])),
    )
    assert not np.array_equal(post.seen, before)
    assert post.scene.steps == ()
    scene = post(tq.RegionEnd(False))
    assert np.array_equal(post.seen, before)
    assert not scene.inside.any()
    assert not scene.can_undo
    post(tq.RegionPoints(np.array([[30.0, 20.0, 1, 0, 0, 0]])), tq.RegionEnd())  # of a stroke that was dropped
    assert not post.scene.can_undo


def test_another_tolerance_takes_the_place_of_the_step():
    post = Post()
    like = {"op": "add", "like": Map({"at": (5, 5), "tolerance": 0.1, "contiguous": False})}
    one = post.do(EVERYTHING, INVERT, Map(like))
    wide = Map({**like, "like": like["like"].set("tolerance", 1.0)})
    other = post(tq.RegionDo("a", wide, True))
    assert other.inside.sum() > one.inside.sum()
    assert other.steps == (EVERYTHING, INVERT, wide)
    assert not post(tq.RegionTravel("a", -1)).inside.any()


def test_only_the_last_of_many_changes_is_shown():
    post = Post()
    post.sent.clear()
    post.do(*[INVERT] * 9)
    assert [type(result) for result in post.sent] == [results.PicturePart, tr.RegionScene]
    assert post.scene.inside.all()


def test_what_was_saved_counts_as_saved_under_its_new_name():
    post = Post()
    steps = post.stroke((10, 10)).steps
    post.do(INVERT)
    post.seen[:] = 0
    scene = post(tq.RegionSaved("a", "b", steps))
    assert (scene.ident, scene.modified) == ("b", True)
    assert post.seen.any()
    assert not post(tq.RegionTravel("b", -1)).modified
    post(tq.RegionDo("a", INVERT))  # it is not there any more
    assert post.scene.ident == "b"


def test_steps_from_a_file_can_be_taken_back_and_all_of_them_however_many():
    told = Post()
    told.stroke((10, 10), (20, 30))
    told.do(*[INVERT] * (KEPT + 20))
    post = Post(told.scene.steps)
    assert np.array_equal(post.scene.inside, told.scene.inside)
    assert not post.scene.modified
    for one in (told, post):
        count = len(one.scene.steps)
        for k in range(count):
            scene = one(tq.RegionTravel("a", -1))
            assert len(scene.steps) == count - k - 1
        assert not scene.can_undo
        assert np.array_equal(scene.inside, one.first)


POINT = st.tuples(st.integers(-10, 70), st.integers(-10, 50))
CHANGE = st.one_of(
    st.tuples(st.just("stroke"), st.lists(POINT, min_size=1, max_size=4), st.sampled_from(["add", "subtract"])),
    st.tuples(st.just("do"), st.sampled_from([EVERYTHING, INVERT, SMOOTH, Map({"alpha": True})])),
    st.tuples(st.just("travel"), st.integers(-3, 3)),
    st.tuples(st.just("drop"), st.lists(POINT, min_size=1, max_size=4)),
)


@settings(deadline=None, max_examples=40)
@given(st.lists(CHANGE, max_size=12), st.booleans())
def test_whatever_is_done_the_steps_mean_what_is_seen_and_undo_takes_all_of_it_back(changes, full):
    post = Post(first=np.full((HEIGHT, WIDTH), full))
    for kind, *about in changes:
        if kind == "stroke":
            post.stroke(*about[0], op=about[1])
        elif kind == "do":
            post.do(about[0])
        elif kind == "travel":
            post(tq.RegionTravel("a", about[0]))
        else:
            post.stroke(*about[0], kept=False)
        assert np.array_equal(post.scene.inside, post.meant())
        assert np.array_equal(post.seen, region_picture(over_paper(post.picture), post.scene.inside, WHOLE))
    last = post.scene
    steps = len(last.steps)
    assert np.array_equal(post(tq.RegionTravel("a", -steps)).inside, post.first)
    again = post(tq.RegionTravel("a", steps))
    assert np.array_equal(again.inside, last.inside)
    assert again.steps == last.steps


def test_what_is_outside_is_dimmed_and_the_edge_is_light():
    flat, inside = np.full((HEIGHT, WIDTH, 3), 200, np.uint8), np.zeros((HEIGHT, WIDTH), bool)
    inside[10:30, 10:30] = True
    seen = region_picture(flat, inside, WHOLE).astype(int)
    assert (seen[12:28, 12:28] == 200).all()
    assert (seen[0:8] < 100).all()
    assert (seen[15, 9] > 200).all()


def test_holes_show_the_paper():
    picture = np.zeros((4, 16, 16), np.float32)
    assert np.unique(over_paper(picture)).tolist() == [198, 226]
    picture[3] = 1.0
    assert not over_paper(picture).any()


@pytest.mark.parametrize("ident", ["a", "b"])
def test_a_region_that_was_opened_before_is_as_it_was_left(ident):
    post = Post()
    left = post.stroke((10, 10), (20, 30)).inside
    post(
        tq.RegionOpen("b", post.picture, post.first),
        tq.RegionOpen(ident, post.picture, post.first),
    )
    assert np.array_equal(post.scene.inside, left if ident == "a" else post.first)
