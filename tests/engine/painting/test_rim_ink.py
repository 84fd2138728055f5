"""Ink that goes by the distance from the stroke's rim, and the way it runs: the same drawn, done, kept and played."""

import json

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from immutables import Map

from engine.brush.heading import nearest_ways
from engine.brush.ink import resolve
from engine.brush.mixture import mixture
from engine.brush.settings import from_json
from engine.canvas.evaluate import evaluate
from engine.canvas.layers import layers
from engine.checks.field_error import FieldError
from engine.files.fault import FileError
from engine.numeric.address import Rect, TileKey
from engine.painting import recording
from engine.painting.textures import Texture
from engine.session.replay import replay
from engine.texture.expression.defined import expression
from engine.texture.table import from_key

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


def drawn_alike(tmp_path, text, brush, points):
    """What a stroke looks like, which is the same played at once and drawn point by point, and nearly so on its way."""
    played = shown(opened(tmp_path, text, {"do": "stroke", "points": points, "brush": brush}).painting)
    session = opened(tmp_path, text)
    live = session.begin(0, (0, 0), from_json(brush))
    for point in points:
        live.add(np.array([[*point, 0.0, 0.0, 0.0]]))
        seen = live.preview(SEEN).data[:4]
    session.finish(live)
    assert (shown(session.painting) == played).all()
    assert np.abs(seen - played).max() <= 2.0**-15
    return played


@pytest.mark.parametrize("more", [{}, {"edge": {"curve": "wet"}}, {"grain": {"texture": "rock", "amount": 0.5}}])
def test_a_rim_is_another_colour_and_the_same_however_it_is_drawn(tmp_path, more):
    played = drawn_alike(tmp_path, "mix(#ff0000, #0000ff, rim)", {**BRUSH, **more}, POINTS)
    red, _, blue, alpha = played[:, 40, 90]
    assert blue > 0.9 * alpha > 10 * red
    if not more:
        top = np.flatnonzero(played[3, :, 90] > 0.9)[0]
        assert played[0, top, 90] > 0.9


TURNED = "stripes((y*cos(direction) - x*sin(direction))*6, 0.4)"
AROUND = [[30, 48], [90, 30], [170, 24], [178, 70], [110, 76]]


@pytest.mark.parametrize("more", [{}, {"copies": [[0, 1, 120, -40, True]]}])
def test_a_texture_is_turned_one_of_sixteen_ways_however_it_is_drawn(tmp_path, more):
    told = {"do": "stroke", "points": AROUND, "brush": BRUSH, **more}
    painting = opened(tmp_path, TURNED, told).painting
    played = shown(painting)
    session = opened(tmp_path, TURNED)
    if not more:
        live = session.begin(0, (0, 0), from_json(BRUSH))
        for point in AROUND:
            live.add(np.array([[*point, 1.0, 0.0, 0.0, 0.0]]))
            seen = live.preview(SEEN).data[:4]
        session.finish(live)
        assert (shown(session.painting) == played).all()
        assert np.abs(seen - played).max() <= 2.0**-15
    fixed = {**BRUSH, "ink": [{"texture": "t", "direction": 337.5}]}  # as the first piece runs
    alike = shown(opened(tmp_path, TURNED, {**told, "brush": fixed}).painting)
    assert (alike == played)[:, :, 40:70].all()
    assert not (alike == played)[:, 30:60, 150:190].all()
    paint = next(iter(layers(painting.root))).pyramid.levels[0]
    inks = {ink for record in paint.values() for ink in record.inks}
    assert len(inks) > 3
    assert all(from_key(list(ink.key), {}) == ink for ink in inks)


THREE = "0.25*fbm(x*9, y*9, 3)*pressure + 0.5*rim*noise(x*4, y*4) + 0.03*direction*pressure"
FELT_BY = {"pressure": ("weight", 1.0), "rim": ("rim", 1.0), "direction": ("direction", 22.5)}
RISING = np.linspace(0.0, 1.0, 128, dtype=np.float32)
SWEPT = nearest_ways(np.stack(np.broadcast_arrays(RISING, 0.2 - RISING[:, None])).astype(np.float32))


