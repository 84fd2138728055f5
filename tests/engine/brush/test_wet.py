"""Wet brushes: what they take up and carry, how it mixes, and that the bits hang on nothing but the stroke."""

import json
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from engine.brush.checks import BrushError
from engine.brush.copies import Copy
from engine.brush.settings import from_json, to_json
from engine.canvas.evaluate import evaluate
from engine.canvas.layers import layers
from engine.numeric.address import Rect
from engine.numeric.kernel import kernel
from engine.numeric.pigment import LIGHT, PIGMENT, from_paint, paints, to_paint
from engine.painting.commands import Undo
from engine.painting.commands import parse as command
from engine.painting.recording import version_of
from engine.session.replay import replay
from engine.session.session import Session

HALVES = Rect(0, 0, 120, 60)
PART = st.floats(0, 1)
COLOUR = st.tuples(PART, PART, PART)


@kernel
def _mixed(first, second, part, size, told):
    one, other = np.empty(size), np.empty(size)
    to_paint(first[0], first[1], first[2], told, one)
    to_paint(second[0], second[1], second[2], told, other)
    for c in range(size):
        one[c] += (other[c] - one[c]) * part
    return from_paint(one, told)


def mixed(first, second, part, size=PIGMENT):
    return np.array(_mixed(tuple(map(float, first)), tuple(map(float, second)), float(part), size, paints()))


@settings(deadline=None)
@given(COLOUR, COLOUR, PART)
def test_paint_that_is_not_mixed_keeps_its_colour(one, other, part):
    for size in (LIGHT, PIGMENT):
        np.testing.assert_allclose(mixed(one, other, 0.0, size), one, atol=2e-6)
        np.testing.assert_allclose(mixed(one, one, part, size), one, atol=2e-6)
    both = mixed(one, other, part)
    assert 0 <= both.min() <= both.max() <= 1
    np.testing.assert_array_equal(both, mixed(one, other, part))


def test_blue_and_yellow_make_green_as_pigment_and_grey_as_light():
    blue, yellow = (0.1, 0.2, 0.6), (0.97, 0.83, 0.1)
    red, green, low = mixed(blue, yellow, 0.4)
    assert green > max(red + 0.08, low + 0.02)
    red, green, low = mixed(blue, yellow, 0.5, LIGHT)
    assert max(red, green, low) - min(red, green, low) < 0.2
    greys = [mixed((0, 0, 0), (1, 1, 1), part)[0] for part in np.linspace(0, 1, 9)]
    assert np.all(np.diff(greys) > 0)
    assert 0.35 < greys[4] < 0.65  # black does not drown white


def points_of(*places):
    return np.array([[x, y, 1.0, 0.0, 0.0, 0.0] for x, y in places], np.float64)


def halves(session=None):
    """Yellow on the left, blue on the right."""
    session = session or Session()
    for x, colour in ((0, "#f5d020"), (60, "#1a3f9f")):
        for y in range(0, 61, 10):
            brush = from_json({"radius": 8, "hardness": 1, "colour": colour, "dynamics": {}})
            draw(session, brush, points_of((x + 8, y), (x + 52, y)))
    return session


def draw(session, brush, points, portion=1000, level=0, **more):
    live = session.begin(level, (0, 0), brush, **more)
    for start in range(0, len(points), portion):
        live.add(points[start : start + portion])
    session.finish(live)


def pixels(session, rect=HALVES, level=0):
    layer = next(iter(layers(session.painting.root)))
    return evaluate(layer.pyramid, level, rect).data


def wet(length=0.9, amount=1.0, dilution=0.0, mixing="light", **brush):
    told = {"length": length, "amount": amount, "dilution": dilution, "mixing": mixing}
    return from_json({"radius": 9, "hardness": 0.6, "spacing": 0.2, "dynamics": {}, "wet": told, **brush})


ACROSS = points_of(*((x, 30 + 3 * np.sin(x)) for x in np.arange(14.0, 106.0, 3.7)))
KINDS = {
    "light": {},
    "pigment": {"mixing": "pigment", "dilution": 0.3, "amount": 0.6},
    "hairs": {"shape": {"bristles": 12, "ratio": 0.5, "angle": 90, "follow": "direction"}, "amount": 0.7},
    "slender": {"shape": {"ratio": 0.2, "angle": 60}, "mixing": "pigment"},
    "textured": {"ink": [{"texture": "rock", "amount": 0.6, "period": 9}], "amount": 0.4},
    "large": {"radius": 31},
}


