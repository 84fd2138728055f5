"""Colours of a whole layer changed by one fill: exactly what the op makes of each pixel, ink and all, in one step."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from immutables import Map

from engine.brush.settings import from_json
from engine.canvas import layers
from engine.canvas.composite import composite
from engine.canvas.reading import layer_planes
from engine.numeric.address import Rect
from engine.painting import commands as c
from engine.painting.recording import Header, version_of
from engine.painting.value import Refusal, first_painting
from engine.session.replay import replay
from engine.session.session import Session
from engine.strokes import all_painted
from engine.strokes.all_painted import level_for_all
from engine.studio.adjusting.trial_records import Tried, TryFill
from engine.studio.studio import Studio

FRAME = Rect(0, 0, 90, 60)
OPS = [
    {"name": "tone", "brightness": 0.2, "contrast": 1.4},
    {"name": "levels", "black": 0.1, "white": 0.7, "gamma": 1.5},
    {"name": "recolour", "turn": 70, "amount": 0.6, "light": -0.2},
    {"name": "invert"},
    {"name": "saturate", "amount": 0},
    {"formula": "0.5 - luma"},
]
INKED = {"radius": 12, "colour": "#c05020", "ink": [{"texture": "rock", "amount": 0.3}]}


def done(level=0, colour="#c05020", ink=False):
    session = Session(first_painting(Header(FRAME)))
    session.do(c.parse({"do": "layer", "add": "sky"}))
    scale = 2.0**level
    points = [[10 * scale, 10 * scale], [80 * scale, 45 * scale]]
    brush = {"radius": 12 * scale, "hardness": 1, "colour": colour, **({"ink": INKED["ink"]} if ink else {})}
    session.do(c.parse({"do": "stroke", "level": level, "points": points, "brush": brush}))
    return session


def adjusted(op, level=0, **more):
    return {"do": "fill", "whole": True, "level": level, "brush": {"mode": "raster", "op": op}, **more}


def paint(session, level=0):
    return layer_planes(layers.find(session.painting.root, "sky"), level, FRAME.zoomed(level))


@settings(max_examples=6, deadline=None)
@given(st.sampled_from(OPS), st.sampled_from(["#c05020", "#203040", "#80f0a0"]), st.integers(-1, 1), st.booleans())
def test_every_pixel_of_the_layer_becomes_what_the_op_makes_of_it(op, colour, level, ink):
    session = done(level, colour, ink)
    before = paint(session, level)
    session.do(c.parse(adjusted(op, level)))
    found = paint(session, level)
    np.testing.assert_array_equal(found[3], before[3])
    tiny = Session(first_painting(Header(FRAME)))
    tiny.do(c.parse({"do": "layer", "add": "sky"}))
    tiny.do(c.parse({"do": "select", "rect": [0, 0, 0, 90, 60]}))
    tiny.do(c.parse({"do": "fill", "brush": {"colour": colour}}))
    tiny.do(c.parse({"do": "fill", "brush": {"mode": "raster", "op": op}}))
    wanted = paint(tiny)[:3, 5, 5]
    full = found[3] == 1
    assert full.any()
    if not ink:
        assert np.abs(found[:3, full] - wanted[:, None]).max() < 1e-4
    assert (found[:3] != before[:3]).any()
    np.testing.assert_array_equal(paint(replay(session.recording()), level), found)
    session.do(c.Undo())
    np.testing.assert_array_equal(paint(session, level), before)


def test_ink_stays_ink_and_a_selection_limits_it():
    session = done(ink=True)
    session.do(c.parse({"do": "select", "rect": [0, 0, 0, 40, 60]}))
    before = paint(session)
    session.do(c.parse(adjusted({"name": "invert"})))
    found = paint(session)
    np.testing.assert_array_equal(found[:, :, 40:], before[:, :, 40:])
    assert (found[:, :, :40] != before[:, :, :40]).any()
    fine = layer_planes(layers.find(session.painting.root, "sky"), 3, Rect(160, 160, 288, 288))
    assert fine[0].std() > 0.005  # the rock shows on


def test_the_level_is_the_finest_that_is_stored_where_that_is_not_too_much():
    session = done(2)
    pyramid = layers.find(session.painting.root, "sky").pyramid
    assert level_for_all(pyramid, session.cache) == 2
    dab = {"do": "stroke", "level": 12, "points": [[80000, 90000]], "brush": {"radius": 20}}
    session.do(c.parse(dab))
    best = level_for_all(layers.find(session.painting.root, "sky").pyramid, session.cache)
    assert 2 <= best < 12
    session.do(c.parse(adjusted({"name": "invert"}, best)))


@pytest.mark.parametrize(
    ("command", "wrong"),
    [
        (adjusted({"name": "invert"}, layer="bare"), "no paint"),
        (adjusted({"name": "invert"}, onto="mask"), "whole of a mask"),
        (adjusted({"name": "invert"}, 14), "more than 256 tiles of level"),
    ],
)
def test_what_cannot_be_is_refused_in_a_line(command, wrong, monkeypatch):
    monkeypatch.setattr(all_painted, "MOST_FILLED", 256)  # 16384 take eight seconds
    session = done()
    session.do(c.parse({"do": "layer", "add": "bare"}))
    session.do(c.parse({"do": "layer", "select": "sky"}))
    session.do(c.parse({"do": "layer", "set": "sky", "mask": {"op": "full"}}))
    with pytest.raises(Refusal, match=wrong):
        session.do(c.parse(command))


def test_the_command_is_told_again():
    command = c.parse(adjusted({"name": "levels"}, 3))
    assert c.parse(c.to_json(command)) == command
    assert version_of(command) == 2
    with pytest.raises(ValueError, match="whole"):
        c.parse({**adjusted({"name": "levels"}), "like": {"at": [0, 0]}})


def test_it_is_seen_before_it_is_done_and_goes_again():
    sent = []
    studio = Studio(sent.append, lambda request: None)
    session = done()
    studio.easel.show(session, None)

    def seen():
        while studio.pending:
            studio.step()
        return composite((studio.easel.viewer.looking or session.painting).root, 0, FRAME, layer_planes)

    before = seen()
    brush = from_json({"mode": "raster", "op": "invert"})
    studio.do(TryFill(brush, 0, FRAME))
    tried = seen()
    assert (tried != before).any()
    assert [told for told in sent if isinstance(told, Tried)] == [Tried("sky", 0)]
    studio.do(TryFill(None))
    np.testing.assert_array_equal(seen(), before)
    told = {"kind": "linear", "from": (0, 0), "to": (40, 0), "level": 0, "ramp": ((0, "#ff0000"), (1, "#0000ff"))}
    gradient = c.DefineTexture("G", "gradient", Map(told))
    laid = from_json({"ink": [{"texture": "G"}]})
    studio.do(TryFill(laid, -1, FRAME.zoomed(-1), gradient))
    assert (seen() != before).any()
    assert "G" not in session.painting.textures
    studio.do(TryFill(None))
    np.testing.assert_array_equal(seen(), before)
    session.do(c.Fill(brush, whole=True))
    np.testing.assert_array_equal(seen(), tried)
    studio.close()
