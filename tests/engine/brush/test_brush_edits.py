"""The edits of a stroke: A and B of painting, erasing and smoothing, alpha lock, and resolved ink."""

from dataclasses import fields

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from engine.brush.checks import BrushError
from engine.brush.coat import local_mean
from engine.brush.covered import Covered
from engine.brush.edits import class_of, edit
from engine.brush.ink import Ink, resolve
from engine.brush.mask import StrokeMask
from engine.brush.modes import MODES
from engine.brush.settings import Brush, from_json
from engine.numeric.address import TILE, Rect, TileKey
from engine.numeric.grid import snapped
from engine.texture.image import ImageSource
from engine.texture.planes import Planes
from engine.texture.table import instance

KEY = TileKey(0, 0, 0)
SOFT = np.array([[40.0, 50, 45, 0.8, 0.7, 0.3], [90, 70, 30, 1, 1, 0.9]])


def old_values(seed=1, size=TILE):
    """Random valid pixels on the grid, parts of them empty and parts opaque."""
    rng = np.random.default_rng(seed)
    alpha = np.clip(rng.uniform(-0.3, 1.3, (size, size)), 0, 1)
    return Planes(snapped(np.concatenate([rng.uniform(0, 1, (3, size, size)) * alpha, alpha[None]])))


def painted(brush, dabs=SOFT, locked=False, read=None, seed=7, textures=None):
    mask = StrokeMask(0, (0, 0))
    mask.paint(dabs)
    brush = from_json(brush)
    return edit(brush, mask, resolve(brush, textures or {}, 0, seed), locked, read), mask.coverage().on_grid(KEY)


def after(stamp, old):
    """v' = snap(A v) + B of the colour planes."""
    return snapped(stamp.keep * old.data[:4]) + stamp.add[:4]


def on_grid(array):
    return (np.asarray(array, float) * 65536 == np.rint(np.asarray(array, float) * 65536)).all()


def test_a_row_names_the_class_of_its_edits_and_the_modes_it_turns_into():
    for name, row in MODES.items():
        assert row.name == name
        assert row.eraser in MODES
        assert row.grows or issubclass(class_of(name), Covered)
        assert row.unfelt <= {part.name for part in fields(Brush)}


def test_paint_is_over():
    made, m = painted({"colour": "#ff8000"})
    stamp = made.stamp(KEY, old_values())
    assert (stamp.keep == 1 - m).all()
    colour = np.array([1, 128 / 255, 0, 1], np.float32)[:, None, None]
    np.testing.assert_allclose(stamp.add, m * colour, atol=2**-16)
    assert (stamp.add[3] == m).all()
    assert stamp.inks == ()
    assert stamp.keep.dtype == stamp.add.dtype == np.float32
    assert on_grid(stamp.keep)
    assert on_grid(stamp.add)


def test_an_edit_tells_where_it_is():
    made, _ = painted({})
    assert made.level == 0
    assert made.tiles == (TileKey(0, -1, 0), KEY)
    assert made.rect == Rect(-6, 4, 121, 101)
    assert made.stamp(TileKey(0, 50, 50), old_values()) is None


@pytest.mark.parametrize("mode", ["paint", "erase", "smooth"])
@pytest.mark.parametrize("column", [3, 4])
def test_without_coverage_there_is_no_stamp(mode, column):
    dabs = SOFT.copy()
    dabs[:, column] = 0
    made, _ = painted({"mode": mode}, dabs, read=lambda rect: Planes.empty(rect.height, rect.width))
    assert all(made.stamp(key, old_values()) is None for key in [*made.tiles, KEY])


def test_coverage_below_the_grid_is_no_stamp():
    made, _ = painted({}, np.array([[50.0, 50, 20, 1, 1e-6, 1]]))
    assert made.tiles
    assert made.stamp(KEY, old_values()) is None


def test_erase_takes_everything_away():
    old = old_values()
    made, m = painted({"mode": "erase"})
    stamp = made.stamp(KEY, old)
    assert (stamp.keep == 1 - m).all()
    assert not stamp.add.any()
    assert (after(stamp, old)[:, m == 1] == 0).all()


