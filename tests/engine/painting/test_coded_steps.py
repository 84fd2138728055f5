"""Old steps, coded: every state that undo comes to is what it was, bit for bit, whoever holds it."""

from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from stepped import ROCK, contents, records, stroke

from engine.canvas import layers
from engine.canvas.store import Record
from engine.canvas.tile_cache import TileCache
from engine.keeping.spill import Spill
from engine.numeric.address import TILE, Rect
from engine.painting import commands as c
from engine.painting.value import Painting
from engine.session import history as histories
from engine.session import line as lines
from engine.session.coding import coded_records
from engine.session.coding.byte_planes import joined_bytes, split_bytes
from engine.session.coding.coded_records import (
    WAY,
    CodedData,
    CodedSheets,
    Ways,
    WholeSheets,
    decode,
    encode,
    put_away,
)
from engine.session.coding.sheets_within import SheetsWithin
from engine.session.coding.spanned import SpannedData
from engine.session.differing import apart_records, difference
from engine.session.history import History
from engine.session.line import STEP_OVERHEAD, StepLine
from engine.session.replay import replay
from engine.session.session import Session
from engine.studio import requests as q
from engine.studio.studio import Studio
from engine.texture.sparse_planes import SparsePlanes


def rest(history):
    """What is done of it while nothing else is to be done."""
    while history.pending:
        history.step()


def code_all(history):
    rest(history)
    for line in (history._done, history._undone):
        while line.plain:
            line.code()


def pieces(history, count):
    """Some of it, a record at a time."""
    while history._mixed:
        history.step()
    for _ in range(count):
        line = max(history._done, history._undone, key=lambda line: line.plain)
        if line.plain:
            line.code(1)


def way(record):
    """The records from whose data those of one are made."""
    out = []
    while isinstance(record.held, CodedData) and record.held.other is not None:
        record = record.held.other
        out.append(record)
    return out


def check_what_is_held(session):
    """What is coded is made of what the history holds; and what it holds is what it says."""
    history = session.history
    assert not any(way(record) for record in records(session.painting))
    states = [*(step.before for step in history.steps.done), session.painting]
    there = {record for state in states for record in records(state)}
    assert all(found in there for record in there for found in way(record))
    for line, far in ((history._done, "before"), (history._undone, "after")):
        for entry in list(line.entries)[: line._coded]:
            lost, gained = difference(entry.step.before.root, entry.step.after.root)
            assert entry.held - STEP_OVERHEAD == (lost if far == "before" else gained)
        assert line.held == sum(entry.held for entry in line.entries)


ACTS = st.one_of(
    st.builds(stroke, st.integers(0, 9), st.integers(-2, 2), st.sampled_from([2.0, 9.0]), st.sampled_from([(), ROCK])),
    st.integers(1, 6).map(c.Undo),
    st.integers(1, 6).map(c.Redo),
    st.sampled_from([c.AddLayer("Above"), c.DuplicateLayer("Layer 1", "Copy"), c.RemoveLayer("Layer 1")]),
    st.just(None),
    st.integers(1, 12),  # pieces of what is done while nothing else is to be done
)


def test_what_waits_to_be_made_plain_is_let_go_where_nobody_rests():
    """Records that were of the present once; those of steps that were forgotten were held for ever."""
    session = Session(Painting(Rect.at(0, 0, 96, 96), 7), TileCache(4 << 20))
    for n in range(8):
        session.do(stroke(n))
    code_all(session.history)
    session.do(c.Undo(6))
    assert session.history._mixed
    for n in range(4):
        session.do(stroke(n, radius=60.0))
    now = set(records(session.painting))
    assert all(record in now for _, record in session.history._mixed)


