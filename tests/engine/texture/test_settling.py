"""Cubes settled until planes in all directions are like the example."""

from concurrent.futures import ThreadPoolExecutor

import cutting
import numpy as np
import pytest
import specimens
from quality import channels_of, unlikeness
from scipy.ndimage import map_coordinates

from engine.numeric import histograms
from engine.texture import solid
from engine.texture.matching import Shape, analysed
from engine.texture.settling import Settling

SIDE = 32
SHAPE = Shape(levels=3)
NIGHTLY = pytest.mark.nightly


@pytest.fixture(scope="module")
def sand():
    """A grey example, its pattern, and noise of its values."""
    example = specimens.sand((64, 64))[:1]
    pattern = analysed(example, SHAPE, channels_of(example))
    cube = solid.noise(1, SIDE, 3)[0]
    histograms.match(cube, pattern.pixels[0])
    return example, pattern, cube


def settled(cube, pattern, turns, threads=None):
    cube, bands = cube.copy(), pattern.bands[0]
    told = list(Settling(len(cube), pattern.shape, bands, bands, pattern.pixels[0]).turns(cube, turns, threads))
    assert told == [(turn + 1) / turns for turn in range(turns)]
    return cube


@pytest.fixture(scope="module")
def after(sand):
    _, pattern, noise = sand
    return settled(noise, pattern, 60)


def likened(planes, example):
    return np.array([unlikeness(plane, example, SHAPE) for plane in planes])


@pytest.mark.parametrize(("planes", "part"), [(cutting.along_axes, 0.5), (cutting.at_a_slant, 0.7)])
def test_planes_become_like_the_example(sand, after, planes, part):
    """Those at a slant less: the spline between voxels has not all that is fine."""
    example, _, noise = sand
    before, found = (likened(planes(cube[None]), example) for cube in (noise, after))
    assert found.mean() < part * before.mean(), (before.mean(), found.mean())
    assert found.max() < (part + 0.2) * before.mean()


def test_both_kinds_of_planes_are_worked_on(sand, after):
    """Flat textures, as tiles and as pieces that were cut out, are not much more like the example."""
    example, _, _ = sand
    flat = likened((cutting.flat_of(example, SIDE, seed) for seed in range(6)), example).mean()
    assert likened(cutting.along_axes(after[None]), example).mean() < 1.4 * flat
    pieces = likened(cutting.pieces(example, SIDE), example).mean()
    assert likened(cutting.at_a_slant(after[None]), example).mean() < 1.4 * pieces


def test_values_are_the_examples(sand, after):
    example, _, _ = sand
    parts = np.linspace(0.02, 0.98, 25)
    assert np.abs(np.quantile(after, parts) - np.quantile(example, parts)).max() < 0.02


@pytest.mark.parametrize("normal", [(1, 1, 1), *(pytest.param(n, marks=NIGHTLY) for n in ((2, 1, 0), (3, 2, 1)))])
def test_planes_do_not_differ_as_a_whole(sand, after, normal):
    """A wave along any direction, by which planes across it are lighter and darker, goes."""
    _, pattern, _ = sand
    z, y, x = np.indices(after.shape)
    wave = 0.1 * np.cos((normal[0] * z + normal[1] * y + normal[2] * x) * (2.0 * np.pi * 3.0 / SIDE))
    wave = wave.astype(np.float32)
    found = settled(after + wave, pattern, 30)
    assert abs(np.vdot(found - found.mean(), wave)) < 0.3 * np.vdot(wave, wave)


def test_a_grain_keeps_its_direction():
    """Of an example that has one: rows on slices are the example's rows."""
    rng = np.random.default_rng(0)
    lines = rng.random((1, 64, 1), np.float32) + 0.1 * rng.random((1, 64, 64), np.float32)
    pattern = analysed(lines, SHAPE, channels_of(lines))
    down = np.array([np.abs(np.diff(lines[0], axis=axis)).mean() for axis in (0, 1)])
    cube = np.broadcast_to(lines[0, :SIDE, :SIDE], (SIDE, SIDE, SIDE)).copy()
    found = settled(cube, pattern, 20)
    assert down[0] > 3.0 * down[1]
    along = [np.abs(np.diff(found, axis=axis)).mean() for axis in range(3)]
    assert along[1] > 1.5 * along[2]


def test_threads_make_no_difference(sand):
    _, pattern, noise = sand
    with ThreadPoolExecutor(2) as threads:
        assert np.array_equal(settled(noise, pattern, 6), settled(noise, pattern, 6, threads))


def test_it_goes_on_without_end(sand, after):
    """A wave of the cube is the same wave across its faces: settled planes there are like those inside."""
    example, _, _ = sand
    d, a = np.mgrid[:SIDE, :SIDE] - SIDE / 2
    half = 0.5**0.5
    found = []
    for shift in (0, SIDE // 2):
        places = np.stack([half * (d + a), half * (d - a), np.full_like(d, shift)])
        seen = map_coordinates(after, places, order=3, mode="grid-wrap")
        found.append(unlikeness(seen[None].astype(np.float32), example, SHAPE))
    assert max(found) < 1.6 * min(found)


@pytest.mark.parametrize(("side", "levels", "orientations"), [(4, 0, 1), (5, 0, 4), (9, 1, 3), (17, 2, 2), (23, 2, 4)])
def test_any_side_and_shape(side, levels, orientations):
    shape = Shape(levels=levels, orientations=orientations)
    example = np.random.default_rng(0).random((1, 40, 40), np.float32)
    pattern = analysed(example, shape, channels_of(example))
    cube = settled(solid.noise(1, side, 1)[0], pattern, 7)
    assert cube.dtype == np.float32
    assert np.isfinite(cube).all()
    assert 0.0 <= cube.min() <= cube.max() <= 1.0


def test_no_turns_and_nothing_to_settle(sand):
    _, pattern, noise = sand
    assert np.array_equal(settled(noise, pattern, 0), noise)
    even = np.full((1, 20, 20), 0.25, np.float32)
    flat = analysed(even, Shape(levels=1), channels_of(even))
    assert (settled(np.full((8, 8, 8), 0.25, np.float32), flat, 3) == 0.25).all()
