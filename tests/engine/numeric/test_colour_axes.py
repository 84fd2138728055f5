"""Principal axes of colours: decorrelated, undone, degenerate ones left out."""

import numpy as np
import pytest

from engine.numeric.arithmetic import EVERYWHERE, LIBRARY
from engine.numeric.colour_axes import aligned, axes_of, blended
from engine.numeric.symmetric import eigenvectors, pseudo_inverse

RNG = np.random.default_rng(0)


@pytest.fixture(params=[LIBRARY, EVERYWHERE])
def arithmetic(request):
    return request.param


def coloured(channels=3, size=(40, 50)):
    mix = RNG.uniform(0.02, 0.1, (channels, channels))
    planes = np.tensordot(mix, RNG.standard_normal((channels, *size)), 1) + 0.5
    return np.clip(planes, 0.0, 1.0).astype(np.float32)


@pytest.mark.parametrize("channels", [1, 2, 3, 4])
def test_planes_are_not_correlated_and_lead_back(channels, arithmetic):
    x = coloured(channels)
    axes = axes_of(x, arithmetic)
    planes = axes.planes(x)
    assert np.abs(np.cov(planes.reshape(channels, -1), bias=True) - np.eye(channels)).max() < 1e-3
    assert np.abs(planes.mean(axis=(1, 2))).max() < 1e-4
    assert np.abs(axes.colours(planes) - x).max() < 1e-5
    lengths = np.sqrt((axes.axes.astype(np.float64) ** 2).sum(axis=0))
    assert (np.diff(lengths) <= 0).all()
    assert (axes.axes.sum(axis=0) > -1e-6).all()


def test_as_singular_values(arithmetic):
    x = coloured()
    flat = x.reshape(3, -1) - x.reshape(3, -1).mean(axis=1, keepdims=True)
    singular = np.linalg.svd(flat, full_matrices=False)[1] / np.sqrt(flat.shape[1])
    assert np.sqrt((axes_of(x, arithmetic).axes.astype(np.float64) ** 2).sum(axis=0)) == pytest.approx(
        singular, rel=1e-4
    )


def test_grey_as_rgb_has_one_axis(arithmetic):
    grey = RNG.integers(0, 256, (1, 30, 30)) / np.float32(255)
    x = np.repeat(grey.astype(np.float32), 3, axis=0)
    axes = axes_of(x, arithmetic)
    assert axes.count == 1
    back = axes.colours(axes.planes(x))
    assert np.abs(back - x).max() < 1e-6
    opaque = axes_of(np.concatenate([x, np.ones_like(grey, np.float32)]), arithmetic)
    assert opaque.count == 1
    assert (opaque.colours(axes.planes(x))[3] == 1.0).all()


def test_one_colour_has_none(arithmetic):
    x = np.empty((3, 5, 6), np.float32)
    x[:] = np.array([0.1, 0.5, 1.0], np.float32)[:, None, None]
    axes = axes_of(x, arithmetic)
    assert axes.planes(x).shape == (0, 5, 6)
    assert np.array_equal(axes.colours(np.empty((0, 5, 6), np.float32)), x)


def test_colours_stay_within_the_example():
    x = coloured()
    wild = axes_of(x).colours(9.0 * RNG.standard_normal((3, 20, 20)).astype(np.float32))
    assert (wild.min(axis=(1, 2)) >= x.min(axis=(1, 2))).all()
    assert (wild.max(axis=(1, 2)) <= x.max(axis=(1, 2))).all()


@pytest.mark.parametrize(("one", "other", "channels"), [(3, 3, 3), (1, 3, 3), (3, 4, 4), (4, 1, 4)])
def test_blends_join_both(one, other, channels, arithmetic):
    a, b = axes_of(coloured(one), arithmetic), axes_of(coloured(other), arithmetic)
    b = aligned(b, a)
    planes = RNG.standard_normal((4, 6, 6)).astype(np.float32)
    for weight, end in ((0.0, a), (1.0, b)):
        found = blended(a, b, weight).unclipped(planes[: max(a.count, b.count)])
        wanted = end.unclipped(planes[: end.count])
        rgb = found[: len(wanted)] if len(wanted) > 1 else found[:3]
        assert np.abs(rgb - wanted).max() < 1e-5
        assert found.shape[0] == channels
    half = blended(a, b, 0.5)
    assert np.abs(half.planes(half.unclipped(planes[: half.count])) - planes[: half.count]).max() < 1e-2


def test_turned_axes_are_the_same_axes():
    a, b = axes_of(coloured()), axes_of(coloured())
    turned = aligned(b, a)
    assert ((a.axes * turned.axes).sum(axis=0) >= 0.0).all()
    assert np.array_equal(np.abs(turned.axes), np.abs(b.axes))
    x = coloured()
    assert np.abs(turned.unclipped(turned.planes(x)) - b.unclipped(b.planes(x))).max() < 1e-4


@pytest.mark.parametrize("count", [1, 2, 3, 4, 9])
def test_eigenvectors_are_those_of_lapack(count):
    drawn = RNG.standard_normal((count, count + 3))
    matrix = drawn @ drawn.T
    values, vectors = eigenvectors(matrix)
    assert values == pytest.approx(np.linalg.eigvalsh(matrix)[::-1], rel=1e-12)
    assert np.abs(matrix @ vectors - vectors * values).max() < 1e-12 * values[0]
    assert np.abs(vectors.T @ vectors - np.eye(count)).max() < 1e-14
    assert pseudo_inverse(drawn.T) == pytest.approx(np.linalg.pinv(drawn.T), rel=1e-8, abs=1e-12)


def test_what_has_no_axes_of_its_own():
    values, vectors = eigenvectors(np.eye(3))
    assert np.array_equal(values, np.ones(3))
    assert np.array_equal(vectors, np.eye(3))
    assert pseudo_inverse(np.zeros((3, 0), np.float32)).shape == (0, 3)
    assert not pseudo_inverse(np.zeros((3, 2), np.float32)).any()
    same = np.ones((3, 2), np.float32)
    assert pseudo_inverse(same) == pytest.approx(np.linalg.pinv(same))


def test_axes_are_nearly_the_same_in_both_arithmetics():
    x = coloured(4)
    one, other = axes_of(x, LIBRARY), axes_of(x, EVERYWHERE)
    for name in ("mean", "axes", "low", "high"):
        assert getattr(other, name) == pytest.approx(getattr(one, name), rel=1e-5, abs=1e-6)
    assert np.abs(other.planes(x) - one.planes(x)).max() < 1e-4
