"""Octaves that are learnt: what maps make of a neighbourhood, the same bits for the same place, odd pictures."""

import hashlib
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from engine.numeric.address import Rect
from engine.numeric.detail import parents, subtract_expanded
from engine.numeric.grid import snapped
from engine.numeric.hashing import fold_key, hash_plane
from engine.numeric.pyramid import reduce
from engine.texture.bounding import bound
from engine.texture.image import ImageSource
from engine.texture.learnt.kinds import kinds_of
from engine.texture.learnt.least_squares import maps_fitted, pieces
from engine.texture.learnt.maps import TAPPED, as_picture, maps_of
from engine.texture.learnt.refining import along_axes, refined
from engine.texture.record import pictures_of
from engine.texture.table import TextureError, from_key, instance

ORIGINS = st.one_of(st.integers(-300, 300), st.integers(-(2**90), 2**90), st.just((1 << 40) - 20))


def stones(size=(96, 96), alpha=False, seed=4):
    """Pebbles of several colours on sand: float32 (3 or 4, *size), premultiplied."""
    random = np.random.default_rng(seed)
    y, x = np.mgrid[: size[0], : size[1]]
    out = np.full((4, *size), 0.2, np.float32) + 0.05 * random.standard_normal(size).astype(np.float32)
    out[3] = 0.0 if alpha else 1.0
    for _ in range(120):
        v, u, r = random.uniform(0, size[0]), random.uniform(0, size[1]), random.uniform(3, 9)
        edge = np.clip(r - np.hypot(y - v, x - u), 0.0, 1.0)
        colour = random.uniform(0.3, 0.9, 3)[:, None, None] * (0.7 + 0.3 * np.clip((y - v) / r, -1, 1))
        out[:3] += (colour - out[:3]) * edge
        out[3] = np.maximum(out[3], edge)
    out[:3] = np.clip(out[:3], 0.0, 1.0) * out[3]
    return snapped(out if alpha else out[:3])


def source(picture, name="sample"):
    planes = np.concatenate([picture, np.ones_like(picture[:1])]) if len(picture) == 3 else picture
    return ImageSource.of(name, snapped(planes.astype(np.float32)))


PLAIN, CLEAR = stones(), stones(alpha=True)
SOURCES = {"plain": source(PLAIN), "clear": source(CLEAR)}
LEARNT = {"detail": "learnt"}


@cache
def learnt(name):
    """The maps of a source, as a picture."""
    return as_picture("m", maps_fitted([{"plain": PLAIN, "clear": CLEAR}[name]]))


def made(kind, name="plain", level=-3, **parameters):
    given = {**LEARNT, "period": 48, **parameters}
    if kind != "series":
        return instance(kind, given, level, 0, SOURCES[name], 2, learnt(name))
    twice = np.concatenate([SOURCES[name].data] * 2, axis=1)
    return instance(kind, {**given, "stages": 2, "weight": 0.3}, level, 0, ImageSource.of("s", twice), 2, learnt(name))


@st.composite
def textures(draw):
    kind = draw(st.sampled_from(["image", "canvas", "example", "matched", "series"]))
    options = {"strength": draw(st.sampled_from([0.3, 1.0])), "octaves": draw(st.sampled_from([1, 2]))}
    if kind in ("matched", "series"):
        options["roughness"] = draw(st.sampled_from([0.0, 0.5, 0.85]))
        options["renew"] = draw(st.booleans())
    found = made(kind, draw(st.sampled_from(["plain", "clear"])), **options)
    cover = found.cover
    return cover if cover is not None and draw(st.booleans()) else found


@settings(deadline=None, max_examples=40)
@given(textures(), ORIGINS, ORIGINS, st.sampled_from([0, 1, 2, 3, 4, 5, 9, 40]), st.data())
def test_any_rectangle_holds_the_same_bits(made, x, y, up, data):
    whole = Rect.at(x, y, 61, 50)
    a, b = sorted(data.draw(st.lists(st.integers(0, 61), min_size=2, max_size=2, unique=True)))
    c, d = sorted(data.draw(st.lists(st.integers(0, 50), min_size=2, max_size=2, unique=True)))
    part = Rect(x + a, y + c, x + b, y + d)
    for values in (made.appearance, made.bandpass):
        big, small = values(up - 3, whole), values(up - 3, part)
        if big is None or small is None:
            assert big is small or not (big if small is None else small).any()
        else:
            assert (small == big[:, *part.slices(whole)]).all()


