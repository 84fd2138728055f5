"""The rim of a stroke: exact distances that agree between tiles, and what curves of them do."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.ndimage import distance_transform_edt

from engine.brush.edits import edit
from engine.brush.ink import resolve as resolve_ink
from engine.brush.mask import StrokeMask
from engine.brush.relief import resolve
from engine.brush.rim import CAP, Rim
from engine.brush.settings import from_json
from engine.numeric.address import TILE, Rect, TileKey
from engine.numeric.grid import snapped
from engine.numeric.shaping import table
from engine.texture.planes import Planes

KEY = TileKey(0, 0, 0)
NEAR = [TileKey(0, i, j) for j in (-1, 0, 1) for i in (-1, 0, 1)]


def rim(width=10.0, **edge):
    return Rim(table(edge.get("curve", "wet"), "edge"), width, edge.get("amount", 1.0), 1 / 16)


def scattered(seed, holes):
    """Coverage of 3 x 3 tiles with some holes in it, as one array."""
    rng = np.random.default_rng(seed)
    whole = np.ones((3 * TILE, 3 * TILE), np.float32)
    whole[tuple(rng.integers(0, 3 * TILE, (2, holes)))] = 0
    return whole


def tiles_of(whole):
    return {k: whole[k.rect.slices(Rect(-TILE, -TILE, 2 * TILE, 2 * TILE))] for k in NEAR}


@settings(deadline=None, max_examples=25)
@given(st.integers(0, 2**32), st.integers(0, 60), st.floats(1, CAP))
def test_distances_are_exact(seed, holes, width):
    whole = scattered(seed, holes)
    made = rim(width)
    found = made.depths(made.around(tiles_of(whole), KEY))
    whole[0, 0] = 0  # farther than any width: scipy wants one
    exact = distance_transform_edt(whole)[TILE : 2 * TILE, TILE : 2 * TILE]
    np.testing.assert_allclose(found, np.clip((exact - 0.5) / width, 0, 1), atol=1e-5)


def test_a_tile_far_from_any_rim_needs_no_distances():
    made = rim(40)
    assert made.depths((1.0,) * 9) is None
    assert made.depths((0.5,) * 8 + (0.01,)) is not None
    assert made.depths((0.0,) * 9).max() == 0


def relief(**brush):
    return resolve(from_json(brush), {}, 0, (1, 7))


def painted(dabs, made):
    mask = StrokeMask(0, (0, 0))
    mask.paint(dabs)
    coverage = mask.coverage()
    return coverage, made.over(coverage)


@pytest.mark.parametrize("curve", ["wet", "dark", "worn", "soft", "outline", "double", [[0, 1], [1, 0.5]]])
def test_the_rim_of_a_disc(curve):
    made = relief(radius=50, edge={"curve": curve, "width": 0.5, "amount": 0.8})
    coverage, thinned = painted(np.array([[64.0, 64, 50, 0.9, 1, 1]]), made)
    out = thinned.tiles[KEY]
    y, x = np.mgrid[:TILE, :TILE] + 0.5
    depth = np.clip((50 - np.hypot(x - 64, y - 64)) / 25, 0, 1)
    solid = coverage.tiles[KEY] > 0.85
    knots = curve if isinstance(curve, str) else tuple(map(tuple, curve))
    factor = 0.2 + 0.8 * np.interp(depth, np.linspace(0, 1, 1025), table(knots, "edge"))
    steep = np.abs(np.diff(table(knots, "edge"))).max() * 1024
    assert np.abs(out - 0.9 * factor)[solid].max() < 0.03 + 0.8 * steep / 25
    assert np.abs(out - 0.9 * factor)[solid].mean() < 0.03
    assert (out <= coverage.tiles[KEY] + 1e-6).all()


def test_tiles_agree_with_one_another():
    """A disc over the corner of four tiles is thinned as one within a single tile."""
    made = relief(radius=40, edge={"curve": "double", "width": 1.5})
    _, apart = painted(np.array([[0.0, 0, 40, 1, 1, 0.9]]), made)
    _, whole = painted(np.array([[64.0, 64, 40, 1, 1, 0.9]]), relief(radius=40, edge={"curve": "double", "width": 1.5}))
    joined = np.zeros((2 * TILE, 2 * TILE), np.float32)
    for key in apart.keys:
        joined[key.rect.slices(Rect(-TILE, -TILE, TILE, TILE))] = apart.tiles[key]
    assert joined[64:192, 64:192].tobytes() == whole.tiles[KEY].tobytes()


def test_flat_tiles_inside_stay_flat():
    made = relief(radius=2000, edge={"curve": "wet", "amount": 0.5})
    _, thinned = painted(np.array([[64.0, 64, 2000, 0.8, 1, 1]]), made)
    assert thinned.tiles[KEY] == pytest.approx(0.8 * (0.5 + 0.5 * float(table("wet", "edge")[-1])), rel=1e-4)


def test_without_width_or_amount_there_is_no_rim():
    assert Rim.of(from_json({})) is None
    assert Rim.of(from_json({"edge": {"width": 0}})) is None
    assert Rim.of(from_json({"edge": {"amount": 0}})) is None
    assert Rim.of(from_json({"radius": 4000, "edge": "wet"})).reach == CAP


@pytest.mark.parametrize("ink", [[], [{"texture": "rock"}]])
@pytest.mark.parametrize("locked", [False, True])
def test_the_rims_colour_is_in_the_paint(ink, locked):
    brush = from_json(
        {"radius": 50, "colour": "#ffffff", "ink": ink, "edge": {"curve": [[0, 1]], "width": 0.4, "colour": "#200000"}}
    )
    made = resolve(brush, {}, 0, (1, 7))
    mask = StrokeMask(0, (0, 0))
    mask.paint(np.array([[64.0, 64, 50, 1, 1, 1]]))
    old = Planes(np.full((4, TILE, TILE), 0.5, np.float32))
    paint = resolve_ink(brush, {}, 0, 1)
    with_rim = edit(brush, mask, paint, locked, relief=made).stamp(KEY, old)
    plain = edit(brush, mask, paint, locked).stamp(KEY, old)
    assert with_rim.keep.tobytes() == plain.keep.tobytes()
    assert (with_rim.add[3] == plain.add[3]).all()
    assert (with_rim.add == snapped(with_rim.add)).all()
    middle, rim_at = (64, 64), (64, 15)
    assert (with_rim.add[(slice(None), *middle)] == plain.add[(slice(None), *middle)]).all()
    weight = with_rim.add[(3, *rim_at)]
    assert weight > 0.2
    np.testing.assert_allclose(with_rim.add[(slice(0, 3), *rim_at)] / weight, [32 / 255, 0, 0], atol=0.15)
    assert np.abs(with_rim.add[(slice(4, None), *rim_at)]).max(initial=0) < 0.08
