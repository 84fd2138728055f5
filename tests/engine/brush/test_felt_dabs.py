"""The walk of brushes that feel more than pressure: tilt, direction, speed, distance, chance; turned and scattered."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from engine.brush import felt, felt_dabs
from engine.brush.dabs import Stroker, stroke_key
from engine.brush.inputs import INPUTS
from engine.brush.samples import cleaned
from engine.brush.settings import from_json, to_json
from engine.brush.targets import FOLLOWERS

STEP = st.floats(-60, 60, width=32)
POINT = st.tuples(STEP, STEP, st.floats(0, 1), STEP, STEP, st.floats(0, 0.2), st.floats(-400, 400))
POINTS = st.lists(POINT, min_size=1, max_size=12).map(np.array)
CURVES = st.sampled_from([[[0, 0.2], [1, 1]], [[0.1, 1], [0.4, 0.3], [0.9, 1.5]], [[0, 1]]])
FELT = st.dictionaries(st.sampled_from([*INPUTS]), CURVES, min_size=1, max_size=3)
BRUSHES = st.builds(
    lambda dynamics, shape, spacing: from_json({"radius": 9, "spacing": spacing, "dynamics": dynamics, "shape": shape}),
    st.dictionaries(st.sampled_from([*FOLLOWERS]), FELT, max_size=4),
    st.fixed_dictionaries(
        {},
        optional={
            "ratio": st.floats(0.05, 1),
            "angle": st.floats(-360, 360),
            "follow": st.sampled_from(["none", "direction", "pen"]),
            "scatter": st.floats(0, 3),
            "count": st.integers(1, 3),
            "bristles": st.integers(0, 5),
        },
    ),
    st.floats(0.1, 2),
)


def timed(points):
    """The same with times that rise."""
    out = points.copy()
    out[:, 5] = np.cumsum(out[:, 5])
    return out


@settings(deadline=None, max_examples=60)
@given(BRUSHES, POINTS.map(timed), st.lists(st.integers(0, 12), max_size=4))
def test_any_portions_give_the_same_dabs_bit_for_bit(brush, points, cuts):
    whole, parts = Stroker(brush, 7), Stroker(brush, 7)
    told = [parts.add(part) for part in np.split(points, sorted(min(c, len(points)) for c in cuts))]
    assert np.concatenate(told).tobytes() == whole.add(points).tobytes()
    assert parts.rest().tobytes() == whole.rest().tobytes()


@settings(deadline=None, max_examples=40)
@given(BRUSHES, POINTS.map(timed))
def test_what_is_compiled_does_what_its_text_does(brush, points):
    points.flags.writeable = False
    known, dabs = felt.feeling(brush), np.zeros((2, 4096, 12))
    states = np.zeros((2, felt.STATE))
    walk = felt_dabs.walk_felt
    made = [
        form(points, states[k], known, np.uint64(5), dabs[k], False)
        for k, form in enumerate((walk.compiled, walk.plain))
    ]
    assert made[0] == made[1]
    assert dabs[0].tobytes() == dabs[1].tobytes()
    assert states[0].tobytes() == states[1].tobytes()


@settings(deadline=None, max_examples=40)
@given(POINTS, st.sampled_from([{}, {"radius": "pressure"}, {"radius": [[0.2, 0.1], [1, 3]], "spacing": "pressure"}]))
def test_without_other_inputs_it_is_the_walk_of_all_brushes(points, dynamics):
    plain = from_json({"radius": 9, "dynamics": dynamics})
    turned = from_json({"radius": 9, "dynamics": dynamics, "shape": {"angle": 30}})
    assert felt.feels(turned)
    assert not felt.feels(plain)
    assert Stroker(turned).add(points).tobytes() == Stroker(plain).add(points).tobytes()


def line(*rows):
    return np.array(rows, float)


def dabs_of(points, dynamics, key=0, **shape):
    brush = from_json({"radius": 10, "spacing": 1, "dynamics": dynamics, **({"shape": shape} if shape else {})})
    return Stroker(brush, key).whole(cleaned(points)[0])


@pytest.mark.parametrize(
    ("felt_input", "knots", "points", "radii"),
    [
        ("tilt", [[0, 1], [90, 0]], line([0, 0, 1, 45, 0], [1, 0, 1, 45, 0]), [5.0]),
        ("tilt_direction", [[0, 0], [360, 1]], line([0, 0, 1, 0, 30], [1, 0, 1, 0, 30]), [2.5]),
        ("rotation", [[0, 0], [360, 1]], line([0, 0, 1, 0, 0, 0, -90], [1, 0, 1, 0, 0, 0, -90]), [7.5]),
        ("direction", [[0, 0], [360, 1]], line([0, 0], [0, -2]), [7.5]),
        ("distance", [[0, 1], [100, 0]], line([0, 0], [25, 0]), [10.0, 9.0, 8.1]),
        ("fade", [[0, 1], [2, 0.5]], line([0, 0], [24, 0]), [10.0, 7.5, 5.0, 5.0]),
        ("speed", [[0, 1], [1, 0.5]], line([0, 0], [9, 0]), [5.0, 5.0]),
    ],
)
def test_each_input_is_what_its_row_says(felt_input, knots, points, radii):
    dabs = dabs_of(points, {"radius": {felt_input: knots}})
    np.testing.assert_allclose(dabs[:, 2][: len(radii)], radii, rtol=1e-12)


def test_speed_comes_up_from_rest_and_is_in_pixels_a_second():
    rows = line(*([k * 10.0, 0, 1, 0, 0, k * 0.01] for k in range(60)))
    radii = dabs_of(rows, {"radius": {"speed": [[0, 1], [1000, 0.5], [2000, 0]]}})[:, 2]
    assert radii[0] == pytest.approx(10.0, abs=0.01)
    assert (np.diff(radii) <= 0).all()
    assert radii[-1] == pytest.approx(5.0, abs=0.01)


def test_several_inputs_are_multiplied():
    both = {"radius": {"pressure": [[0, 0.5]], "tilt": [[0, 0.5]]}, "opacity": {"pressure": [[0, 0.25]]}}
    assert dabs_of(line([0, 0]), both)[0, 2:4].tolist() == [2.5, 0.25]


def test_one_of_pressure_alone_is_the_curve_of_old():
    knots = [[0, 0.2], [1, 1]]
    assert from_json({"dynamics": {"radius": {"pressure": knots}}}) == from_json({"dynamics": {"radius": knots}})
    assert from_json({"dynamics": {"radius": {}}}) == from_json({"dynamics": {}})


@settings(deadline=None, max_examples=30)
@given(BRUSHES)
def test_a_brush_is_read_as_it_was_written(brush):
    assert from_json(to_json(brush)) == brush


def test_random_numbers_hang_on_seed_place_and_dab_alone():
    points = line([0, 0], [90, 0])
    by_dab, by_stroke = ({"radius": {name: [[0, 0], [1, 1]]}} for name in ("random_dab", "random_stroke"))
    keys = [stroke_key(3, 0, (0, 0)), stroke_key(3, 0, (1, 0)), stroke_key(4, 0, (0, 0)), stroke_key(3, 1, (0, 0))]
    first = [dabs_of(points, by_dab, key)[:4, 2].tolist() for key in keys]
    assert len({*map(tuple, first)}) == 4
    assert len(set(first[0])) == 4
    whole = [dabs_of(points, by_stroke, key)[:, 2].tolist() for key in keys]
    assert all(len(set(radii)) == 1 for radii in whole)
    assert len({radii[0] for radii in whole}) == 4
    assert dabs_of(points, by_dab, keys[0])[:4, 2].tolist() == first[0]
    two = dabs_of(points, by_dab | {"opacity": {"random_dab": [[0, 0], [1, 1]]}}, keys[0])
    assert abs(np.corrcoef(two[:, 2], two[:, 3])[0, 1]) < 0.9  # another number for each


def test_random_numbers_are_even():
    numbers = [felt.plain_chance(9, n, 3) for n in range(4000)]
    assert np.histogram(numbers, 8, (0, 1))[0].min() > 420
    assert 0.0 <= min(numbers) < max(numbers) < 1.0


def test_a_tip_follows_the_stroke_from_its_first_dab_on():
    down = dabs_of(line([0, 0], [0, 0], [0, 30]), {}, ratio=0.3, follow="direction")
    np.testing.assert_allclose(down[:, 6:8], [[0, 1]] * len(down), atol=1e-15)
    assert (down[:, 8] == 0.3).all()
    tapped = dabs_of(line([5, 6], [5, 6]), {}, ratio=0.3, angle=90, follow="direction")
    assert tapped[:, :3].tolist() == [[5, 6, 10]]
    np.testing.assert_allclose(tapped[0, 6:8], [0, 1], atol=1e-15)


def test_a_shaking_hand_does_not_turn_a_tip_about():
    rng = np.random.default_rng(1)
    points = np.column_stack([np.arange(0, 60, 0.3), rng.normal(0, 0.2, 200)])
    angles = dabs_of(points, {}, ratio=0.3, follow="direction")[4:, 6]
    assert angles.min() > math.cos(math.radians(45))


def test_a_tip_follows_the_barrel_or_where_the_pen_leans():
    told = dabs_of(line([0, 0, 1, 0, 40, 0, 200.0]), {}, ratio=0.5, follow="pen")
    np.testing.assert_allclose(told[0, 6:8], [math.cos(math.radians(200)), math.sin(math.radians(200))])
    leaning = dabs_of(line([0, 0, 1, 0, 40, 0]), {}, ratio=0.5, follow="pen")
    np.testing.assert_allclose(leaning[0, 6:8], [0, 1], atol=1e-15)


def test_the_barrel_turns_the_short_way():
    points = line([0, 0, 1, 0, 0, 0, 350], [40, 0, 1, 0, 0, 0, 370 - 360])
    turned = dabs_of(points, {"radius": {"rotation": [[0, 1], [180, 1], [181, 0.5]]}})
    assert (turned[:, 0] <= 42).all()
    assert set(turned[:, 2]) == {5.0, 10.0}


def test_angles_are_turned_by_parts_of_a_full_turn():
    quarter = {"angle": {"pressure": [[0, 0.25]]}}
    np.testing.assert_allclose(dabs_of(line([0, 0]), quarter, ratio=0.5, angle=10)[0, 6:8], [
        math.cos(math.radians(100)), math.sin(math.radians(100))])  # fmt: skip
    np.testing.assert_allclose(dabs_of(line([0, 0]), {}, ratio=0.5)[0, 6:8], [1, 0])


def test_dabs_are_scattered_within_their_reach_and_as_many_as_told():
    points = line([0, 0], [400, 0])
    plain, strewn = dabs_of(points, {}), dabs_of(points, {}, scatter=2, count=3)
    assert len(strewn) == 3 * len(plain)
    away = strewn[:, :2].reshape(-1, 3, 2) - plain[:, None, :2]
    far = np.hypot(away[..., 0], away[..., 1])
    assert 15 < far.max() <= 20
    assert abs(away.mean()) < 3


def test_hairs_lie_in_the_tip_and_run_along_the_stroke():
    brush = from_json({"radius": 20, "dynamics": {}, "shape": {"ratio": 0.25, "angle": 90, "bristles": 50}})
    dabs = Stroker(brush, 4).add(line([0, 0], [60, 0])).reshape(-1, 50, 6)
    places = dabs[:, :, :2] - dabs[:, :, :2].mean(axis=1, keepdims=True)
    np.testing.assert_allclose(places, np.broadcast_to(places[:1], places.shape), atol=1e-9)  # each keeps its line
    assert (((dabs[0, :, 0] / 5) ** 2 + (dabs[0, :, 1] / 20) ** 2) <= 1 + 1e-9).all()
    assert np.ptp(dabs[0, :, 1]) > 34
    assert dabs[..., 3].min() < 0.9
    assert dabs[..., 3].max() == 1.0
    assert np.abs(np.diff(dabs[..., 3], axis=0)).max() < 0.1  # not dab by dab


def test_with_less_opacity_fewer_hairs_are_wet_and_each_lays_as_much():
    def wet(opacity):
        told = {"radius": 20, "opacity": 0.8, "dynamics": {"opacity": [[0, opacity]]}, "shape": {"bristles": 60}}
        return Stroker(from_json(told), 4).add(line([0, 0], [60, 0]))[:, 3]

    dry, half, full = map(wet, (0.0, 0.5, 1.0))
    assert not dry.any()
    assert (half > 0).sum() < (full > 0).sum()
    assert half.max() == pytest.approx(full.max()) == pytest.approx(0.8)


HOSTILE = {
    "an input that there is not": ({"dynamics": {"radius": {"wind": [[0, 1]]}}}, "brush.dynamics.radius: found"),
    "an input's knots": ({"dynamics": {"radius": {"tilt": [[91, 1]]}}}, "brush.dynamics.radius.tilt[0]: found 91"),
    "a word": ({"dynamics": {"radius": "speed"}}, "brush.dynamics.radius: found"),
    "a ratio of nothing": ({"shape": {"ratio": 0}}, "brush.shape.ratio: found 0"),
    "an endless angle": ({"shape": {"angle": 1e9}}, "brush.shape.angle: found 1000000000.0"),
    "who it follows": ({"shape": {"follow": "me"}}, "brush.shape.follow: found"),
    "half a dab": ({"shape": {"count": 1.5}}, "brush.shape.count: found 1.5"),
    "no object": ({"shape": 3}, "brush.shape: found 3"),
    "too many hairs": ({"shape": {"bristles": 100000}}, "brush.shape.bristles: found 100000"),
}


@pytest.mark.parametrize("name", HOSTILE)
def test_what_is_wrong_is_told_in_one_line(name):
    told, words = HOSTILE[name]
    with pytest.raises(ValueError, match="found") as caught:
        from_json(told)
    assert str(caught.value).startswith(words)
    assert "\n" not in str(caught.value)


def test_the_number_of_dabs_is_bounded():
    brush = from_json({"radius": 0, "spacing": 0, "dynamics": {}, "shape": {"count": 16, "scatter": 1}})
    far = line([-(2.0**31), 0], [2.0**31, 0])
    assert len(Stroker(brush).add(far)) <= felt_dabs.SEGMENT_CAP + 48
