"""Written textures as ink: the same values for any rectangle, at any place and depth; what a definition tells."""

import numpy as np
import pytest
from immutables import Map

from engine.brush.ink import resolve
from engine.brush.settings import from_json
from engine.checks.field_error import FieldError
from engine.numeric.address import Rect, TileKey
from engine.numeric.detail import parents, subtract_expanded
from engine.painting.textures import Texture
from engine.texture import table
from engine.texture.expression import machine, written_ink
from engine.texture.expression.defined import anew, expression
from engine.texture.expression.placing.placed_scene import drawn_plainly
from engine.texture.record import Instance

TEXTS = {
    "noise": "noise(x*4, y*4)",
    "fbm": "fbm(x*3, y*3, 12)",
    "warped": "warp(fbm(x*3, y*3), 0.3*noise(x*2, y*2), 0.3*noise(x*2, y*2, 1))",
    "white": "white(x*9, y*9)",
    "cells": "cells_edge(x*5, y*5) + cells(x*3, y*2)*0.5 - cells_random(x, y)*0.2",
    "bricks": "mix(#b0a898, #8a3a2a, bricks(x*4, y*8)) * (0.7 + 0.3*bricks_random(x*4, y*8))",
    "ridged": "ramp(ridged(x*2, y*2)*turbulence(x, y), #000000, #c03000, #ffe0a0)",
    "clear": "fade(#ff8040, fill(star(fract(x) - 0.5, fract(y) - 0.5, 5, 0.4, 0.2)))",
    "hexagons": "rotate(hexagons(x*6, y*6) - 0.2*hexagons_random(x*6, y*6), 30)",
    "repeated": "repeat(fill(circle(x, y, 0.2 + 0.2*random(1))), 5, 7, 0.5)",
    "waves": "sin(40*x + 6*noise(x*3, y*3)) * cos(y*9)",
    "powers": "exp(-abs(x))*log(y + 2)*pow(noise(x, y), 0.7) + atan2(y, x)/9 + tan(x)*0.01",
    "relief": "soft_light(relief(fbm(x*3, y*3)), squares(x*4, y*4))",
}


@pytest.mark.parametrize("name", TEXTS)
def test_a_piece_is_the_same_whatever_else_is_asked_for(name):
    made: Instance = expression({"text": TEXTS[name], "seed": 5}, 0)
    for level, left, top in ((0, -300, 40), (3, 77, -1001), (17, 3 << 17, -5 << 17)):
        whole = Rect.at(left, top, 290, 9)
        seen = made.appearance(level, whole)
        assert np.isfinite(seen).all()
        assert seen.dtype == np.float32
        for piece in (Rect.at(left + 255, top + 3, 5, 6), Rect.at(left + 1, top, 288, 1)):
            rows, columns = piece.slices(whole)
            assert (made.appearance(level, piece) == seen[:, rows, columns]).all()


def test_a_definition_is_checked_without_a_kernel(monkeypatch):
    monkeypatch.setattr(
        machine, "run", None
    )  # on a first start it is not there for a while, and must not be waited for
    made = expression({"text": "smoothstep(0.4, 0.6, fbm(x*7, y*7)) + fract(x) + 0.0625"}, 0)
    with pytest.raises(TypeError):
        made.appearance(0, Rect.at(0, 0, 1, 1))


def test_a_square_is_drawn_once_and_kept_unchanged(monkeypatch):
    drawn = []

    def counted(made, rect, *about):
        drawn.append(rect)
        return drawn_plainly(made, rect, *about)

    monkeypatch.setattr(written_ink, "drawn_plainly", counted)
    made = expression({"text": "noise(x*3, y*3) + 0.125"}, 0)
    first = made.appearance(0, Rect.at(-30, 5, 158, 128))
    before, count = first.copy(), len(drawn)
    first[:] = 7.0  # whoever got it may write to it
    again = made.appearance(0, Rect.at(-30, 5, 158, 128))
    assert (again == before).all()
    assert len(drawn) == count + 2 == 6  # of four pieces those five rows high are drawn again
    assert (made.appearance(0, Rect.at(20, 30, 2, 1)) == before[:, 25:26, 50:52]).all()
    assert len(drawn) == 6  # its square is known


