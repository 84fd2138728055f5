"""Records made smaller and put away on disk: the painting is what it was, and goes on as it would have."""

from concurrent.futures import ThreadPoolExecutor
from functools import partial
from itertools import starmap

import numpy as np
import pytest
import stepped
from hypothesis import given, settings
from hypothesis import strategies as st
from stepped import ROCK, contents, records

from engine.archive.opening import open_painting
from engine.archive.saving import Snapshot, save
from engine.canvas import layers
from engine.canvas.rising import paged_level
from engine.canvas.tile_cache import TileCache
from engine.keeping import memory
from engine.keeping.spill import Spill
from engine.numeric.address import Rect
from engine.painting import commands as c
from engine.painting.value import Painting
from engine.session import paging
from engine.session import room as rooms
from engine.session.coding import coded_records, paged_records
from engine.session.coding.coded_records import CodedData, links_of
from engine.session.coding.made_again import made_held
from engine.session.coding.paged_records import put_page_away
from engine.session.differing import placed_records
from engine.session.paging import Paging
from engine.session.room import Room
from engine.session.session import Session
from engine.texture.expression.kept_squares import SQUARES

stroke = partial(stepped.stroke, radius=9.0)


@pytest.fixture(scope="module", autouse=True)
def disk(tmp_path_factory):
    spill = Spill(tmp_path_factory.mktemp("spill"))
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(coded_records, "spill", lambda: spill)
        patch.setattr(paged_records, "spill", lambda: spill)
        yield spill
    spill.close()


def begun():
    return Session(Painting(Rect.at(0, 0, 96, 96), 7), TileCache(1 << 20))


ACTS = st.one_of(
    st.builds(stroke, st.integers(0, 9), st.integers(-2, 2), ink=st.sampled_from([(), ROCK])),
    st.integers(1, 3).map(c.Undo),
    st.integers(1, 3).map(c.Redo),
    st.integers(0, 1 << 18),
)


@settings(deadline=None, max_examples=12)
@given(st.lists(ACTS, min_size=3, max_size=14), st.sampled_from([paged_level.MANY, 1]))
def test_whatever_is_paged_meanwhile_the_painting_is_the_same(acts, many):
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(paged_level, "MANY", many)
        patch.setattr(paging, "_OF_LATE", 1)
        paged_meanwhile(acts)


def paged_meanwhile(acts):
    plain, paged, pages = begun(), begun(), Paging()
    for act in (stroke(0), stroke(1, ink=ROCK), *acts, 1 << 20):
        if isinstance(act, int):
            if act == 1 << 20:
                pages = Paging()  # goes through all anew, also what was read since another painting came and went
            pages.want(paged.painting.root, 0, act)
            while pages.wanted > 0:
                pages.step(1 << 16)
            paged.cache.clear()
            continue
        plain.do(act)
        paged.do(act)
    wanted = contents(plain.painting)
    with ThreadPoolExecutor(3) as threads:  # as those that save do
        assert list(threads.map(contents, [paged.painting] * 3)) == [wanted] * 3
    assert all(isinstance(record.held, CodedData) or record.data.nbytes < 2048 for record in records(paged.painting))


def test_what_is_old_goes_first_and_at_last_to_disk(disk):
    session, paging = begun(), Paging()
    session.do(c.parse({"do": "stroke", "points": [[300, 300], [330, 330]]}))
    for n in range(36):
        session.do(stroke(n % 3))
    before, root = contents(session.painting), session.painting.root
    paging.want(root, None, 1)
    paging.step()
    coded = [record for record in records(session.painting) if isinstance(record.held, CodedData)]
    assert coded
    assert {record.depth for record in coded} == {1}
    held, away = sum(record.nbytes for record in records(session.painting)), disk.held
    paging.want(root, None, 1 << 30)
    paging.step(1 << 30)
    assert paging.wanted == 0
    assert sum(record.nbytes for record in records(session.painting)) < held / 4
    assert disk.held > away
    assert contents(session.painting) == before


