"""Examples refined in the background: served between strokes, safe to undo, save, abandon and close in the middle."""

import threading
import time

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from plantings import FRAME, alike, meadow, pixels, stroke, texture
from test_easel import Window

from engine.brush.settings import from_json
from engine.canvas import layers
from engine.canvas.growth import is_settled
from engine.painting import commands as c
from engine.painting.recording import Header, Recording
from engine.session.replay import replay
from engine.studio import requests as q
from engine.studio import results
from engine.studio.worker import Worker
from opens import opens

__all__ = ["meadow"]

TILES = ((0, 0, 0), (-1, 0, 0), (1, 0, 0))
LONG = [[10, 20], [85, 20], [85, 60], [10, 60]]


def brush(**members):
    return from_json({"radius": 9, "dynamics": {}, "mode": "example", "example": "a", **members})


@pytest.fixture
def window(meadow):
    return begun(meadow)


def begun(meadow):
    one = Window()
    one.studio.do(q.New(FRAME, 7))
    for name in "ab":
        one.studio.do(q.Do(texture(name, str(meadow / f"{name}.png"))))
    one.look(*TILES)
    one.work()
    return one


def points(rows):
    out = np.zeros((len(rows), 6))
    out[:, 2] = 1.0
    out[:, :2] = rows
    return out


def steps(window, count):
    for _ in range(count):
        if window.studio.pending:
            window.studio.step()


def grows(window):
    """Whether the painting is still to be refined."""
    return any(not is_settled(layer.growth) for layer in layers.layers(window.studio.easel.session.painting.root))


def replayed(window):
    log = window.studio.easel.session.log
    return replay(Recording(Header(FRAME, 7), tuple(log), folder=None)).painting


def check(window):
    window.look(*TILES)
    window.work()
    assert not grows(window)
    window.check(*TILES)
    assert alike(pixels(window.studio.easel.session.painting), pixels(replayed(window)))


def progress(window):
    return [r for r in window.other if isinstance(r, results.Growing)]


def test_a_stroke_is_seen_at_once_and_refined_afterwards(window):
    studio = window.studio
    studio.do(q.Begin(0, (0, 0), brush()))
    studio.do(q.Points(points(LONG[:2])))
    studio.step()
    studio.step()
    assert window.tiles[0, 0, 0][20, 40, 3] > 0  # seen before anything is refined
    studio.do(q.Finish())
    assert grows(window)
    early = window.tiles[0, 0, 0].copy()
    check(window)
    assert not np.array_equal(early, window.tiles[0, 0, 0])
    told = progress(window)
    assert told[0].done < 1.0
    assert told[0].rects[0][0] == 0
    assert told[-1] == results.Growing(1.0)


def test_the_stroke_in_progress_is_refined_too(window):
    studio = window.studio
    studio.do(q.Begin(0, (0, 0), brush()))
    studio.do(q.Points(points(LONG[:2])))
    window.work()
    assert is_settled(studio.easel.live.bed.growth)
    kept = studio.easel.live.bed.growth
    studio.do(q.Finish())
    assert layers.find(studio.easel.session.painting.root, "Layer 1").growth is kept  # not done twice
    check(window)


ACTIONS = st.one_of(
    st.builds(
        lambda spots, **members: ("stroke", spots, members),
        st.lists(st.tuples(st.integers(0, 95), st.integers(0, 79)), min_size=1, max_size=4),
        example=st.sampled_from("ab"),
        depth=st.sampled_from([None, 1]),
    ),
    st.builds(lambda at: ("stroke", [at], {"mode": "erase"}), st.tuples(st.integers(0, 95), st.integers(0, 79))),
    st.builds(
        lambda at: ("stroke", [at], {"mode": "paint", "radius": 3}), st.tuples(st.integers(0, 95), st.integers(0, 79))
    ),
    st.sampled_from(
        [
            ("do", c.Undo()),
            ("do", c.Redo()),
            ("do", c.Swap(0, (50, 40), "b")),
            ("do", c.AddLayer("more")),
            ("do", c.SelectLayer("Layer 1")),
            ("abandon",),
        ]
    ),
)


@settings(deadline=None, max_examples=12)
@given(st.lists(st.tuples(ACTIONS, st.integers(0, 12)), min_size=2, max_size=7))
def test_whatever_comes_between_the_window_ends_up_with_the_painting(meadow, actions):
    window = begun(meadow)
    studio = window.studio
    for (kind, *told), work in actions:
        if kind == "stroke":
            studio.do(q.Begin(0, (0, 0), brush(**told[1])))
            for spot in told[0]:
                studio.do(q.Points(points([spot])))
                steps(window, work)
            studio.do(q.Finish())
        elif kind == "do":
            try:
                studio.do(q.Do(told[0]))
            except ValueError:
                continue
        else:
            studio.do(q.Begin(0, (0, 0), brush(example="b")))
            studio.do(q.Points(points([[40, 40], [60, 40]])))
            steps(window, work)
            studio.do(q.Abandon())
        window.look(*TILES)
        steps(window, work)
    check(window)


def test_another_layer_is_refined_while_paint_is_laid(window):
    studio = window.studio
    studio.do(q.Do(stroke(LONG)))
    studio.do(q.Do(c.AddLayer("more")))
    studio.do(q.Begin(0, (0, 0), brush(mode="paint", radius=4)))
    studio.do(q.Points(points([[30, 30], [60, 50]])))
    before = studio.easel.session.state
    window.work()
    assert not grows(window)
    assert studio.easel.live is not None
    studio.do(q.Points(points([[70, 40]])))
    studio.do(q.Finish())
    assert studio.easel.session.state is not before
    assert len(studio.easel.session.log[-1].points) == 3
    check(window)
    studio.do(q.Do(c.Undo()))
    check(window)