@settings(deadline=None, max_examples=30)
@given(
    st.sampled_from(["paint", "smooth"]),
    st.sampled_from([[], [{"texture": "rock", "colour": "#20ff40"}, {"texture": "stripes", "amount": 0.5}]]),
    st.integers(0, 2**32),
)
def test_alpha_lock_keeps_alpha_bit_for_bit(mode, ink, seed):
    rng = np.random.default_rng(seed)
    dabs = np.column_stack([rng.uniform(0, 128, (5, 2)), rng.uniform(1, 90, 5), rng.uniform(0, 1, (5, 3))])
    around = old_values(seed, 3 * TILE)
    old = around.cut(slice(TILE, 2 * TILE), slice(TILE, 2 * TILE))
    read = lambda rect: around.cut(*rect.slices(Rect(-TILE, -TILE, 2 * TILE, 2 * TILE)))  # noqa: E731
    made, m = painted({"mode": mode, "ink": ink, "colour": "#c08020"}, dabs, True, read)
    stamp = made.stamp(KEY, old)
    new = after(stamp, old)
    assert new[3].tobytes() == old.data[3].tobytes()
    assert (new[:, old.data[3] == 0] == 0).all()
    assert (stamp.keep == 1 - m).all()
    assert on_grid(stamp.add)
    if mode == "paint":
        field = resolve(made.brush, {}, 0, 7).field(KEY)
        np.testing.assert_allclose(stamp.add[:3], m * field * old.data[3], atol=3e-5)


def test_erasing_under_alpha_lock_does_nothing():
    made, _ = painted({"mode": "erase"}, locked=True)
    assert made.stamp(KEY, old_values()) is None


def test_flat_tiles_share_one_stamp_and_equal_painted_ones():
    huge = np.array([[64.0, 64, 1500, 0.7, 0.9, 1]])
    made, m = painted({"colour": "#336699"}, huge)
    a, b = made.stamp(KEY, old_values()), made.stamp(TileKey(0, 2, 1), old_values(3))
    assert a is b
    assert (a.keep == 1 - m).all()
    np.testing.assert_allclose(a.add[:3, 0, 0], 0.63 * np.array([0x33, 0x66, 0x99]) / 255, atol=2e-5)
    locked, _ = painted({"colour": "#336699"}, huge, True)
    assert locked.stamp(KEY, old_values()) is not locked.stamp(KEY, old_values(3))


def test_the_same_key_and_values_give_the_same_stamp():
    brush = {"ink": [{"texture": "rock"}]}
    made, _ = painted(brush)
    again, _ = painted(brush)
    a, b, c = (e.stamp(KEY, old_values()) for e in (made, made, again))
    assert a.add.tobytes() == b.add.tobytes() == c.add.tobytes()
    assert a.inks == c.inks


def test_a_later_dab_does_not_change_an_edit():
    mask = StrokeMask(0, (0, 0))
    mask.paint(SOFT[:1])
    brush = from_json({})
    made = edit(brush, mask, resolve(brush, {}, 0, 1))
    before = made.stamp(KEY, old_values()).add.copy()
    mask.paint(SOFT)
    assert (made.stamp(KEY, old_values()).add == before).all()


# ---- ink ------------------------------------------------------------------------------------------------------------


def test_plain_and_white_ink_have_no_planes():
    ink = resolve(from_json({"colour": "#000000", "ink": [{"texture": "white", "amount": 0.5}]}), {}, 3, 1)
    assert ink.inks == ()
    np.testing.assert_allclose(ink.base, 0.5)
    assert resolve(from_json({"colour": "#ff0000"}), {}, 0, 0).base.tolist() == [1, 0, 0]


class Named:
    """A texture defined under a name."""

    def __init__(self, kind):
        self.kind = kind

    def instance(self, parameters, level, seed):
        return instance(self.kind, {"period": 10, **parameters}, level, seed)


def test_a_defined_texture_comes_before_a_built_in_one_of_its_name():
    brush = from_json({"ink": [{"texture": "rock"}, {"texture": "mine", "period": 20}]})
    ink = resolve(brush, {"rock": Named("squares"), "mine": Named("white")}, 0, 1)
    assert [i.key[:3] for i in ink.inks] == [("squares", 0, 10)]