def test_states_kept_aside_go_to_disk_before_anything_of_the_painting(disk):
    session = begun()
    for n in range(9):
        session.do(stroke(n % 3, ink=ROCK if n == 2 else ()))
    aside, before = session.painting, contents(session.painting)
    for n in range(9):
        session.do(stroke(n % 3))
    here, alone = records(session.painting), contents(session.painting)
    kept = {one for record in records(aside) for one in links_of(record)}.difference(here)
    whole = [record for record in kept if isinstance(record.held, np.ndarray) and record.data.nbytes >= 2048]
    assert whole
    away, freed = disk.held, list(starmap(paging._put_aside, placed_records(aside.root, session.painting.root)))
    assert disk.held > away
    assert sum(freed) > sum(record.data.nbytes for record in whole) // 4
    assert not any(isinstance(record.held, np.ndarray) for record in whole)
    assert not any(isinstance(record.held, CodedData) for record in here)
    pages = Paging()
    pages.want(session.painting.root, None, 1, [aside.root])
    pages.step()
    assert pages.wanted == 0
    assert contents(aside) == before
    assert contents(session.painting) == alone


def test_a_process_that_takes_too_much_pages_what_is_painted(monkeypatch):
    session = begun()
    for n in range(6):
        session.do(stroke(n))
    room, before = session.room, contents(session.painting)
    for number in range(3):  # of written textures, as strokes and views asked for them
        SQUARES.keep(number, np.zeros(1), 20 << 20)
    held = made_held()
    assert held >= 60 << 20
    assert all(isinstance(record.held, np.ndarray) for record in records(session.painting))
    monkeypatch.setattr(memory, "budget", lambda: 0)
    monkeypatch.setattr(memory, "PROGRAM", 0)
    room.keep_within(session.painting.root)
    assert made_held() <= held - (20 << 20)
    while room.pending:
        room.step()
    assert all(isinstance(record.held, CodedData) or record.data.nbytes < 2048 for record in records(session.painting))
    assert contents(session.painting) == before


def smallest(pages):
    return min(pages, key=lambda at_page: sum(record.nbytes for _, record in at_page[1].items()))


def test_records_of_levels_that_have_many_go_to_disk_by_pages(disk, monkeypatch, tmp_path):
    monkeypatch.setattr(paged_level, "MANY", 8)
    monkeypatch.setattr(paging, "_OF_LATE", 1)
    session, away = begun(), disk.held
    for n in range(12):
        session.do(c.parse({"do": "stroke", "points": [[300 * n, 10], [300 * n + 30, 30]], "brush": {"radius": 2}}))
        session.do(stroke(n, radius=2.0, ink=ROCK if n == 1 else ()))
    (layer,) = layers.layers(session.painting.root)
    level = layer.pyramid.levels[0]
    assert put_page_away(*smallest(level.pages.items()), 24) == 0  # its place on disk would take as much
    monkeypatch.setattr(paged_records, "_PAGE_OVERHEAD", 0)
    before, states = contents(session.painting), session.history.steps.done
    save(tmp_path / "here.ora", Snapshot(session.painting))
    pages = Paging()
    pages.want(session.painting.root, None, 1 << 30)
    pages.step(1 << 30)
    assert {record.depth for record in level.here()} == {24}
    assert disk.held > away
    with monkeypatch.context() as patch:
        patch.setattr(disk, "piece", None)  # what is counted is not read for that
        assert 0 < layer.pyramid.nbytes < sum(len(stored) for stored in layer.pyramid.levels.values()) * 1000
    assert contents(session.painting) == before
    assert contents(states[-1].after) == before
    pyramid = layer.pyramid
    found = {k: {ink for stack in pyramid.stacks(k) for ink in stack} for k in pyramid.levels}
    assert found == {k: {ink for record in pyramid.levels[k].values() for ink in record.inks} for k in pyramid.levels}
    assert any(found.values())
    save(tmp_path / "away.ora", Snapshot(session.painting))
    assert (tmp_path / "away.ora").read_bytes() == (tmp_path / "here.ora").read_bytes()
    assert contents(open_painting(tmp_path / "away.ora").painting, depth=False) == contents(session.painting, False)
    opened = open_painting(tmp_path / "away.ora").painting
    pages = Paging()
    pages.want(opened.root, None, 1 << 30)  # though nobody has painted on it
    pages.step(1 << 30)
    assert all(record.inks for record in next(layers.layers(opened.root)).pyramid.levels[0].here())
    assert contents(opened, depth=False) == contents(session.painting, False)
    session.do(c.parse({"do": "stroke", "points": [[10, 10], [40, 60]], "brush": {"mode": "erase", "radius": 9}}))
    after = contents(session.painting)
    session.do(c.Undo(1))
    assert contents(session.painting) == before
    session.do(c.Redo(1))
    assert contents(session.painting) == after


