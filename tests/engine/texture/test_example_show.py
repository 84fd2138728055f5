"""What is shown of a region before, while and after it is refined."""

import numpy as np
import pytest
from exemplars import bounded, unbounded

from engine.numeric.address import Rect
from engine.numeric.grid import snapped
from engine.numeric.halving import halved_region
from engine.texture.example import show, tiles
from engine.texture.example.exemplar import PAD, shrunk
from engine.texture.example.region import empty, painted, refined

PICTURE = Rect.at(-21, -37, 90, 85)
EXEMPLARS = {"bounded": bounded(), "unbounded": unbounded()}


def disc(radius):
    y, x = np.mgrid[-radius : radius + 1, -radius : radius + 1]
    return x * x + y * y <= radius * radius


def dabbed(region, x, y, radius, erase=False):
    side = 2 * radius + 1
    return painted(region, Rect.at(x - radius, y - radius, side, side), disc(radius), erase)


def mask_of(region, rect):
    return tiles.gathered(region.masks[0], rect, np.zeros((1, rect.height, rect.width), np.uint8))[0] > 0


def looked_up(colours, name):
    return colours[(name >> 16) - PAD, (name & 0xFFFF) - PAD]


def plain_preview(region, rect):
    """Pixel by pixel, without the blending of seams."""
    out = np.zeros((4, rect.height, rect.width), np.float32)
    for y, x in np.argwhere(mask_of(region, rect)):
        out[:, y, x] = region.exemplar.average
        at = rect.y0 + int(y), rect.x0 + int(x)
        for n in range(len(region.levels)):
            name = source(region, n, at[0] >> n, at[1] >> n)
            if name >= 0:
                out[:, y, x] = continued(region, n, *at) if n else looked_up(region.exemplar.colours[0], name)
                break
    return snapped(out)


def source(region, n, y, x):
    """A pixel's source; none of a coarser level where the region around it was another one when that was refined."""
    around = Rect.at(x - 1, y - 1, 3, 3)
    masks = region.masks[n], region.levels[n].mask
    now, then = (tiles.gathered(mask, around, np.zeros((1, 3, 3), np.uint8)) for mask in masks)
    return -1 if n and (now != then).any() else show.sources(region, Rect.at(x, y, 1, 1), n)[0, 0]


def continued(region, n, y, x):
    """What the example has where the four nearest sources of a level go on to a pixel; nearer ones count for more."""
    colours, side = region.exemplar.colours[0], 1 << n
    total, mixed, coarse = 0.0, np.zeros(4), np.zeros(4)
    v, u = (y + 0.5) / side - 0.5, (x + 0.5) / side - 0.5
    for row in (int(np.floor(v)), int(np.floor(v)) + 1):
        for column in (int(np.floor(u)), int(np.floor(u)) + 1):
            name = source(region, n, row, column)
            if name < 0:
                continue
            down, across = 1 - abs(v - row), 1 - abs(u - column)
            weight = down * down * (3 - 2 * down) * across * across * (3 - 2 * across)
            total += weight
            coarse += weight * looked_up(region.exemplar.colours[n], name)
            i, j = ((name >> 16) - PAD - row) * side + y, ((name & 0xFFFF) - PAD - column) * side + x
            if not region.exemplar.boundary:
                i, j = mirrored(i, colours.shape[0]), mirrored(j, colours.shape[1])
            if 0 <= i < colours.shape[0] and 0 <= j < colours.shape[1]:
                mixed += weight * colours[i, j]
    lacking = max(0.0, show.FAINT - mixed[3] / max(coarse[3], 1e-6))
    return (mixed + lacking * coarse) / total


def mirrored(i, side):
    return -1 - i if i < 0 else 2 * side - 1 - i if i >= side else i


@pytest.mark.parametrize("name", EXEMPLARS)
def test_a_preview_shows_the_finest_colours_there_are(name):
    start = dabbed(empty(EXEMPLARS[name], 1), 10, 0, 22)
    assert len(start.levels) > 1
    average = show.preview(start, PICTURE)
    mask = mask_of(start, PICTURE)
    assert (average[:, mask] == snapped(EXEMPLARS[name].average)[:, None]).all()
    assert not average[:, ~mask].any()
    for upto in reversed(range(1, len(start.levels))):
        coarse = refined(start, upto)
        assert np.abs(show.preview(coarse, PICTURE) - plain_preview(coarse, PICTURE)).max() < 2**-14
    whole = refined(start)
    assert np.array_equal(show.preview(whole, PICTURE), show.picture(whole, PICTURE))


