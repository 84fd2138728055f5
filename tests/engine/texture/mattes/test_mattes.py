"""What lies on a ground is found: untouched on plain grounds, after marks on others, whatever picture it is."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from skimage import data

from bench.composites import composites
from bench.masks import judged
from engine.texture.mattes.finding import Cut, cut_out_of, outlined, sought
from engine.texture.mattes.fine_rim import colours_without, laid_out
from engine.texture.mattes.marks import Mark, where_marked
from engine.texture.mattes.patchwork import SUPERPIXELS, patchwork, reduced
from engine.texture.mattes.things import cut_apart, grown_region, things

SIDE = 128


def overlap(found, wanted):
    return (found & wanted).sum() / max(1, (found | wanted).sum())


def opaque(colours, kind=np.uint8):
    out = np.full((*colours.shape[:2], 4), np.iinfo(kind).max, kind)
    out[..., :3] = colours
    return out


def disc(height, width, kind=np.uint8, at=(0.5, 0.5), radius=0.3):
    y, x = np.mgrid[:height, :width]
    inside = np.hypot((y + 0.5) / height - at[0], (x + 0.5) / width - at[1]) < radius
    colours = np.where(inside[..., None], (40, 90, 160), (230, 225, 220)) * (257 if kind == np.uint16 else 1)
    return opaque(colours, kind), inside


@pytest.mark.parametrize("name", ["bread on white", "felt on blue", "three shapes on white"])
def test_on_plain_grounds_it_is_found_untouched(name):
    (picture,) = composites(SIDE, (name,))
    cut = cut_out_of(sought(picture.pixels))
    alpha = cut[..., 3] / 255
    assert overlap(alpha >= 0.5, picture.mask) >= 0.97
    assert np.abs(alpha - picture.alpha).mean() < 0.015


@pytest.mark.parametrize("name", ["moss on fur"])
def test_on_a_textured_ground_it_is_found_after_three_strokes(name):
    (picture,) = composites(160, (name,))
    assert judged(picture, 3).overlap >= 0.95


def test_what_is_marked_is_as_it_was_marked():
    pixels, _ = disc(120, 160)
    looked = sought(pixels)
    drop, keep = Mark(False, ((80.0, 60.0),), 9.0), Mark(True, ((8.0, 8.0), (20.0, 8.0)), 5.0)
    alpha = cut_out_of(looked, [drop, keep])[..., 3]
    assert alpha[60, 80] == 0
    assert alpha[8, 8:20].min() == 255
    # Later marks lie over earlier ones.
    assert cut_out_of(looked, [drop, drop._replace(keep=True)])[60, 80, 3] == 255


def test_marks_are_drawn_into_the_small_picture():
    said = where_marked(
        [Mark(True, ((20.0, 10.0), (60.0, 10.0)), 4.0), Mark(False, ((60.0, 10.0),), 4.0)], (40, 80), (20, 40)
    )
    assert said[5, 12] == 1
    assert said[5, 30] == -1
    assert not said[12:].any()
    outside = where_marked([Mark(True, ((-500.0, 5.0), (-400.0, 9e6)), 4.0)], (40, 80), (20, 40))
    assert not outside.any()


def test_a_picture_without_ground_is_all_of_it():
    rng = np.random.default_rng(3)
    for colours in (np.full((60, 90, 3), 77), rng.integers(0, 256, (90, 90, 3))):
        pixels = opaque(colours)
        looked = sought(pixels)
        assert outlined(looked).whole
        assert np.array_equal(cut_out_of(looked), pixels)


@pytest.mark.parametrize("name", ["brick", "gravel"])
def test_a_texture_is_not_taken_for_things_on_a_ground(name):
    picture = getattr(data, name)()[:200, :200]
    assert outlined(sought(opaque(picture[..., None]))).whole


def test_of_a_texture_a_mark_tells_what_its_ground_is():
    looked = sought(opaque(data.brick()[..., None]))
    brick = Mark(True, ((30.0, 60.0), (30.0, 90.0)), 6.0)
    for mark, low, high in ((brick, 0.7, 0.92), (brick._replace(keep=False), 0.08, 0.3)):
        found = outlined(looked, [mark])
        assert not found.whole
        assert low < (found.trace > 0.5).mean() < high


def test_many_things_are_not_taken_for_a_texture():
    coins = opaque(data.coins()[..., None])
    found = cut_out_of(sought(coins))
    assert len(things(found)) == 24
    assert 0.25 < (found[..., 3] > 127).mean() < 0.4


@pytest.mark.parametrize("size", [(1, 1), (8, 8), (1, 5000), (5000, 3), (9, 700), (40, 40)])
@pytest.mark.parametrize("kind", [np.uint8, np.uint16])
def test_pictures_of_any_shape_give_something(size, kind):
    pixels, inside = disc(*size, kind)
    cut = cut_out_of(sought(pixels))
    assert cut.dtype == kind
    assert cut.shape == pixels.shape
    assert patchwork(pixels).count <= SUPERPIXELS
    if min(size) >= 9:
        assert overlap(cut[..., 3] > np.iinfo(kind).max // 2, inside) > 0.93


def test_sixteen_bits_are_kept():
    pixels, inside = disc(64, 64, np.uint16)
    pixels[..., :3] += np.arange(64, dtype=np.uint16)[:, None, None]
    cut = cut_out_of(sought(pixels))
    whole = cut[..., 3] == 65535
    assert whole[inside].mean() > 0.9
    assert np.array_equal(cut[whole], pixels[whole])
    assert not cut[cut[..., 3] == 0].any()


def test_holes_of_the_picture_stay_holes():
    pixels, inside = disc(100, 150)
    pixels[:30] = 0
    pixels[45:55, 70:80, 3] = 0
    cut = cut_out_of(sought(pixels))
    assert not cut[:30].any()
    assert not cut[45:55, 70:80].any()
    inside[:30] = inside[45:55, 70:80] = False
    assert overlap(cut[..., 3] > 127, inside) > 0.95
    assert not cut_out_of(sought(np.zeros((30, 30, 4), np.uint8))).any()


def test_its_rim_is_found_first_where_the_last_mark_ends():
    pieces = laid_out((600, 1000), (0.9, 0.1))
    assert (pieces[0].x0, pieces[0].y0) == (768, 0)
    assert sum(one.width * one.height for one in pieces) == 600 * 1000
    pixels, _ = disc(600, 600)
    looked = sought(pixels)
    mark = Mark(False, ((10.0, 10.0), (590.0, 590.0)), 4.0)
    steps = list(Cut(looked, outlined(looked, [mark])).steps())
    assert [done for done, _ in steps] == sorted(done for done, _ in steps)
    assert steps[-1][0] <= 1.0
    assert steps[0][1].rect.x0 > 0


def test_it_is_the_same_every_time():
    (picture,) = composites(96, ("leaves on gravel",))
    mark = Mark(True, ((40.0, 40.0),), 5.0)
    assert np.array_equal(cut_out_of(sought(picture.pixels), [mark]), cut_out_of(sought(picture.pixels), [mark]))


def test_colours_at_the_rim_are_without_the_ground():
    y, x = np.mgrid[:40, :40] - 19.5
    alpha = np.clip((12 - np.hypot(x, y)) / 6 + 0.5, 0, 1).astype(np.float32)
    front, back = np.array([0.8, 0.2, 0.1], np.float32), np.array([0.1, 0.3, 0.9], np.float32)
    seen = alpha[..., None] * front + (1 - alpha[..., None]) * back
    found = colours_without(seen, alpha)
    assert (np.abs(found - front) * alpha[..., None]).max() < 0.03


def test_several_things_become_one_picture_each():
    (picture,) = composites(SIDE, ("three shapes on white",))
    cut = cut_out_of(sought(picture.pixels))
    assert len(things(cut)) == 3
    pieces = cut_apart(cut)
    assert [p.shape[:2] for p in pieces] == [(r.height, r.width) for r in things(cut)]
    assert sum(int((p[..., 3] > 0).sum()) for p in pieces) == int((cut[..., 3] > 0).sum())
    areas = [(p[..., 3] > 127).sum() for p in pieces]
    assert areas == sorted(areas, reverse=True)
    assert not things(np.zeros((9, 9, 4), np.uint8))


def test_a_region_holds_all_that_is_seen_and_a_little_more():
    (picture,) = composites(SIDE, ("hairs on cream",))
    pixels = picture.pixels.copy()
    pixels[..., 3] = np.rint(picture.alpha * 255)
    region, seen = grown_region(pixels), pixels[..., 3] > 0
    assert region[seen].all()
    assert 1.0 < region.sum() / seen.sum() < 1.4


@settings(max_examples=20, deadline=None)
@given(st.integers(1, 30), st.integers(1, 30), st.data())
def test_means_over_rectangles_keep_the_sum(height, width, drawn):
    rows, columns = drawn.draw(st.integers(1, height)), drawn.draw(st.integers(1, width))
    pixels = np.random.default_rng(height * 31 + width).integers(0, 256, (height, width, 2)).astype(np.uint8)
    found = reduced(pixels, rows, columns)
    assert found.shape == (rows, columns, 2)
    tall, wide = (np.diff([*(np.arange(n) * size // n), size]) for n, size in ((rows, height), (columns, width)))
    total = (found * np.multiply.outer(tall, wide)[..., None]).sum(axis=(0, 1))
    assert np.allclose(total, pixels.sum(axis=(0, 1), dtype=float), rtol=1e-5)