@settings(deadline=None, max_examples=30)
@given(textures(), ORIGINS, ORIGINS, st.sampled_from([1, 2, 3, 4, 5, 9, 30]))
def test_the_bandpass_is_what_expand_leaves_out(made, x, y, up):
    rect = Rect.at(x, y, 40, 36).evened()
    left = made.appearance(up - 3, rect)[:3]
    subtract_expanded(left, made.appearance(up - 4, parents(rect))[:3])
    added = made.bandpass(up - 3, rect)
    assert np.abs(left - (0 if added is None else added)).max() < 2e-5


@settings(deadline=None, max_examples=20)
@given(textures(), st.sampled_from([-3, 0, 5]))
def test_a_key_tells_it_again(made, up):
    found = from_key([*made.key], {one.sha: one for one in pictures_of(made)})
    assert found == made
    assert found.key == made.key
    rect = Rect.at(7, 9, 20, 30)
    assert np.array_equal(found.appearance(up, rect), made.appearance(up, rect))
    without = from_key(made.key, {one.sha: one for one in pictures_of(made)[:1]})
    assert without.key == made.key
    assert without.appearance(up, rect).shape == made.appearance(up, rect).shape


KEYS = (["learnt", 0], ["learnt", 0, 2, 1.0, "m", "sha", ["rock", 0, 32.0, 0.5, 0]], ["learnt", 0, 3, 1.0, "m", "s", 5])


@pytest.mark.parametrize("key", KEYS)
def test_keys_that_are_none(key):
    with pytest.raises(TextureError, match="key"):
        from_key(key, {})


def test_threads_and_order_make_no_difference():
    texture = made("matched")
    tiles = [(level, Rect.at(32 * k, -32 * k, 32, 32)) for level in (0, -1, 3) for k in range(4)]
    alone = [texture.bandpass(*tile) for tile in tiles]
    with ThreadPoolExecutor(2) as pool:
        together = list(pool.map(lambda tile: texture.bandpass(*tile), reversed(tiles)))
    assert all(np.array_equal(a, b) for a, b in zip(alone, reversed(together), strict=True))


@pytest.mark.parametrize("name", ["plain", "clear"])
def test_what_was_learnt_survives_being_kept(name):
    picture = {"plain": PLAIN, "clear": CLEAR}[name]
    maps, again = maps_fitted([picture]), maps_of(learnt(name))
    for field in ("axes", "edges", "loud", "sharp", "rough"):
        assert np.array_equal(getattr(maps, field), getattr(again, field))
    assert as_picture("m", maps).sha == learnt(name).sha


def told_by(numbers, size=(64, 90)):
    """A picture that tells whole numbers as kept maps do."""
    flat = np.zeros(3 * size[0] * size[1])
    flat[: len(numbers)] = numbers
    planes = ((flat + (1 << 15)) * 2.0**-16).astype(np.float32).reshape(3, size[1], size[0])
    return ImageSource.of("m", np.concatenate([planes, np.ones_like(planes[:1])]))


@pytest.mark.parametrize("numbers", [(1, 2, 2), (2, 1, 1), (1, 4, 3), (1, -1, 3), (1, 1, 0), (1, 4, 4)])
def test_a_picture_that_tells_no_maps_changes_nothing(numbers):
    """Nor does one that is too small, or of another width."""
    shapes = [told_by(numbers, (64, 20) if numbers == (1, 4, 4) else (64, 90)), told_by((1, 1, 1), (60, 90))]
    for maps in shapes:
        assert maps_of(maps) is None
        for name, kind in (("plain", "image"), ("clear", "matched")):
            texture = instance(kind, {**LEARNT, "period": 48}, 0, 0, SOURCES[name], 2, maps)
            plain = instance(kind, {"period": 48}, 0, 0, SOURCES[name], 2)
            for level in (1, 2, 5):
                rect = Rect.at(3, 4, 20, 10)
                assert np.array_equal(texture.appearance(level, rect), plain.appearance(level, rect))


@pytest.mark.parametrize("kind", ["image", "matched", "series"])
@pytest.mark.parametrize(("name", "other"), [("plain", "clear"), ("clear", "plain")])
def test_maps_of_another_picture_are_no_fault(kind, name, other):
    found = instance(kind, {**LEARNT, "period": 48, "stages": 2}, 0, 0, SOURCES[name], 2, learnt(other))
    for texture in (found, found.cover or found):
        for level in (1, 2, 5):
            rect = Rect.at(3, 4, 20, 10)
            assert np.isfinite(texture.appearance(level, rect)).all()
            added = texture.bandpass(level, rect)
            assert added is None or added.shape[1:] == (10, 20)


# ---- what maps make ----


