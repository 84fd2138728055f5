"""Colours and inks are taken as it is set: from the layer or what is seen, of a pixel or a disc, the ink, too."""

from types import SimpleNamespace

import pytest

from app.canvas.view import Place, View
from app.desk.desk import Desk
from app.desk.holding.picking_up import take_ink
from app.input.events import LEFT, PenEvent
from app.news import HEARS
from app.tools.asking_gestures import pick
from engine.brush.settings import Brush, Component
from engine.studio import requests as q
from engine.studio.past.past_records import AskHere, Here


@pytest.fixture
def desk():
    return Desk(View(Place(0, 0, 0), 0, 0.0, 1280, 800), [].append)


def picked(desk, *ways):
    out = []
    desk.post = out.append
    gesture = pick(desk, PenEvent("down", 640.0, 400.0, button=LEFT))
    next(gesture)
    for kind, x in ways:
        try:
            gesture.send(PenEvent(kind, x, 400.0, button=LEFT))
        except StopIteration:
            break
    return out


def test_what_is_set_is_asked_for_and_the_ink_only_once_the_pointer_is_lifted(desk):
    assert picked(desk, ("up", 640.0)) == [q.Pick(0, 0, 0)] * 2
    desk.picking.radius, desk.picking.ink, desk.picking.layer = 9, True, True
    assert picked(desk, ("move", 650.0), ("up", 660.0)) == [
        *(q.Pick(0, x, 0, 9) for x in (0, 10, 20)),
        AskHere(0, 20, 0),
    ]


def test_the_newest_stroke_there_gives_its_ink_and_colour_once(desk):
    assert HEARS[Here] is take_ink
    desk.picking.ink = True
    picked(desk, ("up", 640.0))
    brush = Brush(radius=90.0, colour="#ff0000", ink=(Component("rock", 0.5, "#00ff00"),))
    found = Here((0, 0, 0), (SimpleNamespace(step=SimpleNamespace(brush=brush)),))
    desk.hand.take(Brush(radius=7.0), "Pen", ())
    take_ink(desk, Here((0, 5, 5), found.strokes), 0.0)
    assert desk.hand.brush == Brush(radius=7.0)
    take_ink(desk, found, 0.0)
    assert desk.hand.dipped() == Brush(radius=7.0, colour="#ff0000", ink=brush.ink)
    desk.hand.take(Brush(radius=7.0), "Pen", ())
    take_ink(desk, found, 0.0)
    assert desk.hand.brush == Brush(radius=7.0)
