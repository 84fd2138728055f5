"""Raster-ops on tiles: each against its formula in plain NumPy; alpha, bounds, slopes; those that look around."""

import numpy as np
import pytest
from op_edits import GIVEN, KEY, SOFT, TARGETS, WIDE, P, after, around, edited, old_of, reader

from engine.brush import edits, op_paint, op_targets
from engine.brush.covered import Scene
from engine.brush.mask import StrokeMask
from engine.brush.mixture import mixture
from engine.brush.ops import OPS
from engine.brush.settings import from_json
from engine.numeric.address import TILE, Rect
from engine.numeric.grid import snapped
from engine.texture.planes import Planes

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
