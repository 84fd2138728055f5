"""What is large in a cube, settled of planes as tiles and as pictures."""

from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
import specimens

from engine.numeric import histograms, steerable
from engine.texture import solid
from engine.texture.framing import Framing
from engine.texture.matching import Shape, analysed
from engine.texture.quality import channels_of
from engine.texture.settling import Settling, sheaves

SIDE = 32
SHAPE = Shape(levels=3)


@pytest.fixture(scope="module")
def sand():
    """A grey example's pattern, and noise of its values."""
    example = specimens.sand((64, 64))[:1]
    pattern = analysed(example, SHAPE, channels_of(example))
    cube = solid.noise(1, SIDE, 3)[0]
    histograms.match(cube, pattern.pixels[0])
    return pattern, cube


def coarse(bands, pattern):
    """How far the bands of levels 2 and 3 are, on average, from the example's."""
    found = []
    for place, values in bands.items():
        if place.level >= 2:
            wanted = pattern.bands[0][place]
            found.append(histograms.distance(np.sort(values, axis=None), wanted) / wanted.std())
    return np.mean(found)


def as_tiles(cube, pattern):
    made = steerable.filters(SIDE, SIDE, SHAPE.levels, SHAPE.orientations)
    planes = [np.take(cube, k, axis) for axis in range(3) for k in range(0, SIDE, 5)]
    return np.mean([coarse(steerable.build(np.ascontiguousarray(plane), made), pattern) for plane in planes])


def as_pictures(cube, pattern):
    planes = [np.ascontiguousarray(np.take(cube, [k], axis)) for axis in range(3) for k in range(0, SIDE, 5)]
    turned = [np.moveaxis(plane, axis, 0) for plane, axis in zip(planes, np.repeat(range(3), 7), strict=True)]
    seen = [analysed(np.ascontiguousarray(plane), SHAPE, pattern.colours) for plane in turned]
    return np.mean([coarse(plane.bands[0], pattern) for plane in seen])


def test_planes_as_tiles(sand):
    pattern, noise = sand
    cube = noise.copy()
    settling = Settling(SIDE, SHAPE)
    for _ in range(6):
        settling.turn(cube, pattern.bands[0])
    before, after = as_tiles(noise, pattern), as_tiles(cube, pattern)
    assert after < 0.5 * before, (before, after)


@pytest.mark.parametrize("centred", [False, True])
def test_planes_as_pictures(sand, centred):
    pattern, noise = sand
    cube = noise.copy()
    framing = Framing(SIDE, SHAPE)
    for _ in range(6):
        framing.turn(cube, pattern.bands[0], centred)
    shift = -(SIDE // 2) if centred else 0
    rolled = np.roll(cube, (shift,) * 3, (0, 1, 2))
    before, after = as_pictures(noise, pattern), as_pictures(rolled, pattern)
    assert after < 0.5 * before, (before, after)


def test_oblique_planes_take_part(sand):
    """A wave along a diagonal, by which planes across it differ from one another as a whole, goes."""
    pattern, noise = sand
    z, y, x = np.indices(noise.shape)
    wave = np.cos((x + y + z) * (2.0 * np.pi * 3.0 / SIDE)).astype(np.float32)
    cube = noise + wave
    settling = Settling(SIDE, SHAPE)
    for _ in range(6):
        settling.turn(cube, pattern.bands[0])
    assert abs((cube * wave).mean()) < 0.3 * abs(((noise + wave) * wave).mean())


def test_only_what_is_large_moves(sand):
    """Waves that are short along all axes, which no plane across them sees as large, stay as they are."""
    pattern, noise = sand
    cube = noise.copy()
    Framing(SIDE, SHAPE).turn(cube, pattern.bands[0], True)
    moved = np.abs(np.fft.fftn(cube - noise))
    short = sum(np.meshgrid(*[(np.abs(np.fft.fftfreq(SIDE)) > 0.13).astype(int)] * 3))
    assert moved[short == 0].mean() > 1.0
    assert moved[short == 3].max() < 1e-2


def test_sheaves_are_across_axes_and_diagonals():
    found = list(sheaves())
    assert len(found) == len({sheaf.normal for sheaf in found}) == 13
    for sheaf in found:
        frame = np.array([sheaf.normal / np.linalg.norm(sheaf.normal), sheaf.down, sheaf.across])
        assert np.allclose(frame @ frame.T, np.eye(3))
        assert abs(sheaf.normal[sheaf.step]) == 1


def test_threads_make_no_difference(sand):
    pattern, noise = sand
    with ThreadPoolExecutor(2) as threads:
        for turn, more in ((Settling(SIDE, SHAPE).turn, ()), (Framing(SIDE, SHAPE).turn, (False,))):
            alone, together = noise.copy(), noise.copy()
            turn(alone, pattern.bands[0], *more)
            turn(together, pattern.bands[0], *more, threads)
            assert np.array_equal(alone, together)


@pytest.mark.parametrize(("side", "levels", "orientations"), [(4, 0, 1), (5, 0, 4), (9, 1, 3), (17, 2, 2), (23, 2, 4)])
def test_any_side_and_shape(side, levels, orientations):
    shape = Shape(levels=levels, orientations=orientations)
    example = np.random.default_rng(0).random((1, 40, 40), np.float32)
    bands = analysed(example, shape, channels_of(example)).bands[0]
    cube = solid.noise(1, side, 1)[0]
    for _ in range(3):
        Settling(side, shape).turn(cube, bands)
        Framing(side, shape).turn(cube, bands, True)
    assert cube.dtype == np.float32
    assert np.isfinite(cube).all()
    assert np.abs(cube).max() < 3.0
