"""A texture while it is written: what the engine tells of it, piece by piece."""

from types import SimpleNamespace

import numpy as np
import pytest
from immutables import Map

from engine.painting.commands import DefineTexture
from engine.painting.value import Painting
from engine.session.session import Session
from engine.studio.workshop import workshop
from engine.studio.workshop import workshop_records as wr
from engine.studio.workshop.workshop import Workshop
from engine.texture.expression.written import WrittenError

WALL = """brick = pick(#8a3a2a)
worn = slider(0.4, 0, 1)
wall = bricks(x*4, y*8, 0.12)
mix(#b0a898, brick * (1 - worn), wall)
"""
SIZE = (160, 96)


class Room:
    """The workshop, and what it told."""

    def __init__(self):
        self.sent = []
        self.easel = SimpleNamespace(send=self.sent.append, live=None)
        self.workshop = Workshop(self.easel)

    def ask(self, request):
        self.sent.clear()
        self.workshop.handlers[type(request)](request)
        while self.workshop.pending:
            self.workshop.step()
        return self.sent

    def scene(self, text, **told):
        return [one for one in self.ask(wr.WorkshopSet(text, size=SIZE, **told)) if isinstance(one, wr.WorkshopScene)][
            -1
        ]

    def pictures(self):
        return {one.ident: one.pixels for one in self.sent if hasattr(one, "ident")}


@pytest.fixture
def room():
    return Room()


def test_a_text_is_told_line_by_line(room):
    scene = room.scene(WALL)
    assert scene.mistake is None
    assert [(line.name, line.row, line.coloured) for line in scene.lines] == [
        *(("brick", 1, True), ("worn", 2, False), ("wall", 3, False), ("", 4, True)),
    ]
    assert [row[:2] for row in scene.sliders] == [("brick", "#8a3a2a"), ("worn", 0.4)]
    assert (scene.lines[1].least, scene.lines[1].most) == (pytest.approx(0.4), pytest.approx(0.4))
    assert scene.lines[2].least < 0.05
    assert scene.lines[2].most > 0.95
    assert scene.shimmer >= 0.0
    pictures = room.pictures()
    assert pictures["workshop texture"].shape == (96, 160, 4)
    assert pictures["workshop levels"].shape[1] == wr.LEVELS_SHOWN * wr.LEVEL_SIDE
    assert pictures["workshop lines"].shape == (wr.LINE_SIDE, wr.LINES_ACROSS * wr.LINE_SIDE, 4)
    assert scene.pictured == ("brick", "worn", "wall", "")
    told = [
        one.pictured for one in room.ask(wr.WorkshopSet("a = x; a*y", size=SIZE)) if isinstance(one, wr.WorkshopScene)
    ]
    assert told[0] == scene.pictured, "as long as there are no others"
    assert told[-1] == ("a", "")


def test_a_text_names_what_the_painting_has(room):
    room.easel.session = Session(Painting())
    room.easel.session.do(DefineTexture("mine", "expression", Map({"text": "#ff0000"})))
    assert room.scene('red("mine"()) + 0*"rock"()').lines[-1].least == pytest.approx(1.0)
    mistake = room.scene('x = "mine"()\n"yours"()').mistake
    assert (mistake.line, mistake.column, mistake.found) == (1, 1, '"x"')
    mistake = room.scene('a = "mine"()\n"yours"()').mistake
    assert (mistake.line, mistake.column, mistake.found) == (2, 1, '"yours"')


def test_a_text_is_seen_at_a_pressure_and_a_distance_from_the_rim(room):
    scene = room.scene("a = pressure\na*rim", felt=(0.5, 0.4, 0.0))
    assert scene.felt == ("pressure", "rim")
    assert [line.least for line in scene.lines] == [pytest.approx(0.5), pytest.approx(0.2)]
    assert room.scene("direction/tau", felt=(1.0, 1.0, 90.0)).lines[-1].most == pytest.approx(0.25)
    assert room.scene("a = 0.3\na*x").felt == ()
    assert room.scene("pressure*rim*direction").felt == ("pressure", "rim", "direction")


def test_a_text_that_is_too_dear_from_near_is_told_of_behind_its_first_picture(room, monkeypatch):
    def dear(*about):
        raise WrittenError((1, 1), "60 microseconds a pixel", "50 at most")

    monkeypatch.setattr(workshop, "check_woven", dear)
    sent = room.ask(wr.WorkshopSet("noise(x, y)", size=SIZE))
    assert sent[-1].mistake.found == "60 microseconds a pixel"
    assert {one.mistake for one in sent[:-1] if isinstance(one, wr.WorkshopScene)} == {None}
    assert "workshop texture" in room.pictures()


