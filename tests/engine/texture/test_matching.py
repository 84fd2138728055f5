"""Matching textures to examples: how alike they become, seams, sizes, steps, the same bits from the same seed."""

from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
import quality
import specimens
from quality import noise_like, unlikeness

from engine.numeric.colour_axes import axes_of
from engine.texture import matching
from engine.texture.matching import Shape, analysed, matched, matched_colours, noise, started

SIDE = 128


def made(example, size=(SIDE, SIDE), shape=None, seed=3, **more):
    pattern = analysed(example, (shape or Shape()).within(size))
    *_, last = matching.matching(pattern, noise(pattern.colours.count, size, seed), **more)
    return matched_colours(pattern, last.planes)


def closed(example, other, result, shape=None):
    """What part of the distance from noise to another crop of the example the result has closed."""
    axes = axes_of(example)
    planes = axes.planes(example)
    values = tuple(np.sort(plane, axis=None) for plane in planes)
    noisy = noise_like(axes, values, noise(axes.count, result.shape[1:], 11))
    far, near, own = (unlikeness(given, example, shape) for given in (noisy, other, result))
    assert near < 0.5 * far
    return (far - own) / (far - near)


@pytest.mark.parametrize("name", specimens.STOCHASTIC)
def test_stochastic_textures_are_matched(name):
    make = specimens.STOCHASTIC[name]
    example, other = make((SIDE, SIDE), 1), make((SIDE, SIDE), 50)
    assert closed(example, other, made(example)) > 0.95


@pytest.mark.parametrize("name", ["gravel", "grass"])
def test_photographs_are_matched(name):
    example, other = (specimens.photograph(name, (192, 192), at) for at in ((0, 0), (256, 256)))
    assert closed(example, other, made(example, (160, 240))) > 0.95


def correlation(plane, shift):
    """Of a grey picture with itself, so many pixels further down."""
    return np.corrcoef(plane[:-shift].ravel(), plane[shift:].ravel())[0, 1]


@pytest.mark.parametrize(
    ("example", "far"), [(specimens.wood(), 24), (specimens.photograph("brick", (256, 256)), 32)], ids=["wood", "brick"]
)
def test_long_fine_structure_is_lost(example, far):
    """Figures 8 and 9: histograms know nothing of fine detail that goes on for long.  Not a wish, a fact."""
    result = made(example)
    assert correlation(example[0], far) > 0.3
    assert correlation(result[0], far) < 0.5 * correlation(example[0], far)


def test_the_laplacian_pyramid_matches_sizes_but_not_directions():
    example, shape = specimens.bark(), Shape("laplacian")
    assert closed(example, specimens.bark(seed=30), made(example, shape=shape), shape) > 0.95
    along, across = (np.abs(np.diff(made(example, shape=shape)[0], axis=axis)).mean() for axis in (0, 1))
    own_along, own_across = (np.abs(np.diff(example[0], axis=axis)).mean() for axis in (0, 1))
    assert own_along / own_across < 0.8 < along / across


@pytest.mark.parametrize("size", [(128, 128), (97, 75), (64, 160)])
@pytest.mark.parametrize("kind", matching.PYRAMIDS)
def test_no_seams(kind, size):
    """Differences across the wrap are distributed as those between any other two lines."""
    example = specimens.sand()
    found = np.stack([made(example, size, Shape(kind), seed) for seed in range(4)])
    for axis in (2, 3):
        jumps = np.abs(np.diff(found, axis=axis, append=np.take(found, [0], axis)))
        lines = np.moveaxis(jumps, axis, 0).reshape(size[axis - 2], -1)
        for measure in (lines.mean(axis=1), np.percentile(lines, 90, axis=1), lines.std(axis=1)):
            assert abs(measure[-1] - measure.mean()) < 4.0 * measure.std()


@pytest.mark.parametrize("size", [(1, 1), (1, 9), (5, 3), (8, 8), (33, 17), (31, 64)])
@pytest.mark.parametrize("channels", [1, 2, 3, 4])
def test_examples_and_textures_of_any_size(channels, size):
    example = np.random.default_rng(1).random((channels, *size), np.float32)
    for out in ((1, 1), (7, 20), (40, 33)):
        found = made(example, out)
        assert found.shape == (channels, *out)
        assert np.isfinite(found).all()
        for plane, own in zip(found, example, strict=True):
            assert own.min() - 1e-4 <= plane.min()
            assert plane.max() <= own.max() + 1e-4