@pytest.mark.parametrize("name", ["fbm", "bricks", "clear"])
def test_the_bandpass_is_what_the_coarser_level_lacks(name):
    made = expression({"text": TEXTS[name]}, 0)
    rect = Rect.at(10, 20, 40, 30)
    planes = 1 if made.at(0).channels == 1 else 3
    fine, coarse = made.appearance(2, rect)[:planes].copy(), made.appearance(1, parents(rect))[:planes].copy()
    subtract_expanded(fine, coarse)
    assert (added(made, rect) == fine).all()
    assert made.bandpass(0, rect) is None
    odd = Rect.at(11, 21, 7, 8)
    rows, columns = odd.slices(rect)
    assert (added(made, odd) == fine[:, rows, columns]).all()


def added(made, rect):
    """The bandpass of level 2; zeros where there is none."""
    found = made.bandpass(2, rect)
    return 0.0 if found is None else found


def test_what_it_hides_is_a_texture_of_its_own():
    assert expression({"text": TEXTS["bricks"]}, 0).cover is None
    made = expression({"text": TEXTS["clear"]}, 0)
    assert (made.cover.appearance(1, Rect(0, 0, 9, 9)) == made.appearance(1, Rect(0, 0, 9, 9))[3:]).all()
    assert made.cover.cover is None


@pytest.mark.parametrize("name", ["noise", "clear"])
def test_a_key_tells_all_of_it(name):
    text = "a = slider(0.5, 0, 1)\nc = pick(#ff0000)\n" + TEXTS[name]
    told = {"text": text, "seed": -3, "period": 37.3, "level": 2, "values": {"a": 0.25}}
    made = table.instance("expression", told, 4, 0)
    for one in (made, made.cover):
        if one is not None:
            assert table.from_key(list(one.key), {}) == one
    assert made != table.instance("expression", {**told, "values": {"a": 0.3}}, 4, 0)
    for broken in (made.key[:-1], (*made.key, "b", 1), ("expression", 0, "noise(", 64.0, 0, 0)):
        with pytest.raises(table.TextureError):
            table.from_key(list(broken), {})


def test_places_of_any_size_have_values():
    made = expression({"text": TEXTS["warped"], "period": 37.3}, 40)
    far = Rect.at((7 << 130) + 5, -(9 << 131), 12, 4)
    seen = made.appearance(40, far)
    assert np.isfinite(seen).all()
    assert (made.appearance(40, Rect.at(far.x0 + 3, far.y0 + 1, 5, 2)) == seen[:, 1:3, 3:8]).all()
    assert made.appearance(40, Rect(0, 0, 4, 4)).std() < 0.01  # 64 pixels of level 0 to a period: it is level there
    here = expression({"text": TEXTS["noise"], "level": 40}, 40)
    assert here.appearance(40, Rect(0, 0, 64, 64)).std() > 0.2
    assert here.bandpass(40 + 40, Rect(0, 0, 4, 4)) is None


def test_ink_gives_values_anew_and_a_period_of_its_own_level():
    defined = {"text": "a", "period": 64, "values": {"a": 1, "b": 2}}
    assert anew(defined, {"values": {"b": 3}}, 5)["values"] == {"a": 1, "b": 3}
    assert anew(defined, {"period": 20}, 5) == {**defined, "period": 20, "level": 5}
    assert anew(defined, {}, 5) == defined