@pytest.mark.parametrize("name", EXEMPLARS)
def test_a_preview_shows_no_squares(name):
    """A coarse pixel is no square of one colour: what is inside of it differs as much as what is beside it."""
    start = dabbed(empty(EXEMPLARS[name], 1), 10, 0, 30)
    n = len(start.levels) - 1
    shown = show.preview(refined(start, n), PICTURE)[:3].mean(axis=0)
    step, inside = np.abs(np.diff(shown, axis=1)), mask_of(start, PICTURE)
    inside = inside[:, 1:] & inside[:, :-1]
    border = np.broadcast_to((np.arange(PICTURE.x0 + 1, PICTURE.x1) % (1 << n) == 0)[None], step.shape)
    assert step[inside & border].mean() < 2 * step[inside & ~border].mean()


def test_what_is_new_does_not_look_like_the_rim_that_was_there():
    """Around an old rim levels in between still have sources of it: new pixels look as if it had never been."""
    exemplar = bounded(levels=4, feather=0)
    grown = dabbed(refined(dabbed(empty(exemplar, 1), 10, 0, 14)), 10, 0, 30)
    fresh = dabbed(empty(exemplar, 1), 10, 0, 30)
    top = len(exemplar.levels) - 1
    assert top > 1
    new = mask_of(grown, PICTURE) & ~mask_of(dabbed(empty(exemplar, 1), 10, 0, 14), PICTURE)
    old, plain = (show.preview(refined(region, top), PICTURE) for region in (grown, fresh))
    assert np.array_equal(old[:, new], plain[:, new])


def test_old_sources_show_until_there_are_new_ones():
    old = refined(dabbed(empty(bounded(feather=0), 1), 10, 0, 22))
    grown = refined(dabbed(dabbed(old, 40, 6, 15), 0, 0, 9, erase=True), len(old.levels) - 1)
    shown = show.preview(grown, PICTURE)
    assert np.abs(shown - plain_preview(grown, PICTURE)).max() < 2**-14
    both = mask_of(old, PICTURE) & mask_of(grown, PICTURE)
    assert both.any()
    assert np.array_equal(shown[:, both], show.picture(old, PICTURE)[:, both])
    assert not shown[:, ~mask_of(grown, PICTURE)].any()


def test_what_is_shown_does_not_depend_on_the_rectangle():
    grown = refined(dabbed(refined(dabbed(empty(shrunk(bounded(), 1), 1), 10, 0, 22)), 40, 6, 15), 1)
    part = Rect.at(-3, -11, 40, 31)
    assert np.array_equal(show.preview(grown, part), show.preview(grown, PICTURE)[(slice(None), *part.slices(PICTURE))])


@pytest.mark.parametrize("detail", [1, 2, 3, 7])
def test_a_shrunk_example_keeps_what_is_finer(detail):
    for exemplar in (bounded(), unbounded(), bounded(passes=2, smooth=2.0)):
        small = shrunk(exemplar, detail)
        sides = [-(-len(exemplar.pixels) // 2**n) for n in reversed(range(detail))]
        assert [len(colours) for colours in small.finer] == sides
        assert np.array_equal(small.finer[-1], exemplar.colours[0])
        assert (small.boundary, small.parameters) == (exemplar.boundary, exemplar.parameters)
        region = exemplar.mask
        for _ in range(detail):
            region = halved_region(region)
        assert np.array_equal(small.mask, region)
        assert np.array_equal(small.levels[0].region[PAD:-PAD, PAD:-PAD] > 0, region)
        if detail < len(exemplar.levels):
            assert small.levels == exemplar.levels[detail:]
            assert np.abs(small.colours[0] - exemplar.colours[detail]).max() < 2**-15
        twice = shrunk(shrunk(exemplar, 1), detail - 1)
        assert len(twice.finer) == detail
        done = refined(dabbed(empty(small, 1), 10, 10, 12))
        assert show.picture(done, Rect.at(-2, -2, 25, 25)).any()
    assert shrunk(exemplar, 0) is exemplar