@pytest.mark.parametrize("kind", matching.PYRAMIDS)
def test_one_colour_and_grey_as_rgb(kind):
    flat = np.full((3, 20, 20), 0.5, np.float32)
    assert (made(flat, (30, 40), Shape(kind)) == 0.5).all()
    grey = np.repeat(specimens.photograph("gravel"), 3, axis=0)
    found = made(grey, (60, 50), Shape(kind))
    assert np.abs(found[0] - found[1]).max() <= 2.0**-15
    assert found[0].std() == pytest.approx(grey[0].std(), rel=0.1)


def test_alpha_is_a_band_like_the_others():
    rgb = specimens.granite()
    alpha = specimens.steep(specimens.rock((SIDE, SIDE), 12, 0.5, 9), 0.5, 0.2)[None].astype(np.float32)
    example = np.concatenate([rgb * alpha, alpha])
    found = made(example)
    assert abs(found[3].mean() - alpha.mean()) < 0.02
    assert np.corrcoef(found[3].ravel(), found[0].ravel())[0, 1] == pytest.approx(
        np.corrcoef(alpha.ravel(), example[0].ravel())[0, 1], abs=0.1
    )


def test_steps_come_one_by_one_and_may_be_the_last():
    pattern = analysed(specimens.granite((64, 64)), Shape())
    steps = list(matching.matching(pattern, noise(3, (64, 64), 1), 3))
    assert [step.done for step in steps] == sorted(step.done for step in steps)
    whole = [step for step in steps if step.planes is not None]
    assert [round(step.done, 6) for step in whole] == [round(k / 3, 6) for k in (1, 2, 3)]
    assert np.array_equal(whole[0].planes, matched(pattern, noise(3, (64, 64), 1), 1))
    begun = matching.matching(pattern, noise(3, (64, 64), 1), 3)
    assert next(begun).planes is None
    begun.close()


def test_the_same_seed_gives_the_same_bits():
    example = specimens.granite((64, 64))
    with ThreadPoolExecutor(2) as threads:
        assert np.array_equal(made(example), made(example, threads=threads))
    assert not np.array_equal(made(example), made(example, seed=4))


def test_more_turns_come_nearer():
    example = specimens.photograph("brick")
    distances = [unlikeness(made(example, iterations=n), example) for n in (1, 2, 5)]
    assert distances == sorted(distances, reverse=True)


def test_tables_are_as_good_as_ranks():
    example = specimens.granite()
    by_tables, by_rank = (unlikeness(made(example, exact=exact), example) for exact in (False, True))
    assert by_tables == pytest.approx(by_rank, rel=0.1)


def test_a_start_picture_leaves_its_traces():
    example, start = specimens.sand(), specimens.wood()
    pattern = analysed(example, Shape())
    found = matched_colours(pattern, matched(pattern, started(pattern, axes_of(start).planes(start), 1)))
    assert closed(example, specimens.sand(seed=40), found) > 0.6  # a bit like each of the two
    alike = np.corrcoef(found[0].ravel(), start[0].ravel())[0, 1]
    assert alike > 0.3 > abs(np.corrcoef(made(example)[0].ravel(), start[0].ravel())[0, 1]) + 0.1
    flat = matched_colours(pattern, matched(pattern, started(pattern, np.zeros((0, SIDE, SIDE), np.float32), 1)))
    assert closed(example, specimens.sand(seed=40), flat) > 0.95


def test_noise_knows_only_seed_and_place():
    assert np.array_equal(noise(2, (40, 50), 7)[:, :13, :20], noise(3, (13, 20), 7)[:2])
    values = noise(1, (200, 200), 7)
    assert values.mean() == pytest.approx(0.0, abs=0.02)
    assert values.std() == pytest.approx(3.0**-0.5, rel=0.02)
    assert abs(correlation(values[0], 1)) < 0.02


def test_a_pattern_too_deep_for_the_texture_is_refused():
    pattern = analysed(specimens.sand(), Shape())
    with pytest.raises(ValueError, match="found a pattern of 4 levels, expected 1 or fewer"):
        matched(pattern, noise(3, (9, 9), 0))


def test_quality_of_the_example_itself_is_nought():
    example = specimens.granite()
    assert unlikeness(example, example) == 0.0
    assert unlikeness(np.clip(example + 0.1, 0, 1).astype(np.float32), example) > 0.02
    assert quality.unlikeness(np.zeros((1, 9, 9), np.float32), np.zeros((1, 9, 9), np.float32)) == 0.0
