"""Pictures as textures: their pyramid is exact, they tile, and they stop where their pixels stop."""

import gc
import itertools
import weakref

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from engine.numeric.address import Rect
from engine.numeric.detail import parents
from engine.numeric.pyramid import expand
from engine.texture.image import Image, ImageSource, picture_pyramid, stretched, tiled

ORIGINS = st.one_of(st.integers(-300, 300), st.integers(-(2**90), 2**90))


def picture(height: int, width: int, seed: int = 0) -> ImageSource:
    rng = np.random.default_rng(seed)
    data = rng.random((4, height, width), np.float32)
    data[:3] *= data[3]
    return ImageSource.of(f"picture {seed}", np.round(data * 65536) / np.float32(65536))


PICTURE = picture(48, 64)


def test_at_its_own_size_the_picture_is_kept():
    assert (Image(0, 64, PICTURE).appearance(0, Rect.at(0, 0, 64, 48)) == PICTURE.data).all()
    assert (Image(-7, 16, PICTURE).appearance(-5, Rect.at(0, 0, 64, 48)) == PICTURE.data).all()
    assert len(picture_pyramid(PICTURE, 16)) == 3


@pytest.mark.parametrize("period", [1, 5, 16, 23, 64, 100])
def test_each_level_is_the_mean_of_the_next(period):
    levels = picture_pyramid(PICTURE, period)
    height = max(1, round(period * 48 / 64))
    for n, level in enumerate(levels):
        assert level.shape == (4, height << n, period << n)
        assert (level * 65536 == np.rint(level * 65536)).all()
        assert (level[3] >= 0).all()
        assert (level[3] <= 1).all()
        assert (level[:3] >= 0).all()
        assert (level[:3] <= level[3]).all()
    for coarse, fine in itertools.pairwise(levels):
        mean = fine.reshape(4, coarse.shape[1], 2, coarse.shape[2], 2).mean((2, 4), dtype=np.float64)
        assert np.abs(coarse - mean).max() <= 2.0**-17
    assert levels[-1].shape[2] >= 64
    assert levels[-1].shape[1] >= 48
    assert len(levels) == 1 or levels[-2].shape[2] < 64 or levels[-2].shape[1] < 48


def stretch(data: np.ndarray, height: int, width: int) -> np.ndarray:
    return stretched(ImageSource.of("", data), (height, width), np.arange(height), np.arange(width))


@pytest.mark.parametrize("size", [(33, 50), (24, 50), (20, 33), (11, 15)])
def test_resampling_keeps_smooth_pictures(size):
    y, x = np.mgrid[0:24, 0:32]
    wave = (0.5 + 0.25 * np.sin(2 * np.pi * x / 32) + 0.2 * np.cos(2 * np.pi * y / 24)).astype(np.float32)
    data = np.stack([wave * 0.5, wave * 0.25, wave, np.ones_like(wave)])
    y, x = (np.mgrid[0 : size[0], 0 : size[1]] + 0.5) * np.array([24 / size[0], 32 / size[1]])[:, None, None] - 0.5
    exact = 0.5 + 0.25 * np.sin(2 * np.pi * x / 32) + 0.2 * np.cos(2 * np.pi * y / 24)
    found = stretch(data, *size)
    assert np.abs(found[2] - exact).max() < 0.005
    assert (found[3] == 1).all()


def test_resampling_is_periodic():
    data = PICTURE.data
    rolled = stretch(np.roll(data, (12, 16), (1, 2)), 72, 96)
    assert (rolled == np.roll(stretch(data, 72, 96), (18, 24), (1, 2))).all()


def test_a_picture_enlarged_beyond_memory_is_made_piece_by_piece():
    """65536 pixels wide: 40 GB as a whole.  The same values as a picture small enough to be kept, where they meet."""
    image = Image(0, 65536, PICTURE)
    assert image.refinements == 0
    here = image.appearance(0, Rect.at(65536 * 7 + 1000, -49152 + 500, 40, 30))
    columns, rows = 1000 + np.arange(40), 500 + np.arange(30)
    assert (here == stretched(PICTURE, (49152, 65536), rows, columns)).all()
    sliver = ImageSource.of("sliver", np.ones((4, 1, 3000), np.float32))
    assert Image(0, 1, sliver).appearance(0, Rect.at(0, 0, 3, 3)).shape == (4, 3, 3)


@settings(deadline=None, max_examples=40)
@given(ORIGINS, ORIGINS, st.sampled_from([1, 3, 16, 23]), st.integers(0, 9), st.data())
def test_any_rectangle_holds_the_same_values(x, y, period, up, data):
    image = Image(2, period, PICTURE)
    whole = Rect.at(x, y, 75, 66)
    a, b = sorted(data.draw(st.lists(st.integers(0, 75), min_size=2, max_size=2, unique=True)))
    c, d = sorted(data.draw(st.lists(st.integers(0, 66), min_size=2, max_size=2, unique=True)))
    part = Rect(x + a, y + c, x + b, y + d)
    rows, columns = part.slices(whole)
    assert (image.appearance(2 + up, part) == image.appearance(2 + up, whole)[:, rows, columns]).all()
    big, small = image.bandpass(2 + up, whole), image.bandpass(2 + up, part)
    if big is None:
        assert small is None
    elif small is not None:
        assert (small == big[:, rows, columns]).all()
        assert small.shape[0] == 3