def test_what_is_taken_up_is_carried_and_fades():
    session = halves()
    draw(session, wet(), ACROSS)
    along = pixels(session)[:3, 30]
    before, after = along[:, 40], along[:, 68]
    yellow, blue = np.array([0.96, 0.82, 0.13]), np.array([0.1, 0.25, 0.62])
    assert np.abs(before - yellow).max() < 0.1
    assert np.abs(after - blue).max() > 0.15  # yellow came along
    shorter = halves()
    draw(shorter, wet(length=0.2), ACROSS)
    far = pixels(shorter)[:3, 30, 80]
    assert np.abs(far - blue).max() < np.abs(along[:, 80] - blue).max()


def test_a_brush_that_takes_nothing_up_paints_as_one_that_is_not_wet():
    paint = {"colour": "#c02040", "radius": 9, "hardness": 0.6, "spacing": 0.2, "dynamics": {}}
    one, other = halves(), halves()
    draw(one, from_json({**paint, "wet": {"amount": 0}}), ACROSS)
    draw(other, from_json(paint), ACROSS)
    assert np.abs(pixels(one) - pixels(other)).max() < 1e-4


def test_where_nothing_lies_a_smear_leaves_nothing_and_no_hole():
    session = Session()
    draw(session, from_json({"radius": 9, "dynamics": {}}), points_of((60, 30), (100, 30)))
    before = pixels(session)
    draw(session, wet(), points_of((5, 30), (25, 30)))
    np.testing.assert_array_equal(pixels(session), before)
    draw(session, wet(length=1.0), ACROSS)  # it begins on nothing, which is no paint
    assert (pixels(session)[3] >= before[3] - 2**-15).all()


def test_water_lets_what_lies_there_show_pixel_by_pixel():
    session = halves()
    draw(session, wet(amount=0.0, dilution=0.6, mixing="pigment", colour="#1a3f9f"), points_of((20, 30), (45, 30)))
    red, green, blue = pixels(session)[:3, 30, 32]
    assert green > max(red, blue)  # blue over yellow
    clear = halves()
    before = pixels(clear)
    draw(clear, wet(amount=0.0, dilution=1.0, colour="#1a3f9f"), ACROSS)
    np.testing.assert_array_equal(pixels(clear), before)


@pytest.mark.parametrize("kind", KINDS)
def test_a_stroke_is_the_same_in_whatever_portions_its_points_come(kind):
    brush = wet(**KINDS[kind])
    whole, parts = halves(), halves()
    draw(whole, brush, ACROSS)
    live = parts.begin(0, (0, 0), brush)
    for point in ACROSS:
        live.add(point[None])
    shown = live.preview(HALVES).data.copy()
    parts.finish(live)
    assert pixels(whole).tobytes() == pixels(parts).tobytes()
    np.testing.assert_array_equal(shown, pixels(parts))  # the preview is what the commit is
    replays = replay(whole.recording()).painting
    layer = next(iter(layers(replays.root)))
    assert evaluate(layer.pyramid, 0, HALVES).data.tobytes() == pixels(whole).tobytes()
    before = pixels(halves()).tobytes()
    whole.do(Undo())
    assert pixels(whole).tobytes() == before


def test_bits_do_not_hang_on_where_squares_and_tiles_lie():
    far = (1 << 40) + 40
    one, other = Session(), Session()
    for session, x in ((one, 0), (other, far)):
        for radius, level, brush in ((20, 0, {"colour": "#f5d020"}), (9, 0, {"wet": {"amount": 0.7}})):
            live = session.begin(level, (x, x), from_json({"radius": radius, "dynamics": {}, **brush}))
            live.add(ACROSS)
            session.finish(live)
    moved = Rect.at(far, far, HALVES.width, HALVES.height)
    np.testing.assert_allclose(pixels(one), pixels(other, moved), atol=1e-4)