@settings(deadline=None, max_examples=15)
@given(st.lists(ACTS, min_size=4, max_size=24))
def test_whatever_is_done_coded_states_are_what_they_were(acts):
    session = Session(Painting(Rect.at(0, 0, 96, 96), 7), TileCache(4 << 20))
    held = {}
    for act in (stroke(0), stroke(1, ink=ROCK), *acts):
        if act is None:
            code_all(session.history)
            continue
        if isinstance(act, int):
            pieces(session.history, act)
            continue
        try:
            session.do(act)
        except Exception as error:  # a layer of that name is there already, or not
            assert "layer" in str(error)  # noqa: PT017
            continue
        held[id(session.painting.root)] = session.painting, contents(session.painting)
    code_all(session.history)
    for painting, wanted in held.values():
        assert contents(painting) == wanted
    session.do(c.Undo(99))
    session.do(c.Redo(99))
    for painting, wanted in held.values():
        assert contents(painting) == wanted
    rest(session.history)
    check_what_is_held(session)
    session.do(c.Undo(5))  # and at once, before what is coded was made plain
    session.do(stroke(3))
    session.do(c.Undo(3))
    session.do(stroke(4))
    code_all(session.history)
    check_what_is_held(session)


def test_a_small_stroke_over_paint_costs_a_tenth_and_undo_comes_to_the_first_step():
    session = Session(Painting(Rect.at(0, 0, 96, 96), 7), TileCache(16 << 20), history=History())
    for n in range(4):
        session.do(stroke(n, radius=60.0))
    before = session.history.held
    for n in range(40):
        session.do(stroke(n, radius=3.0))
    held, first = session.history.held - before, session.history.at(-44)
    states = [session.history.at(-n) for n in (1, 20, 40)]
    wanted = list(map(contents, states))
    steps = [(step.before.root, step.after.root) for step in session.history.steps.done[4:]]
    whole = sum(record.plain_size for far, near in steps for _, record, _ in apart_records(far, near))
    assert held < whole / 4, (held, whole)
    code_all(session.history)
    coded = session.history.held - before
    assert coded < whole / 8, (coded, whole)
    assert list(map(contents, states)) == wanted
    with ThreadPoolExecutor(4) as threads:  # as those that save and keep checkpoints do
        assert list(threads.map(contents, states)) == wanted
    held = session.history.held
    session.do(c.Undo(44))
    assert session.painting.root is first.root
    code_all(session.history)
    session.do(c.Redo(44))
    code_all(session.history)
    assert 0.8 * held < session.history.held < 1.02 * held  # the next one stays coded


@pytest.mark.parametrize("spread", [False, True])
def test_steps_over_many_inks_are_coded_too(spread):
    session = Session(Painting(Rect.at(0, 0, 96, 96), 7), TileCache(16 << 20), history=History())
    for n in range(12):  # some of which the last strokes do not meet
        ink = [{"texture": "rock", "colour": "#ffffff", "period": 8 + n}]
        session.do(stroke(n if spread else 0, radius=9.0, ink=ink))
    for n in range(24):
        session.do(stroke(n, radius=3.0, ink=[{"texture": "rock", "colour": "#ffffff", "period": 8 + n % 12}]))
    states = [session.history.at(-n) for n in range(1, 37)]
    wanted, sheets = list(map(contents, states)), [list(map(sparse, records(state))) for state in states]
    plain = session.history.held
    assert sum(sum(each) for each in sheets) > 100
    code_all(session.history)
    there = [record for state in states[1:] for record in lost(state, states[0])]
    assert session.history.held < plain / 1.2  # of which most steps kept what they changed alone
    assert not any(isinstance(record.held, SparsePlanes) for record in there)
    assert list(map(contents, states)) == wanted
    check_what_is_held(session)
    session.do(c.Undo(30))
    rest(session.history)
    assert [list(map(sparse, records(state))) for state in states] == sheets
    assert list(map(contents, states)) == wanted
    session.do(c.Redo(30))
    rest(session.history)
    check_what_is_held(session)
    assert list(map(contents, states)) == wanted
    for record in records(session.painting):
        encode(record, None)
    assert contents(session.painting) != wanted[0]
    session.cache.clear()
    session.do(stroke(5, radius=9.0))
    fresh = replay(session.recording())
    assert contents(session.painting) == contents(fresh.painting)


