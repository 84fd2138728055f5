"""Where tiles lie, by blocks: found as by going through all of them."""

import itertools
import sys

import immutables
import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from strokes import fill

from engine.canvas import store
from engine.canvas.attenuate import fold
from engine.canvas.commit import commit
from engine.canvas.rising.tile_blocks import Blocks
from engine.canvas.store import Pyramid
from engine.numeric.address import Rect
from engine.session import differing

PLACES = st.frozensets(st.tuples(st.integers(-80, 80), st.integers(-80, 80) | st.just(1 << 70)), max_size=40)


CORNERS = st.tuples(st.integers(-100, 100), st.integers(-100, 100), st.integers(0, 90), st.integers(0, 1 << 71))


@given(PLACES, PLACES, CORNERS)
def test_tiles_within_a_rectangle_are_those_that_lie_there(one, other, corner):
    before, after = (immutables.Map(dict.fromkeys(places)) for places in (one, other))
    blocks = Blocks.of(before).after(after, one | other)
    assert blocks.blocks == Blocks.of(after).blocks
    assert blocks.stored is after
    x, y, width, height = corner
    wanted = {(px, py) for px, py in other if x <= px < x + width and y <= py < y + height}
    found = list(blocks.within(Rect.at(x, y, width, height)))
    assert set(found) == wanted
    assert len(found) == len(wanted)


def test_a_full_block_takes_few_bytes_in_each_state_of_the_history():
    full = Blocks.of(immutables.Map(dict.fromkeys(itertools.product(range(-32, 0), range(32)))))
    assert [sys.getsizeof(held) < 200 for held in full.blocks.values()] == [True]


def painted():
    """Detail here and there, and strokes over it at coarser levels: the states that they made."""
    random, pyramid = np.random.default_rng(3), Pyramid()
    states = [pyramid]
    for n in range(6):
        pyramid = commit(pyramid, fill(3, 900 * n, -700 * n, 20, 20, alpha=0.5))
        states.append(pyramid)
    for n in range(36):  # more than may wait: the first are folded into finer records
        x, y = (int(v) << 1 for v in random.integers((-20, -300), (300, 20)))
        pyramid = commit(pyramid, fill(1, x, y, 60, 60, alpha=0.02 if n % 6 else 1.0))
        states.append(pyramid)
    return states


def told(states):
    """What is found by places, plainly comparable."""
    rects = [Rect(0, -4000, 12000, 100), Rect(-50, -50, 4000, 20), Rect(5000, -9000, 70000, -100)]
    held = [
        sorted((key, record.rect, record.data.tobytes()) for key, record in states[-1].records(level, rect))
        for level in states[-1].levels
        for rect in rects
    ]
    has = [state.has_records(level, rect) for state in states for level in state.levels for rect in rects]
    apart = [
        sorted(key for key, _, _ in differing.placed_apart(one, other)) for one, other in itertools.pairwise(states)
    ]
    return held, has, apart


def test_what_blocks_tell_is_what_going_through_all_tells(monkeypatch):
    states = painted()
    plain = told(states)
    assert not states[-1].known
    monkeypatch.setattr(store, "_FEW", 0)
    monkeypatch.setattr(differing, "_FEW", 0)
    states = painted()
    newest, folded = states[-1], fold(states[-1])
    assert set(newest.known) == set(newest.levels)
    for state in (newest, folded):  # whoever asks next goes through no level anew
        assert all(blocks.stored is state.levels[level] for level, blocks in state.known.items())
        assert all(blocks.blocks == Blocks.of(state.levels[level]).blocks for level, blocks in state.known.items())
    assert folded.levels is not newest.levels
    assert told(states) == plain
