"""Many inks of an old state are kept as far as the next commit changed them, and are what they were."""

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st
from stepped import contents, records, stroke

from engine.canvas.store import Record, Since
from engine.canvas.tile_cache import TileCache
from engine.numeric.address import Rect
from engine.painting.value import Painting
from engine.session.coding.coded_records import decode, encode
from engine.session.coding.sheets_within import SheetsWithin, sheets_within
from engine.session.session import Session
from engine.texture.planes import COLOURS, merged
from engine.texture.sparse_planes import SparsePlanes
from engine.texture.table import instance

INKS = merged(tuple(instance("rock", {"period": 2 + n}, 0, 3) for n in range(9)))
SOME = st.lists(st.booleans(), min_size=9, max_size=9)


@settings(deadline=None)
@given(st.integers(0, 2**32 - 1), SOME, SOME, st.booleans(), st.sampled_from([300, 1 << 17]))
def test_sheets_are_what_they_were_whichever_inks_come_and_go(seed, there, stay, deflated, most):
    rng = np.random.default_rng(seed)
    data = np.zeros((COLOURS + 3 * len(INKS), 60, 90), np.int32)
    data[:COLOURS] = 1
    for n, one in enumerate(there):
        data[COLOURS + 3 * n : COLOURS + 3 * n + 3] = rng.integers(-most, most, (3, 60, 90)) if one else 0
    sheets, at = SparsePlanes.of(Rect(5, 7, 95, 67), data, INKS), Rect.at(*rng.integers(10, 40, 2).tolist(), 20, 9)
    before = sheets.over(at, INKS, np.int32)
    after = before.copy()
    for n, one in enumerate(stay):  # an ink that lay nowhere may come in the part, one may go there
        after[COLOURS + 3 * n : COLOURS + 3 * n + 3] = rng.integers(-9, 9, (3, 9, 20)) if one else 0
    new = sheets.replaced(at, after, INKS, before)
    old = Record(sheets.rect, sheets, tuple(sheets.inks), 1)
    spans = np.tile(np.array([0, at.width]), (at.height, 1))
    other = Record(new.rect, new, tuple(new.inks), 2, Since.it(old, at, spans))
    wanted, coded = old.data.copy(), sheets_within(old, other)
    if coded is None:  # it is not worth it
        return
    assert coded.nbytes < sheets.alone(new)
    old.exchange(coded)
    if deflated:
        encode(old, other)
    found = old.sheets
    assert (found.rect, tuple(found.inks), found.kind) == (sheets.rect, tuple(sheets.inks), sheets.kind)
    assert old.data.dtype == wanted.dtype
    assert np.array_equal(old.data, wanted)
    for one, same in [(found.colours, sheets.colours), *((found.inks[ink], sheets.inks[ink]) for ink in sheets.inks)]:
        assert (one.rect, one.most, one.data.dtype) == (same.rect, same.most, same.data.dtype)
    decode(old)
    assert isinstance(old.held, SparsePlanes)
    assert np.array_equal(old.data, wanted)


def test_a_small_stroke_over_many_inks_keeps_for_undo_what_it_changed():
    session, states = Session(Painting(Rect.at(0, 0, 96, 96), 7), TileCache(8 << 20)), []
    for n in range(16):
        ink = [{"texture": "rock", "colour": "#ffffff", "period": 8 + n % 10}]
        session.do(stroke(n, radius=60.0 if n < 10 else 4.0, ink=ink))
        states.append((session.painting, contents(session.painting)))
    small = [record for record in records(states[-2][0]) if isinstance(record.held, SheetsWithin)]
    assert small
    assert sum(record.nbytes for record in small) < sum(record.plain_size for record in small) / 3
    for painting, wanted in states:
        assert contents(painting) == wanted
    while session.history.pending:
        session.history.step()
    assert [contents(painting) for painting, _ in states] == [wanted for _, wanted in states]
