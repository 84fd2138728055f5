"""What a drag with the tool Gradient asks for: a texture under a name of its own, and one fill."""

import numpy as np
import pytest

from app.canvas.view import Place, View
from app.desk.desk import Desk
from app.desk.filling.gradients import FRAME_CAP
from app.input.events import PenEvent
from app.tools.tools import TOOLS
from engine.canvas.evaluate import evaluate
from engine.canvas.layers import layers
from engine.numeric.address import Rect
from engine.painting import commands as c
from engine.session.session import Session
from engine.studio.results import Scene
from engine.studio.selecting.ants_records import Ants

FRAME = Rect(0, 0, 200, 100)


def dragged(level=0, place=None, ants=None, **settings):
    """The commands that a drag by 80 pixels to the right asks for, and the line of the message."""
    requests = []
    desk = Desk(View(place or Place(100, 50, 0), level, 0.0, 200, 100), requests.append)
    desk.learn(ready=True, scene=Scene(FRAME, (), None, False, False, False, None))
    desk.hand.colour, desk.hand.other_colour, desk.selecting.ants = (1.0, 0.0, 0.0), (0.0, 0.0, 1.0), ants
    for name, value in settings.items():
        setattr(desk.filling, name, value)
    gesture = TOOLS["gradient"].gesture(desk, PenEvent("down", 60.0, 50.0, button=1))
    next(gesture)
    gesture.send(PenEvent("move", 90.0, 50.0))
    assert len(desk.guides.path) == 2
    with pytest.raises(StopIteration):
        gesture.send(PenEvent("up", 140.0, 50.0, button=1))
    assert not desk.guides.path
    return [request.command for request in requests], desk


@pytest.mark.parametrize(("fades", "other"), [(False, (0, 0, 1, 1)), (True, (0, 0, 0, 0))])
def test_the_ends_have_the_very_colours_and_an_undo_takes_all_away(fades, other):
    commands, _ = dragged(fades=fades)
    session = Session()
    before = session.painting.root
    for command in commands:
        session.do(command)
    (layer,) = layers(session.painting.root)
    seen = evaluate(layer.pyramid, 0, Rect.at(0, 50, 200, 1)).rgba[:, 0]
    for at, colour in ((slice(0, 60), (1, 0, 0, 1)), (slice(140, 200), other)):
        np.testing.assert_allclose(seen[:, at], np.array(colour)[:, None] * np.ones(60), atol=2**-14)
    assert np.abs(np.diff(seen, axis=1)).max() < 1 / 80 + 2**-13
    session.do(c.Undo())
    assert session.painting.root is before


def test_what_is_selected_is_filled_at_the_level_that_is_shown():
    ants = Ants(True, (), 0, FRAME, np.empty((0, 4), np.float32), True)
    (_, fill), _ = dragged(level=3, place=Place(800, 400, 3), ants=ants)
    assert (fill.like, fill.level) == (None, 3)


def test_elsewhere_the_frame_is_filled_or_outside_of_it_what_is_seen():
    (_, fill), _ = dragged()
    assert (fill.like.rect, fill.like.level, fill.open) == (FRAME, 0, True)
    (_, far), desk = dragged(place=Place(9000, 50, 0))
    assert far.like.rect == desk.view.visible(0)
    (_, near), _ = dragged(level=9, place=Place(100 << 9, 50 << 9, 9))
    assert near.like.rect.area <= FRAME_CAP < 4 * near.like.rect.area


def test_each_has_a_name_of_its_own_and_none_is_laid_where_it_would_be_elsewhere():
    (define, fill), _ = dragged(named={"Gradient 1"})
    assert define.name == fill.brush.ink[0].texture == "Gradient 2"
    commands, desk = dragged(level=60, place=Place(100 << 60, 50 << 60, 60))
    assert not commands
    assert "too deep" in desk.message.text
