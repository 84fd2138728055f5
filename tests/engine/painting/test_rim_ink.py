"""Ink that goes by the distance from the stroke's rim: the same while it is drawn, when it is done, and played."""

import json

import numpy as np
import pytest
from immutables import Map

from engine.brush.ink import resolve
from engine.brush.mixture import mixture
from engine.brush.settings import from_json
from engine.canvas.evaluate import evaluate
from engine.canvas.layers import layers
from engine.numeric.address import Rect, TileKey
from engine.painting import recording
from engine.painting.textures import Texture
from engine.session.replay import replay

BRUSH = {"radius": 18, "hardness": 1, "dynamics": {}, "ink": [{"texture": "t"}]}
SEEN = Rect(0, 0, 200, 96)
POINTS = [[30, 48, 0.5], [90, 40, 0.8], [170, 48, 1]]


def opened(tmp_path, text, *strokes):
    lines = [{"inkfall": 2, "seed": 1}, {"do": "texture", "name": "t", "maker": "expression", "text": text}, *strokes]
    file = tmp_path / "a.jsonl"
    file.write_text("\n".join(map(json.dumps, lines)))
    return replay(recording.read(file))


def shown(painting):
    return evaluate(next(iter(layers(painting.root))).pyramid, 0, SEEN).data[:4]


@pytest.mark.parametrize("more", [{}, {"edge": {"curve": "wet"}}, {"grain": {"texture": "rock", "amount": 0.5}}])
def test_a_rim_is_another_colour_and_the_same_however_it_is_drawn(tmp_path, more):
    text, brush = "mix(#ff0000, #0000ff, rim)", {**BRUSH, **more}
    played = shown(opened(tmp_path, text, {"do": "stroke", "points": POINTS, "brush": brush}).painting)
    session = opened(tmp_path, text)
    live = session.begin(0, (0, 0), from_json(brush))
    for point in POINTS:
        live.add(np.array([[*point, 0.0, 0.0, 0.0]]))
        seen = live.preview(SEEN).data[:4]
    session.finish(live)
    assert (shown(session.painting) == played).all()
    assert np.abs(seen - played).max() <= 2.0**-15
    red, _, blue, alpha = played[:, 40, 90]
    assert blue > 0.9 * alpha > 10 * red
    if not more:
        top = np.flatnonzero(played[3, :, 90] > 0.9)[0]
        assert played[0, top, 90] > 0.9


def test_other_modes_take_the_middle_of_a_stroke_at_full_pressure():
    texture = Texture("expression", Map({"text": "rim*pressure"}))
    brush = from_json({"mode": "raster", "ink": [{"texture": "t"}]})
    ink = mixture(brush, {"t": texture}, 0, 0)
    assert not ink.swayed
    assert ink.field(TileKey(0, 0, 0)).min() == 1.0
    assert resolve(from_json({"ink": [{"texture": "t", "rim": 0.5, "weight": 1}]}), {"t": texture}, 0, 0).swayed == ()
