"""What is shown of a region before, while and after it is refined, and when it is zoomed into."""

import numpy as np
import pytest
from exemplars import blob, bounded, unbounded

from engine.numeric.address import Rect
from engine.numeric.grid import snapped
from engine.numeric.halving import halved_region
from engine.texture.example import show, tiles
from engine.texture.example.exemplar import PAD, analysed, shrunk
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
    whole = PICTURE.zoomed(1)
    assert np.array_equal(show.finer(grown, 1, part), show.finer(grown, 1, whole)[(slice(None), *part.slices(whole))])


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


def plain_finer(region, k, rect):
    """Pixel by pixel: below each source its child of the same parity, or the next of the four in the example."""
    out = np.zeros((4, rect.height, rect.width), np.float32)
    regions = [region.exemplar.mask] + [inside[PAD:-PAD, PAD:-PAD] > 0 for inside in region.exemplar.within]
    colours = (region.exemplar.colours[0], *region.exemplar.finer)
    for i in range(rect.height):
        for j in range(rect.width):
            y, x = rect.y0 + i, rect.x0 + j
            name = int(show.sources(region, Rect.at(x >> k, y >> k, 1, 1))[0, 0])
            if name < 0:
                continue
            row, column = (name >> 16) - PAD, (name & 0xFFFF) - PAD
            for n in range(1, k + 1):
                odd = y >> (k - n) & 1, x >> (k - n) & 1
                around = [(2 * row + (odd[0] ^ (m >> 1)), 2 * column + (odd[1] ^ (m & 1))) for m in range(4)]
                height, width = regions[n].shape
                row, column = next(at for at in around if at[0] < height and at[1] < width and regions[n][at])
            out[:, i, j] = colours[k][row, column]
    return snapped(out)


def test_zooming_in_shows_what_lies_below_the_sources():
    pixels, mask = blob(63)
    grown = refined(dabbed(empty(shrunk(analysed(pixels, mask), 2), 1), 0, 0, 9))
    for k, rect in ((0, Rect.at(-9, -9, 18, 17)), (1, Rect.at(-21, -19, 37, 34)), (2, Rect.at(-31, -33, 50, 41))):
        found = show.finer(grown, k, rect)
        assert np.array_equal(found, plain_finer(grown, k, rect))
        there = show.sources(grown, rect.zoomed(-k)) >= 0
        y, x = np.mgrid[rect.y0 : rect.y1, rect.x0 : rect.x1] >> k
        place = rect.zoomed(-k)
        assert not found[:, ~there[y - place.y0, x - place.x0]].any()
        assert found[3, there[y - place.y0, x - place.x0]].min() > 0


def test_the_detail_is_the_examples_own():
    """Where the region is one piece of the example, zooming in gives its pixels."""
    exemplar = unbounded(64)
    small = shrunk(exemplar, 1)
    grown = refined(painted(empty(small, 2), Rect.at(0, 0, 64, 64), np.ones((64, 64), bool)))
    found = show.finer(grown, 1, Rect.at(0, 0, 128, 128))
    names = show.sources(grown, Rect.at(0, 0, 64, 64))
    own = snapped(exemplar.colours[0])
    y, x = 2 * ((names >> 16) - PAD), 2 * ((names & 0xFFFF) - PAD)
    for dy in range(2):
        for dx in range(2):
            assert np.array_equal(found[:, dy::2, dx::2], own[y + dy, x + dx].transpose(2, 0, 1))
