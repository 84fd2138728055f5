"""What may still come below a level: never more than is promised, and of rock that lasts what its law says."""

import numpy as np
import pytest

from engine.numeric.address import Rect
from engine.numeric.similarity import Dyadic, Similarity
from engine.texture.bounding import NO_MORE, bound
from engine.texture.image import ImageSource
from engine.texture.placed import as_placed
from engine.texture.shaped import FADED, shaped
from engine.texture.table import KINDS, instance

LEVELS = (0, 1, 2, 3, 5, 8, 11, 14, 17, 20)
SIZE, DEEPER = 20, 4


def picture(alpha=1.0):
    rng = np.random.default_rng(5)
    data = np.ones((4, 48, 48), np.float32)
    data[:3] = np.rint(rng.random((1, 48, 48)) * 255) / 255
    data[3] = alpha
    data[:3] *= alpha
    return ImageSource.of("noise", data)


def made(kind, **parameters):
    return instance(kind, {"period": 24, **parameters}, 0, 7, picture() if KINDS[kind].pictured else None)


def placed(inner):
    return as_placed(inner, Similarity(Dyadic.of(0, 2, 0), Dyadic.of(3, 5, 0), True), 0)


RIDGED = ((0.0, 0.0), (0.5, 1.0), (1.0, 0.0))
TEXTURES = {
    "white": made("white"),
    "stripes": made("stripes", period=9.3, angle=27),
    "squares": made("squares", period=14.0),
    "sawtooth": made("sawtooth", period=11.0, angle=200),
    "image": made("image", period=12),
    "gradient": instance("gradient", {"from": [0, 0], "to": [9, 4], "ramp": [[0, "#000000"], [0.7, "#ffffff"]]}, 0, 0),
    "rock": made("rock", renew=False, roughness=0.86, period=64),
    "rough rock": made("rock", renew=False, roughness=0.3, period=3.3),
    "spectrum": made("spectrum", renew=False, roughness=0.6, period=12),
    "faint": made("spectrum", roughness=0.1),
    "sparse": made("sparse", renew=False, roughness=0.5, period=16),
    "few strengths": made("sparse", renew=False, quantise=3, density=1.0),
    "matched": made("matched", renew=False, roughness=0.5),
    "ridged rock": shaped(made("rock", renew=False, roughness=0.86, period=64), RIDGED),
    "bent twice": shaped(made("rock", renew=False, roughness=0.6), RIDGED, ((0.2, 0.0), (0.6, 1.0))),
    "bent stripes": shaped(made("stripes"), ((0.0, 0.3), (1.0, 0.9))),
    "bent picture": shaped(made("image", period=12), RIDGED),
    "placed": placed(made("rock", renew=False, roughness=0.7)),
}


def expanded(values):
    up = values.repeat(2, axis=1).repeat(2, axis=2)[:, 1:-1, 1:-1]
    for axis in (1, 2):
        far = np.empty_like(up)
        even, odd = (tuple(slice(s, None, 2) if a == axis else slice(None) for a in range(3)) for s in (0, 1))
        back = np.roll(up, 1, axis)
        ahead = np.roll(up, -1, axis)
        far[odd], far[even] = back[odd], ahead[even]
        up = 0.75 * up + 0.25 * far
    return up[:, 1:-1, 1:-1]


def measured(texture, level, rect):
    """What the next levels add, in float64: where differences of two appearances would be rounding alone."""
    left = None
    for k in range(level + 1, level + DEEPER + 1):
        here = rect.zoomed(k - level).grown(6)
        added = texture.bandpass(k, here)
        added = np.zeros((1, here.height, here.width)) if added is None else added.astype(np.float64)
        if left is not None:
            down = expanded(left)
            edge = (down.shape[1] - here.height) // 2
            added = added + down[:, edge : edge + here.height, edge : edge + here.width]
        left = added
    return left[:, 6:-6, 6:-6]


@pytest.mark.parametrize("name", TEXTURES)
def test_never_less_than_what_is_measured(name):
    texture = TEXTURES[name]
    for level in LEVELS:
        rect = Rect.at((1 << level) * 5 - 3, (1 << level) * 3 - 7, SIZE, SIZE)
        promised = bound(texture, level, rect)
        found = measured(texture, level, rect)
        assert promised is not None
        assert np.abs(found).max() <= promised.hard
        assert promised.rms <= promised.hard or promised.hard == 0.0


@pytest.mark.parametrize("name", ["rock", "rough rock", "spectrum", "sparse", "matched", "placed"])
def test_what_lasts_comes_to_no_more_than_its_rms_in_a_wide_window(name):
    for level in (3, 14):
        promised = bound(TEXTURES[name], level)
        found = measured(TEXTURES[name], level, Rect.at(1 << level, 1 << level, 40, 40))
        assert 0.1 * promised.rms < np.sqrt(np.square(found).mean()) < 1.15 * promised.rms


def test_rock_keeps_the_law_of_its_octaves():
    rock = TEXTURES["rock"]
    for level in (0, 9, 30):
        newest, fall = float(rock.weights(level + 1)[0]), 2.0**-0.86
        hard, rms, edge = bound(rock, level)
        assert hard == pytest.approx(3 * newest / (1 - fall), rel=1e-4)
        assert rms == pytest.approx(newest / np.sqrt(1 - fall**2), rel=1e-4)
        assert edge == 0.0


def test_pictures_add_nothing_past_their_pixels():
    assert bound(TEXTURES["white"], 0) == NO_MORE
    assert bound(TEXTURES["image"], 1).hard > 0.1
    assert bound(TEXTURES["image"], 2) == NO_MORE
    assert bound(TEXTURES["bent picture"], 2 + FADED) == NO_MORE


@pytest.mark.parametrize("texture", [made("rock"), made("spectrum"), made("sparse"), made("rock", roughness=0)])
def test_nothing_is_promised_of_what_is_raised_again(texture):
    assert bound(texture, 3) is None
    assert bound(shaped(texture, RIDGED), 3) is None
