"""What fills covered, found again in a painting that was opened: its recording is played as far as that needs."""

import json

import pytest

from app.__main__ import main
from engine.archive.opening import open_painting
from engine.archive.saving import Snapshot, save
from engine.numeric.address import Rect
from engine.painting import commands as c
from engine.painting.value import Painting
from engine.session.here.painted_here import CanvasPixel, PaintedHere
from engine.session.session import Session
from engine.studio.past import past_records as p
from engine.studio.past.found_again import FoundAgain
from engine.studio.studio import Studio

FRAME = Rect.at(0, 0, 64, 48)


def stroke(*points, **brush):
    brush = {"radius": 5, "hardness": 0.9, **brush}
    return {"do": "stroke", "points": [list(point) for point in points], "brush": brush}


COMMANDS = (
    stroke((-9, 24), (80, 24), colour="#ff0000"),
    {"do": "fill", "like": {"at": [30, 5]}, "open": True, "brush": {"colour": "#00ff00"}},
    {"do": "undo", "count": 1},
    {"do": "fill", "like": {"at": [30, 5]}, "open": True, "brush": {"colour": "#0000ff"}},
    {"do": "select", "like": {"at": [30, 24], "level": 0}},
    stroke((30, 0), (30, 47), colour="#ffffff"),
    {"do": "select", "none": True},
)
WANTED = {(30, 5): [3], (30, 24): [5], (10, 24): [0], (10, 5): [3], (30, 40): [], (10, 40): []}


@pytest.fixture(scope="module")
def session():
    session = Session(Painting(FRAME, 3))
    for command in COMMANDS:
        session.do(c.parse(command))
    return session


def told(session, x, y, held):
    found = PaintedHere(session.cache, held).at(CanvasPixel(0, x, y), session.painting, session.steps)
    return [one.step.index for one in found]


def test_what_is_not_at_hand_is_played_anew_once(session):
    again = FoundAgain(session, lambda number: None)
    assert told(session, 30, 40, again.held) == [5, 3]  # nobody knows
    assert again.wanted
    assert again.begin()
    while again.play():
        pass
    assert {place: told(session, *place, again.held) for place in WANTED} == WANTED
    assert not again.wanted


def test_the_command_line_tells_it_of_a_saved_painting(session, tmp_path, capsys):
    path = tmp_path / "a.ora"
    save(path, Snapshot(session.painting, session.recording()))
    assert open_painting(path).native
    for (x, y), wanted in WANTED.items():
        capsys.readouterr()
        assert main(["info", str(path), "--at", f"0,{x},{y}", "--json"]) == 0
        found = json.loads(capsys.readouterr().out)["strokes"]
        assert [one["index"] - 1 for one in found] == wanted


def test_the_window_is_told_what_is_known_and_then_all(session):
    sent = []
    studio = Studio(sent.append, lambda request: None)
    studio.easel.show(Session(session.painting, log=session.log), None)
    while studio.pending:
        studio.step()
    studio.do(p.AskHere(0, 30, 40))
    while studio.pending:
        studio.step()
    told = [result for result in sent if isinstance(result, p.Here)]
    assert ([one.step.index for one in told[0].strokes], told[0].more) == ([5, 3], True)
    assert (told[-1].strokes, told[-1].more) == ((), False)
