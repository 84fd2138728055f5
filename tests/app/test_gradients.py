"""What a drag with the tool Gradient asks for: a texture under a name of its own, and one fill."""

from dataclasses import replace

import numpy as np
import pytest

from app.canvas.view import Place, View
from app.desk.desk import Desk
from app.desk.filling import gradients
from app.desk.filling.gradients import FRAME_CAP
from app.input.events import PenEvent
from app.tools.tools import TOOLS
from engine.archive.opening import open_painting
from engine.archive.saving import Snapshot, save
from engine.canvas.evaluate import evaluate
from engine.canvas.layers import layers
from engine.canvas.placing.pose import SourcePart
from engine.numeric.address import Rect
from engine.painting import commands as c
from engine.session.session import Session
from engine.studio.adjusting.trial_records import TryFill
from engine.studio.layer_rows import LayerRow
from engine.studio.results import Scene
from engine.studio.selecting.ants_records import Ants

FRAME = Rect(0, 0, 200, 100)


CELL = SourcePart(1, Rect.at(64, 64, 128, 64))


def dragged(level=0, place=None, ants=None, wrap=None, **settings):
    """The commands that a drag by 80 pixels to the right asks for, and the line of the message."""
    requests = []
    desk = Desk(View(place or Place(100, 50, 0), level, 0.0, 200, 100), requests.append)
    row = LayerRow("Sky", False, 0, None, 0, 1.0, True, "src-over", False, False, wrap=wrap)
    desk.learn(ready=True, scene=Scene(FRAME, (row,), "Sky", False, False, False, None))
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
    if not requests:  # too deep
        return [], desk
    tried, *asked, left = requests
    assert (tried.level, tried.texture.arguments["level"], left) == (level - 2, level, TryFill(None))
    assert tried.area == desk.view.visible(level - 2) or FRAME.zoomed(level - 2).intersect(tried.area) == tried.area
    return [request.command for request in asked], desk


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


def test_the_painting_lists_the_last_one_alone_unless_one_is_kept_or_in_the_brush():
    (define, fill), desk = dragged()
    assert define.name == fill.brush.ink[0].texture == "Gradient"
    scene = replace(desk.known.scene, textures=("Gradient",), texture_kinds=(("Gradient", "gradient"),))
    desk.learn(scene=scene)
    assert gradients.may_keep(desk)
    gradients.keep_gradient(desk)
    assert desk.filling.gradient == replace(define, name="Gradient 1")
    assert not gradients.may_keep(desk)
    desk.hand.change(ink=fill.brush.ink)  # it paints with that one
    assert laid_again(desk).name == "Gradient 2"
    desk.hand.change(ink=())
    assert laid_again(desk).name == "Gradient"
    desk.learn(scene=replace(scene, texture_kinds=(("Gradient", "image"),)))
    assert laid_again(desk).name == "Gradient 3"


def laid_again(desk):
    asked = []
    desk.post = asked.append
    gradients.lay(desk, Place(100, 50, 0), 0, (0.0, 0.0), (50.0, 5.0))
    return asked[0].command


def test_fills_with_gradients_of_one_name_each_keep_their_own(tmp_path):
    first = dragged()[0]
    second = [*dragged(shape="radial")[0], c.AddLayer("Above")]
    session = Session()
    session.do(c.AddLayer("Below"))
    for command in (*second, *first):  # the radial one under the linear one, both of the same name
        session.do(command)
    save(tmp_path / "two.ora", Snapshot(session.painting, session.recording()))
    opened = open_painting(tmp_path / "two.ora").painting
    for level in (0, 2):
        rect = Rect.at(300, 150, 90, 40) if level else FRAME
        planes = [
            evaluate(layer.pyramid, level, rect).rgba
            for painting in (session.painting, opened)
            for layer in layers(painting.root)
        ]
        assert (planes[0] != planes[1]).any()
        assert (planes[0] == planes[2]).all()
        assert (planes[1] == planes[3]).all()


def test_none_is_laid_where_it_would_be_elsewhere():
    commands, desk = dragged(level=60, place=Place(100 << 60, 50 << 60, 60))
    assert not commands
    assert "too deep" in desk.message.text


def test_on_a_layer_that_wraps_around_it_lies_in_the_cell_whatever_tile_it_is_dragged_in():
    ends = [
        dragged(place=Place(100 + x, 50 + y, 0), wrap=CELL)[0][0].arguments for x, y in ((0, 0), (-448, 192), (64, 32))
    ]
    assert ends[0]["from"] == (60.0, 50.0)
    assert ends[0] == ends[1] == ends[2]
