"""Regions of like colour against plain counting: `scipy.ndimage` labels and grows them."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy import ndimage

from engine.numeric import flood
from engine.numeric.address import Rect
from engine.numeric.flood import Likeness, region

SEEDS = st.integers(0, 2**32 - 1)
CROSS = ndimage.generate_binary_structure(2, 1)


def blotches(seed, height, width, lines=0.4):
    """A picture of a few colours with soft rims, most of it free."""
    rng = np.random.default_rng(seed)
    rough = ndimage.gaussian_filter(rng.random((height, width)), rng.uniform(0.5, 2.5))
    line = (np.abs(rough - np.median(rough)) / (np.ptp(rough) + 1e-9) < 0.5 * lines * rng.random()).astype(np.float32)
    out = np.zeros((4, height, width), np.float32)
    out[3] = ndimage.uniform_filter(line, 3) if rng.random() < 0.7 else line
    out[0] = out[3] * np.float32(rng.random())
    return out


def unlike(picture, x, y):
    return np.abs(picture - picture[:, y, x][:, None, None]).max(axis=0)


def plain_own(picture, x, y, likeness):
    """The pixels inside, as the module's text tells it."""
    free = unlike(picture, x, y) <= np.float32(likeness.tolerance)
    if not likeness.contiguous:
        return free
    parts, _ = ndimage.label(free)
    if not likeness.gap:
        return parts == parts[y, x]
    reach = (likeness.gap + 1) // 2
    core = ndimage.minimum_filter(free.astype(np.uint8), 2 * reach + 1, mode="constant", cval=1) > 0
    from_seed = steps_within(free, np.arange(free.size).reshape(free.shape) == y * free.shape[1] + x)
    cores, _ = ndimage.label(core)
    reached = core & (from_seed >= 0)
    if not reached.any():
        return parts == parts[y, x]
    nearest = from_seed[reached].min()
    names = set(cores[reached & (from_seed == nearest)].tolist())
    assume_one(names)
    own = cores == names.pop()
    ours, others = steps_within(free, own), steps_within(free, core & ~own)
    return (ours >= 0) & (ours <= 2 * reach) & ((others < 0) | (ours <= others))


class Ambiguous(Exception):
    pass


def assume_one(names):
    if len(names) > 1:
        raise Ambiguous


def steps_within(free, start):
    """How many steps each free pixel is away from some; -1 where they cannot be reached."""
    out, there = np.where(start & free, 0, -1), start & free
    for step in range(1, free.size):
        more = ndimage.binary_dilation(there, CROSS, mask=free)
        if (more == there).all():
            break
        out[more & ~there], there = step, more
    return out


def parts_of(far):
    """How far each pixel of a line is covered, as `_part` tells it."""
    most = ndimage.maximum_filter(far, 5, mode="constant")
    left = most - far
    with np.errstate(divide="ignore", invalid="ignore"):
        part = np.where(left > np.float32(1 / 16) * most, np.float32(1) - np.float32(1 / 16) * most / left, 0)
    return part.astype(np.float32)


def ringed(picture, x, y, own, tolerance):
    """What is covered, as `_cover` tells it."""
    far = unlike(picture, x, y)
    part = parts_of(far)
    free = far <= np.float32(tolerance)
    out = own.astype(np.float32)
    height, width = own.shape
    ring = ndimage.binary_dilation(own, np.ones((3, 3))) & ~own
    out[ring] = np.where(free[ring], np.float32(0.5), np.maximum(part[ring], np.float32(0.5)))
    for _ in range(flood.RINGS - 1):
        more = np.zeros_like(own)
        for v, u in zip(*np.nonzero(ring), strict=True):
            for j in range(max(v - 1, 0), min(v + 2, height)):
                for i in range(max(u - 1, 0), min(u + 2, width)):
                    more[j, i] |= out[j, i] == 0 and not free[j, i] and far[j, i] > far[v, u] and part[j, i] > 0
        out[more], ring = part[more], more
    return out


@given(
    SEEDS, st.integers(3, 40), st.integers(3, 40), st.sampled_from([0.0, 0.1, 0.3]), st.integers(0, 9), st.booleans()
)
@settings(deadline=None, max_examples=120)
def test_a_region_is_what_plain_counting_finds(seed, height, width, tolerance, gap, contiguous):
    picture = blotches(seed, height, width)
    rng = np.random.default_rng(seed + 1)
    x, y = int(rng.integers(width)), int(rng.integers(height))
    likeness = Likeness(tolerance, gap, contiguous)
    try:
        own = plain_own(picture, x, y, likeness)
    except Ambiguous:  # two cores are as near as one another: either may be it
        return
    found = region(picture, x, y, likeness)
    np.testing.assert_array_equal(found.covered, ringed(picture, x, y, own, tolerance))
    assert found.open == bool(own[0].any() or own[-1].any() or own[:, 0].any() or own[:, -1].any())
    rows, columns = np.nonzero(found.covered)
    assert found.rect == Rect(columns.min(), rows.min(), columns.max() + 1, rows.max() + 1)
    assert found.covered[y, x] == 1 or gap


def ring_with_a_gap(gap, size=161, radius=60, width=3.0):
    """A soft ring, alpha alone, with an opening at its right."""
    y, x = np.mgrid[:size, :size] - size // 2
    out = np.zeros((4, size, size), np.float32)
    out[3] = np.clip(width - np.abs(np.hypot(x, y) - radius), 0, 1)
    out[3][(x > 0) & (np.abs(y) * 2 < gap)] = 0
    return out


@pytest.mark.parametrize("gap", [0, 3, 8, 15])
def test_a_gap_is_closed_from_its_width_on_and_the_fill_stops_in_it(gap):
    picture = ring_with_a_gap(gap)
    leaking = region(picture, 80, 80, Likeness())
    assert leaking.open == (gap > 0)
    held = region(picture, 80, 80, Likeness(gap=gap + 1))
    assert not held.open
    assert held.covered[:, 80 + 60 + 4 :].max() == 0
    inside = np.hypot(*(np.mgrid[:161, :161] - 80)) < 56
    assert held.covered[inside].min() == 1


@given(st.floats(40, 64), st.floats(1.2, 5), st.floats(0.5, 4), st.sampled_from([0.0, 0.2, 0.5, 0.9]))
@settings(deadline=None, max_examples=40)
def test_no_halo_stays_along_a_soft_line(radius, width, softness, grey):
    """A black line on white paper, and a fill over it: going outwards, nowhere is lighter than both but for little."""
    size = 161
    y, x = np.mgrid[:size, :size] - size // 2
    line = np.clip((width - np.abs(np.hypot(x, y) - radius)) / softness, 0, 1)
    if line.max() < 1:
        return
    picture = np.zeros((4, size, size), np.float32)
    picture[3] = line
    found = region(picture, 80, 80, Likeness())
    covered = found.covered
    shown = 1 - (covered * (1 - grey) + (1 - covered) * line)  # of white, less what fill and line take
    inside = np.hypot(x, y) < radius
    assert shown[inside].max() <= grey + 0.2
    assert covered[line == 1].max(initial=0) <= 0.5


def test_a_region_without_bounds_reaches_the_border():
    assert region(np.zeros((4, 7, 9), np.float32), 3, 3, Likeness()).open
    assert region(np.zeros((4, 7, 9), np.float32), 3, 3, Likeness(gap=6)).open
