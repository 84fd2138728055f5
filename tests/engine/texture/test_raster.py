"""Pictures held in as few bits as tell them: the same planes, bit for bit, under the same hash."""

import hashlib

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from engine.makers.spectrum import spectrum_picture
from engine.numeric.address import Rect
from engine.numeric.colour import to_rgba8, to_rgba16
from engine.texture import image, raster
from engine.texture.image import Image, ImageSource, stretched
from engine.texture.lean_planes import lean_of
from engine.texture.raster import planes_of, put_plainly, straight_of

SEEDS = st.integers(0, 1 << 32)
KINDS = st.sampled_from((np.uint8, np.uint16))


def pixels_of(seed: int, kind: type, height: int = 11, width: int = 9) -> np.ndarray:
    """Returns pixels among which alpha is nothing, little, much and all, and colours lie under all of them."""
    rng, top = np.random.default_rng(seed), np.iinfo(kind).max
    found = rng.integers(0, top, (height, width, 4), kind, endpoint=True)
    found[..., 3] = rng.choice([0, 1, 2, top // 2, top - 1, top, rng.integers(0, top)], (height, width)).astype(kind)
    return found


def bits(planes: np.ndarray) -> np.ndarray:
    return np.ascontiguousarray(planes).view(np.uint32)


@settings(deadline=None, max_examples=60)
@given(SEEDS, KINDS, st.integers(1, 200))
def test_what_is_put_plainly_has_the_same_planes_and_is_what_tells_them(seed, kind, at_once):
    pixels = pixels_of(seed, kind)
    planes, told = planes_of(pixels), (to_rgba8 if kind == np.uint8 else to_rgba16)(planes_of(pixels))
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(raster, "AT_ONCE", at_once)
        plain, found = put_plainly(pixels.copy()), straight_of(planes)
    assert np.array_equal(bits(planes_of(plain)), bits(planes))
    assert np.array_equal(plain, told)
    assert np.array_equal(found, told)


def test_16_bits_that_8_tell_are_8():
    wide = (pixels_of(3, np.uint16) & 1) * np.uint16(65535)
    plain = put_plainly(wide.copy())
    assert plain.dtype == np.uint8
    assert np.array_equal(bits(planes_of(plain)), bits(planes_of(wide)))


@pytest.mark.parametrize("value", [-0.0, 0.3, np.nan])
def test_planes_that_no_bits_tell_stay_as_they_are(value):
    planes = planes_of(pixels_of(5, np.uint8))
    planes[1, 4, 2] = np.float32(value)
    assert straight_of(planes) is None


@settings(deadline=None, max_examples=25)
@given(SEEDS, KINDS, st.integers(1, 40), st.integers(1, 40))
def test_a_picture_in_fewer_bits_is_the_same_source(seed, kind, height, width):
    pixels = pixels_of(seed, kind)
    planes = planes_of(pixels)
    whole = ImageSource.of("p", planes)
    size, rows, columns = (height, width), np.arange(-3, height + 4), np.arange(-5, width)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(image, "_NARROW", 1)
        patch.setattr(image, "_BANDED", 1)
        patch.setattr(image, "AT_ONCE", 17)
        patch.setattr(raster, "AT_ONCE", 25)
        patch.setattr(image, "_HELD", {})
        made = [ImageSource.of("p", planes), ImageSource.of_raster("p", put_plainly(pixels.copy()))]
        seen = [stretched(source, size, rows, columns) for source in made]
    digest = hashlib.sha256(repr(planes.shape).encode() + planes.astype("<f4").tobytes()).hexdigest()
    wanted = stretched(whole, size, rows, columns)
    for source, part in zip(made, seen, strict=True):
        assert source.pixels.dtype == kind
        assert source == whole
        assert source.sha == digest
        assert (source.width, source.height, source.opaque) == (9, 11, whole.opaque)
        assert np.array_equal(bits(source.data), bits(planes))
        assert np.array_equal(bits(source.planes(Rect(2, 3, 7, 10))), bits(planes[:, 3:10, 2:7]))
        assert np.array_equal(bits(part), bits(wanted))


def test_a_picture_too_large_for_a_texture_is_refined_as_far_as_that_may_be_large(monkeypatch):
    source = ImageSource.of("p", planes_of(pixels_of(9, np.uint8, 64, 64)))
    assert Image(0, 8, source).refinements == 3
    monkeypatch.setattr(image, "_LARGE", 1024)
    assert Image(0, 8, source).refinements == 2
    wide = Image(0, 64, source).appearance(0, Rect(0, 0, 64, 64))
    assert np.array_equal(wide, source.data)


@pytest.mark.parametrize(("kind", "taken"), [(np.uint8, 4), (np.uint16, 8)])
def test_a_small_picture_takes_what_its_file_does_and_tells_the_same(kind, taken):
    most = np.iinfo(kind).max
    pixels = np.random.default_rng(3).integers(0, most, (90, 120, 4), kind, endpoint=True)
    pixels[..., 3] = most
    plain = planes_of(pixels)
    source = ImageSource.of("a", plain)
    assert source.pixels.nbytes == taken * 90 * 120
    np.testing.assert_array_equal(source.planes(source.whole).view(np.uint32), plain.view(np.uint32))


@settings(deadline=None)
@given(
    arrays(np.int32, st.tuples(st.just(4), st.integers(1, 4), st.integers(1, 5)), elements=st.integers(-9, 65540)),
    st.booleans(),
    st.sampled_from([0.0, 0.3, np.nan, -0.0]),
)
def test_lean_planes_are_those_that_they_are_of_or_none(steps, grey, other):
    planes = (steps * np.float32(2**-16)).astype(np.float32)
    if grey:
        planes[:3] = planes[0]
    if other or np.signbit(other):
        planes[3, 0, 0] = other
    lean = lean_of(planes)
    told = (np.ptp(steps, axis=(1, 2))[: 1 if grey else 3] <= 65535).all() and np.ptp(steps[3]) <= 65535
    if lean is None:
        assert other or np.signbit(other) or not told
        return
    _, height, width = planes.shape
    assert lean.shape == (height, width, 4)
    part = Rect(width // 2, height // 2, width, height)
    assert lean.planes(part).tobytes() == np.ascontiguousarray(planes[:, height // 2 :, width // 2 :]).tobytes()
    assert not grey or lean.nbytes <= 4 * height * width


@pytest.mark.parametrize(("channels", "taken"), [(1, 2), (3, 6)])
def test_what_a_texture_is_made_into_takes_two_bytes_a_value(channels, taken):
    made = np.random.default_rng(7).normal(size=(channels, 90, 120)).astype(np.float32) * np.float32(0.3)
    made[:, 0, 0] = 0  # one half: no file of 16 bits tells it
    planes = spectrum_picture(np.clip(made, -1, np.float32(0.999)))
    source = ImageSource.of("moss", planes)
    assert source.pixels.nbytes == taken * 90 * 120
    assert source.data.tobytes() == planes.tobytes()
    assert source.rows(np.array([3, 4, 80])).tobytes() == np.ascontiguousarray(planes[:, [3, 4, 80]]).tobytes()
    assert source.straight() is None
    assert straight_of(planes) is None
