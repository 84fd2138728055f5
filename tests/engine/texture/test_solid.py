"""Solid textures: planes in three directions look like the example, and nothing shows where the cube ends."""

from concurrent.futures import ThreadPoolExecutor
from functools import cache

import numpy as np
import pytest
import specimens
from quality import noise_like, unlikeness
from scipy.ndimage import map_coordinates

from engine.numeric.colour_axes import axes_of
from engine.texture import matching, solid
from engine.texture.matching import Shape, analysed, matched, matched_colours

SIDE = 32
EXAMPLES = [pytest.param(name, marks=pytest.mark.nightly) for name in ("granite", "moss", "sand")]


def made(example, side=SIDE, seed=1, shape=None, **more):
    wanted = solid.patterns(example, side, shape or Shape())
    *_, last = solid.matching(wanted, solid.noise(wanted.oriented.colours.count, side, seed), **more)
    return matched_colours(wanted.oriented, last.planes)


def planes_of(cube):
    return [np.ascontiguousarray(np.take(cube, k, axis)) for axis in (1, 2, 3) for k in (0, 11, 31)]


def askew(cube, across, down):
    """Planes that are spanned by two unit vectors, between voxels by cubic splines."""
    side = cube.shape[1]
    b, a = np.mgrid[:side, :side] - side / 2
    across, down = (np.array(v)[:, None, None] for v in (across, down))
    for shift in (0, 7, 14, 21):
        places = across * a + down * b + np.cross(across, down, axis=0) * shift
        seen = [map_coordinates(plane, places, order=3, mode="grid-wrap") for plane in cube]
        yield np.stack(seen).astype(np.float32)


@cache
def grown(name):
    """An example, and the solid made of it."""
    example = specimens.STOCHASTIC[name]((64, 64))
    return example, made(example)


@pytest.fixture(scope="module")
def granite():
    """A grey example, and the solid made of it: a third of the time that colours take."""
    example = specimens.granite((64, 64))[:1]
    return example, made(example)


@pytest.mark.parametrize("name", EXAMPLES)
def test_planes_look_like_the_example(name):
    example, cube = grown(name)
    flat = []
    for seed in range(3):
        pattern = analysed(example, Shape().within((SIDE, SIDE)))
        start = matching.noise(pattern.colours.count, (SIDE, SIDE), seed)
        flat.append(unlikeness(matched_colours(pattern, matched(pattern, start)), example))
    found = [unlikeness(plane, example) for plane in planes_of(cube)]
    assert np.mean(found) < 1.15 * np.mean(flat), np.mean(found) / np.mean(flat)
    assert max(found) < 1.5 * np.mean(flat), max(found) / np.mean(flat)
    axes = axes_of(example)
    values = tuple(np.sort(plane, axis=None) for plane in axes.planes(example))
    noisy = unlikeness(noise_like(axes, values, matching.noise(axes.count, (SIDE, SIDE), 5)), example)
    assert max(found) < 0.65 * noisy


@pytest.mark.parametrize("name", EXAMPLES)
def test_planes_askew_look_like_the_example(name):
    """As much as pieces of a flat texture that were cut out of it, and so do not tile either."""
    example, cube = grown(name)
    pattern = analysed(example, Shape().within((SIDE, SIDE)))
    whole = matched_colours(pattern, matched(pattern, matching.noise(pattern.colours.count, (2 * SIDE, 2 * SIDE), 0)))
    pieces = [whole[:, y : y + SIDE, x : x + SIDE] for y in (0, SIDE) for x in (0, SIDE)]
    flat = np.mean([unlikeness(piece, example) for piece in pieces])
    half, third = 2.0**-0.5, 6.0**-0.5
    for across, down in (((0, half, half), (1, 0, 0)), ((half, -half, 0), (third, third, -2 * third))):
        found = np.mean([unlikeness(plane, example) for plane in askew(cube, across, down)])
        assert found < 1.5 * flat, found / flat