def plainly(planes, hashes, maps, octave):
    """`refined`, without its kernel: float64."""
    x = along_axes(planes, maps.axes).astype(np.float64)
    height, width = planes.shape[1] - 4, planes.shape[2] - 4
    kinds, steep = kinds_of(along_axes(planes, maps.axes)[0], maps.edges)
    lively = np.minimum(1.0, np.sqrt(steep) / maps.edges[0])
    found, rough = np.zeros((2, 3, len(x), height, width))
    for r, plane in enumerate(x):
        near = [plane[j : j + height, i : i + width] - plane[2:-2, 2:-2] for j in range(TAPPED) for i in range(TAPPED)]
        mixed = [[_mixed(int(h) + (r + 1) * 0x9E3779B97F4A7C15) for h in row] for row in hashes]
        bits = np.array([[[h >> 21 * n & (1 << 21) - 1 for n in range(3)] for h in row] for row in mixed], np.float64)
        noise = (bits - (1 << 20) + 0.5) * (3**0.5 / (1 << 20)) * float(maps.loud[octave])
        random = [noise[j : j + height, i : i + width, n] for j in range(3) for i in range(3) for n in range(3)]
        found[:, r] = np.einsum("phw,hwpn->nhw", near, maps.sharp[kinds, r, :, :3])
        rough[:, r] = lively * np.einsum("phw,hwpn->nhw", random, maps.rough[kinds, r, :, :3])
    noise = np.einsum("nrhw,rc->nchw", rough, maps.axes)
    noise[:, 3:] = 0.0  # alpha has none
    across, down, both = np.einsum("nrhw,rc->nchw", found, maps.axes) + noise
    own = planes[:, 2:-2, 2:-2]
    out = np.zeros((len(planes), 2 * height, 2 * width))
    for j, v in enumerate((1, -1)):
        for i, u in enumerate((1, -1)):
            out[:, j::2, i::2] = np.clip(own + u * across + v * down + u * v * both, 0.0, 1.0)
    if len(out) == 4:
        out[:3] = np.minimum(out[:3], out[3])
    return out


def _mixed(h):
    mask = (1 << 64) - 1
    h &= mask
    h = (h ^ h >> 30) * 0xBF58476D1CE4E5B9 & mask
    h = (h ^ h >> 27) * 0x94D049BB133111EB & mask
    return h ^ h >> 31


@pytest.mark.parametrize("picture", [PLAIN, CLEAR, PLAIN[:1]], ids=["colours", "alpha", "grey"])
@pytest.mark.parametrize("octave", [0, 1])
def test_the_kernel_makes_what_the_plain_form_makes(picture, octave):
    maps = maps_fitted([picture])
    planes = np.ascontiguousarray(picture[:, 10:38, 4:40])
    hashes = hash_plane(fold_key(5), 3, 4, 34, 26)
    found = refined(planes, hashes, maps, octave)
    assert np.abs(found - plainly(planes, hashes, maps, octave)).max() < 1e-5


def test_the_mean_of_four_pixels_is_the_pixel_that_they_lie_in():
    inner = np.clip(PLAIN, 0.25, 0.75)  # where nothing is cut off at black or white
    middle = instance("image", LEARNT, 0, 0, source(inner), 2, learnt("plain"))
    own = middle.appearance(0, Rect.at(0, 0, 96, 96))[:3]
    assert np.abs(reduce(middle.appearance(1, Rect.at(0, 0, 192, 192))[:3]) - own).max() < 3e-5


def refinement(picture, strength=1.0, loud=1.0):
    """The picture at half size, refined by one octave by what was learnt of it there; and expanded."""
    half = reduce(np.ascontiguousarray(picture))
    maps = maps_fitted([half])
    maps = as_picture("m", replace(maps, loud=maps.loud * np.float32(loud)))
    size = Rect.at(0, 0, picture.shape[2], picture.shape[1])
    of = source(half)
    return [
        instance("image", {**LEARNT, "strength": s}, 0, 0, of, 2, maps).appearance(1, size)[:3] for s in (strength, 0.0)
    ]


def test_it_is_nearer_to_the_finer_picture_than_expansion():
    picture = stones((160, 160), seed=7)
    sharp, soft = (((one - picture) ** 2).mean() for one in refinement(picture, loud=0.0))
    assert 10 * np.log10(soft / sharp) > 0.9  # dB


def test_strength_goes_from_expansion_to_all_of_it():
    picture = stones((96, 96), seed=8)
    (part, soft), (all_, _) = refinement(picture, 0.25), refinement(picture)
    assert np.abs(part - soft - 0.25 * (all_ - soft)).max() < 1e-5