def test_undo_in_the_middle_and_back(window):
    studio = window.studio
    studio.do(q.Do(stroke(LONG)))
    studio.do(q.Do(stroke([[45, 10], [45, 70]], example="b")))
    steps(window, 6)
    studio.do(q.Do(c.Undo()))
    steps(window, 4)
    studio.do(q.Do(c.Redo()))
    steps(window, 3)
    check(window)
    studio.do(q.Do(c.Undo(2)))
    check(window)
    assert progress(window)[-1] == results.Growing(1.0)
    assert not window.tiles[0, 0, 0].any()


def test_more_threads_make_no_difference(window, monkeypatch):
    monkeypatch.setattr("os.cpu_count", lambda: 4)
    window.studio.do(q.Do(stroke([[0, y] for y in range(0, 400, 40)], radius=60)))
    check(window)
    window.studio.close()


def test_a_fault_is_told_once_and_painting_goes_on(window, monkeypatch):
    def broken(*_):
        raise RuntimeError("it does not grow")
        yield

    studio = window.studio
    monkeypatch.setattr("engine.studio.grower.settling", broken)
    studio.do(q.Do(stroke(LONG)))
    with pytest.raises(RuntimeError):
        window.work()
    window.work()
    monkeypatch.undo()
    studio.do(q.Do(stroke([[45, 10], [45, 70]])))
    check(window)


def test_a_recording_plays_stroke_by_stroke(window, meadow):
    from engine.painting.recording import read, write

    window.studio.do(q.Do(stroke(LONG)))
    window.studio.do(q.Do(stroke([[45, 10], [45, 70]], example="b", depth=1)))
    window.studio.do(q.Do(c.Swap(0, (45, 40), "a")))
    path = meadow / "played.jsonl"
    write(Recording(Header(FRAME, 7), tuple(window.studio.easel.session.log)), path)
    wanted = pixels(replay(read(path)).painting)
    studio = window.studio
    opens(studio, window.posted, path, live=True)
    window.look(*TILES)
    while studio.due is not None:
        studio.play()
        steps(window, 5)
    check(window)
    assert alike(wanted, pixels(studio.easel.session.painting))
    assert studio.easel.session.log == list(read(path).commands)


@pytest.mark.parametrize(("request_", "saving"), [(q.Save, True), (q.Export, False)])
def test_a_file_that_is_grown_first_tells_how_far_it_is(window, tmp_path, request_, saving):
    studio = window.studio
    studio.do(q.Do(stroke(LONG)))
    studio.do(q.Do(c.AddLayer("more")))
    studio.do(q.Do(stroke(LONG, example="b")))
    assert grows(window)
    studio.do(request_(tmp_path / ("p.ora" if saving else "p.png")))
    window.written()
    told = [r for r in window.other if isinstance(r, results.Writing)]
    assert told[0] == results.Writing(1, saving)
    assert told[1] == results.Writing(1, saving, 0.0)
    assert [r.grown for r in told[1:-1]] == sorted(r.grown for r in told[1:-1])
    assert told[-2].grown == 1.0
    assert told[-1] == results.Writing()
    window.work()
    window.other.clear()
    studio.do(request_(tmp_path / ("q.ora" if saving else "q.png")))
    window.written()
    told = [r for r in window.other if isinstance(r, results.Writing)]
    assert told == [results.Writing(1, saving), results.Writing()]  # all had grown


def test_saving_in_the_middle_holds_the_final_pixels_and_refining_is_no_change(window, tmp_path):
    from engine.archive.opening import open_painting

    studio = window.studio
    studio.do(q.Do(stroke(LONG)))
    steps(window, 3)
    assert grows(window)
    studio.do(q.Save(tmp_path / "p.ora"))
    studio.do(q.Export(tmp_path / "p.png"))
    window.written()
    assert not [r for r in window.other if isinstance(r, results.Note) and r.bad]
    assert not window.scene().modified
    window.work()
    studio.easel.tell()
    assert not window.scene().modified
    studio.do(q.Export(tmp_path / "q.png"))
    window.written()
    assert (tmp_path / "p.png").read_bytes() == (tmp_path / "q.png").read_bytes()
    opened = open_painting(tmp_path / "p.ora")
    assert alike(pixels(opened.painting), pixels(studio.easel.session.painting))
    studio.do(q.Do(c.Undo()))
    assert window.scene().modified


def test_a_stroke_is_served_while_refinement_runs_and_closing_is_safe(meadow):
    """Real thread: points are laid between steps, and the thread ends although work is left."""
    came, woken = [], threading.Event()
    worker = Worker(woken.set)
    worker.post(q.New(FRAME, 7))
    for name in "ab":
        worker.post(q.Do(texture(name, str(meadow / f"{name}.png"))))
    worker.post(q.Look(tuple((*tile, -1) for tile in TILES)))
    for y in range(0, 400, 40):  # far more than is refined at once
        worker.post(q.Do(stroke([[0, y], [600, y]], radius=20)))
    end = time.monotonic() + 200
    while not any(isinstance(r, results.Growing) for r in came):
        woken.wait(1.0)
        woken.clear()
        came += worker.results()
        assert time.monotonic() < end
    worker.post(q.Begin(0, (0, 0), brush(example="b")))
    worker.post(q.Points(points([[40, 40]])))
    worker.post(q.Finish())
    worker.close(200.0)
    assert not worker._thread.is_alive()
    came += worker.results()
    assert not [r for r in came if isinstance(r, results.Note) and r.bad]
    assert not any(isinstance(r, results.Growing) and r.done == 1.0 for r in came)