def test_a_component_mixes_towards_its_colour():
    """C + a s (X - C), s = (S + 1)/2, summed over the components."""
    brush = from_json(
        {
            "colour": "#204060",
            "ink": [
                {"texture": "stripes", "amount": 0.5, "colour": "#ff0000", "period": 16},
                {"texture": "rock", "amount": 0.25, "colour": "#00ff00", "seed": 5},
            ],
        }
    )
    ink = resolve(brush, {}, 2, 9)
    key = TileKey(2, 3, -4)
    assert [i.key[0] for i in ink.inks] == ["rock", "stripes"]
    under = np.array(brush.rgb)[:, None, None]
    expected = under + 0
    for part in brush.ink:
        s = (next(i for i in ink.inks if i.key[0] == part.texture).appearance(2, key.rect).astype(float) + 1) / 2
        expected = expected + part.amount * s * (np.array(part.rgb)[:, None, None] - under)
    np.testing.assert_allclose(ink.field(key), expected, atol=1e-6)
    assert ink.field(key) is ink.field(key)


def test_painting_with_texture_lays_amplitudes():
    brush = {"colour": "#000000", "ink": [{"texture": "squares", "amount": 0.5, "colour": "#ffffff", "period": 9}]}
    made, m = painted(brush)
    stamp = made.stamp(KEY, old_values())
    assert stamp.add.shape == (7, TILE, TILE)
    np.testing.assert_allclose(stamp.add[4:], np.broadcast_to(m * 0.25, (3, TILE, TILE)), atol=2**-16)
    s = stamp.inks[0].appearance(0, KEY.rect)[0]
    np.testing.assert_allclose(stamp.add[0], m * (0.25 + 0.25 * s), atol=2**-15)
    assert on_grid(stamp.add)


def test_equal_instances_are_one():
    rock = {"texture": "rock", "seed": 1, "amount": 0.5}
    ink = resolve(from_json({"ink": [rock | {"colour": "#ff0000"}, rock | {"colour": "#0000ff"}]}), {}, 0, 1)
    assert len(ink.loaded) == 1
    np.testing.assert_allclose(ink.loaded[0].amplitude, [0.25, 0, 0.25])


def test_components_without_effect_have_no_planes():
    parts = [{"texture": "rock", "amount": 0}, {"texture": "stripes", "colour": "#000000"}]
    assert resolve(from_json({"colour": "#000000", "ink": parts}), {}, 0, 1).inks == ()


def test_the_strokes_seed_is_the_textures_unless_they_have_their_own():
    brush = from_json({"ink": [{"texture": "rock"}]})
    assert resolve(brush, {}, 0, 1).inks != resolve(brush, {}, 0, 2).inks
    brush = from_json({"ink": [{"texture": "rock", "seed": 4}]})
    assert resolve(brush, {}, 0, 1).inks == resolve(brush, {}, 0, 2).inks


def picture():
    y, x = np.mgrid[:32, :32] / 31.0
    alpha = (x > 0.5).astype(float)
    return ImageSource.of("leaf", np.stack([x * alpha, y * alpha, 0 * x, alpha]).astype(np.float32))


def test_a_picture_covers_the_brush_colour_by_its_own_alpha():
    brush = from_json({"colour": "#ffffff", "ink": [{"texture": "leaf", "amount": 0.5, "colour": "#ff8000"}]})
    ink = resolve(brush, {"leaf": picture()}, 0, 1)
    cover, image = ink.loaded
    s = image.instance.appearance(0, KEY.rect)
    tint = np.array([1, 128 / 255, 0])[:, None, None]
    np.testing.assert_allclose(ink.field(KEY), 1 - 0.5 * s[3] + 0.5 * tint * s[:3], atol=1e-6)
    np.testing.assert_allclose(image.amplitude, 0.5 * tint[:, 0, 0])
    np.testing.assert_allclose(cover.amplitude, [-0.5, -0.5, -0.5])
    assert (cover.instance.appearance(0, KEY.rect) == s[3:]).all()


