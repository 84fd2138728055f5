"""Stacks of many inks: which planes of one are those of another, and what is left out of them."""

from dataclasses import replace

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from engine.canvas.tile_cache import without_empty_inks
from engine.numeric.address import Rect
from engine.texture.planes import COLOURS, Planes, merged, plane_map, sort_key, widened
from engine.texture.sparse_planes import SparsePlanes
from engine.texture.table import instance

ALL = merged(tuple(instance("rock", {"period": 2 + n}, 0, 3) for n in range(150)))
STACKS = st.lists(st.lists(st.sampled_from(range(len(ALL))), unique=True, max_size=90), min_size=1, max_size=4)


def stack(numbers, copied=False):
    """The inks of some numbers; `copied`: equal ones, but other objects."""
    return tuple(replace(ALL[n]) if copied else ALL[n] for n in sorted(numbers))


@settings(max_examples=60, deadline=None)
@given(STACKS, st.booleans())
def test_stacks_are_merged_in_order_and_each_plane_is_found(lists, copied):
    stacks = [stack(numbers, copied and i % 2 == 1) for i, numbers in enumerate(lists)]
    whole = merged(*stacks)
    assert list(whole) == sorted(set().union(*stacks), key=lambda ink: sort_key(ink.key))
    for some in (*stacks, stack(lists[0], copied=True)):
        for one, other in ((some, whole), (whole, some)):
            found = plane_map(one, other).tolist()
            assert found[:COLOURS] == list(range(COLOURS))
            at = [one.index(ink) if ink in one else -1 for ink in other]
            expected = [COLOURS + 3 * i + c if i >= 0 else -1 for i in at for c in range(3)]
            assert found[COLOURS:] == expected
        planes = Planes(np.arange(2 * (4 + 3 * len(some)), dtype=np.float32).reshape(-1, 1, 2), some)
        wide = widened(planes, whole)
        narrow = plane_map(whole, some)
        assert wide.inks == whole
        assert np.array_equal(wide.data[narrow], planes.data)
        assert wide.data.sum() == planes.data.sum()


@settings(max_examples=40, deadline=None)
@given(st.sets(st.integers(-1, len(ALL) - 1), max_size=6), st.integers(1, len(ALL)))
def test_inks_that_are_nowhere_are_left_out_of_many(filled, count):
    """-1: the colour."""
    filled = {n for n in filled if n < count}
    data = np.zeros((COLOURS + 3 * count, 3, 5), np.float32)
    for n in filled:
        data[COLOURS + 3 * n + n % 3 if n >= 0 else 1, 2, 4] = -1.0
    found = without_empty_inks(Planes(data, ALL[:count]))
    if not filled:
        assert found is None
        return
    assert found is not None
    assert found.inks == stack(filled - {-1})
    assert np.array_equal(widened(found, ALL[:count]).data, data)


@settings(max_examples=40, deadline=None)
@given(st.integers(0, 1 << 32))
def test_what_is_put_into_sparse_planes_is_what_is_put_into_full_ones(seed):
    rng = np.random.default_rng(seed)
    whole = Rect(0, 0, 24, 20)
    full = np.zeros((COLOURS + 3 * len(ALL), whole.height, whole.width), np.int32)
    sparse = None
    for _ in range(6):
        x, y = rng.integers(0, 16, 2)
        rect = Rect(int(x), int(y), int(x) + int(rng.integers(1, 8)), int(y) + int(rng.integers(1, 4)))
        new = stack(rng.choice(len(ALL), 5, replace=False).tolist())
        inks = new if sparse is None else merged(new, sparse.within(rect))
        places = plane_map(ALL, inks)
        data = rng.integers(-70000, 70000, (len(places), rect.height, rect.width)) * (
            rng.random((len(places), 1, 1)) < 0.6
        )
        before = full[places][:, *rect.slices(whole)]
        full[places[:, None, None], np.arange(rect.y0, rect.y1)[:, None], np.arange(rect.x0, rect.x1)] = data
        sparse = (
            SparsePlanes.of(rect, data.astype(np.int32), inks)
            if sparse is None
            else sparse.replaced(rect, data.astype(np.int32), inks, before)
        )
        if sparse is None:
            assert not full.any()
            continue
        assert list(sparse.inks) == sorted(sparse.inks, key=lambda ink: sort_key(ink.key))
        assert np.array_equal(sparse.over(whole, ALL, np.int32), full)
        view = Rect(int(x) - 3, 2, int(x) + 4, 9).intersect(whole)
        shown = sparse.within(view)
        assert set(shown) == {ink for ink, sheet in sparse.inks.items() if sheet.rect.meets(view)}
        assert np.array_equal(sparse.over(view, shown, np.int32)[:4], full[:4, *view.slices(whole)])