def test_the_first_picture_comes_before_all_else(room):
    room.workshop.handlers[wr.WorkshopSet](wr.WorkshopSet(WALL, size=(256, 256)))
    while not room.pictures():
        room.workshop.step()
    first = room.pictures()["workshop texture"]
    assert max(first.shape[:2]) == 128
    while room.workshop.pending:
        room.workshop.step()
    whole = room.pictures()["workshop texture"].astype(float)
    reduced = whole.reshape(128, 2, 128, 2, 4).mean(axis=(1, 3))
    assert np.abs(reduced - first).mean() < 3.0


@pytest.mark.parametrize(("soon", "part"), [(1e3, 4), (4e6, 1)])
def test_the_first_picture_of_a_dear_text_is_of_one_sample_or_small(room, monkeypatch, soon, part):
    text = "fract(x*40)*cells(x*40, y*40)"
    monkeypatch.setattr(workshop, "_SOON", soon)
    room.workshop.handlers[wr.WorkshopSet](wr.WorkshopSet(text, size=(96, 96)))
    while not room.pictures() and room.workshop.pending:
        room.workshop.step()
    first = room.pictures()["workshop texture"].astype(float)
    assert first.shape[:2] == (96 // part, 96 // part)
    while room.workshop.pending:
        room.workshop.step()
    whole = room.pictures()["workshop texture"]
    assert whole.shape[:2] == (96, 96)
    assert part > 1 or 0.0 < np.abs(whole - first).mean() < 30.0


def test_a_mistake_tells_its_place_and_leaves_what_was_right(room):
    before = room.scene(WALL)
    scene = room.scene(WALL + "fbn(x)")
    assert not room.pictures()
    assert scene.mistake is not None
    assert scene.mistake.line == 4
    assert scene.lines == before.lines
    again = room.scene("fbn(x, y)")
    assert (again.mistake.line, again.mistake.column) == (1, 1)
    assert "fbn" in again.mistake.found
    assert "fbm" in again.mistake.expected


def test_values_that_fit_are_taken_and_others_are_not_in_the_way(room):
    room.scene(WALL, values=Map({"brick": "#FFFFFF", "worn": 7.0, "gone": 1.0}), line=0)
    assert (room.pictures()["workshop texture"] == 255).all()
    scene = room.scene(WALL, values=Map({"brick": 3.0, "worn": "#000000"}))
    assert scene.mistake is None


def test_values_of_all_lines_are_told_at_a_place(room):
    room.scene(WALL)
    (told,) = room.ask(wr.WorkshopAsk((0, 0)))
    assert told.place == (0, 0)
    assert [len(values) for values in told.values] == [4, 1, 1, 4]
    assert told.values[1] == (pytest.approx(0.4),)


def test_nothing_is_done_while_the_pen_draws(room):
    room.easel.live = object()
    room.workshop.handlers[wr.WorkshopSet](wr.WorkshopSet(WALL))
    assert not room.workshop.pending
    room.easel.live = None
    assert room.workshop.pending


def test_what_is_looked_at_alone_is_marked_where_it_leaves_0_to_1(room):
    room.scene("far = x*8 - 4\nfract(far)", line=0)
    seen = room.pictures()["workshop texture"].astype(int)
    assert (seen[0, 0] != seen[0, -1]).any()
    assert seen[0, 0, 2] > seen[0, 0, 0]  # below 0: blue
    assert seen[0, -1, 0] > seen[0, -1, 2]  # above 1: red
    lit = room.scene("far = x*8 - 4\nfract(far)", line=0, lit=True)
    assert lit.mistake is None
    assert room.pictures()["workshop texture"].shape == (96, 160, 4)


def test_all_words_are_told_once(room):
    found = [one for one in room.ask(wr.WorkshopSet("x")) if isinstance(one, wr.WorkshopWords)]
    assert {"moss", "clay-tiles", "rock", "felt"} <= {row.name for row in found[-1].textures}
    assert {"fbm", "slider", "pick", "ramp"} <= {row.name for row in found[0].functions}
    assert all(row.form.startswith(row.name) and row.about for row in found[0].functions)
    assert not [one for one in room.ask(wr.WorkshopSet("y")) if isinstance(one, wr.WorkshopWords)]


def test_a_line_looked_at_before_all_are_made_has_them_made_all_the_same(room):
    room.workshop.handlers[wr.WorkshopSet](wr.WorkshopSet(WALL, size=SIZE))
    while not room.pictures():
        room.workshop.step()
    scene = room.scene(WALL, line=2)
    assert scene.lines[2].most > 0.95
    assert "workshop lines" in room.pictures()
    room.scene(WALL, line=0)
    assert "workshop lines" not in room.pictures()