def test_what_is_smooth_stays_smooth():
    """Half of the picture has grain; the other gets none."""
    ramp = np.linspace(0.3, 0.6, 128, dtype=np.float32) * np.ones((3, 128, 1), np.float32)
    ramp[:, :, 64:] += 0.1 * np.random.default_rng(1).standard_normal((128, 64)).astype(np.float32)
    fine, soft = refinement(np.clip(ramp, 0.0, 1.0))
    added = np.abs(fine - soft)
    assert added[:, 8:-8, 8:56].mean() < 0.06 * added[:, 8:-8, 72:120].mean()


def test_print_that_is_too_fine_for_its_pixels_gets_no_rows_beside_it():
    """What is learnt of such a picture's steps is mostly its steps."""
    random = np.random.default_rng(3)
    page = np.full((3, 128, 128), 0.85, np.float32)
    for y in range(4, 120, 9):
        for x in range(3, 122, 6):
            down, across = random.random(2) < 0.5
            page[:, y : y + 6 * down, x] = 0.1
            page[:, y + random.integers(6), x : x + 4 * across] = 0.1
    page += 0.01 * random.standard_normal((1, 128, 128)).astype(np.float32)
    found = refined(page, hash_plane(5, 0, 0, 126, 126), maps_fitted([page]), 0)
    paper = page[0, 2:-2, 2:-2].repeat(2, 0).repeat(2, 1) > 0.6
    assert np.abs(found[0] - 0.85)[paper].mean() < 0.035


def test_octaves_fall_as_the_pictures_do():
    texture = made("image", period=96, level=0)
    sizes = [texture.bandpass(level, Rect.at(0, 0, 96 << level, 96 << level)).std() for level in (1, 2)]
    finest = PLAIN - _expanded(reduce(PLAIN))
    assert sizes[0] < finest.std()
    assert sizes[1] < sizes[0]


def _expanded(coarse):
    out = np.zeros((len(coarse), 2 * coarse.shape[1], 2 * coarse.shape[2]), np.float32)
    subtract_expanded(out, np.pad(coarse, ((0, 0), (1, 1), (1, 1)), mode="edge"))
    return -out


ODD = {
    "tiny": stones((8, 8)),
    "a pixel": stones((1, 1)),
    "a line": stones((1, 300)),
    "one colour": np.full((3, 40, 40), 0.3, np.float32),
    "black and white": (stones((64, 64)) > 0.4).astype(np.float32),
    "holes": stones((48, 64), alpha=True),
    "clear": np.zeros((4, 40, 40), np.float32),
    "odd": stones((47, 61)),
}


@pytest.mark.parametrize("picture", ODD.values(), ids=ODD)
def test_odd_pictures(picture):
    of = source(picture)
    channels = picture if len(picture) == 4 else picture[:3]
    texture = instance("image", LEARNT, 0, 0, of, 2, as_picture("m", maps_fitted([channels])))
    for level in (1, 2, 3):
        seen = texture.appearance(level, Rect.at(-3, 5, 40, 30))
        assert np.isfinite(seen).all()
        assert seen.min() >= 0.0
        assert (seen[:3] <= seen[3] + 1e-6).all()
        assert seen[3].max() <= 1.0
    if picture.std() == 0.0:
        assert texture.bandpass(1, Rect.at(0, 0, 32, 32)) is None


def test_parts_of_a_large_picture_lie_within_it():
    for size in ((640, 480), (6000, 4000), (1, 5000), (5000, 3), (1030, 20)):
        for rect in pieces(*size):
            assert rect.intersect(Rect(0, 0, *size)) == rect
            assert not rect.empty
    assert pieces(640, 480) == [Rect(64, 0, 576, 480)]
    assert len(pieces(6000, 4000)) == 4


def test_bounds_hold():
    rect = Rect.at(0, 0, 64, 64)
    for texture in (made("image"), made("matched", renew=False)):
        told = bound(texture, texture.base)
        assert told is not None
        assert told.hard >= np.abs(texture.bandpass(texture.base + 3, rect)).max()
    assert bound(made("image"), 30).hard == 0.0
    assert bound(made("matched"), 30) is None


# ---- pixels that stay ----

PIXELS = {
    ("image", "plain"): "ee6a35b928d7f9a2",
    ("matched", "plain"): "e357911e47d3ff76",
    ("matched", "clear"): "9bd1b8efc355b285",
}


@pytest.mark.parametrize(("kind", "name"), PIXELS)
def test_pixels_stay(kind, name):
    texture = made(kind, name, roughness=0.6) if kind == "matched" else made(kind, name)
    digest = hashlib.sha256(learnt(name).sha.encode())
    for level in (-2, -1, 0, 1, 4):
        digest.update(texture.appearance(level, Rect.at(-9, 4, 50, 40)).tobytes())
    assert digest.hexdigest()[:16] == PIXELS[kind, name]
