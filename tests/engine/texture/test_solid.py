"""Solid textures: planes in three directions look like the example, and nothing shows where the cube ends."""

from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
import specimens

from engine.numeric.colour_axes import axes_of
from engine.texture import matching, solid
from engine.texture.matching import Shape, analysed, matched, picture
from engine.texture.quality import noise_like, unlikeness

SIDE = 32


def made(example, side=SIDE, seed=1, shape=None, **more):
    oriented, round_ = solid.patterns(example, side, shape or Shape())
    *_, last = solid.matching(oriented, round_, solid.noise(oriented.colours.count, side, seed), **more)
    return picture(oriented, last.planes)


def planes_of(cube):
    return [np.ascontiguousarray(np.take(cube, k, axis)) for axis in (1, 2, 3) for k in (0, 11, 31)]


@pytest.fixture(scope="module")
def granite():
    example = specimens.granite((64, 64))
    return example, made(example)


@pytest.mark.parametrize("name", ["granite", "moss"])
def test_planes_look_like_the_example(name, granite):
    example = specimens.STOCHASTIC[name]((64, 64))
    cube = granite[1] if name == "granite" else made(example)
    flat = []
    for seed in range(3):
        pattern = analysed(example, Shape().within((SIDE, SIDE)))
        start = matching.noise(pattern.colours.count, (SIDE, SIDE), seed)
        flat.append(unlikeness(picture(pattern, matched(pattern, start)), example))
    found = [unlikeness(plane, example) for plane in planes_of(cube)]
    assert np.mean(found) < 1.5 * np.mean(flat)
    axes = axes_of(example)
    values = tuple(np.sort(plane, axis=None) for plane in axes.planes(example))
    noisy = unlikeness(noise_like(axes, values, matching.noise(axes.count, (SIDE, SIDE), 5)), example)
    assert max(found) < 0.5 * noisy


def test_no_seams_in_any_direction(granite):
    cube = granite[1]
    for axis in (1, 2, 3):
        jumps = np.abs(np.diff(cube, axis=axis, append=np.take(cube, [0], axis)))
        lines = np.moveaxis(jumps, axis, 0).reshape(SIDE, -1)
        for measure in (lines.mean(axis=1), np.percentile(lines, 90, axis=1)):
            assert abs(measure[-1] - measure.mean()) < 4.0 * measure.std()


def test_no_direction_is_preferred(granite):
    """Of an example that prefers none: differences along x, y and z are as large."""
    example, cube = granite
    found = [np.abs(np.diff(cube, axis=axis)).mean() for axis in (1, 2, 3)]
    assert max(found) < 1.06 * min(found)
    assert np.mean(found) == pytest.approx(np.abs(np.diff(example, axis=1)).mean(), rel=0.15)


def test_steps_and_threads():
    example = specimens.granite((40, 40))
    with ThreadPoolExecutor(2) as threads:
        assert np.array_equal(made(example, 16, iterations=2), made(example, 16, iterations=2, threads=threads))
    oriented, round_ = solid.patterns(example, 16, Shape())
    steps = list(solid.matching(oriented, round_, solid.noise(3, 16, 1), 2))
    assert [s.done for s in steps] == sorted(s.done for s in steps)
    assert len(steps) > 2 * 3 * 4
    assert [s.done for s in steps if s.planes is not None] == [0.5, 1.0]
    begun = solid.matching(oriented, round_, solid.noise(3, 16, 1), 2)
    assert next(begun).planes is None
    begun.close()


@pytest.mark.parametrize("side", [4, 5, 9, 13])
def test_any_example_and_side(side):
    rng = np.random.default_rng(0)
    for shape in ((1, 8, 8), (3, 5, 7), (4, 1, 1), (1, 40, 3)):
        cube = made(rng.random(shape, np.float32), side, iterations=1)
        assert cube.shape == (shape[0], side, side, side)
        assert np.isfinite(cube).all()
    assert (made(np.full((3, 9, 9), 0.5, np.float32), side) == 0.5).all()


def test_noise_knows_only_seed_and_place():
    assert np.array_equal(solid.noise(2, 12, 4)[:, :8, :8, :8], solid.noise(2, 8, 4))
    assert not np.array_equal(solid.noise(1, 8, 4), solid.noise(1, 8, 5))
    slices = solid.noise(1, 16, 4)[0]
    assert len({plane.tobytes() for plane in slices}) == 16