def test_only_what_is_selected_is_seen_and_changed():
    session = halves()
    session.do(command({"do": "select", "rect": [0, 0, 0, 60, 60]}))
    before = pixels(session)
    draw(session, wet(length=1.0), ACROSS[::-1])
    after = pixels(session)
    np.testing.assert_array_equal(after[:, :, 61:], before[:, :, 61:])
    assert (after != before).any()


def test_under_alpha_lock_alpha_stays():
    session = halves()
    session.do(command({"do": "layer", "set": "Layer 1", "alpha_locked": True}))
    before = pixels(session)
    draw(session, wet(amount=0.6, dilution=0.4, mixing="pigment", colour="#d02020"), points_of((-20, 30), (140, 40)))
    after = pixels(session)
    np.testing.assert_array_equal(after[3], before[3])
    assert (after[:3] != before[:3]).any()


def test_on_a_layer_that_repeats_paint_is_carried_over_the_rim():
    session = halves()
    session.do(command({"do": "layer", "set": "Layer 1", "wrap": [0, 0, 0, 128, 64]}))
    draw(session, wet(length=0.97), points_of((100, 30), (145, 30)))  # from blue over the rim onto yellow
    red, _, blue = pixels(session)[:3, 30, 12]
    assert blue > 0.3
    assert red < 0.8


@settings(deadline=None, max_examples=10)
@given(PART, PART, PART, st.sampled_from(["light", "pigment"]))
def test_colours_stay_between_those_that_there_are(length, amount, dilution, mixing):
    session = halves()
    draw(session, wet(length, amount, dilution, mixing, colour="#c01830"), ACROSS[::4])
    rgba = pixels(session)[:4]
    assert 0 <= rgba.min() <= rgba.max() <= 1
    assert (rgba[:3] <= rgba[3] + 2**-14).all()


def test_hairs_of_a_tip_stay_together_in_its_copies(monkeypatch):
    copy = Copy(0.0, 1.0, 90.0, -30.0, True)
    brush, found = wet(**KINDS["hairs"]), []
    for most in (1 << 18, 40):
        monkeypatch.setattr("engine.brush.copies._AT_ONCE", most)
        session = halves()
        draw(session, brush, ACROSS, copies=(copy,))
        found.append(pixels(session).tobytes())
    assert found[0] == found[1]


@settings(deadline=None, max_examples=10)
@given(st.floats(0, 40), st.floats(0.01, 1), st.floats(-90, 90), PART, st.integers(0, 5))
def test_tips_however_slender_or_small_take_up_paint(radius, ratio, angle, least, hairs):
    shape = {"ratio": ratio, "angle": angle, "follow": "direction", "bristles": hairs}
    session = halves()
    brush = wet(amount=0.7, radius=radius, shape=shape, dynamics={"radius": {"fade": [[0, least], [9, 0], [20, 1]]}})
    draw(session, brush, ACROSS[::4])
    assert 0 <= pixels(session)[:4].min() <= pixels(session)[:4].max() <= 1


def test_it_is_told_as_it_was_read_and_is_of_version_2():
    told = {"length": 0.5, "amount": 0.25, "dilution": 0.125, "mixing": "pigment", "later": [1]}
    brush = from_json({"wet": told})
    assert to_json(brush)["wet"] == told
    assert from_json(json.loads(json.dumps(to_json(brush)))) == brush
    assert "wet" not in to_json(replace(brush, wet=None))
    stroke = {"do": "stroke", "points": [[0, 0]]}
    assert version_of(command({**stroke, "brush": {"wet": {}}})) == 2
    assert version_of(command({**stroke, "brush": {}})) == 1


@pytest.mark.parametrize(
    ("told", "message"),
    [
        (3, "brush.wet: found 3, expected an object"),
        ({"length": 2}, "brush.wet.length: found 2, expected a number from 0 to 1"),
        ({"amount": "much"}, "brush.wet.amount: found"),
        ({"dilution": float("nan")}, "brush.wet.dilution: found"),
        ({"mixing": "oil"}, "brush.wet.mixing: found"),
    ],
)
def test_what_is_wrong_is_named(told, message):
    with pytest.raises(BrushError, match=message.replace(".", r"\.")):
        from_json({"wet": told})
