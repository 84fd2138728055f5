"""Textures with a structure have the joint statistics of an example, tile, come from a seed; any picture will do."""

import hashlib

import numpy as np
import pytest

from engine.numeric.address import Rect
from engine.texture import matching
from engine.texture.structure.made import STRUCTURES, structured
from engine.texture.structure.pieced import pieced
from engine.texture.structure.statistics import bands_measured, joint_between, joint_of, unlike
from engine.texture.structure.synthesis import colours_of
from engine.texture.table import instance

SIZE = (64, 72)


def pebbles(channels=1, size=SIZE):
    """Round stones in a row of colours: float32 (channels, *size)."""
    random = np.random.default_rng(4)
    y, x = np.mgrid[: size[0], : size[1]]
    out = np.full((channels, *size), 0.2, np.float32)
    for _ in range(90):
        v, u, r = random.uniform(0, size[0]), random.uniform(0, size[1]), random.uniform(3, 7)
        far = ((y - v) ** 2 + (x - u) ** 2) / r**2
        colour = random.uniform(0.3, 1.0, channels)[:, None]
        out[:, far < 1] = colour * (1.0 - 0.6 * far[far < 1])
    return out


@pytest.fixture(scope="module")
def stones():
    picture = pebbles()
    return picture, joint_of(picture)


def made(picture, structure, size=SIZE, seed=1, wanted=None):
    wanted = wanted or joint_of(picture)
    *_, last = structured(picture, wanted, structure, size, seed)
    return colours_of(wanted, last.planes)


def apart(example, texture):
    wanted = joint_of(example)
    return unlike(bands_measured(wanted.axes.planes(texture), 3), wanted.scales)


@pytest.mark.parametrize("structure", STRUCTURES)
def test_joint_statistics_are_the_examples_where_histograms_leave_them(stones, structure):
    picture, wanted = stones
    pattern = matching.analysed(picture, matching.Shape("steerable", 4, 4).within(SIZE))
    histograms = matching.matched_colours(pattern, matching.matched(pattern, matching.noise(1, SIZE, 1)))
    texture = made(picture, structure, wanted=wanted)
    share = 0.45 if structure == "pieces" else 0.35  # cut where they agree, few large ones are not all of the example
    assert apart(picture, texture) < share * apart(picture, histograms)
    assert np.abs(np.sort(texture, axis=None) - np.sort(picture, axis=None)).mean() < 0.01


@pytest.mark.parametrize("structure", STRUCTURES)
def test_it_tiles(stones, structure):
    picture, wanted = stones
    texture = made(picture, structure, wanted=wanted)[0]
    for axis in (0, 1):
        steps = np.abs(texture - np.roll(texture, 1, axis)).mean(axis=1 - axis)
        assert steps[0] < 1.3 * steps[1:].max()


def test_the_same_bits_everywhere_and_another_seed_another_texture():
    rock = instance("rock", {"period": 12, "seed": 1}, 0, 0).appearance(0, Rect.at(0, 0, 40, 40))
    picture = np.clip(0.5 + 0.5 * rock, 0.0, 1.0).astype(np.float32)
    told = {name: made(picture, name, (45, 40)) for name in STRUCTURES}
    assert {n: hashlib.sha256(t.tobytes()).hexdigest()[:12] for n, t in told.items()} == BITS
    assert np.abs(made(picture, "objects", (45, 40), 2) - told["objects"]).mean() > 0.01


BITS = {
    "statistics": "2643b25f5681",
    "coarse": "a5321a4107bd",
    "objects": "fab3411d8bbf",
    "full": "55f5a1079362",
    "pieces": "c2fa61cb93b4",
}
ODD = {
    "one colour": (np.full((3, 20, 20), 0.3, np.float32), (30, 21)),
    "two values": ((pebbles() > 0.4).astype(np.float32), (33, 64)),
    "tiny": (pebbles(3)[:, :8, :8], (40, 40)),
    "a line": (pebbles()[:, :1], (16, 70)),
    "to a line": (pebbles(), (1, 50)),
    "to a pixel": (pebbles(), (1, 1)),
}


@pytest.mark.parametrize("structure", ["statistics", "objects", "pieces"])
@pytest.mark.parametrize("name", ODD)
def test_any_picture_gives_a_texture_of_any_size(name, structure):
    picture, size = ODD[name]
    texture = made(np.ascontiguousarray(picture), structure, size)
    assert texture.shape == (len(picture), *size)
    assert np.isfinite(texture).all()
    assert abs(texture.mean() - picture.mean()) < 0.2


def test_pieces_of_a_wall_make_a_wall():
    """Every row of mortar goes on, and every brick is whole."""
    y, x = np.mgrid[:66, :70]
    mortar = (y % 12 < 2) | ((x + 8 * (y // 12 % 2)) % 16 < 2)
    wall = np.where(mortar, np.float32(0.9), np.float32(0.4) + 0.05 * (y // 12 % 2))[None].astype(np.float32)
    *_, (done, texture) = pieced(wall, (72, 64), 3)
    assert done == 1.0
    assert texture.shape == (1, 72, 64)
    rows, columns = (np.arange(n) for n in texture.shape[1:])
    walls = (wall[:, (rows[:, None] + v) % 48, (columns + u) % 48] for v in range(24) for u in range(16))
    assert any(np.array_equal(texture, one) for one in walls)


def test_pieces_of_a_line_on_blank_ground_have_it():
    """They would agree best where there is nothing."""
    line = np.full((1, 64, 96), 0.95, np.float32)
    line[:, 28:36] = 0.2
    for seed in range(3):
        *_, (_, texture) = pieced(line, (64, 64), seed)
        assert abs(texture.mean() - line.mean()) < 0.07


def test_statistics_between_two_begin_with_the_first_and_end_with_the_other():
    one, other = pebbles(3), pebbles(3, (64, 64))[:, ::-1] * np.float32(0.5)
    first = joint_of(one)
    second = joint_of(np.ascontiguousarray(other), first.axes)
    for weight, end in ((0.0, first), (1.0, second)):
        found = joint_between(first, second, weight)
        assert unlike(found.scales, end.scales[: len(found.scales)]) < 1e-6
        assert (found.pixels == end.pixels).all()
    half = joint_between(first, second, 0.5)
    assert np.allclose(half.scales[0].together, (first.scales[0].together + second.scales[0].together) / 2)
    assert made(one, "objects", wanted=half).mean() == pytest.approx((one.mean() + other.mean()) / 2, abs=0.03)


@pytest.mark.parametrize("small", [(8, 8), (1, 50)])
def test_a_layout_goes_with_statistics_between_it_and_a_small_picture(small):
    one = pebbles(3, (64, 64))
    other = np.ascontiguousarray(pebbles(3)[:, : small[0], : small[1]])
    first = joint_of(one)
    half = joint_between(first, joint_of(other, first.axes), 0.5)
    assert len(half.scales) < len(first.scales)
    texture = made(one, "objects", wanted=half)
    assert np.isfinite(texture).all()
    assert texture.mean() == pytest.approx((one.mean() + other.mean()) / 2, abs=0.1)