def sparse(record):
    return record.sheets is not None


def lost(old, new):
    there = set(records(new))
    return [record for record in records(old) if record not in there]


def test_a_long_way_makes_no_data_but_those_that_are_looked_at(monkeypatch):
    session = Session(Painting(Rect.at(0, 0, 96, 96), 7), TileCache(16 << 20), history=History())
    for n in range(60):
        session.do(stroke(n, radius=3.0))
    code_all(session.history)
    states = [step.before for step in session.history.steps.done]
    longest = max(len(way(record)) for state in states for record in records(state))
    assert WAY - 2 <= longest <= WAY
    made, plain = [], CodedData.made
    monkeypatch.setattr(CodedData, "made", lambda coded: (made.append(coded), plain(coded))[1])
    session.do(c.Undo(50))
    session.do(c.Redo(20))
    session.do(c.Undo(10))
    assert not made
    coded = [record for record in records(session.painting) if isinstance(record.held, CodedData)]
    assert coded
    wayside = [record for record in coded if way(record)]
    rest(session.history)
    assert all(isinstance(record.held, np.ndarray) for record in wayside)
    assert len(made) >= len(wayside) > 0


def test_a_step_codes_some_of_the_others_only_where_they_take_much_and_nobody_rests(monkeypatch):
    coded, plain = [], Ways.encode
    monkeypatch.setattr(Ways, "encode", lambda w, one, other: (coded.append(one.held.nbytes), plain(w, one, other))[1])
    session = Session(Painting(Rect.at(0, 0, 96, 96), 7), TileCache(16 << 20), history=History(3 << 19))
    some = 0
    for n in range(70):
        before = session.history.held
        coded.clear()
        session.do(stroke(n, radius=60.0 if n % 9 == 0 else 5.0))
        brought = session.history.steps.done[-1].lost
        share = max(2 * (brought + STEP_OVERHEAD), histories._AT_ONCE)
        assert sum(coded) <= share + max(coded, default=0) + 4000
        assert not coded or before + brought > 3 << 18
        some += len(coded)
    assert some
    assert session.history.undo_count == 70
    coded.clear()
    replayed = replay(session.recording())
    assert not coded
    assert contents(replayed.painting) == contents(session.painting)


def test_what_is_coded_at_a_time_is_little(monkeypatch):
    monkeypatch.setattr(histories, "_AT_ONCE", 1)
    session = Session(Painting(Rect.at(0, 0, 96, 96), 7), TileCache(16 << 20), history=History(256 << 20))
    for n in range(30):
        session.do(stroke(n))
    coded, plain = [], Ways.encode
    monkeypatch.setattr(Ways, "encode", lambda *given: (coded.append(given), plain(*given))[1])
    while session.history.pending:
        before = len(coded)
        session.history.step()
        assert len(coded) <= before + 1
    assert len(coded) > 30


def test_steps_are_coded_at_once_where_they_take_too_much():
    plain = Session(Painting(Rect.at(0, 0, 96, 96), 7), TileCache(16 << 20), history=History())
    tight = Session(plain.painting, TileCache(16 << 20), history=History(2 << 20))
    for n in range(60):
        plain.do(stroke(n, radius=60.0))
        tight.do(stroke(n, radius=60.0))
    assert plain.history.held > 2 * tight.history.held
    assert tight.history.undo_count == 60
    assert tight.history.held < (2 << 20) + tight.history.steps.done[-1].lost + STEP_OVERHEAD


def test_no_record_is_made_of_itself():
    session = Session(Painting(Rect.at(0, 0, 96, 96), 7), TileCache(4 << 20))
    for n in range(3):
        session.do(stroke(n, radius=30.0))
    states = [step.after for step in session.history.steps.done]
    one, two = (next(layers.layers(state.root)).pyramid.levels[0][0, 0] for state in states[:2])
    wanted = one.data.tobytes(), two.data.tobytes()
    assert encode(one, two) > 0
    assert encode(one, two) == 0
    assert encode(two, one) > 0
    assert (one.data.tobytes(), two.data.tobytes()) == wanted
    decode(one)
    assert isinstance(one.held, np.ndarray)
    assert two.data.tobytes() == wanted[1]


