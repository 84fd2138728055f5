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
        for n, colours in enumerate(region.exemplar.colours):
            place = Rect.at((rect.x0 + int(x)) >> n, (rect.y0 + int(y)) >> n, 1, 1)
            name = show.sources(region, place, n)[0, 0]
            if name >= 0:
                out[:, y, x] = looked_up(colours, name)
                break
    return snapped(out)


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
        assert np.array_equal(show.preview(coarse, PICTURE), plain_preview(coarse, PICTURE))
    whole = refined(start)
    assert np.array_equal(show.preview(whole, PICTURE), show.picture(whole, PICTURE))


def test_old_sources_show_until_there_are_new_ones():
    old = refined(dabbed(empty(bounded(feather=0), 1), 10, 0, 22))
    grown = refined(dabbed(dabbed(old, 40, 6, 15), 0, 0, 9, erase=True), len(old.levels) - 1)
    shown = show.preview(grown, PICTURE)
    assert np.array_equal(shown, plain_preview(grown, PICTURE))
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
