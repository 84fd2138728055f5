"""Planes between voxels by cubic splines, against scipy's."""

import numpy as np
import pytest
from scipy.fft import irfftn, rfftn
from scipy.ndimage import map_coordinates

from engine.numeric import bspline
from engine.numeric.bspline import Plane


def splined(cube):
    along = bspline.prefilter(len(cube))
    half = rfftn(cube) * (along[:, None, None] * along[:, None] * along[: len(cube) // 2 + 1])
    return irfftn(half, s=cube.shape, axes=(0, 1, 2)).astype(np.float32)


def somewhere(side, seed):
    rng = np.random.default_rng(seed)
    _, down, across = np.linalg.qr(rng.normal(size=(3, 3)))[0]
    return Plane(rng.uniform(-2 * side, 2 * side, 3), down, across)


@pytest.mark.parametrize("side", [4, 13, 32])
def test_a_plane_is_scipys(side):
    cube = np.random.default_rng(side).normal(size=(side,) * 3).astype(np.float32)
    for seed in range(4):
        plane = somewhere(side, seed)
        i, j = np.indices((side + 3, side + 3))
        places = (v[:, None, None] for v in plane)
        corner, down, across = places
        wanted = map_coordinates(cube, corner + down * i + across * j, order=3, mode="grid-wrap")
        assert np.abs(bspline.cut(splined(cube), plane, side + 3) - wanted).max() < 1e-5


def test_planes_across_the_axes_are_slices():
    cube = np.random.default_rng(0).normal(size=(16, 16, 16)).astype(np.float32)
    found = bspline.cut(splined(cube), Plane(np.array([0.0, 5.0, 0.0]), *np.eye(3)[[0, 2]]), 16)
    assert np.abs(found - cube[:, 5]).max() < 1e-5


@pytest.mark.parametrize("side", [5, 16])
def test_laying_is_the_transpose_of_cutting(side):
    rng = np.random.default_rng(side)
    cube, values = (rng.normal(size=(side,) * n).astype(np.float32) for n in (3, 2))
    plane, total = somewhere(side, 7), np.zeros_like(cube)
    bspline.lay(total, plane, values)
    assert np.vdot(total, cube) == pytest.approx(np.vdot(values, bspline.cut(cube, plane, side)), rel=1e-4)


def test_response_is_what_becomes_of_a_wave():
    side, k = 32, 11
    wave = np.cos(2.0 * np.pi * k / side * np.arange(side)).astype(np.float32)
    cube = np.ascontiguousarray(np.broadcast_to(wave, (side,) * 3))
    # Looked at between voxels, where other waves that look the same on voxels do not.
    fine = bspline.cut(
        splined(cube), Plane(np.zeros(3), np.array([0.0, 1.0, 0.0]), np.array([0.0, 0.0, 0.25])), 4 * side
    )
    assert 2.0 * np.abs(np.fft.fft(fine[0])[k]) / fine.shape[1] == pytest.approx(bspline.response(k / side), rel=1e-3)


def test_blur_takes_what_pieces_at_a_slant_lose():
    size, rng = 96, np.random.default_rng(3)
    down, across = np.mgrid[:size, :size] - size / 2.0
    lost = []
    for slant in rng.uniform(0.0, np.pi, 24):
        wave = np.cos(2.0 * np.pi * 0.35 * (down * np.cos(slant) + across * np.sin(slant)))
        lost.append(map_coordinates(wave, rng.uniform(30, 60, (2, 4000)), order=3).std() / wave.std())
    straight = np.cos(np.pi / size * (np.arange(size) + 0.5) * round(2 * size * 0.35)).astype(np.float32)
    found = bspline.blur(np.tile(straight, (size, 1)))[0].std() / straight.std()
    assert found == pytest.approx(np.mean(lost), rel=0.02)
    assert np.allclose(bspline.blur(np.full((2, 5, 9), 0.25)), 0.25)
