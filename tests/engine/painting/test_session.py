"""Sessions: undo, redo and replay give identical pixels, whatever was looked at in between."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from engine.archive.opening import open_painting
from engine.archive.saving import Snapshot, save
from engine.brush.checks import BrushError
from engine.brush.settings import Brush
from engine.canvas import layers
from engine.canvas.composite import composite
from engine.canvas.evaluate import evaluate, evaluate_sparse
from engine.canvas.tile_cache import TileCache
from engine.files.fault import FileError
from engine.numeric.address import Rect
from engine.painting import commands as c
from engine.painting import recording as r
from engine.session.apply import Painting, Refusal
from engine.session.differing import difference
from engine.session.history import History
from engine.session.line import STEP_OVERHEAD, StepLine
from engine.session.replay import replay
from engine.session.session import Session
from engine.strokes.paint_stroke import LiveStroke

FRAME = Rect.at(0, 0, 48, 48)
PLACES = ((-3, Rect.at(0, 0, 6, 6)), (0, FRAME), (2, Rect.at(40, 40, 64, 64)), (5, Rect.at(700, 700, 48, 48)))


def fresh(**options):
    return Session(Painting(FRAME, 7), TileCache(32 << 20), **options)


def picture(painting, level, rect, cache=None):
    def read(sheet, level, rect):
        found = evaluate_sparse(sheet.pyramid, level, rect, cache)
        return None if found is None else found.rgba

    return composite(painting.root, level, rect, read)


def assert_same(one, other):
    """All pixels, ink and properties that can be looked at."""
    shape = [(node.name, node.opacity, node.visible, node.blend) for node in layers.walk(one.root)]
    assert shape == [(node.name, node.opacity, node.visible, node.blend) for node in layers.walk(other.root)]
    assert one.active == other.active
    for a, b in zip(layers.layers(one.root), layers.layers(other.root), strict=True):
        for level, rect in PLACES:
            p, q = evaluate(a.pyramid, level, rect), evaluate(b.pyramid, level, rect)
            assert p.inks == q.inks
            assert np.array_equal(p.data, q.data)


def stroke(level=0, at=(24, 24), to=(30, 20), seed=None, **brush):
    points = [[at[0] * 2.0**level, at[1] * 2.0**level], [to[0] * 2.0**level, to[1] * 2.0**level, 0.5]]
    data = {"do": "stroke", "level": level, "points": points, "brush": {"radius": 5, **brush}}
    return c.parse(data | ({"seed": seed} if seed is not None else {}))


ROCK = {"ink": [{"texture": "rock", "colour": "#ffffff", "period": 16}]}
STROKES = st.builds(
    stroke,
    st.sampled_from([-1, 0, 2]),
    st.tuples(st.integers(15, 30), st.integers(15, 30)),
    seed=st.none() | st.integers(0, 2),
    mode=st.sampled_from(["paint", "paint", "erase", "smooth"]),
    colour=st.sampled_from(["#c03020", "#204060"]),
    opacity=st.sampled_from([1.0, 0.4]),
    ink=st.sampled_from([[], ROCK["ink"], [{"texture": "spots", "amount": 0.5}]]),
)
TEXTURE = c.DefineTexture(
    "spots", "squares", c.parse({"do": "texture", "name": "a", "maker": "b", "period": 4}).arguments
)
COMMANDS = st.one_of(
    STROKES,
    STROKES,
    st.builds(c.Undo, st.integers(1, 3)),
    st.builds(c.Redo, st.integers(1, 3)),
    st.sampled_from(
        [c.AddLayer("A"), c.AddLayer("B"), c.AddLayer("G", "group"), c.SelectLayer("A"), c.RemoveLayer("B")]
    ),
    st.sampled_from(
        [c.RenameLayer("A", "C"), c.MoveLayer("B", 0), c.MoveLayer("A", 0, "G"), c.DuplicateLayer("A", "D")]
    ),
    st.sampled_from([c.SetLayer("A", opacity=0.5), c.SetLayer("B", alpha_locked=True), c.SetLayer("A", locked=True)]),
    st.sampled_from([c.View(2.5, (3, 4), (64, 64)), c.Bookmark("here", 1.5, (9, -4)), TEXTURE]),
)


def done(session, commands, look=False):
    """Does what can be done, perhaps looking around in between."""
    for i, command in enumerate(commands):
        try:
            session.do(command)
        except Refusal:
            continue
        if look:
            level, rect = PLACES[i % len(PLACES)]
            picture(session.painting, level, rect, session.cache)
    return session


@settings(deadline=None, max_examples=25)
@given(st.lists(COMMANDS, min_size=4, max_size=10))
def test_a_replay_gives_the_same_pixels_whatever_was_looked_at(commands):
    first = done(fresh(), [TEXTURE, *commands], look=True)
    text = "\n".join(first.recording().lines()).encode()
    again = replay(r.read_from(BytesLines(text), "log"), TileCache(1 << 20))
    assert_same(first.painting, again.painting)
    plain = done(fresh(), [TEXTURE, *commands])
    assert_same(first.painting, plain.painting)


class BytesLines:
    def __init__(self, data):
        self._lines = iter(data.splitlines(keepends=True))

    def readline(self, limit):
        return next(self._lines, b"")


@settings(deadline=None, max_examples=15)
@given(st.lists(STROKES, min_size=2, max_size=5), st.data())
def test_undo_and_redo_go_back_and_forth_exactly(strokes, data):
    session = fresh()
    states = [session.painting]
    for command in strokes:
        states.append(done(session, [TEXTURE, command]).painting)
    back = data.draw(st.integers(1, len(strokes)))
    session.do(c.Undo(back))
    reference = done(fresh(), [TEXTURE, *strokes[: len(strokes) - back]]).painting
    if back < len(strokes):
        assert_same(session.painting, reference)
    session.do(c.Redo(back))
    assert_same(session.painting, states[-1])
    assert not session.can_redo


def test_a_new_step_after_undo_ends_what_could_be_redone():
    session = done(fresh(), [stroke(), stroke(colour="#ff0000"), c.Undo()])
    assert session.can_redo
    session.do(stroke(colour="#00ff00"))
    assert not session.can_redo
    before = session.painting
    session.do(c.Redo())
    assert session.painting is before


def test_undo_is_recorded_as_often_as_it_was_done():
    session = done(fresh(), [stroke(), stroke(), c.Undo(5), c.Undo(), c.Redo(9), c.View(1.0)])
    assert session.log[2:] == [c.Undo(2), c.Redo(2), c.View(1.0)]


def test_what_is_refused_leaves_no_trace():
    session = done(fresh(), [stroke()])
    before, log = session.painting, list(session.log)
    with pytest.raises(Refusal):
        session.do(c.RemoveLayer("nobody"))
    assert session.painting is before
    assert session.log == log


def test_textures_and_the_active_layer_are_no_steps():
    session = done(
        fresh(), [c.AddLayer("A"), stroke(), c.AddLayer("B"), c.SelectLayer("A"), stroke(), TEXTURE, c.Undo()]
    )
    assert "spots" in session.painting.textures
    assert session.painting.active == "A"


def test_history_is_bounded_by_the_bytes_that_only_it_holds():
    big = [stroke(at=(8 * i, 8), to=(8 * i + 4, 30), **ROCK) for i in range(6)]
    free = done(fresh(), big)
    assert free.history.undo_count == 6
    assert free.history.held > 6 * STEP_OVERHEAD
    cap = 3 * STEP_OVERHEAD  # what they hold is put away on disk first; their own objects stay
    tight = done(fresh(history=History(bytes_cap=cap)), big)
    assert 0 < tight.history.undo_count < 6
    newest = tight.history.steps.done[-1].lost + STEP_OVERHEAD
    assert tight.history.held - newest <= cap
    assert_same(tight.painting, free.painting)
    count = tight.history.undo_count
    tight.do(c.Undo(99))
    assert tight.log[-1] == c.Undo(count)
    assert_same(tight.painting, replay(tight.recording()).painting)


def test_what_history_counts_is_what_is_held_alone():
    session = fresh()
    before = done(session, [stroke(**ROCK)]).painting
    after = done(session, [stroke(at=(26, 24), **ROCK)]).painting
    shared = {id(x) for x in records(before)} & {id(x) for x in records(after)}
    lost, gained = difference(before.root, after.root)
    assert lost == sum(x.nbytes for x in records(before) if id(x) not in shared)
    assert gained == sum(x.nbytes for x in records(after) if id(x) not in shared)
    assert session.history.held == lost + difference(Painting().root, before.root)[0] + 2 * STEP_OVERHEAD
    held = session.history.held
    session.do(c.Undo(2))
    session.do(c.Redo(2))
    assert session.history.held == held


def records(painting):
    return [record for sheet in layers.layers(painting.root) for _, record in sheet.pyramid.all_records()]


def test_a_stroke_in_progress_is_its_command_and_its_preview_is_what_it_commits():
    session = done(fresh(), [stroke(2, **ROCK), stroke(0, colour="#00a000", opacity=0.3)])
    brush = Brush(radius=6.0, opacity=0.7)
    live = session.begin(1, (10, 20), brush)
    rng = np.random.default_rng(3)
    for _ in range(6):
        dirty = live.add(np.column_stack([rng.uniform(0, 50, (3, 2)), rng.uniform(0, 1, 3)]))
        assert not dirty.empty
        live.preview(dirty)
    rect = live.rect.union(Rect.at(0, 0, 96, 96))
    shown = live.preview(rect)
    other = done(fresh(), [*session.log, live.to_command()])
    session.finish(live)
    assert_same(session.painting, other.painting)
    committed = evaluate(next(layers.layers(session.painting.root)).pyramid, 1, rect)
    assert np.array_equal(shown.rgba, committed.rgba)
    assert c.parse(c.to_json(session.log[-1])) == session.log[-1]


def test_hostile_points_are_dropped_and_counted():
    live = fresh().begin(0, (0, 0), Brush(radius=3.0))
    bad = [[np.nan, 0, 1], [0, np.inf, 1], [1e308, 0, 1], [0, -1e300, 1], [1, 1, np.nan]]
    assert live.add(np.array(bad)).empty
    assert live.dropped == 5
    assert live.empty
    live.add(np.array([[5, 5, 2.0, 1e9, -np.inf, np.nan], [6, 6, -1.0, 0, 0, -5], [5e-324, -0.0, 1, 0, 0, 0]]))
    assert live.dropped == 5
    command = live.to_command()
    assert command.points[:, 2].tolist() == [1.0, 0.0, 1.0]
    assert command.points[0, 3] == 90.0
    assert c.parse(c.to_json(command)) == command


def test_a_stroke_without_points_is_nothing():
    session = fresh()
    before = session.painting
    live = session.begin(0, (0, 0), Brush())
    with pytest.raises(Refusal, match="no point"):
        live.to_command()
    assert session.finish(live) is before
    assert session.log == []


def test_a_stroke_is_done_on_what_is_there_when_it_ends():
    session = fresh()
    live = session.begin(0, (24, 24), Brush(radius=5.0, colour="#ff0000"))
    live.add(np.array([[0.0, 0.0]]))
    session.do(stroke(colour="#0000ff"))
    session.finish(live)
    assert_same(session.painting, replay(session.recording()).painting)
    assert session.history.undo_count == 2


def test_a_burst_of_points_fills_strokes_without_losing_any():
    live = LiveStroke(Painting(FRAME), 0, (0, 0), Brush(radius=2.0, spacing=1.0))
    while not live.full:
        x = np.linspace(0, 40, 20_000) + 1 / 3
        live.add(np.column_stack([x, np.sin(x) + 20.000001]))
    assert live.dropped == 0
    line = r.dumps(c.to_json(live.to_command())).encode()
    assert len(line) < r.BYTES_CAP
    assert c.parse(r.loads(line)) == live.to_command()


def test_a_replay_names_the_line_of_what_cannot_be_done(tmp_path):
    path = tmp_path / "a.jsonl"
    path.write_text('{"inkfall": 1}\n\n{"do": "layer", "add": "a"}\n{"do": "layer", "remove": "b"}\n')
    with pytest.raises(FileError, match=r"a\.jsonl: line 4: layer: found 'b', expected one of 'a'"):
        replay(r.read(path))


def test_a_replay_remembers_only_as_many_steps_as_it_needs():
    commands = [stroke(), stroke(), stroke(), c.Undo(2), stroke()]
    session = replay(r.Recording(r.Header(FRAME, 7), tuple(commands)))
    assert session.history.undo_count <= 2
    assert_same(session.painting, done(fresh(), commands).painting)


def test_a_replay_codes_no_step_that_it_does_not_take_back(monkeypatch):
    monkeypatch.setattr(StepLine, "code", lambda *given: pytest.fail("a step was coded"))
    commands = tuple(stroke(at=(8 * i, 8), to=(8 * i + 4, 30), **ROCK) for i in range(6))
    session = replay(r.Recording(r.Header(FRAME, 7), commands))
    assert session.history.undo_count == 0
    assert session.history.forgotten == 6


def test_a_painting_saved_and_reopened_on_the_way_goes_on_alike(tmp_path):
    commands = [
        stroke(**ROCK),
        c.AddLayer("B"),
        stroke(2, at=(20, 28)),
        stroke(-1, opacity=0.5),
        stroke(3, mode="erase"),
    ]
    straight = done(fresh(), [TEXTURE, *commands])
    for cut in range(1, len(commands)):
        first = done(fresh(), [TEXTURE, *commands[:cut]])
        save(tmp_path / "a.ora", Snapshot(first.painting, first.recording()))
        found = open_painting(tmp_path / "a.ora")
        second = done(Session(found.painting, log=found.recording.commands), commands[cut:])
        assert_same(straight.painting, second.painting)
        assert second.log == straight.log


def test_another_seed_is_another_rock_and_nothing_else():
    script = r.Recording(r.Header(FRAME, 7), (stroke(**ROCK), stroke(at=(4, 4), seed=1, **ROCK)))
    same, other = replay(script, seed=7).painting, replay(script, seed=8).painting
    assert_same(same, replay(script).painting)
    assert not np.array_equal(picture(same, 0, FRAME), picture(other, 0, FRAME))
    assert np.array_equal(picture(same, 0, FRAME)[3], picture(other, 0, FRAME)[3])


def test_deep_and_far_places_are_painted_and_undone_exactly():
    far = c.parse(
        {"do": "stroke", "level": 200, "origin": [10**70, -(10**70)], "points": [[0, 0], [9, 9]], "brush": ROCK}
    )
    session = done(fresh(), [stroke(**ROCK)])
    before = session.painting
    session.do(far)
    rect = Rect.at(10**70 - 8, -(10**70) - 8, 16, 16)
    assert picture(session.painting, 200, rect)[3].max() == 1.0
    assert_same(session.painting, before)
    session.do(c.Undo())
    assert not picture(session.painting, 200, rect).any()


def test_history_counts_what_settling_many_strokes_replaced():
    """The attenuation of the oldest strokes that wait is applied everywhere, not only under the last one."""
    session = Session(cache=TileCache(16 << 20))
    session.do(c.parse(FINE))
    counted = real = 0
    for n in range(40):
        before, held = session.painting.root, session.history.held
        coarse = {"do": "stroke", "origin": [n * 20, 0], "points": [[0, 0]], "brush": {"radius": 6, "opacity": 0.5}}
        session.do(c.parse(coarse))
        now = {id(r) for layer in layers.layers(session.painting.root) for _, r in layer.pyramid.all_records()}
        old = [r for layer in layers.layers(before) for _, r in layer.pyramid.all_records()]
        real += sum(r.nbytes for r in old if id(r) not in now)
        waits, still = (
            {id(a.keep): a.nbytes for sheet in layers.layers(root) for a in sheet.pyramid.waiting()}
            for root in (before, session.painting.root)
        )
        real += sum(size for number, size in waits.items() if number not in still)
        counted += session.history.held - held - STEP_OVERHEAD
    assert counted == real


FINE = {
    "do": "stroke", "level": 2, "origin": [0, 0], "points": [[0, 0], [3200, 0]],
    "brush": {"radius": 30, "ink": [{"texture": "rock"}]},
}  # fmt: skip


def test_points_that_make_a_stroke_too_large_leave_it_as_it_was():
    brush = Brush(radius=300.0, colour="#204080")
    live, plain = (LiveStroke(Painting(FRAME), 0, (0, 0), brush) for _ in "ab")
    for stroke in (live, plain):
        stroke.add(np.array([[0.0, 0.0], [40.0, 10.0]]))
    live._mask._tiles_cap = 60
    with pytest.raises(BrushError):
        live.add(np.array([[9000.0, 0.0]]))
    assert live.rect == plain.rect
    for stroke in (live, plain):
        stroke.add(np.array([[80.0, 60.0]]))
    a, b = (stroke.commit() for stroke in (live, plain))
    assert_same(a, b)
    assert len(live.to_command().points) == 3
