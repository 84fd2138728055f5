"""Raster-ops on tiles: each against its formula in plain NumPy; alpha, identity, bounds, slopes, textures, formulas."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from engine.brush import edits, op_paint, op_targets
from engine.brush.checks import rgb
from engine.brush.covered import Scene
from engine.brush.mask import StrokeMask
from engine.brush.mixture import mixture
from engine.brush.ops import OPS
from engine.brush.settings import from_json, to_json
from engine.brush.tints import saturating, turning
from engine.numeric.address import TILE, Rect, TileKey
from engine.numeric.grid import snapped
from engine.texture.planes import Planes

KEY = TileKey(0, 0, 0)
WIDE = 3 * TILE
FULL = np.array([[64.0, 64, 400, 1, 1, 1]])
SOFT = np.array([[40.0, 50, 45, 0.8, 0.7, 0.3], [90, 70, 30, 1, 1, 0.9]])
COLOUR = "#c06020"
P = np.array(rgb(COLOUR))[:, None, None]
LUMA = np.array([0.3, 0.59, 0.11])[:, None, None]
GIVEN = {"clone": {"name": "clone", "layer": "x"}}


def around(seed=1, opaque=False):
    """Random pixels of 3 x 3 tiles, KEY in the middle: parts of them empty and parts opaque."""
    rng = np.random.default_rng(seed)
    alpha = np.ones((WIDE, WIDE)) if opaque else np.clip(rng.uniform(-0.3, 1.3, (WIDE, WIDE)), 0, 1)
    return Planes(snapped(np.concatenate([rng.uniform(0, 1, (3, WIDE, WIDE)) * alpha, alpha[None]])))


def reader(planes):
    return lambda rect: planes.cut(*rect.slices(Rect(-TILE, -TILE, 2 * TILE, 2 * TILE)))


def old_of(planes):
    return Planes(np.ascontiguousarray(reader(planes)(KEY.rect).data), planes.inks)


def edited(op, planes, dabs=FULL, locked=False, **members):
    brush = from_json({"mode": "raster", "op": op, "colour": COLOUR, "radius": 60, **members})
    mask = StrokeMask(0, (0, 0))
    mask.paint(dabs)
    read = reader(planes)
    made = edits.edit(brush, mask, mixture(brush, {}, 0, 7), locked, read, scene=Scene(read))
    return made, mask.coverage().on_grid(KEY)


def after(made, old):
    stamp = made.stamp(KEY, old)
    if stamp is None:
        return old.data[:4]
    new = snapped(stamp.keep * old.data[:4]) + stamp.add[:4]
    if made.spares_alpha:
        new[3] = old.data[3]
    new[3] = np.clip(new[3], 0, 1)
    return new


def grey(c):
    return (LUMA * c).sum(axis=0)[None]


def wash(c):
    places = [0.0, 0.5, 1.0]
    colours = np.array([rgb("#1b1033"), rgb("#c8553d"), rgb("#ffe9b0")])
    return np.stack([np.interp(grey(c)[0], places, column) for column in colours.T])


TARGETS = {
    "toward": lambda c: P + 0 * c,
    "multiply": lambda c: c * P,
    "screen": lambda c: 1 - (1 - c) * (1 - P),
    "overlay": lambda c: np.where(c <= 0.5, 2 * c * P, 1 - 2 * (1 - c) * (1 - P)),
    "dodge": lambda c: c / (1 - P),
    "burn": lambda c: 1 - (1 - c) / P,
    "add": lambda c: c + P,
    "subtract": lambda c: c - P,
    "difference": lambda c: np.abs(c - P),
    "invert": lambda c: 1 - c,
    "lighten": lambda c: (1 + c) / 2,
    "darken": lambda c: c / 2,
    "gamma": np.sqrt,
    "contrast": lambda c: 0.5 + 1.5 * (c - 0.5),
    "posterise": lambda c: np.floor(np.minimum(c * 4, 3.5)) / 3,
    "saturate": lambda c: grey(c) + 1.5 * (c - grey(c)),
    "hue": lambda c: np.einsum("ij,jhw->ihw", turning(60), c),
    "gradient": wash,
}
LOOK_AROUND = ("smooth", "sharpen", "displace", "predict", "clone", "erase")


def test_the_table_is_complete():
    assert set(TARGETS) | set(LOOK_AROUND) == set(OPS)
    assert len(OPS) >= 16
    for row in OPS.values():
        assert row.finer.endswith(".")
        assert row.coarser.endswith(".")
        assert "\n" not in row.finer + row.coarser + row.tooltip


def test_every_row_names_its_kernel_and_no_kernel_is_without_a_row():
    for module, lays in ((op_paint, True), (op_targets, False)):
        assert {row.kernel for row in OPS.values() if row.lays == lays} == set(module.KERNELS)


@pytest.mark.parametrize("name", TARGETS)
def test_in_full_it_is_its_formula(name):
    planes = around(opaque=True)
    old = old_of(planes)
    made, _ = edited(name, planes)
    want = np.clip(TARGETS[name](old.data[:3].astype(float)), 0, 1)
    got = after(made, old)
    np.testing.assert_allclose(got[:3], want, atol=5e-5 if name != "posterise" else 4e-5)
    assert (got[3] == 1).all()


@pytest.mark.parametrize("name", TARGETS)
def test_in_part_it_goes_part_of_the_way_and_keeps_alpha(name):
    planes = around()
    old = old_of(planes)
    made, m = edited(name, planes, SOFT)
    v, alpha = old.data[:3].astype(float), old.data[3].astype(float)
    c = np.clip(v / np.maximum(alpha, 1e-9), 0, 1)
    got = after(made, old)
    if name == "toward":
        want, cover = v + m * (P - v), alpha + m * (1 - alpha)
    else:
        want, cover = v + m * (alpha * np.clip(TARGETS[name](c), 0, 1) - v), alpha
        assert got[3].tobytes() == old.data[3].tobytes()
    np.testing.assert_allclose(got[:3], want, atol=8e-5)
    np.testing.assert_allclose(got[3], cover, atol=4e-5)


@pytest.mark.parametrize("name", OPS)
def test_every_op_is_bounded_on_the_grid_and_does_nothing_where_nothing_is_covered(name):
    planes = around(3)
    old = old_of(planes)
    made, m = edited(GIVEN.get(name, name), planes, SOFT)
    stamp = made.stamp(KEY, old)
    new = after(made, old)
    assert np.isfinite(new).all()
    assert (new[:3] >= -(2**-15)).all()
    assert (new[:3] <= new[3] + 2**-14).all()
    for part in (stamp.keep, stamp.add):
        assert part.dtype == np.float32
        assert (part.astype(float) * 65536 == np.rint(part.astype(float) * 65536)).all()
    assert stamp.keep.min() >= -1
    assert stamp.keep.max() <= 2
    bare = m == 0
    assert bare.any()
    assert (stamp.keep[bare] == 1).all()
    assert (new[:, bare] == old.data[:4, bare]).all()
    again = made.stamp(KEY, old)
    assert again.keep.tobytes() == stamp.keep.tobytes()
    assert again.add.tobytes() == stamp.add.tobytes()


@pytest.mark.parametrize("name", [*OPS, "formula"])
def test_without_coverage_there_is_no_stamp(name):
    planes = around()
    dabs = SOFT.copy()
    dabs[:, 3] = 0
    made, _ = edited({"formula": "1"} if name == "formula" else GIVEN.get(name, name), planes, dabs)
    assert all(made.stamp(key, old_of(planes)) is None for key in [*made.tiles, KEY])


@pytest.mark.parametrize("name", [*OPS, "formula"])
def test_alpha_lock_keeps_alpha(name):
    planes = around(5)
    old = old_of(planes)
    made, _ = edited({"formula": "1-pic"} if name == "formula" else GIVEN.get(name, name), planes, SOFT, locked=True)
    assert made.spares_alpha
    got = after(made, old)
    assert got[3].tobytes() == old.data[3].tobytes()
    assert (got[:3, old.data[3] == 0] == 0).all()
    assert (got[:3] <= got[3] + 2**-14).all()
    assert name in ("erase",) or (got != old.data).any()


@pytest.mark.parametrize("name", [n for n in TARGETS if n not in ("toward", "posterise", "gradient")])
def test_a_is_what_small_grey_detail_becomes(name):
    """A against a difference of what the op makes of slightly darker and lighter colours."""
    planes = around(opaque=True)
    old = old_of(planes)
    step = 1 / 512
    inner = Planes(snapped(np.concatenate([np.clip(old.data[:3], 0.1, 0.9), old.data[3:]])))
    made, _ = edited(name, planes)
    keep = made.stamp(KEY, inner).keep
    shift = np.array([step, step, step, 0], np.float32)[:, None, None]
    up, down = (after(made, Planes(inner.data + sign * shift)) for sign in (1, -1))
    want = np.clip(((up - down)[:3] / (2 * step)).mean(axis=0), -1, 2)
    off = np.abs(keep - want)
    assert np.quantile(off, 0.97) < 0.02  # not where a kink lies between
    assert np.quantile(off, 0.5) < 0.01


def test_a_over_what_is_not_opaque_is_the_ratio_of_colours():
    colour = np.array([0.5, 0.25, 0.25, 0.5], np.float32)
    planes = Planes(np.broadcast_to(colour[:, None, None], (4, WIDE, WIDE)).copy())
    made, _ = edited("invert", planes)
    np.testing.assert_allclose(made.stamp(KEY, old_of(planes)).keep, (0 + 0.5 + 0.5) / 2, atol=1e-4)


# ---- those that look around ------------------------------------------------------------------------------------------


def test_smooth_evens_out_and_sharpen_is_its_opposite():
    planes = around(opaque=True)
    old = old_of(planes)
    smooth = after(edited({"name": "smooth", "reach": 2}, planes)[0], old)[:3]
    assert smooth.std() < 0.4 * old.data[:3].std()
    np.testing.assert_allclose(smooth[:, 60, 60], boxed(planes, 60, 60, 2), atol=4e-5)
    made, _ = edited({"name": "sharpen", "reach": 2, "amount": 0.5}, planes)
    want = np.clip(old.data[:3] + 0.5 * (old.data[:3] - smooth), 0, 1)
    np.testing.assert_allclose(after(made, old)[:3], want, atol=8e-5)
    keep = made.stamp(KEY, old).keep
    inside = ((want > 0) & (want < 1)).all(axis=0)
    np.testing.assert_allclose(keep[inside], 1.5, atol=1e-4)
    assert (edited("smooth", planes)[0].stamp(KEY, old).keep == 0).all()


def boxed(planes, x, y, reach):
    """Two passes of a box along each axis at one pixel of KEY."""
    kernel = np.convolve(*[np.ones(2 * reach + 1) / (2 * reach + 1)] * 2)
    part = planes.data[:3, TILE + y - 2 * reach :, TILE + x - 2 * reach :][:, : len(kernel), : len(kernel)]
    return np.einsum("chw,h,w->c", part, kernel, kernel)


def test_smooth_keeps_alpha_and_colours_do_not_bleed_from_what_is_empty():
    planes = Planes(np.zeros((4, WIDE, WIDE), np.float32))
    planes.data[:, :, :192] = np.array([0.25, 0.5, 0.0, 0.5], np.float32)[:, None, None]
    old = old_of(planes)
    got = after(edited("smooth", planes)[0], old)
    np.testing.assert_allclose(got, old.data, atol=2e-5)


@pytest.mark.parametrize(("angle", "dx", "dy"), [(0, 5, 0), (90, 0, 5), (180, -5, 0), (-90, 0, -5)])
def test_displace_moves_paint_along_an_angle(angle, dx, dy):
    planes = around()
    old = old_of(planes)
    got = after(edited({"name": "displace", "distance": 5, "angle": angle}, planes)[0], old)
    want = reader(planes)(Rect(-dx, -dy, TILE - dx, TILE - dy)).data
    np.testing.assert_allclose(got, want, atol=1e-4)


def test_displace_by_texture_follows_its_slopes():
    planes = around(opaque=True)
    ramp = np.linspace(0, 1, WIDE, dtype=np.float32)
    planes.data[:3] = snapped(ramp)[None, None, :]
    old = old_of(planes)
    op = {"name": "displace", "distance": 20, "by": "texture"}
    assert (after(edited(op, planes)[0], old) == old.data).all()  # without a texture there is no slope
    got = after(edited(op, planes, ink=[{"texture": "stripes", "period": 64}])[0], old)
    assert np.abs(got[:3] - old.data[:3]).max() > 0.01
    assert np.abs(got[:3] - old.data[:3]).max() <= 20 * 1.5 / WIDE


@pytest.mark.parametrize("offset", [[0, 0], [7, -3]])
def test_clone_copies_from_some_way_off(offset):
    planes = around()
    old = Planes.empty(TILE, TILE)
    made, m = edited({"name": "clone", "layer": "x", "offset": offset}, planes, SOFT)
    want = reader(planes)(Rect.at(*offset, TILE, TILE)).data
    np.testing.assert_allclose(after(made, old), m * want, atol=2e-5)


def test_predict_continues_the_texture_of_where_the_stroke_begins():
    y, x = np.mgrid[0:WIDE, 0:WIDE]
    stripes = 0.5 + 0.3 * np.sin(2 * np.pi * (x + y) / 12)
    planes = Planes(snapped(np.stack([stripes, stripes * 0.5, 1 - stripes, np.ones((WIDE, WIDE))])))
    whole = Planes(planes.data.copy())
    whole.data[:, TILE + 40 : TILE + 80, TILE + 30 : TILE + 90] = 0  # a hole
    old = old_of(whole)
    brush = from_json({"mode": "raster", "op": "predict", "radius": 30, "hardness": 1})
    mask = StrokeMask(0, (0, 0))
    mask.paint(np.array([[60.0, 60, 45, 1, 1, 1]]))
    read = reader(whole)
    made = edits.edit(brush, mask, mixture(brush, {}, 0, 7), False, read, scene=Scene(read, start=(-40, -40)))
    got = after(made, old)
    hole = (slice(None), slice(40, 80), slice(30, 90))
    want = old_of(planes).data[hole]
    assert all(np.corrcoef(got[hole][c].ravel(), want[c].ravel())[0, 1] > 0.9 for c in range(3))
    assert (got[hole][3] == 1).all()
    assert (made.stamp(KEY, old).keep[60, 60] == 0).all()


def continued(planes, start):
    """What lies at the tile after a dab of `predict` in its middle, and the hole that the dab covers."""
    brush = from_json({"mode": "raster", "op": "predict", "radius": 30, "hardness": 1})
    mask = StrokeMask(0, (0, 0))
    mask.paint(np.array([[60.0, 60, 45, 1, 1, 1]]))
    read = reader(planes)
    old = old_of(planes)
    made = edits.edit(brush, mask, mixture(brush, {}, 0, 7), False, read, scene=Scene(read, start=start))
    return after(made, old), (slice(None), slice(40, 80), slice(30, 90))


def test_predict_leaves_the_gaps_that_the_texture_has():
    """Fur and moss are bristles with bare paper between them: that is no black."""
    y, x = np.mgrid[0:WIDE, 0:WIDE]
    alpha = np.clip(0.5 + np.sin(2 * np.pi * (x + y) / 12), 0, 1)
    planes = Planes(snapped(np.stack([alpha * 0.8, alpha * 0.5, alpha * 0.2, alpha])))
    got, hole = continued(planes, (-40, -40))
    found, want = got[hole], old_of(planes).data[hole]
    assert np.corrcoef(found[3].ravel(), want[3].ravel())[0, 1] > 0.9
    assert abs(found[3].mean() - want[3].mean()) < 0.05
    covered = found[3] > 0.5
    straight = found[:3, covered] / found[3, covered]
    np.testing.assert_allclose(straight, np.array([[0.8], [0.5], [0.2]]) * np.ones_like(straight), atol=0.05)


def test_predict_does_not_take_bare_paper_beyond_the_rim_for_paint():
    planes = around(opaque=True)
    planes.data[:, :, : TILE - 4] = 0  # the stroke begins close to where the paint ends
    got, hole = continued(planes, (0, 60))
    assert (got[hole][3] == 1).all()


def test_predict_continues_nothing_where_nothing_is():
    planes = around(opaque=True)
    planes.data[:, :TILE, :TILE] = 0
    got, _ = continued(planes, (-64, -64))
    assert (got == old_of(planes).data).all()


def test_erase_takes_by_the_texture():
    planes = around(opaque=True)
    old = old_of(planes)
    made, _ = edited("erase", planes, ink=[{"texture": "stripes", "period": 32, "amount": 0.6}])
    got = after(made, old)
    t = np.clip(made.mixture.tile(KEY), 0, 1)
    np.testing.assert_allclose(got, old.data * (1 - t), atol=4e-5)
    assert 0.35 < got[3].min() < 0.5
    assert got[3].max() > 0.95


# ---- textures --------------------------------------------------------------------------------------------------------

INKS = (
    [{"texture": "white", "amount": 0.5}],
    [{"texture": "rock"}],
    [{"texture": "rock", "amount": 0.7}, {"texture": "stripes"}],
)


@pytest.mark.parametrize("ink", INKS)
@pytest.mark.parametrize("name", ["invert", "toward"])
def test_the_weight_is_coverage_times_texture(name, ink):
    planes = around(opaque=True)
    old = old_of(planes)
    made, m = edited(name, planes, SOFT, ink=ink)
    t = np.clip(made.mixture.tile(KEY), 0, 1)
    if ink[0]["texture"] == "white":
        np.testing.assert_allclose(t, 0.5)
    c = old.data[:3]
    np.testing.assert_allclose(after(made, old)[:3], c + m * t * (TARGETS[name](c) - c), atol=8e-5)


def test_the_texture_goes_on_as_ink_of_the_amplitude_that_the_op_has():
    planes = around(opaque=True)
    old = old_of(planes)
    for name in ("invert", "toward"):
        made, _ = edited(name, planes, ink=[{"texture": "rock", "amount": 0.8}])
        stamp = made.stamp(KEY, old)
        assert [i.key[0] for i in stamp.inks] == ["rock"]
        t = made.mixture.tile(KEY)
        free = (t >= 0) & (t <= 1)
        want = np.where(free, 0.4 * (TARGETS[name](old.data[:3]) - old.data[:3]), 0)
        np.testing.assert_allclose(stamp.add[4:7], want, atol=4e-5)


def test_ink_that_lies_there_follows_and_stays_bounded():
    planes = around(opaque=True)
    made, _ = edited("toward", planes, ink=[{"texture": "rock"}])
    inks = made.stamp(KEY, old_of(planes)).inks
    data = np.concatenate([old_of(planes).data, np.full((3, TILE, TILE), 1.5, np.float32)])
    old = Planes(data, inks)
    stamp = edited({"name": "contrast", "gain": 4}, planes)[0].stamp(KEY, old)
    ink = snapped(stamp.keep * data[4:]) + stamp.add[4:]
    assert ink.max() == 2.0
    inverted = edited("invert", planes)[0].stamp(KEY, old)
    assert (snapped(inverted.keep * data[4:]) + inverted.add[4:] == -1.5).all()
    for name in ("hue", "toward"):
        made, _ = edited(name, planes, ink=[{"texture": "rock"}])
        now = old
        for _ in range(12):
            stamp = made.stamp(KEY, now)
            add = stamp.add
            new = snapped(stamp.keep * now.data) + add
            new[3] = 1
            now = Planes(new, inks)
            assert np.abs(new[4:]).max() <= 1.5


def test_a_wash_by_texture_runs_along_the_ramp():
    planes = around(opaque=True)
    old = old_of(planes)
    op = {"name": "gradient", "by": "texture", "ramp": [[0, "#000000"], [1, "#ff8000"]]}
    made, _ = edited(op, planes, ink=[{"texture": "stripes", "period": 40}])
    stamp = made.stamp(KEY, old)
    t = np.clip(made.mixture.tile(KEY), 0, 1)
    want = np.array(rgb("#ff8000"))[:, None, None] * t
    np.testing.assert_allclose(after(made, old)[:3], want, atol=5e-5)
    assert (stamp.keep == 0).all()
    np.testing.assert_allclose(stamp.add[4:7, 5, 5], np.array(rgb("#ff8000")) / 2, atol=2e-3)


# ---- colour matrices -------------------------------------------------------------------------------------------------


@settings(deadline=None, max_examples=25)
@given(st.floats(-360, 360), st.floats(0, 4))
def test_matrices_keep_grey_and_brightness(turn, amount):
    for matrix in (turning(turn), saturating(amount)):
        np.testing.assert_allclose(matrix @ np.ones(3), np.ones(3), atol=1e-12)
        np.testing.assert_allclose(LUMA[:, 0, 0] @ matrix, LUMA[:, 0, 0], atol=1e-12)
    np.testing.assert_allclose(turning(turn) @ turning(-turn), np.eye(3), atol=1e-12)


# ---- formulas --------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("text", "f"),
    [
        ("colour - pic", lambda c: P - c),
        ("1 - 2*pic", lambda c: 1 - 2 * c),
        ("0.25*(luma - pic)", lambda c: 0.25 * (grey(c) - c)),
        ("pic*1e300*1e300", lambda c: 0 * c),
        ("5", lambda c: 5 + 0 * c),
    ],
)
def test_a_formula_is_f(text, f):
    planes = around()
    old = old_of(planes)
    made, m = edited({"formula": text}, planes, SOFT)
    alpha = old.data[3].astype(float)
    c = np.clip(old.data[:3] / np.maximum(alpha, 1e-9), 0, 1)
    got = after(made, old)
    np.testing.assert_allclose(got[:3], alpha * np.clip(c + m * f(c), 0, 1), atol=8e-5)
    assert got[3].tobytes() == old.data[3].tobytes()


def test_a_formula_knows_its_place_texture_level_and_coverage():
    planes = around(opaque=True)
    planes.data[:3] = 0
    old = old_of(planes)
    x = np.arange(TILE) + 0.5
    for text, want in {
        "x/200": np.tile(x / 200, (TILE, 1)),
        "y/200": np.tile(x / 200, (TILE, 1)).T,
        "(level + 1) * 0.5": np.full((TILE, TILE), 0.5),
        "d": np.ones((TILE, TILE)),
        "pressure*0.5": np.full((TILE, TILE), 0.5),
    }.items():
        got = after(edited({"formula": text}, planes)[0], old)
        np.testing.assert_allclose(got[0], want, atol=3e-5)
    made, _ = edited({"formula": "tex"}, planes, ink=[{"texture": "rock"}])
    np.testing.assert_allclose(after(made, old)[1], np.clip(made.mixture.tile(KEY), 0, 1) ** 2, atol=4e-5)


def test_a_formula_has_a_slope():
    planes = around(opaque=True)
    planes.data[:3] = snapped(np.array([0.4]))
    keep = edited({"formula": "1 - 2*pic"}, planes)[0].stamp(KEY, old_of(planes)).keep
    np.testing.assert_allclose(keep, -1, atol=1e-4)
    keep = edited({"formula": "0.5*(pic - 0.5)"}, planes)[0].stamp(KEY, old_of(planes)).keep
    np.testing.assert_allclose(keep, 1.5, atol=1e-4)
    keep = edited({"formula": "0.1"}, planes)[0].stamp(KEY, old_of(planes)).keep
    np.testing.assert_allclose(keep, 1.0, atol=1e-4)


@pytest.mark.parametrize(
    "op",
    [
        "multiply",
        {"name": "lighten", "amount": 0.25},
        {"formula": "1 - pic"},
        {"name": "clone", "layer": "a", "offset": [3, -4]},
        {"name": "gradient", "by": "texture", "ramp": [[0, "#000000"], [0.5, "#102030"], [1, "#ffffff"]]},
    ],
)
def test_ops_are_written_as_they_were_read(op):
    brush = from_json({"mode": "raster", "op": op})
    assert to_json(brush)["op"] == op
    assert from_json(to_json(brush)) == brush
    hash(brush)
