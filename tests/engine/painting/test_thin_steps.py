"""Steps far from the present, known by what they changed alone: undo and redo come to what was there, bit for bit."""

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from stepped import ROCK, contents, stroke, thick

from engine.canvas import compact, residuals
from engine.canvas.tile_cache import TileCache
from engine.keeping.spill import Spill
from engine.numeric.address import Rect
from engine.painting import commands as c
from engine.painting.value import Painting
from engine.session import line as lines
from engine.session.coding import coded_records, thin_steps
from engine.session.line import STEP_OVERHEAD, is_thickset
from engine.session.room import Room
from engine.session.session import Session
from engine.studio.filing.document import held_by

GROUP = [c.AddLayer("Inner", kind="group"), c.AddLayer("Within", group="Inner")]
ROCKS = [[{**ROCK[0], "period": period}] for period in (16, 20, 24, 28)]
ACTS = st.one_of(
    st.builds(
        stroke, st.integers(0, 9), st.integers(-2, 2), st.sampled_from([2.0, 9.0]), st.sampled_from([(), *ROCKS])
    ),
    st.builds(stroke, st.just(3), st.sampled_from([0, 1]), st.just(60.0)),
    st.integers(1, 5).map(c.Undo),
    st.integers(1, 5).map(c.Redo),
    st.sampled_from([c.AddLayer("Above"), thick(2), c.SetLayer("Layer 1", opacity=0.5)]),
)


@pytest.fixture
def tight(monkeypatch, tmp_path):
    """A session of which all steps but the nearest two are made thin, and its first strokes; two inks are many."""
    spill = Spill(tmp_path)
    for module in (coded_records, thin_steps):
        monkeypatch.setattr(module, "spill", lambda: spill)
    for module in (residuals, compact):
        monkeypatch.setattr(module, "MANY", 2)
    monkeypatch.setattr(lines, "KEPT_WHOLE", 2)
    monkeypatch.setattr(Room, "keep_within", lambda room, root: None)  # there is little room all the time
    yield begun
    spill.close()


def begun():
    session = Session(Painting(Rect.at(0, 0, 96, 96), 7), TileCache(4 << 20))
    session.history.tight = True
    for command in (stroke(0), *GROUP, stroke(1)):
        session.do(command)
    return session


def thin_ones(session):
    return [entry.whole is None for line in session.history._lines for entry in line.entries]


def there_and_back(session, acts):
    states = {session.history.undo_count: contents(session.painting)}
    for act in acts:
        try:
            session.do(act)
        except ValueError:  # a layer of that name is there already
            continue
        states = {number: state for number, state in states.items() if number < session.history.undo_count}
        states[session.history.undo_count] = contents(session.painting)
        for line in session.history._lines:
            assert line.held == sum(entry.held for entry in line.entries)
            assert line._thin <= min(line._coded, len(line.entries))
    for command, count in ((c.Undo(1), session.history.undo_count), (c.Redo(1), 99), (c.Undo(99), 1), (c.Redo(99), 1)):
        for _ in range(min(count, session.history.undo_count + session.history.redo_count)):
            session.do(command)
            wanted = states.get(session.history.undo_count)
            assert wanted is None or contents(session.painting) == wanted
    return states


@pytest.mark.parametrize("inks", [[()], ROCKS])
def test_steps_far_away_are_thin_until_they_are_near_again(tight, inks):
    session = tight()
    there_and_back(session, [stroke(n, ink=inks[n % len(inks)]) for n in range(12)])
    thin = thin_ones(session)
    assert sum(thin) > 8
    assert not any(thin[-2:])
    assert not any(map(is_thickset, session.history._lines))
    assert all(entry.held < STEP_OVERHEAD / 3 for entry in session.history._done.entries if entry.whole is None)
    assert session.history.at(-1) is not None
    assert session.history.at(-9) is None
    document = held_by(session)
    assert document.leapt
    assert 0 < len(document.steps.done) < session.history.undo_count
    session.do(c.Undo(99))
    while session.history.pending:
        session.history.step()
    session.do(c.Redo(99))


@pytest.mark.parametrize("ink", [(), ROCKS[0], [*ROCKS[0], *ROCKS[1]]])
def test_steps_undone_without_a_rest_take_no_more_than_they_changed(tight, ink):
    session = tight()
    for command in (stroke(3, radius=60.0, ink=ink), *(stroke(n % 10, radius=2.0, ink=ink) for n in range(48))):
        session.do(command)
    done = sizes(session.history._done)
    for _ in range(len(done)):
        session.do(c.Undo(1))
    assert sum(sizes(session.history._undone)) < 2 * sum(done)


def sizes(line):
    pieces = [entry.thin.piece for entry in line.entries if entry.thin is not None]
    return [len(piece) if isinstance(piece, bytes) else piece.size for piece in pieces]


@settings(deadline=None, max_examples=25, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(st.lists(ACTS, min_size=4, max_size=20))
def test_whatever_was_done_is_come_to_again(tight, acts):
    there_and_back(tight(), acts)
