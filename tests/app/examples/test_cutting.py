"""Examples cut out of photographs: found, corrected by strokes, taken as examples of the artist's own."""

from queue import Queue

import numpy as np
import pytest
from examples_at_hand import named
from PIL import Image

from app.actions.actions import ACTIONS
from app.desk.examples import cutting_work, example_state, example_use, example_work
from app.input.events import PenEvent
from app.panels.examples.finding_panel import FindingPanel
from app.tools import painting_gestures
from engine.strokes.example_files import read_mask
from engine.studio.textures.cut_finder import CutFinder
from engine.studio.textures.cut_records import CutFound, FindCut


@pytest.fixture
def photo(tmp_path):
    """Two discs on paper, one larger than the other."""
    y, x = np.mgrid[:80, :120]
    inside = (np.hypot(y - 40, x - 36) < 25) | (np.hypot(y - 40, x - 92) < 15)
    colours = np.where(inside[..., None], (150, 40, 50), (235, 230, 215)).astype(np.uint8)
    Image.fromarray(colours).save(tmp_path / "fruit.png")
    return tmp_path / "fruit.png"


@pytest.fixture
def added(desk, photo):
    assert example_work.dropped(desk, photo)
    desk.examples.spot = (0.0, 0.0, 1.0)
    return desk.examples.finding


def answer(desk, posted):
    """The engine finds what was asked for last."""
    told = Queue()
    request = next(one for one in reversed(posted) if isinstance(one, FindCut))
    CutFinder(told.put).handlers[FindCut](request)
    while True:
        result = told.get(timeout=90)
        if isinstance(result, CutFound):
            cutting_work.hear(desk, result, 0.0)
            if result.pixels is not None:
                return


def marked(desk, *points, eraser=False, given_up=False):
    gesture = painting_gestures.mark_region(desk, PenEvent("down", *points[0], eraser=eraser))
    next(gesture)
    for point in points[1:]:
        gesture.send(PenEvent("move", *point))
    if given_up:
        gesture.close()
        return
    with pytest.raises(StopIteration):
        gesture.send(PenEvent("up", *points[-1]))


def test_a_dropped_photograph_is_looked_through_at_once(desk, posted, added):
    assert added is cutting_work.finding_of(desk)
    assert desk.examples.tab == "region"
    assert not added.settled
    answer(desk, posted)
    assert added.settled
    assert (added.found.things, added.found.whole) == (2, False)


def test_what_is_found_is_taken_as_examples_one_for_each_thing(desk, own, posted, added):
    answer(desk, posted)
    cutting_work.take_cut(desk)
    state = desk.examples
    assert [entry.name for entry in state.entries if entry.own] == ["fruit", "fruit 2"]
    assert (state.entry.name, state.tab, state.finding) == ("fruit", "palette", None)
    assert state.region is None  # it was of the whole picture
    large, small = (np.asarray(Image.open(own / f"{name}.png")) for name in ("fruit", "fruit 2"))
    assert large.shape[:2] == pytest.approx((58, 58), abs=6)
    assert small.shape[:2] == pytest.approx((38, 38), abs=6)
    assert large[0, 0, 3] == 0
    region = read_mask(own / "fruit.mask.png")
    assert region[large[..., 3] > 0].all()
    assert "2 examples" in desk.message[0]


def test_it_is_taken_as_soon_as_its_rim_is_found(desk, own, posted, added):
    cutting_work.take_cut(desk)
    assert added.taking
    assert desk.examples.finding is added
    answer(desk, posted)
    assert desk.examples.finding is None
    assert (own / "fruit 2.png").exists()


def test_strokes_say_what_is_kept_and_dropped_and_are_taken_back(desk, posted, added):
    answer(desk, posted)
    added.way = "drop"
    added.radius = 6.0
    marked(desk, (88.0, 40.0), (96.0, 40.0))
    assert not added.settled
    answer(desk, posted)
    assert added.found.pixels[40, 92, 3] == 0
    marked(desk, (5.0, 5.0), given_up=True)
    added.way = "keep"
    marked(desk, (30.0, 40.0), eraser=True)  # a pen's eraser drops
    assert [mark.keep for mark in added.marks] == [False, False]
    page = FindingPanel()
    assert page.takes(desk, ACTIONS["undo"])
    assert page.takes(desk, ACTIONS["undo"])
    assert not added.marks
    answer(desk, posted)
    assert added.found.things == 2
    assert page.takes(desk, ACTIONS["redo"])
    assert len(added.marks) == 1
    assert page.takes(desk, ACTIONS["larger"])
    assert added.radius > 6.0
    assert not page.takes(desk, ACTIONS["save"])


def test_what_was_told_of_other_marks_is_of_no_use(desk, added):
    added.hear(CutFound(added.ident, 3, 0.5, False))
    added.hear(CutFound("own other", 0, 0.5, False))
    assert added.found is None


def test_where_nothing_is_left_it_is_said(desk, posted, added):
    answer(desk, posted)
    added.radius = 200.0
    added.way = "drop"
    marked(desk, (0.0, 40.0), (119.0, 40.0))
    answer(desk, posted)
    cutting_work.take_cut(desk)
    assert desk.message[1]
    assert desk.examples.finding is added


def test_by_hand_the_picture_stays_whole(desk, own, posted, added):
    cutting_work.leave(desk)
    assert cutting_work.finding_of(desk) is None
    assert desk.examples.region.scene.inside.all()
    assert posted[-1].pixels.size == 0
    assert np.asarray(Image.open(own / "fruit.png")).shape == (80, 120, 4)


def test_of_an_example_that_stays_copies_are_cut_out(desk, own, posted):
    example_use.choose(desk, named(desk, "felt"))
    example_work.edit(desk)
    cutting_work.find(desk)
    assert not cutting_work.finding_of(desk).fresh
    answer(desk, posted)
    cutting_work.take_cut(desk)
    assert desk.examples.entry.own
    assert named(desk, "felt") is not None
    assert example_state.bundled_folder() not in desk.examples.entry.picture.parents
