"""Strokes whose dabs have colours of their own: the mean of what was laid at each pixel; inks by their amounts."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from app.desk.colours import from_oklch, to_oklch
from engine.brush.dabs import Stroker
from engine.brush.felt import tints_of
from engine.brush.ink import resolve
from engine.brush.mask import StrokeMask
from engine.brush.settings import from_json
from engine.brush.tinted_ink import tinted_ink
from engine.brush.tinting import Tinted
from engine.numeric.address import TILE, TileKey
from engine.numeric.oklch import lab_of, shift_colours

KEY = TileKey(0, 0, 0)
PART = st.floats(0, 1)
DABS = st.lists(
    st.tuples(st.floats(10, 110), st.floats(10, 110), st.floats(1, 30), PART, PART, PART, PART, PART, PART),
    min_size=1,
    max_size=8,
).map(np.array)


@settings(deadline=None, max_examples=40)
@given(st.tuples(PART, PART, PART), st.floats(-400, 400), st.floats(0, 2), st.floats(0, 1.5))
def test_colours_are_shifted_in_oklch(rgb, turn, lighter, stronger):
    lightness, chroma, hue = to_oklch(rgb)
    wanted = from_oklch(min(lightness * lighter, 1.0), chroma * stronger, hue + turn)
    rows = np.array([[turn, lighter, stronger]])
    plain = rows.copy()
    shift_colours(rows, lab_of(rgb))
    shift_colours.plain(plain, lab_of(rgb))
    assert rows.tobytes() == plain.tobytes()
    if max(rows.max(), *wanted) < 1 and min(rows.min(), *wanted) > 0:  # else the panel brings it into the gamut its way
        np.testing.assert_allclose(rows[0], wanted, atol=1e-4)


@settings(deadline=None, max_examples=40)
@given(DABS)
def test_a_pixel_has_the_mean_that_its_dabs_leave(dabs):
    mask, plain = StrokeMask(0, (0, 0), tip=Tinted(None, 3)), StrokeMask(0, (0, 0))
    mean, covered = np.zeros((3, TILE, TILE), np.float32), np.zeros((TILE, TILE), np.float32)
    for row in dabs:
        mask.paint(row[None])
        plain.paint(row[None, :6])
        one = StrokeMask(0, (0, 0))
        one.paint(row[None, :6])
        strength = np.zeros_like(covered) + one.coverage().tiles.get(KEY, 0.0)
        covered = np.zeros_like(covered) + plain.coverage().tiles.get(KEY, 0.0)
        part = np.where(strength > 0, np.minimum(strength / np.maximum(np.maximum(covered, strength), 1e-30), 1), 0)
        mean += (row[6:, None, None].astype(np.float32) - mean) * part.astype(np.float32)
    found, wanted = mask.coverage(), plain.coverage()
    for key, tile in found.tiles.items():  # how much is covered does not hang on the colours
        assert np.abs(tile - wanted.tiles.get(key, 0.0)).max() < 2e-7
    if KEY in found.tints:
        assert np.abs(found.tints[KEY] - mean)[:, covered > 1e-4].max(initial=0.0) < 1e-4


def test_later_dabs_do_not_change_what_was_told():
    mask = StrokeMask(0, (0, 0), tip=Tinted(None, 1))
    mask.paint(np.array([[60.0, 60, 20, 1, 1, 1, 0.25]]))
    before = mask.coverage()
    kept = before.tints[KEY].copy()
    mask.paint(np.array([[60.0, 60, 20, 1, 1, 1, 0.75]]))
    assert np.array_equal(before.tints[KEY], kept)
    assert mask.coverage().tints[KEY][0, 60, 60] == 0.75  # a dab that covers in full leaves nothing below


@pytest.mark.parametrize("shaping", [None, "negate"])
def test_an_ink_under_no_tint_but_its_own_is_the_ink(shaping):
    parts = [{"texture": "rock", "amount": 0.8, "colour": "#20c040"}, {"texture": "white", "amount": 0.3}]
    brush = from_json({"colour": "#a04030", "ink": parts, "shaping": shaping})
    plain, made = resolve(brush, {}, 0, 1), tinted_ink(brush, {}, 0, 1)
    tints = np.ones((5, TILE, TILE), np.float32)
    tints[:3] = np.array(brush.rgb)[:, None, None]
    assert made.inks_under(None) == plain.inks
    weight, add = np.ones((TILE, TILE), np.float32), np.empty((4 + 3, TILE, TILE), np.float32)
    made.lay(KEY, tints, None, weight, add)
    np.testing.assert_allclose(add[:3], plain.field(KEY), atol=1e-5)
    np.testing.assert_allclose(add[4:], np.broadcast_to(plain.amplitudes[:, None, None], add[4:].shape), atol=1e-5)
    tints[3:], weight[:, :50] = 0.0, 0.0
    made.lay(KEY, tints, None, weight, add)
    assert not add[4:].any()
    assert not add[:3, :, :50].any()
    np.testing.assert_allclose(add[:3, :, 50:], tints[:3, :, 50:], atol=1e-5)


def test_only_brushes_that_lay_ink_have_tints_and_of_inks_that_there_are():
    hue = {"hue": {"random_dab": [[0, 1]]}}
    assert tints_of(from_json({"dynamics": hue})) == 3
    assert tints_of(from_json({"dynamics": hue, "ink": [{"texture": "rock"}]})) == 4
    assert tints_of(from_json({"dynamics": {"ink_1": {"tilt": [[0, 1]]}}})) == 0
    assert tints_of(from_json({"dynamics": hue, "mode": "erase"})) == 0
    dabs = Stroker(from_json({"dynamics": hue, "colour": "#336699"}), 3).add(np.array([[0.0, 0], [9, 0]]))
    np.testing.assert_allclose(
        dabs[:, 6:], np.broadcast_to(np.array([0x33, 0x66, 0x99]) / 255, dabs[:, 6:].shape), atol=1e-6
    )