def test_an_opaque_picture_hides_the_brush_colour_without_a_plane_for_its_alpha():
    data = np.concatenate([picture().data[:3], np.ones((1, 32, 32), np.float32)])
    brush = from_json({"colour": "#ffffff", "ink": [{"texture": "leaf", "amount": 0.5}]})
    ink = resolve(brush, {"leaf": ImageSource.of("leaf", data)}, 0, 1)
    assert len(ink.loaded) == 1
    np.testing.assert_allclose(ink.base, 0.5)
    s = ink.inks[0].appearance(0, KEY.rect)
    np.testing.assert_allclose(ink.field(KEY), 0.5 + 0.5 * s[:3], atol=1e-6)


@pytest.mark.parametrize(
    ("component", "place"),
    [
        ({"texture": "marmalade"}, "brush.ink[0].texture"),
        ({"texture": "stripes", "period": 1}, "brush.ink[0].period"),
        ({"texture": "stripes", "period": None, "angle": "up"}, "brush.ink[0].angle"),
        ({"texture": "image"}, "brush.ink[0].source"),
    ],
)
def test_textures_that_cannot_be_are_named(component, place):
    with pytest.raises(BrushError) as caught:
        resolve(from_json({"ink": [component]}), {}, 0, 1)
    assert caught.value.place == place
    assert "\n" not in str(caught.value)


def test_unknown_parameters_are_ignored():
    parts = [{"texture": "rock", "seed": 1, "of a later version": [1]}]
    assert (
        resolve(from_json({"ink": parts}), {}, 0, 1).inks
        == resolve(from_json({"ink": [{"texture": "rock", "seed": 1}]}), {}, 0, 1).inks
    )


# ---- smoothing ------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("reach", [1, 5, 32])
def test_the_local_mean_is_two_boxes(reach):
    planes = old_values(4, TILE + 4 * reach).data
    box = np.ones(2 * reach + 1)
    tent = np.convolve(box, box) / len(box) ** 2
    rows = np.apply_along_axis(lambda line: np.convolve(line, tent, "valid"), 1, planes.astype(float))
    expected = np.apply_along_axis(lambda line: np.convolve(line, tent, "valid"), 2, rows)
    np.testing.assert_allclose(local_mean(planes, reach), expected, atol=1e-6)


def smooth_read(planes, margin):
    return lambda rect: planes.cut(*rect.slices(Rect(-margin, -margin, TILE + margin, TILE + margin)))


def test_smoothing_goes_to_the_local_mean_and_removes_ink():
    margin = 2 * TILE
    around = old_values(5, TILE + 2 * margin)
    old = around.cut(slice(margin, margin + TILE), slice(margin, margin + TILE))
    full = np.array([[64.0, 64, 400, 1, 1, 1]])
    made, m = painted({"mode": "smooth", "radius": 20}, full, read=smooth_read(around, margin))
    assert (m == 1).all()
    stamp = made.stamp(KEY, old)
    new = after(stamp, old)
    mean = local_mean(np.ascontiguousarray(around.data[:4, margin - 10 : -margin + 10, margin - 10 : -margin + 10]), 5)
    np.testing.assert_allclose(new, mean, atol=2**-16)
    assert stamp.inks == ()
    assert not stamp.keep.any()
    assert new.std() < 0.5 * old.data.std()


def test_smoothing_leaves_an_even_area_as_it_is():
    even = Planes(np.full((4, TILE, TILE), 0.375, np.float32))
    made, _ = painted(
        {"mode": "smooth", "radius": 300},
        read=lambda rect: Planes(np.full((4, rect.height, rect.width), 0.375, np.float32)),
    )
    np.testing.assert_allclose(after(made.stamp(KEY, even), even), 0.375, atol=2**-15)


def test_smoothing_reads_no_farther_than_its_cap():
    seen = []

    def read(rect):
        seen.append(rect)
        return Planes.empty(rect.height, rect.width)

    made, _ = painted({"mode": "smooth", "radius": 4000}, read=read)
    made.stamp(KEY, old_values())
    assert seen == [KEY.rect.grown(64)]


def test_a_mode_that_makes_no_edit_is_refused():
    brush = from_json({"mode": "example"})
    with pytest.raises(BrushError, match=r"brush\.mode"):
        edit(brush, StrokeMask(0, (0, 0)), Ink(np.zeros(3, np.float32)))