@settings(deadline=None, max_examples=40)
@given(ORIGINS, ORIGINS, st.integers(1, 90), st.integers(1, 9))
def test_bandpass_is_what_expand_leaves_out(x, y, period, up):
    image = Image(0, period, PICTURE)
    rect = Rect.at(x, y, 40, 30).evened()
    coarse = image.appearance(up - 1, parents(rect))
    found = image.bandpass(up, rect)
    whole = expand(coarse)[:3] + (0 if found is None else found)
    assert np.abs(whole - image.appearance(up, rect)[:3]).max() <= 2.0**-17
    assert (found is None) == (up >= len(picture_pyramid(PICTURE, period)))


@settings(deadline=None, max_examples=30)
@given(ORIGINS, ORIGINS, st.integers(0, 4), st.integers(-5, 5), st.integers(-5, 5))
def test_it_tiles_from_the_origin_of_the_base_level(x, y, up, right, down):
    image = Image(0, 20, PICTURE)
    rect = Rect.at(x, y, 9, 9)
    moved = Rect.at(x + right * (20 << up), y + down * (15 << up), 9, 9)
    assert (image.appearance(up, rect) == image.appearance(up, moved)).all()


@settings(deadline=None, max_examples=40)
@given(ORIGINS, ORIGINS, st.integers(1, 70), st.integers(1, 70), st.integers(1, 99), st.integers(1, 99))
def test_tiled_against_indices(x, y, height, width, rows, columns):
    planes = np.arange(2 * height * width, dtype=np.float32).reshape(2, height, width)
    j = [(y + k) % height for k in range(rows)]
    i = [(x + k) % width for k in range(columns)]
    assert (tiled(planes, Rect.at(x, y, columns, rows)) == planes[:, j][:, :, i]).all()


def test_sources_are_told_apart_by_their_pixels():
    a, b = picture(4, 6, 1), picture(4, 6, 2)
    assert a.sha != b.sha
    assert a == ImageSource("picture 1", a.sha)
    assert Image(0, 8, a) == Image(0, 8, picture(4, 6, 1))
    assert ImageSource.of("a", a.data.reshape(4, 6, 4)).sha != a.sha


@settings(deadline=None, max_examples=20)
@given(ORIGINS, ORIGINS, st.integers(1, 90), st.integers(1, 9))
def test_cover_is_the_alpha_of_the_image_at_every_level(x, y, period, up):
    image = Image(0, period, PICTURE)
    cover = image.cover
    rect = Rect.at(x, y, 40, 30).evened()
    assert (cover.appearance(up, rect) == image.appearance(up, rect)[3:]).all()
    found = cover.bandpass(up, rect)
    whole = expand(cover.appearance(up - 1, parents(rect))) + (0 if found is None else found)
    assert np.abs(whole - cover.appearance(up, rect)).max() <= 2.0**-17
    assert cover.key != image.key
    assert cover.key[1:] == image.key[1:]


def test_an_opaque_picture_has_no_cover():
    data = PICTURE.data.copy()
    data[3] = 1.0
    assert Image(0, 8, ImageSource.of("opaque", data)).cover is None


def test_a_flat_picture_adds_nothing():
    flat = ImageSource.of("flat", np.full((4, 32, 32), 0.5, np.float32))
    assert Image(0, 8, flat).bandpass(1, Rect.at(0, 0, 40, 40)) is None


def test_a_lost_picture_is_transparent():
    lost = Image(0, 8, ImageSource("gone", "00"))
    assert not lost.appearance(3, Rect.at(0, 0, 4, 4)).any()
    assert lost.bandpass(1, Rect.at(0, 0, 4, 4)) is None


@pytest.mark.parametrize(
    "data", [np.zeros((3, 4, 4), np.float32), np.zeros((4, 4, 4)), np.zeros((4, 0, 4), np.float32)]
)
def test_sources_of_another_form_are_refused(data):
    with pytest.raises(ValueError, match=r"expected float32 \(4, h, w\)"):
        ImageSource.of("bad", data)


def test_pictures_with_the_same_pixels_share_them_as_long_as_one_is_there():
    pixels = np.random.default_rng(3).random((4, 9, 7), np.float32)
    one, other = ImageSource.of("one", pixels), ImageSource.of("other", pixels.copy())
    assert other.data is one.data
    assert (one.name, other.name) == ("one", "other")
    held = weakref.ref(one.data)
    del one, other, pixels
    gc.collect()
    assert held() is None
