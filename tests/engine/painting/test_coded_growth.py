"""Old steps of what was painted with examples, coded and put away on disk: every state is what it was, bit for bit."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from plantings import fresh, meadow, stroke

from engine.canvas import growth as growths
from engine.canvas import layers
from engine.keeping.spill import Spill, Spilled
from engine.painting import commands as c
from engine.painting.grown import settled
from engine.session.apply import Refusal
from engine.session.coding import coded_records
from engine.session.coding.coded_tiles import CodedTile, decode_tile, encode_tile
from engine.session.differing import difference
from engine.session.line import STEP_OVERHEAD
from engine.session.paging import Paging
from engine.texture.example.tiles import sealed

__all__ = ["meadow"]

ACTS = st.one_of(
    st.builds(
        lambda x, y, seed, example: stroke([[x, y], [x + 9, y]], seed=seed, example=example, radius=7),
        st.integers(0, 90),
        st.integers(0, 70),
        st.sampled_from([None, 3]),
        st.sampled_from("ab"),
    ),
    st.builds(lambda x: stroke([[x, 30]], mode="erase", radius=5), st.integers(0, 90)),
    st.integers(1, 5).map(c.Undo),
    st.integers(1, 5).map(c.Redo),
    st.just(c.DuplicateLayer("Layer 1", "Copy")),
    st.sampled_from(["code", "rest", "refine"]),
)


@pytest.fixture(scope="module", autouse=True)
def disk(tmp_path_factory):
    spill = Spill(tmp_path_factory.mktemp("spill"))
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(coded_records, "spill", lambda: spill)
        yield spill
    spill.close()


def shown(painting):
    """All tiles of what is grown, by where they lie."""
    return [
        (layer.id, plot.order, n, m, sorted((key, tile.data.tobytes()) for key, tile in part.items()))
        for layer in layers.layers(painting.root)
        for plot in layer.growth
        for n, maps in enumerate((plot.shown, plot.region.masks, [held.sources for held in plot.region.levels]))
        for m, part in enumerate(maps)
    ]


def code_all(history):
    for line in (history._done, history._undone):
        while line.plain:
            line.code()
        while line.in_memory:
            line.put_away()


def rest(session):
    while session.history.pending:
        session.history.step()


def do(session, act):
    if act == "code":
        code_all(session.history)
    elif act == "rest":
        rest(session)
    elif act == "refine":
        session.amend(settled(session.painting))
    else:
        try:
            session.do(act)
        except Refusal:
            return


@settings(deadline=None, max_examples=5)
@given(acts=st.lists(ACTS, min_size=4, max_size=12))
def test_states_with_examples_are_what_they_were(meadow, acts):
    session, held = fresh(meadow), {}
    for act in (stroke([[20, 30], [60, 40]]), "refine", *acts):
        do(session, act)
        held[id(session.painting)] = session.painting, shown(session.painting)
    code_all(session.history)
    for painting, wanted in held.values():
        assert shown(painting) == wanted
    for entry in list(session.history._done.entries)[: session.history._done._coded]:
        assert entry.held - STEP_OVERHEAD == difference(entry.step.before.root, entry.step.after.root)[0]
    for step in (c.Undo(1), c.Redo(1)):
        for _ in range(16):
            do(session, step)
            known = held.get(id(session.painting))
            assert known is None or shown(session.painting) == known[1]


def test_old_steps_take_a_part_of_the_memory_and_come_back_plain(meadow):
    session = fresh(meadow)
    for n in range(4):
        do(session, stroke([[20 * n, 30], [20 * n + 20, 40]]))
        do(session, "refine")
    session.do(c.AddLayer("Above"))
    first = session.history.steps.done[1].before
    before, state = session.history.held, shown(first)
    own = growths.tiles_of(first.root.children[0].growth) - growths.tiles_of(session.painting.root.children[0].growth)
    code_all(session.history)
    assert session.history.held < 0.3 * before
    assert own
    assert any(isinstance(tile.held, CodedTile) and isinstance(tile.held.packed, Spilled) for tile in own)
    now = growths.tiles_of(session.painting.root.children[0].growth)
    assert all(isinstance(tile.held, np.ndarray) for tile in now)
    session.do(c.Undo(4))
    assert session.painting.root is first.root
    rest(session)
    here = growths.tiles_of(first.root.children[0].growth)
    assert all(isinstance(tile.held, np.ndarray) for tile in here)
    assert shown(first) == state


def test_what_is_painted_with_examples_is_paged_and_goes_on_as_it_would_have(meadow):
    plain, paged = fresh(meadow), fresh(meadow)
    for act in (stroke([[20, 30], [60, 40]]), "refine", "page", stroke([[30, 30], [60, 60]]), "refine"):
        for session in (plain, paged):
            if act == "page" and session is paged:
                pages = Paging()
                pages.want(paged.painting.root, 0, 1 << 40)
                while pages.wanted:
                    pages.step()
                grown = growths.tiles_of(paged.painting.root.children[0].growth)
                assert sum(tile.nbytes for tile in grown) < 0.3 * sum(tile.data.nbytes for tile in grown)
            elif act != "page":
                do(session, act)
    assert shown(paged.painting) == shown(plain.painting)


@pytest.mark.parametrize("dtype", [np.uint8, np.int32, np.float32])
def test_a_tile_is_the_same_to_the_bit(dtype):
    planes = np.zeros((4, 64, 64), dtype)
    planes[1, 3:9, 5:60] = 1
    planes[2] = np.arange(64)
    if dtype is np.float32:
        planes[3] = np.arange(64) / np.float32(65536.0)
        for odd in (planes, planes / 3, -planes):  # beside the grid, and with zeros that have signs
            there_and_back(odd.astype(dtype))
    there_and_back(planes)


def there_and_back(planes):
    tile = sealed(planes.copy())
    assert encode_tile(tile) > 0
    assert encode_tile(tile) == 0
    assert isinstance(tile.held, CodedTile)
    assert tile.data.dtype == planes.dtype
    assert tile.data.tobytes() == planes.tobytes()
    assert not tile.data.flags.writeable
    decode_tile(tile)
    assert tile.data.tobytes() == planes.tobytes()
