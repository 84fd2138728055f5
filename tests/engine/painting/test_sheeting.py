"""What lies below something, itself and what lies above it: laid over one another they are what is seen."""

import numpy as np
import pytest

from engine.numeric.address import Rect
from engine.numeric.colour import to_premul8
from engine.painting import commands as c
from engine.session.session import Session
from engine.studio import requests as q
from engine.studio.moving.around import stacks_around
from engine.studio.moving.sheet_records import AskSheets, AskShown, CarriedSheets, DropSheets, Shown
from engine.studio.results import Patch
from engine.studio.studio import Studio

SEEN, AROUND = Rect(-20, -10, 90, 70), Rect(-60, -40, 130, 110)


def stroke(layer, x, colour="#306080"):
    brush = {"radius": 14, "colour": colour, "opacity": 0.8}
    return {"do": "stroke", "layer": layer, "points": [[x, 0], [x + 40, 60]], "brush": brush}


def add(name, **members):
    return {"do": "layer", "add": name, **members}


def change(name, **members):
    return {"do": "layer", "set": name, **members}


TREE = (
    add("Ground"), stroke("Ground", 0), add("Mixed"), stroke("Mixed", 10, "#c0c020"), change("Mixed", blend="multiply"),
    add("Group", kind="group"), add("Inner", group="Group"), stroke("Inner", 20, "#a03030"),
    add("Beside", group="Group"), stroke("Beside", 35, "#20a040"), change("Beside", opacity=0.5),
    add("Top", group=None), stroke("Top", 5, "#f0e040"), change("Top", opacity=0.7),
)  # fmt: skip


class Window:
    def __init__(self, *commands):
        self.told = []
        self.studio = Studio(self.told.append, lambda request: None)
        for command in commands:
            self.studio.do(q.Do(c.parse(command)))

    def answers(self, *requests):
        self.told.clear()
        for request in requests:
            self.studio.do(request)
        while self.studio.pending:
            self.studio.step()
        return [told for told in self.told if isinstance(told, CarriedSheets | Shown | Patch)]


@pytest.fixture(scope="module")
def window():
    return Window(*TREE)


@pytest.mark.parametrize("name", ["Ground", "Mixed", "Inner", "Beside", "Group", "Top"])
@pytest.mark.parametrize("level", [-1, 0])
def test_laid_over_one_another_they_are_what_is_seen(window, name, level):
    seen, around = SEEN.zoomed(level), AROUND.zoomed(level)
    (told,) = window.answers(AskSheets(7, name, level, seen, around))
    assert (told.number, told.level) == (7, level)
    if name in ("Ground", "Mixed"):
        assert told.sheets is None  # one takes its look from what lies below it
        return
    out = np.zeros((4, seen.height, seen.width))
    for sheet in told.sheets:
        if sheet.pixels is not None:
            here = np.zeros((4, seen.height, seen.width))
            part = sheet.rect.intersect(seen)
            here[:, *part.slices(seen)] = np.moveaxis(sheet.pixels[part.slices(sheet.rect)], -1, 0)
            out = here + out * (1 - here[3] / 255)
    wanted = to_premul8(window.studio.easel.picture(level, seen))
    assert wanted.any()
    np.testing.assert_allclose(np.moveaxis(out, 0, -1), wanted, atol=2)
    assert told.sheets[1].rect.intersect(around) == told.sheets[1].rect


@pytest.mark.parametrize(
    "more",
    [
        [change("Top", blend="multiply")],
        [change("Beside", clip=True)],
        [change("Inner", visible=False)],
        [change("Inner", blend="screen")],
        [
            add("Lowest", group="Group"),
            {"do": "layer", "move": "Lowest", "to": 0, "group": "Group"},
            change("Lowest", blend="multiply"),
        ],
        [change("Group", opacity=0.5)],
        [add("Again", kind="placement", of="Inner", at=[40, 0], group=None)],
        [add("Itself", kind="placement", of=None, at=[9, 9], levels=-1, rect=[0, 0, 0, 90, 90], group=None)],
    ],
)
def test_what_cannot_be_told_apart_is_not(more):
    session = Session()
    for command in (*TREE, *more):
        session.do(c.parse(command))
    assert stacks_around(session.painting.root, "Inner") is None


def test_what_is_gone_or_too_large_is_not_and_what_nobody_wants_is_not_made(window):
    huge = Rect(0, 0, 1 << 13, 1 << 13)
    for one in (AskSheets(1, "Nobody", 0, SEEN, AROUND), AskSheets(1, "Top", 0, SEEN, huge)):
        assert [told.sheets for told in window.answers(one)] == [None]
    assert window.answers(AskSheets(1, "Top", 0, SEEN, AROUND), DropSheets()) == []


def test_that_all_is_shown_is_told_after_the_last_tile(window):
    tiles = q.Look(tuple((0, x, 0, -1) for x in range(-1, 3)))
    window.told.clear()
    window.studio.look(tiles)
    told = window.answers(AskSheets(2, "Top", 0, SEEN, AROUND), AskShown(5))
    assert [type(one) for one in told] == [Patch] * 4 + [Shown, CarriedSheets]
