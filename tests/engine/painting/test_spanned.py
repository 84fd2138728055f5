"""What is kept of a record for undo where the commit that took its place knew what it changed."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from stepped import contents, records, stroke

from engine.canvas.rising import span_values
from engine.canvas.rising.spans import within
from engine.canvas.store import Record, Since
from engine.canvas.tile_cache import TileCache
from engine.numeric.address import Rect
from engine.painting import commands as c
from engine.painting.value import Painting
from engine.session.coding import spanned as spanning
from engine.session.coding.coded_records import WAY, CodedData, decode, encode
from engine.session.coding.spanned import SpannedData, spanned
from engine.session.history import History
from engine.session.session import Session


def painted(count, radius=4.0, **more):
    """A session with some wide strokes and many small ones over them; what each state stored."""
    session = Session(Painting(Rect.at(0, 0, 96, 96), 7), TileCache(8 << 20), **more)
    states = []
    for n in range(3 + count):
        session.do(stroke(n, radius=60.0 if n < 3 else radius))
        states.append((session.painting, contents(session.painting)))
    return session, states


def held(painting, kind):
    """The records of a state that are held so."""
    return [record for record in records(painting) if isinstance(record.held, kind)]


@settings(deadline=None)
@given(st.integers(0, 2**32 - 1), st.sampled_from([np.int16, np.int32]))
def test_what_lies_in_spans_is_gathered_plainly_and_put_back_by_kernels_as_plainly(seed, kind):
    rng = np.random.default_rng(seed)
    planes, height, width, top, rows = (int(n) for n in rng.integers(1, [8, 20, 20, 6, 12]))
    data = rng.integers(-9, 9, (planes, height + top + rows, width)).astype(kind)
    spans = rng.integers(0, width + 1, (rows, 2)).astype(np.int32)
    spans[spans[:, 0] >= spans[:, 1]] = 0
    values = np.empty(planes * int((spans[:, 1] - spans[:, 0]).sum()), kind)
    span_values.gather(data, top, spans, values)
    plain = np.empty_like(values)
    span_values.gather.plain(data, top, spans, plain)
    assert np.array_equal(values, plain)
    assert np.array_equal(values, data[:, top : top + rows][:, within(spans, width)].reshape(-1))
    one, other = np.zeros_like(data), np.zeros_like(data)
    span_values.scatter(values, spans, one, top)
    span_values.scatter.plain(values, spans, other, top)
    assert np.array_equal(one, other)
    assert np.array_equal(one[:, top : top + rows][:, within(spans, width)].reshape(-1), values)


@settings(deadline=None)
@given(st.integers(0, 2**32 - 1), st.integers(-130, 130), st.integers(1, 128), st.integers(0, 2000))
def test_what_is_taken_is_what_lies_in_the_clipped_spans(seed, by, width, room):
    rng = np.random.default_rng(seed)
    told, data = rng.integers(0, 129, (9, 2)).astype(np.uint8), rng.integers(-9, 9, (4, 12, width)).astype(np.int16)
    (one, other), (values, plain) = np.zeros((2, 9, 2), np.uint8), np.zeros((2, room), np.int16)
    count = span_values.pick(data, 2, told, by, one, values)
    assert count == span_values.pick.plain(data, 2, told, by, other, plain)
    if count >= 0:
        assert np.array_equal(one, other)
        assert np.array_equal(values, plain)
        assert np.array_equal(values[:count], data[:, 2:11][:, within(one.astype(np.int32), width)].reshape(-1))
    else:
        columns = np.clip(told.astype(int) + by, 0, width)
        assert 4 * np.maximum(columns[:, 1] - columns[:, 0], 0).sum() > room


@settings(deadline=None)
@given(st.integers(0, 2**32 - 1), st.booleans())
def test_a_record_is_what_it_was_wherever_the_next_one_lies(seed, deflated):
    """The next one may be cropped to less, or cover more; it differs within the spans alone."""
    rng = np.random.default_rng(seed)
    whole = np.zeros((4, 128, 128), np.int16)
    y0, x0, y1, x1 = 10, 20, int(rng.integers(30, 110)), int(rng.integers(40, 120))
    whole[:, y0:y1, x0:x1] = rng.integers(-300, 300, (4, y1 - y0, x1 - x0))
    old = Record(Rect(x0, y0, x1, y1), whole[:, y0:y1, x0:x1].copy(), (), 1)
    at = Rect(*sorted(rng.integers(0, 64, 2).tolist()), 128, 100)
    spans = rng.integers(0, min(9, at.width) + 1, (at.height, 2)).astype(np.int32)
    after = whole.copy()
    for y, (first, last) in enumerate(spans):
        if first < last:
            after[:, at.y0 + y, at.x0 + first : at.x0 + last] += 7
    ys, xs = np.nonzero(after.any(axis=0))
    rect = Rect(int(xs.min()), int(ys.min()), int(xs.max()) + 1, int(ys.max()) + 1)
    cut = after[:, rect.y0 : rect.y1, rect.x0 : rect.x1].copy()
    new = Record(rect, cut, (), 2, Since.it(old, at, spans))
    wanted, coded = old.data.copy(), spanned(old, new)
    if coded is None:  # it is not worth it: never wrong
        return
    old.exchange(coded)
    if deflated:
        encode(old, new)
    assert np.array_equal(old.data, wanted)
    assert not old.data.flags.writeable


def test_a_small_stroke_keeps_for_undo_no_whole_tiles_and_every_state_is_what_it_was():
    session, states = painted(12)
    last = states[-2][0]
    small = held(last, SpannedData)
    assert sum(one.nbytes for one in small) < sum(one.plain_size for one in small) / 3
    assert sum(one.plain_size for one in small) > sum(one.plain_size for one in records(last)) / 3
    assert not held(session.painting, CodedData)
    for painting, wanted in states:
        assert contents(painting) == wanted
    while session.history.pending:
        session.history.step()
    assert [contents(painting) for painting, _ in states] == [wanted for _, wanted in states]


def test_no_way_to_a_record_is_longer_than_that_of_coded_ones():
    _, states = painted(5 * WAY)
    longest = 0
    for painting, _ in states:
        for record in records(painting):
            way = 0
            while isinstance(record.held, CodedData) and record.held.other is not None:
                record, way = record.held.other, way + 1
            longest = max(longest, way)
    assert longest == WAY - 1


def test_nothing_of_the_record_before_is_noted_once_it_was_counted():
    session, _ = painted(3)
    assert all(record.since is None for record in records(session.painting))


def test_a_replay_keeps_no_step_and_codes_none():
    _, states = painted(4, history=History(0))
    assert not any(held(painting, SpannedData) for painting, _ in states)


def test_what_another_layer_shares_stays_whole():
    session, _ = painted(1)
    session.do(c.DuplicateLayer("Layer 1", "Copy"))
    before = session.painting
    session.do(stroke(9, radius=4.0))
    assert not held(before, CodedData)


@pytest.mark.parametrize("deflated", [False, True])
def test_a_record_kept_so_is_made_plain_as_any_other(deflated):
    session, states = painted(6)
    record = held(states[-2][0], SpannedData)[0]
    wanted = record.data.copy()
    if deflated:
        assert encode(record, record.held.other) >= 0
    decode(record)
    assert isinstance(record.held, np.ndarray)
    assert np.array_equal(record.data, wanted)
    assert contents(session.painting) == states[-1][1]


def test_what_did_not_come_from_the_record_before_it_is_coded_as_ever():
    data = np.zeros((4, 8, 8), np.int16)
    one, other = (Record(Rect(0, 0, 8, 8), data, (), n) for n in (1, 2))
    assert spanning.spanned(one, other) is None
    other.came_from(Since.it(other, Rect(0, 0, 8, 8), np.zeros((8, 2))))
    assert spanning.spanned(one, other) is None
