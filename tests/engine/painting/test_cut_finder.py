"""What lies on a ground, found beside the engine's thread: the newest request counts, and its pictures are told."""

from queue import Queue
from threading import Event

import numpy as np
import pytest

from engine.studio.results import PicturePart
from engine.studio.textures.cut_finder import CutFinder
from engine.studio.textures.cut_records import CutFound, FindCut
from engine.studio.textures.region_strokes import DIM, TINT
from engine.texture.mattes.marks import Mark

SIDE = 90


@pytest.fixture(scope="module")
def pixels():
    """Two discs on paper."""
    y, x = np.mgrid[:SIDE, :SIDE]
    inside = (np.hypot(y - 30, x - 28) < 18) | (np.hypot(y - 62, x - 64) < 14)
    out = np.full((SIDE, SIDE, 4), 255, np.uint8)
    out[..., :3] = np.where(inside[..., None], (150, 40, 50), (235, 230, 215))
    out.flags.writeable = False
    return out


class Heard:
    def __init__(self):
        self.told, self.goes_on = Queue(), Event()
        self.goes_on.set()
        self.finder = CutFinder(self.hear)
        self.shown = np.zeros((SIDE, SIDE, 3), np.uint8)

    def hear(self, result):
        """Takes what is told, on the thread that finds it, which waits for that."""
        self.goes_on.wait(90)
        self.told.put(result)

    def ask(self, *request):
        self.finder.handlers[FindCut](FindCut("own leaf", *request))

    def until(self, marks):
        """What is told last of so many marks, and all before it."""
        found = []
        while True:
            result = self.told.get(timeout=90)
            if isinstance(result, PicturePart):
                assert result.ident == "cut own leaf"
                assert result.size == (SIDE, SIDE)
                self.shown[result.area.y0 : result.area.y1, result.area.x0 : result.area.x1] = result.pixels
                continue
            assert isinstance(result, CutFound)
            found.append(result)
            if result.pixels is not None and result.marks == marks:
                return found


def test_it_is_told_as_far_as_it_is_found_and_shown_under_a_veil(pixels):
    heard = Heard()
    heard.ask(pixels)
    told = heard.until(0)
    assert told[0].pixels is None
    assert [one.done for one in told] == sorted(one.done for one in told)
    last = told[-1]
    assert (last.done, last.things, last.whole, last.ident) == (1.0, 2, False, "own leaf")
    assert not last.pixels.flags.writeable
    inside, outside = last.pixels[..., 3] == 255, last.pixels[..., 3] == 0
    assert np.array_equal(heard.shown[inside], pixels[inside][:, :3])
    dimmed = TINT + DIM * (pixels[outside][:, :3].astype(np.float32) - TINT)
    assert np.abs(heard.shown[outside] - dimmed).max() <= 1


def test_marks_change_it_and_it_is_shown_without_the_ground(pixels):
    heard = Heard()
    heard.ask(pixels)
    before = heard.until(0)[-1].pixels
    mark = Mark(False, ((64.0, 62.0), (66.0, 62.0)), 6.0)
    heard.ask(pixels, (mark,))
    dropped = heard.until(1)[-1]
    assert dropped.pixels[62, 64, 3] == 0
    assert np.array_equal(dropped.pixels[30, 28], before[30, 28])
    heard.ask(pixels, (mark,), True)
    bare = heard.until(1)[-1]
    assert np.array_equal(bare.pixels, dropped.pixels)
    assert heard.shown[2, 2].min() > 190  # the checker
    # All marks taken back: as at first.
    heard.ask(pixels)
    assert np.array_equal(heard.until(0)[-1].pixels, before)


def test_only_the_newest_request_is_carried_out_to_the_end(pixels):
    heard = Heard()
    marks = tuple(Mark(True, ((10.0 + 3 * n, 80.0),), 3.0) for n in range(6))
    heard.goes_on.clear()  # none is quicker than the next is asked for
    for count in range(len(marks)):
        heard.ask(pixels, marks[:count])
    heard.ask(pixels, marks)
    heard.goes_on.set()
    told = heard.until(len(marks))
    assert len({one.marks for one in told if one.pixels is not None}) == 1
    heard.ask(np.zeros((0, 0, 4), np.uint8))
    heard.ask(pixels)
    assert heard.until(0)[-1].things == 2
