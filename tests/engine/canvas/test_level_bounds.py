"""Where the tiles of many levels lie, by bands of levels: found as by going through all levels."""

import itertools

import immutables
import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from strokes import fill

from engine.canvas import store
from engine.canvas.attenuate import fold
from engine.canvas.commit import commit
from engine.canvas.rising.level_bounds import LevelBounds, LevelTiles
from engine.canvas.store import Pyramid, changes_between
from engine.numeric.address import TILE, Rect
from engine.session import differing

PLACES = st.frozensets(st.tuples(st.integers(-9, 9), st.integers(-9, 1 << 70)), min_size=1, max_size=4)
LEVELS = st.dictionaries(st.integers(-100, 100) | st.integers(-5000, 5000), PLACES, max_size=12)


@given(LEVELS, LEVELS, st.integers(-110, 110), st.tuples(*[st.integers(-2000, 2000)] * 2), st.integers(1, 3000))
def test_levels_with_tiles_in_a_rectangle_are_among_those_that_are_told(one, other, level, corner, side):
    written = {k: one.get(k, frozenset()) | other.get(k, frozenset()) for k in one | other}
    before, after = (immutables.Map({k: dict.fromkeys(at) for k, at in held.items()}) for held in (one, written))
    bounds = LevelBounds.of(before).after(after, [LevelTiles(k, held) for k, held in other.items()])
    assert bounds.bands == LevelBounds.of(after).bands
    assert bounds.coarsest == min(written, default=None)
    rect = Rect.at(*corner, side, side)
    told = list(bounds.finer(level, rect))
    tiles = ((k, Rect.at(x * TILE, y * TILE, TILE, TILE)) for k, held in written.items() for x, y in held)
    assert {k for k, tile in tiles if k > level and tile.meets(rect.zoomed(k - level))} <= set(told)
    assert all(k > level and k in written for k in told)
    assert len(told) == len(set(told))


def painted():
    """Strokes at levels far apart, over one another or not, more than may wait: the states that they made."""
    random, states = np.random.default_rng(5), [Pyramid()]
    for n in range(40):
        level = int(random.integers(0, 30))
        x, y = (((700 << 30) >> (30 - level)) + int(v) for v in random.integers(-40, 40, 2))
        states.append(commit(states[-1], fill(level, x, y, 30, 30, alpha=0.5 if n % 5 else 1.0)))
    return states


def told(states):
    """What is found by levels, plainly comparable."""
    ends = [(state.coarsest, state.waits and state.waits.change.depth, state.settled) for state in states]
    held = [(key, record.rect, record.data.tobytes()) for key, record in fold(states[-1]).all_records()]
    apart = [
        sorted(key for key, _, _ in differing.placed_apart(one, other)) for one, other in itertools.pairwise(states)
    ]
    return ends, held, apart


def test_what_bounds_tell_is_what_going_through_all_levels_tells(monkeypatch):
    states = painted()
    plain = told(states)
    assert states[-1].bounds_known is None
    assert states[-1].settled > 0
    monkeypatch.setattr(store, "MANY_LEVELS", 0)
    states = painted()
    for state in states[1:]:  # whoever asks next goes through no level anew
        assert state.bounds_known.levels is state.levels
    assert told(states) == plain


def test_states_differ_at_no_other_levels_than_are_looked_at():
    states = painted()
    for one, other in itertools.combinations(states[::3], 2):
        changes = list(changes_between(one.last, other.last))
        levels = {k for k in {*one.levels, *other.levels} if one.levels.get(k) is not other.levels.get(k)}
        folded = differing._folded_between(one, other)
        assert changes
        assert levels <= set(differing._levels_apart(one, other, folded))
        found = {key for key, _, _ in differing.placed_apart(one, other)}
        for k in levels:
            here, there = (state.levels.get(k, {}) for state in (one, other))
            wanted = {place for place in {*here, *there} if here.get(place) is not there.get(place)}
            assert {(key.x, key.y) for key in found if key.level == k} == wanted