def test_what_looks_at_the_pressure_has_stages():
    text = "a = slider(1, 0, 2)\npressure*a + x*0"
    made = expression({"text": text, "weight": 0.25}, 0)
    assert made.stages == 5
    assert made.appearance(0, Rect(0, 0, 1, 1)).item() == -0.5
    assert table.from_key(list(made.key), {}) == made
    assert expression({"text": text}, 0).appearance(0, Rect(0, 0, 1, 1)).item() == 1.0
    assert expression({"text": "x"}, 0).stages == 1
    assert expression({"text": "x", "stages": 9}, 0).stages == 1
    few = expression({"text": text, "stages": 3}, 0)
    assert (few.stages, few.key) == (3, expression({"text": text}, 0).key)
    assert [(part, dict(one.values)["pressure"]) for part, one in few.under(0.75, 1.0)] == [(0.5, 0.5), (0.5, 1.0)]
    for wrong in ({"weight": 2}, {"weight": "hard"}, {"values": {"pressure": 0.5}}, {"stages": 1}, {"stages": 2.5}):
        with pytest.raises(FieldError):
            expression({"text": text, **wrong}, 0)


def test_a_stroke_follows_the_pressure():
    texture = Texture("expression", Map({"text": "mix(#ff0000, #0000ff, pressure)"}))
    brush = from_json({"colour": "#00ff00", "ink": [{"texture": "t", "amount": 1}]})
    ink = resolve(brush, {"t": texture}, 0, 0)
    pressure = np.linspace(0, 1, 128 * 128, dtype=np.float32).reshape(128, 128)
    colour, amplitudes, inks = ink.under(TileKey(0, 0, 0), pressure)
    np.testing.assert_allclose(colour[0], 1 - pressure, atol=1e-5)
    np.testing.assert_allclose(colour[1], 0, atol=1e-5)
    np.testing.assert_allclose(colour[2], pressure, atol=1e-5)
    assert len(inks) == 5 == len(amplitudes) // 3
    few = from_json({"ink": [{"texture": "t", "amount": 1, "stages": 2}]})
    assert len(resolve(few, {"t": texture}, 0, 0).under(TileKey(0, 0, 0), pressure)[2]) == 2
    told = from_json({"ink": [{"texture": "t", "amount": 1, "weight": 0.5}]})
    assert not resolve(told, {"t": texture}, 0, 0).swayed


def test_a_stroke_follows_its_rim():
    texture = Texture("expression", Map({"text": "mix(#ff0000, #0000ff, rim) * (0.5 + 0.5*pressure)", "stages": 3}))
    brush = from_json({"colour": "#00ff00", "ink": [{"texture": "t", "amount": 1}]})
    ink = resolve(brush, {"t": texture}, 0, 0)
    pressure, rim = np.meshgrid(*[np.linspace(0, 1, 128, dtype=np.float32)] * 2)
    colour, _, inks = ink.under(TileKey(0, 0, 0), pressure, rim)
    np.testing.assert_allclose(colour[0], (1 - rim) * (0.5 + 0.5 * pressure), atol=1e-5)
    np.testing.assert_allclose(colour[2], rim * (0.5 + 0.5 * pressure), atol=1e-5)
    assert len(inks) == 9
    own = expression({"text": "rim = slider(0.25, 0, 1); rim"}, 0)  # a name as any, which a line may have
    assert (own.rims, own.appearance(0, Rect(0, 0, 1, 1)).item()) == (1, -0.5)
    made = expression({"text": "rim + 0*x", "rim": 0.5}, 0)
    assert table.from_key(list(made.key), {}) == made
    with pytest.raises(FieldError, match="stages"):
        expression({"text": "rim*pressure", "stages": 6}, 0)


def test_a_seed_is_another_texture():
    rect = Rect(0, 0, 32, 32)
    for text in ("noise(x*9, y*9)", "white(x*9, y*9)", "cells(x*9, y*9)", "repeat(random(0), 9, 9)"):
        first, second = (expression({"text": text, "seed": seed}, 0).appearance(0, rect) for seed in (0, 1))
        assert (first != second).any()