def streaks(cube):
    """How much more power waves have that go on along an axis than others of their lengths."""
    k = np.fft.fftfreq(cube.shape[1]) * cube.shape[1]
    length = np.sqrt(sum(np.meshgrid(k**2, k**2, k**2)))
    fine = (length > 0.2 * k.size) & (length < 0.45 * k.size)
    along = np.zeros_like(fine)
    along[0], along[:, 0], along[:, :, 0] = True, True, True
    found = np.abs(np.fft.fftn(cube[0] - cube[0].mean())) ** 2
    return found[fine & along].mean() / found[fine].mean()


@pytest.mark.nightly
def test_a_cube_that_grows_from_a_smaller_one_has_no_streaks(monkeypatch):
    example = specimens.granite((96, 96))[:1]
    assert streaks(made(example, 48)) < 1.3
    found = streaks(made(example, 48, settling=0))
    assert found < 1.5
    monkeypatch.setattr(solid, "_SMALLEST", 1 << 16)
    without = streaks(made(example, 48, settling=0))
    assert found < 0.75 * without, (found, without)


def test_slices_across_diagonals_take_streaks_away(monkeypatch):
    """Also of a cube that does not grow from a smaller one, and is not settled."""
    monkeypatch.setattr(solid, "_SMALLEST", 1 << 16)
    example = specimens.granite((96, 96))[:1]
    found = streaks(made(example, 48, settling=0))
    monkeypatch.setattr(solid, "CUTS", solid.CUTS[:3])
    without = streaks(made(example, 48, settling=0))
    assert found < 0.8 * without, (found, without)


@pytest.mark.nightly
def test_no_single_plane_is_unlike_the_example():
    """Neither of those along the faces of the cube, nor where it is cut elsewhere."""
    example = specimens.sand((64, 64))
    pattern = analysed(example, Shape())
    flat = []
    for seed in range(4):
        start = matching.noise(pattern.colours.count, (64, 64), seed)
        flat.append(unlikeness(matched_colours(pattern, matched(pattern, start)), example))
    cube = made(example, 64)
    for shift, step in ((0, 1), (21, 4)):
        moved = np.roll(cube, (shift,) * 3, (1, 2, 3))
        planes = [np.ascontiguousarray(np.take(moved, k, axis)) for axis in (1, 2, 3) for k in range(0, 64, step)]
        found = [unlikeness(plane, example) for plane in planes]
        assert np.mean(found) < 1.15 * np.mean(flat), np.mean(found) / np.mean(flat)
        assert max(found) < 1.5 * np.mean(flat), max(found) / np.mean(flat)


def test_no_seams_in_any_direction(granite):
    cube = granite[1]
    for axis in (1, 2, 3):
        jumps = np.abs(np.diff(cube, axis=axis, append=np.take(cube, [0], axis)))
        lines = np.moveaxis(jumps, axis, 0).reshape(SIDE, -1)
        for measure in (lines.mean(axis=1), np.percentile(lines, 90, axis=1)):
            assert abs(measure[-1] - measure.mean()) < 4.0 * measure.std()


def test_no_direction_is_preferred(granite):
    """Of an example that prefers none: differences along x, y and z are as large, and as in a flat texture."""
    example, cube = granite
    pattern = analysed(example, Shape().within((SIDE, SIDE)))
    flat = matched_colours(pattern, matched(pattern, matching.noise(pattern.colours.count, (SIDE, SIDE), 1)))
    found = [np.abs(np.diff(cube, axis=axis)).mean() for axis in (1, 2, 3)]
    assert max(found) < 1.06 * min(found)
    assert np.mean(found) == pytest.approx(np.abs(np.diff(flat, axis=1)).mean(), rel=0.1)


def test_steps_and_threads():
    example = specimens.granite((40, 40))
    with ThreadPoolExecutor(2) as threads:
        assert np.array_equal(made(example, 16, iterations=2), made(example, 16, iterations=2, threads=threads))
    wanted = solid.patterns(example, 16, Shape())
    steps = list(solid.matching(wanted, solid.noise(3, 16, 1), 2))
    assert [s.done for s in steps] == sorted(s.done for s in steps)
    assert len(steps) > 2 * 3 * 4
    shown = [s.done for s in steps if s.planes is not None]
    assert len(shown) == 3
    assert shown[-1] == 1.0
    begun = solid.matching(wanted, solid.noise(3, 16, 1), 2)
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
