"""Whole solids, plane by plane, against flat textures of the same example (Heeger & Bergen 1995, section 4)."""

from collections.abc import Callable

import cutting as planes
import numpy as np
import pytest
import specimens
from quality import unlikeness

pytestmark = pytest.mark.nightly

SIDE = 64
EXAMPLES: dict[str, Callable[[], np.ndarray]] = {
    **{name: lambda name=name: specimens.STOCHASTIC[name]((SIDE, SIDE)) for name in ("sand", "moss", "granite")},
    **{name: lambda name=name: specimens.photograph(name, (SIDE, SIDE)) for name in ("gravel", "grass")},
}


@pytest.fixture(scope="module", params=EXAMPLES)
def grown(request):
    """An example, and the solid made of it."""
    example = EXAMPLES[request.param]()
    return example, planes.solid_of(example, SIDE)


def likened(pictures, example):
    return np.array([unlikeness(picture, example) for picture in pictures])


def test_every_plane_along_two_axes(grown):
    example, cube = grown
    flat = likened((planes.flat_of(example, SIDE, seed) for seed in range(8)), example).mean()
    found = likened(planes.along_axes(cube), example)
    assert found.size == 3 * SIDE
    assert found.mean() < 1.15 * flat, found.mean() / flat
    assert found.max() < 1.5 * flat, found.max() / flat


def test_planes_at_a_slant(grown):
    """On average over directions that have nothing to do with the axes; single ones, of which each is a small sample,
    are further off, as single pieces of a flat texture are."""
    example, cube = grown
    flat = likened(planes.pieces(example, SIDE), example).mean()
    found = likened(planes.at_a_slant(cube), example)
    assert found.mean() < 1.5 * flat, found.mean() / flat
    assert np.quantile(found, 0.9) < 2.0 * flat, np.quantile(found, 0.9) / flat


def test_planes_at_a_slant_through_a_large_cube():
    """Of sand, whose power rises with frequency, which planes in all directions cannot have: the more samples they have
    of what is large, the more it shows."""
    example = specimens.sand((128, 128)).mean(axis=0, keepdims=True)
    cube = planes.solid_of(example, 128)
    flat = likened(planes.pieces(example, 128), example).mean()
    found = likened(planes.at_a_slant(cube), example)
    assert found.mean() < 1.5 * flat, found.mean() / flat
    assert np.quantile(found, 0.9) < 1.9 * flat, np.quantile(found, 0.9) / flat
    tiles = likened((planes.flat_of(example, 128, seed) for seed in range(4)), example).mean()
    slices = likened(planes.along_axes(cube), example)
    assert slices.max() < 1.5 * tiles, slices.max() / tiles