def test_what_was_looked_through_is_not_again_before_the_process_has_grown(monkeypatch):
    session, pages, looks = begun(), Paging(), []
    freed = paging._freed
    monkeypatch.setattr(paging, "_freed", lambda root, level, aside: looks.append(root) or freed(root, level, aside))

    def wants(size):
        pages.want(session.painting.root, None, size)
        while pages.wanted > 0:
            pages.step()
        return len(looks)

    session.do(stroke(0))
    assert wants(1 << 30) == 1
    session.do(stroke(1))
    assert wants(1 << 30) == 1
    assert any(isinstance(record.held, np.ndarray) for record in records(session.painting))
    assert wants((1 << 30) + paging._GROWN + 1) == 2
    assert not any(isinstance(record.held, np.ndarray) and record.nbytes > 4096 for record in records(session.painting))
    session.do(stroke(2))
    wants(0)  # there was room meanwhile
    assert wants(1 << 20) == 3


def test_one_piece_of_work_looks_at_so_many_records(monkeypatch):
    session, pages = begun(), Paging()
    for n in range(3):
        session.do(stroke(n))
    monkeypatch.setattr(paging, "_LOOKS", 1)
    pages.want(session.painting.root, None, 1 << 30)
    steps = 0
    while pages.wanted > 0:
        pages.step()
        steps += 1
    assert steps > 2 * len(list(records(session.painting)))


@pytest.mark.parametrize(("beyond", "longest"), [(20, 0.02), (800, 0.2)])
def test_paging_is_spread_over_commands_none_of_which_takes_much_longer(monkeypatch, beyond, longest):
    """Unless the process takes far too much."""
    session, now, took = begun(), [0.0], []
    for n in range(12):
        session.do(stroke(n, n % 3))
    before, root = contents(session.painting), session.painting.root
    monkeypatch.setattr(paging, "encode", lambda *told: (now.append(now[-1] + 0.006), coded_records.encode(*told))[1])
    monkeypatch.setattr("time.thread_time", lambda: now[-1])
    monkeypatch.setattr(memory, "resident", lambda: 1 << 30)  # whatever of other tests is given up for it
    monkeypatch.setattr(memory, "peak", memory.resident)
    monkeypatch.setattr(rooms, "_most", lambda: (1 << 30) - (beyond << 20))
    room = Room(session.cache, session.history)
    for worked in (0.2, *(0.01, 0.2, 0.0) * 40):
        now.append(now[-1] + worked)
        start = now[-1]
        room.keep_within(root)
        took.append((worked, now[-1] - start))
    assert all(spent < min(worked, longest) + 0.007 for worked, spent in took)
    assert (max(spent for _, spent in took) > 0.03) == (longest > 0.03)
    assert all(isinstance(record.held, CodedData) or record.data.nbytes < 2048 for record in records(session.painting))
    assert contents(session.painting) == before


def test_old_steps_are_made_smaller_though_nobody_rests(monkeypatch):
    session, now = begun(), [0.0]
    for n in range(30):
        session.do(stroke(n))
    session.do(c.Undo(20))  # steps that no new one has made smaller
    monkeypatch.setattr("time.thread_time", lambda: now.append(now[-1] + 0.001) or now[-1])
    monkeypatch.setattr(memory, "resident", lambda: 1 << 30)
    monkeypatch.setattr(memory, "peak", memory.resident)
    monkeypatch.setattr(rooms, "_most", lambda: (1 << 30) - (20 << 20))
    room, held = Room(session.cache, session.history), session.history.held
    for _ in range(60):
        now.append(now[-1] + 0.2)
        room.keep_within(session.painting.root)
    assert session.history.tight
    assert not session.history.pending
    assert session.history.held < held / 2


def test_records_stay_in_memory_where_the_disk_is_full(disk, monkeypatch):
    session, paging = begun(), Paging()
    for n in range(6):
        session.do(stroke(n))
    before = contents(session.painting)
    monkeypatch.setattr(disk, "put", lambda piece: None)
    paging.want(session.painting.root, None, 1 << 30)
    paging.step(1 << 30)
    assert paging.wanted == 0
    assert contents(session.painting) == before