def felt_ink(text, **given):
    texture = Texture("expression", Map({"text": text, "stages": 3}))
    brush = from_json({"colour": "#000000", "ink": [{"texture": "t", **given}]})
    return resolve(brush, {"t": texture}, 0, 0).under(TileKey(0, 0, 0), RISING + 0.0 * RISING[:, None], SLOPED, SWEPT)


SLOPED = np.ascontiguousarray(np.broadcast_to(RISING[:, None], (128, 128)))


@pytest.mark.parametrize("name", FELT_BY)
@given(part=st.floats(0.0, 1.0))
@settings(max_examples=3)
def test_all_three_are_two_where_one_is_the_same_everywhere(name, part):
    member, most = FELT_BY[name]
    value = part * most if name != "direction" else round(part * 15) * most
    told = f"({value!r}*(tau/360))" if name == "direction" else f"({value!r})"
    three, two = felt_ink(THREE, **{member: value}), felt_ink(THREE.replace(name, told))
    assert len(three[2]) == len(two[2]) > 3
    assert np.abs(three[0] - two[0]).max() <= 2.0**-22


def test_all_three_are_mixed_as_the_stroke_tells():
    colour, amplitudes, inks = felt_ink("0.5*pressure + 0.3*rim + 0.03*direction")
    ways = sum(SWEPT.part(k) * np.float32(0.03 * k * np.pi / 8) for k in range(16))
    assert np.abs(colour[0] - (0.5 * RISING + 0.3 * SLOPED + ways)).max() < 1e-5
    assert 9 < len(inks) <= 9 * 16
    assert len(amplitudes) == 3 * len(inks)
    assert all(from_key(list(ink.key), {}) == ink for ink in inks[:2])
    with pytest.raises(FieldError, match="at most 3 of a text that goes by pressure, rim, direction"):
        expression({"text": THREE, "stages": 4}, 0)


def test_a_stroke_that_goes_by_all_three_is_the_same_however_it_is_drawn(tmp_path):
    points = [[x, y, 0.3 + 0.1 * n] for n, (x, y) in enumerate(AROUND)]
    played = drawn_alike(tmp_path, "stripes(x*6, 0.1 + 0.5*pressure)*rim*direction", BRUSH, points)
    assert played[3].any()


def test_a_direction_is_for_strokes_alone(tmp_path):
    fill = {"do": "fill", "brush": BRUSH}
    select = {"do": "select", "rect": [0, 0, 0, 9, 9]}
    stroke = {"do": "stroke", "points": POINTS}
    for done, expected in (
        ([select, fill], "a fill runs no way"),
        ([{**stroke, "brush": {**BRUSH, "mode": "raster"}}], "a direction is for paint"),
        ([{**stroke, "brush": {**BRUSH, "wet": {}}}], "where a brush is wet"),
        ([{**stroke, "brush": {"density": {"texture": "t"}}}], "that is for ink"),
        ([{"do": "texture", "name": "u", "maker": "expression", "text": '"t"(x, y)'}], "a texture that is not"),
    ):
        with pytest.raises(FileError, match=expected):
            opened(tmp_path, TURNED, *done)
    with pytest.raises(FieldError, match="heading"):
        expression({"text": "row(direction, 1, 1)"}, 0)
    with pytest.raises(FieldError, match="by its name"):
        expression({"text": '"brushed-fur"()'}, 0)


def test_other_modes_take_the_middle_of_a_stroke_at_full_pressure():
    texture = Texture("expression", Map({"text": "rim*pressure"}))
    brush = from_json({"mode": "raster", "ink": [{"texture": "t"}]})
    ink = mixture(brush, {"t": texture}, 0, 0)
    assert not ink.swayed
    assert ink.field(TileKey(0, 0, 0)).min() == 1.0
    assert resolve(from_json({"ink": [{"texture": "t", "rim": 0.5, "weight": 1}]}), {"t": texture}, 0, 0).swayed == ()