def test_what_is_kept_of_data_that_were_asked_for_is_bounded(monkeypatch):
    monkeypatch.setattr(coded_records, "_MADE", 1 << 20)
    session = Session(Painting(Rect.at(0, 0, 96, 96), 7), TileCache(4 << 20))
    for n in range(12):
        session.do(stroke(n, radius=30.0))
    code_all(session.history)
    for n in range(1, 12):
        contents(session.history.at(-n))
    assert coded_records.RECORDS_MADE.held <= 1 << 20


def test_old_steps_are_coded_beside_the_painting_and_forgotten_ones_are_played_anew(monkeypatch):
    monkeypatch.setattr(Spill, "put", lambda spill, piece, spare=False: None)
    studio = Studio(lambda result: None, lambda request: None)
    studio.do(q.New(Rect.at(0, 0, 96, 96)))
    session = studio.easel.session
    session._history = session.room.history = History(200_000, keep=2)
    states = [session.painting]
    for n in range(30):
        studio.do(q.Do(stroke(n, radius=2.0)))
        states.append(session.painting)
    while studio.step():
        pass
    assert session.history.pending == 0
    assert session.history.forgotten > 0
    for n in range(29, -1, -1):
        assert session.can_undo
        studio.do(q.Do(c.Undo()))
        while studio.step():
            pass
        mine, wanted = contents(session.painting), contents(states[n])
        assert [row[:4] + row[5:] for row in mine] == [row[:4] + row[5:] for row in wanted]
    assert not session.can_undo
    studio.close()


@given(st.sampled_from([np.int16, np.int32]), st.integers(0, 2**32 - 1))
def test_bytes_of_integers_are_told_apart_and_put_together(kind, seed):
    bounds = np.iinfo(kind)
    whole = np.random.default_rng(seed).integers(bounds.min, bounds.max, (3, 5, 7), kind, endpoint=True)
    values = whole[:, 1:4, 2:]
    apart = split_bytes(values)
    assert np.array_equal(apart, np.ascontiguousarray(values).view(np.uint8).reshape(-1, values.itemsize).T)
    together = joined_bytes(apart, values.dtype).reshape(values.shape)
    assert together.dtype == kind
    assert np.array_equal(together, values)


def test_layers_that_were_removed_are_coded_and_plain_again_when_they_are_back():
    session = Session(Painting(Rect.at(0, 0, 96, 96), 7), TileCache(16 << 20), history=History())
    session.do(c.AddLayer("Above"))
    for n in range(6):
        session.do(stroke(n, radius=30.0))
    before, held = contents(session.painting), records(session.painting)
    session.do(c.RemoveLayer("Above"))
    session.do(c.AddLayer("Other"))
    code_all(session.history)
    assert sum(record.held.nbytes for record in held) < sum(record.plain_size for record in held) / 2
    assert any(isinstance(record.held, CodedData) for record in held)
    check_what_is_held(session)
    session.do(c.Undo(2))
    assert contents(session.painting) == before
    rest(session.history)
    assert all(isinstance(record.held, np.ndarray) for record in records(session.painting))
    assert contents(session.painting) == before
    check_what_is_held(session)


def test_while_memory_is_tight_each_step_codes_old_ones_and_puts_them_away_though_nobody_rests(monkeypatch, tmp_path):
    spill = Spill(tmp_path)
    monkeypatch.setattr(coded_records, "spill", lambda: spill)
    monkeypatch.setattr(histories, "_TIGHT_AT_ONCE", 1 << 16)
    session = Session(Painting(Rect.at(0, 0, 96, 96), 7), TileCache(16 << 20), history=History(4 << 20))
    states, held = [], []
    for n in range(60):
        session.history.tight = n >= 30
        session.do(stroke(n))
        states.append((session.painting, contents(session.painting)))
        held.append(session.history.held)
    assert held[29] > 3 << 18
    assert held[-1] < (1 << 20) + 2 * max(step.lost for step in session.history.steps.done)
    assert spill.held
    assert session.history.undo_count == 60
    for painting, wanted in states:
        assert contents(painting) == wanted
    spill.close()


