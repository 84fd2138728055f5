"""The smooth part of parallel planes, against the plain sum of the waves that they have."""

import numpy as np
import pytest
from scipy.fft import irfftn, rfftn

from engine.numeric.bspline import response
from engine.numeric.directions import frame
from engine.numeric.sheaf import Sheaves


def noise(side, seed=0):
    return np.random.default_rng(seed).normal(size=(side,) * 3).astype(np.float32)


def plain(cube, sheaves, at, centre, weights, place):
    """One sample, by the sum of all waves near the normal."""
    side = len(cube)
    k = np.stack(np.meshgrid(*[np.fft.fftfreq(side) * side] * 3, indexing="ij"), axis=-1)
    rows, columns = k @ at[1], k @ at[2]
    near = (rows**2 + columns**2 < sheaves.reach**2) & (2 * np.abs(k).max(axis=-1) < side)
    g, i, j = (n - count // 2 for n, count in zip(place, (side, sheaves.small, sheaves.small), strict=True))
    where = centre + at[0] * g + (at[1] * i + at[2] * j) * (side / sheaves.small)
    size = np.prod(weights[np.abs(k).astype(int)], axis=-1)
    return (np.fft.fftn(cube) * size * np.exp(2j * np.pi / side * (k @ where)))[near].sum().real / side**3


@pytest.mark.parametrize(("side", "small", "reach"), [(15, 4, 1.9), (16, 8, 4.0), (32, 4, 2.0)])
def test_planes_are_sums_of_waves(side, small, reach):
    rng, cube = np.random.default_rng(side), noise(side)
    sheaves = Sheaves(side, small, reach)
    for _ in range(3):
        at, centre = np.linalg.qr(rng.normal(size=(3, 3)))[0], rng.uniform(0, side, 3)
        found = sheaves.planes(rfftn(cube), sheaves.rod(at, centre, response(np.arange(side // 2 + 1) / side)))
        assert found.shape == (side, small, small)
        for place in rng.integers(0, found.shape, (12, 3)):
            wanted = plain(cube, sheaves, at, centre, response(np.arange(side // 2 + 1) / side), place)
            assert abs(found[tuple(place)] - wanted) < 0.02 * found.std()


def test_giving_is_the_transpose():
    cube, sheaves = noise(24), Sheaves(24, 6, 3.0)
    rod = sheaves.rod(
        np.linalg.qr(noise(3, 1)[0])[0].astype(float), np.array([3.0, 8.5, 20.1]), response(np.arange(13) / 24)
    )
    found = sheaves.planes(rfftn(cube), rod)
    values = np.random.default_rng(2).normal(size=found.shape).astype(np.float32)
    half = np.zeros((24, 24, 13), np.complex64)
    np.add.at(half.reshape(-1), rod.places, sheaves.given(rod, values))
    given = irfftn(half, s=cube.shape, axes=(0, 1, 2))
    assert np.vdot(given, cube) == pytest.approx(np.vdot(values, found), rel=1e-4)


def test_planes_across_an_axis_are_smoothed_slices():
    side, small = 32, 8
    half, sheaves = rfftn(noise(side)), Sheaves(side, small, 4.0)
    half[:, side // 2] = 0.0  # waves that no sheaf has: they look the same either way
    cube = irfftn(half, s=(side,) * 3, axes=(0, 1, 2))
    found = sheaves.planes(half, sheaves.rod(frame(np.eye(3)[1]), np.full(3, side / 2.0), np.ones(17)))
    waves = np.fft.fft2(cube[:, 5])
    k = np.fft.fftfreq(side) * side
    waves[np.hypot(k[:, None], k) >= 4.0] = 0.0
    wanted = np.fft.ifft2(waves).real[:: side // small, :: side // small]
    assert np.abs(found[5] - wanted).max() < 0.02 * wanted.std()


def test_a_rod_has_each_wave_once():
    rod = Sheaves(16, 8, 4.0).rod(frame(np.array([0.6, 0.0, 0.8])), np.zeros(3), np.ones(9))
    assert len(set(rod.places)) == len(rod.places) > 50
