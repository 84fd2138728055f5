"""Palettes made of pictures: few colours that stand for all, rare ones too."""

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from engine.files.swatches.picture_colours import MOST_SHADES, picture_palette


def patches(*colours, side=16):
    rows = [np.full((side, side, 4), (*colour, 255), np.uint8) for colour in colours]
    return np.concatenate(rows, 1)


def eighths(palette):
    return [tuple(round(255 * v) for v in rgb) for rgb, _ in palette.colours]


def test_flat_colours_are_found_exactly_dark_to_light():
    found = picture_palette(patches((250, 240, 20), (10, 20, 30), (200, 30, 40)), "a")
    assert eighths(found) == [(10, 20, 30), (200, 30, 40), (250, 240, 20)]
    assert found.name == "a"


def test_a_small_flower_on_a_large_meadow_is_found():
    picture = np.full((256, 256, 4), (60, 140, 50, 255), np.uint8)
    noise = np.random.default_rng(3).integers(-20, 20, (256, 256, 3))
    picture[..., :3] = np.clip(picture[..., :3] + noise, 0, 255)
    picture[100:106, 100:106, :3] = 230, 40, 160
    found = eighths(picture_palette(picture, "a"))
    assert min(max(abs(a - b) for a, b in zip(one, (230, 40, 160), strict=True)) for one in found) <= 2


def test_what_is_not_opaque_is_seen_on_the_paper_or_left_out():
    picture = patches((200, 30, 40))
    picture[:, :8, 3] = 0
    assert eighths(picture_palette(picture, "a")) == [(200, 30, 40)]
    assert eighths(picture_palette(picture, "a", (1.0, 1.0, 1.0))) == [(200, 30, 40), (255, 255, 255)]
    assert picture_palette(picture * 0, "a").colours == ()


@settings(deadline=None, max_examples=30)
@given(st.integers(1, 40), st.integers(1, 40), st.integers(0, 99), st.sampled_from((np.uint8, np.uint16)))
def test_any_picture_gives_few_colours_the_same_again(wide, high, seed, depth):
    pixels = np.random.default_rng(seed).integers(0, np.iinfo(depth).max, (high, wide, 4), depth, endpoint=True)
    found = picture_palette(pixels, "a", (0.5, 0.5, 0.5))
    assert 1 <= len(found.colours) <= MOST_SHADES
    assert all(0 <= v <= 1 for rgb, _ in found.colours for v in rgb)
    assert picture_palette(pixels, "a", (0.5, 0.5, 0.5)) == found