def test_one_step_does_not_code_thousands_that_hold_next_to_nothing(monkeypatch):
    monkeypatch.setattr(lines, "_PRESSED", 3)
    session = Session(Painting(Rect.at(0, 0, 96, 96), 7), TileCache(4 << 20))
    for n in range(6):
        session.do(stroke(n))
    line = StepLine(False, session.history.steps.done)
    plain = [line.plain]
    for _ in range(3):
        line.press(1 << 40, 0)
        plain.append(line.plain)
    assert plain == [5, 2, 0, 0]


@settings(deadline=None, max_examples=10)
@given(st.lists(ACTS, min_size=2, max_size=8))
def test_how_many_bytes_data_take_is_known_however_they_are_held(acts):
    session = Session(Painting(Rect.at(0, 0, 96, 96), 7), TileCache(4 << 20))
    many = [stroke(n, ink=[{"texture": "rock", "colour": "#ffffff", "period": 16 + n}]) for n in range(9)]
    for act in (*(act for act in acts if isinstance(act, c.Stroke | c.Undo)), *many):
        session.do(act)
    code_all(session.history)
    kinds = set()
    for state in (*(step.before for step in session.history.steps.done), session.painting):
        for record in records(state):
            size, itemsize = record.plain_size, record.held.itemsize
            assert (size, itemsize) == (record.data.nbytes, record.data.itemsize)
            kinds.add(type(record.held))
    assert (
        {np.ndarray, SparsePlanes, CodedData, CodedSheets, SpannedData, SheetsWithin}
        >= kinds
        >= {np.ndarray, CodedData}
    )


@pytest.mark.parametrize("part", [(0, 128, 0, 128), (127, 128, 127, 128), (3, 90, 100, 128), (0, 0, 0, 0)])
def test_what_is_coded_of_a_tile_is_the_same_wherever_it_lies(part):
    top, bottom, left, right = part
    data = np.zeros((4, TILE, TILE), np.int16)
    data[:, top:bottom, left:right] = 7
    record = Record(Rect(0, 0, TILE, TILE), data.copy(), (), 1)
    assert encode(record, None) > 0
    assert record.held is not data
    assert np.array_equal(record.data, data)


def test_very_many_inks_are_coded_sheet_by_sheet_and_nothing_over_all_of_their_rectangle(monkeypatch):
    def refused(*about):
        raise AssertionError(about)

    monkeypatch.setattr(coded_records, "_DENSE", 0)
    session = Session(Painting(Rect.at(0, 0, 96, 96), 7), TileCache(4 << 20))
    for n in range(14):
        session.do(stroke(n, ink=[{"texture": "rock", "colour": "#ffffff", "period": 16 + n}]))
    found = [record for record in records(session.painting) if isinstance(record.held, SparsePlanes)]
    before = [(record.held, record.data.tobytes(), record.data.dtype) for record in found]
    assert found
    with monkeypatch.context() as patch:
        patch.setattr(coded_records, "_sheets_over", refused)
        assert all(encode(record, None) > 0 for record in found)
        assert all(isinstance(record.held, WholeSheets) for record in found)
        assert sum(map(put_away, (record.held for record in found))) > 0
        made = [record.held.plain() for record in found]
    for record, (planes, data, dtype), again in zip(found, before, made, strict=True):
        assert (record.data.tobytes(), record.data.dtype) == (data, dtype)
        assert [sheet.rect for sheet in again.inks.values()] == [sheet.rect for sheet in planes.inks.values()]
        assert tuple(again.inks) == tuple(planes.inks) == record.inks
