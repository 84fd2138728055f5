"""The past: jumps are undo and redo, whether the history holds the step or not; looking back changes nothing."""

import time
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from app.desk.past.past_state import PastState
from engine.canvas.composite import composite
from engine.canvas.layers import layers
from engine.canvas.reading import layer_planes
from engine.canvas.tile_cache import TileCache
from engine.numeric.address import Rect
from engine.painting import commands as c
from engine.painting import recording as r
from engine.session.differing import difference
from engine.session.here.painted_here import CanvasPixel, PaintedHere
from engine.session.replay import replay
from engine.session.session import Session
from engine.studio import requests as q
from engine.studio import results
from engine.studio.past import past_records as p
from engine.studio.past import step_pictures as step_pictures_module
from engine.studio.past.rebuilding import STEPS_APART, KeptStates
from engine.studio.past.step_pictures import StepPainter
from engine.studio.studio import Studio

FRAME = Rect.at(0, 0, 64, 48)
TILE = (0, 0, 0)


class Asker:
    """A studio, and what it sent."""

    def __init__(self, session=None):
        self.sent = []
        self.studio = Studio(self.sent.append, lambda request: None)
        self.easel = self.studio.easel
        if session is not None:
            self.easel.show(session, None)
        self.work()

    def ask(self, *requests):
        for request in requests:
            self.studio.do(request)
        self.work()

    def work(self):
        while self.studio.pending:
            self.studio.step()

    def last(self, kind):
        return next(result for result in reversed(self.sent) if isinstance(result, kind))

    @property
    def scene(self):
        return self.last(p.PastScene)

    @property
    def session(self):
        return self.easel.session

    def seen(self):
        return self.easel.viewer.picture(0, FRAME)


def stroke(x, y, colour="#102030", layer=None):
    told = {"do": "stroke", "points": [[x, y], [x + 9, y + 4]], "brush": {"radius": 4, "colour": colour}}
    return c.parse(told if layer is None else {**told, "layer": layer})


STROKES = tuple(stroke(5 * n, 3 * n, f"#{40 * n % 256:02x}{90 * n % 256:02x}80") for n in range(12))
COMMANDS = (
    *STROKES[:4],
    c.parse({"do": "layer", "add": "Above"}),
    c.parse({"do": "texture", "name": "Stone", "maker": "rock"}),
    *STROKES[4:8],
    c.parse({"do": "layer", "set": "Above", "opacity": 0.5}),
    c.parse({"do": "undo", "count": 2}),
    c.parse({"do": "layer", "select": "Layer 1"}),
    *STROKES[8:],
)


def painted(session):
    return composite(session.painting.root, 0, FRAME, layer_planes)


def after(commands, count):
    return painted(replay(r.Recording(r.Header(FRAME, 0), tuple(commands[:count]))))


def opened(commands=COMMANDS):
    """A session as a file gives it: the painting and its log, and a history that holds nothing."""
    made = replay(r.Recording(r.Header(FRAME, 0), tuple(commands)))
    return Session(made.painting, TileCache(16 << 20), log=made.log)


ACTS = st.one_of(
    st.integers(0, 14).map(p.Jump),
    st.integers(0, 14).map(p.LookBack),
    st.sampled_from(STROKES).map(q.Do),
    st.just(q.Do(c.Undo())),
    st.just(q.Do(c.Redo())),
    st.just(q.Do(c.AddLayer("Other"))),
)


@settings(deadline=None, max_examples=5)
@given(st.booleans(), st.lists(ACTS, max_size=6))
def test_whatever_is_jumped_and_looked_at_the_recording_gives_the_painting(held, acts):
    check_acts(held, acts)


def test_a_jump_to_and_fro_leaves_the_layer_that_the_recording_leaves():
    check_acts(False, [p.Jump(0), p.Jump(8)])  # after step 8 another layer was chosen, which is no step


@pytest.mark.nightly
@settings(deadline=None, max_examples=150)
@given(st.booleans(), st.lists(ACTS, max_size=10))
def test_it_does_so_many_times_over(held, acts):
    check_acts(held, acts)


def check_acts(held, acts):
    asker = Asker(None if held else opened())
    if held:
        asker.ask(q.New(FRAME), *map(q.Do, COMMANDS))
    asker.ask(p.ShowPast())
    for act in acts:
        if act == q.Do(c.AddLayer("Other")) and any(row.name == "Other" for row in asker.last(results.Scene).layers):
            continue
        before, log = painted(asker.session), list(asker.session.log)
        asker.ask(act)
        if isinstance(act, p.Jump) and act.number <= len(asker.scene.steps):
            assert asker.scene.done == act.number
            if len(log) < len(asker.session.log):
                (jump,) = asker.session.log[len(log) :]
                assert isinstance(jump, c.Undo | c.Redo)
        elif isinstance(act, p.LookBack):
            assert asker.session.log == log
            assert np.array_equal(painted(asker.session), before)
    again = replay(asker.session.recording())
    assert np.array_equal(painted(again), painted(asker.session))
    assert again.painting.active == asker.session.painting.active
    assert (len(again.steps.done), len(again.steps.undone)) == (
        asker.scene.done,
        len(asker.scene.steps) - asker.scene.done,
    )


@pytest.mark.parametrize("number", [0, 3, 12])
def test_a_step_of_a_file_is_reached_and_looked_at(number):
    asker = Asker(opened())
    asker.ask(p.ShowPast())
    scene = asker.scene
    assert (len(scene.steps), scene.done, scene.held) == (12, 12, (12, 12))
    index = scene.steps[number - 1].index + 1 if number else 0
    wanted, present, log = after(COMMANDS, index), painted(asker.session), len(asker.session.log)
    asker.ask(p.LookBack(number))
    assert np.array_equal(asker.seen(), wanted)
    assert len(asker.session.log) == log
    asker.ask(p.LookBack(None))
    assert np.array_equal(asker.seen(), present)
    asker.ask(p.Jump(number))
    assert np.array_equal(painted(asker.session), wanted)
    assert np.array_equal(asker.seen(), wanted)
    assert asker.session.can_redo == (number < 12)
    for further in range(number + 1, 13):  # redo survives, although nothing is held
        asker.ask(q.Do(c.Redo()))
        assert asker.scene.done == further
    assert np.array_equal(painted(asker.session), present)
    asker.ask(p.Jump(0), q.Do(stroke(0, 0)))
    assert not asker.session.can_redo


def test_a_jump_comes_to_the_layer_that_undoing_comes_to():
    asker = Asker(opened())
    asker.ask(p.ShowPast(), q.Do(c.AddLayer("Other")), p.Jump(8))
    assert asker.session.painting.active == replay(asker.session.recording()).painting.active == "Layer 1"


def test_looking_ends_as_soon_as_somebody_paints():
    asker = Asker()
    asker.ask(q.New(FRAME), *map(q.Do, STROKES[:4]), p.ShowPast())
    asker.ask(p.LookBack(1))
    assert asker.scene.looking == 1
    assert not np.array_equal(asker.seen(), painted(asker.session))
    asker.ask(q.Do(STROKES[5]))
    assert asker.scene.looking is None
    assert np.array_equal(asker.seen(), painted(asker.session))
    assert asker.scene.done == 5


def step_pictures(asker):
    """The pictures of steps that were sent; those of layers come, too."""
    return [one for one in asker.sent if isinstance(one, results.Picture) and one.ident.startswith("step ")]


def test_the_way_to_a_step_can_be_given_up_and_tells_how_far_it_is():
    many = tuple(stroke(n % 50, n % 40) for n in range(60))
    asker = Asker(opened(many))
    asker.ask(p.ShowPast())
    before = painted(asker.session)
    asker.studio.do(p.Jump(59))
    asker.studio.step()
    asker.studio.do(p.StopJump())
    asker.work()
    assert (asker.scene.done, asker.scene.playing) == (60, None)
    asker.studio.do(p.Jump(5))
    asker.studio.do(q.Do(STROKES[0]))  # who goes on painting does not want to be taken away
    asker.work()
    assert asker.scene.done == 61
    asker.ask(p.Jump(59))
    assert any(scene.playing is not None for scene in asker.sent if isinstance(scene, p.PastScene))
    asker.ask(p.Jump(60))
    assert np.array_equal(painted(asker.session), before)


@pytest.mark.parametrize("at_hand", [1 << 20, 0])
def test_every_step_has_a_picture_of_where_it_was_painted(monkeypatch, at_hand):
    """Also where it lies on disk."""
    monkeypatch.setattr(step_pictures_module, "_AT_HAND", at_hand)
    asker = Asker(opened())
    asker.ask(p.ShowPast())
    steps = asker.scene.steps
    asker.ask(p.ShowPast(True, tuple(step.index for step in steps)))
    shown = {result.ident: result.pixels for result in step_pictures(asker)}
    assert set(shown) == {step.picture for step in steps}
    for step in asker.session.steps.done[1::4]:
        there = replay(r.Recording(r.Header(FRAME, 0), COMMANDS[: step.index + 1])).painting
        made = StepPainter().made(step, there, None)
        assert made[30:42, 40:56, 3].any()
        assert np.array_equal(shown[steps[step.number - 1].picture], made)
    asker.ask(q.Do(STROKES[0]))
    asker.ask(p.ShowPast(True, (asker.scene.steps[-1].index,)))
    assert asker.scene.steps[-1].picture == step_pictures(asker)[-1].ident


def test_states_beside_the_painting_are_told_to_who_looks_after_memory():
    asker = Asker(opened())
    asker.ask(p.LookBack(5))

    def aside():
        return [root for told in asker.session.room.aside for root in told()]

    assert asker.easel.viewer.looking.root in aside()
    asker.studio.do(p.Jump(3))
    assert len(aside()) == 3  # what the log begins with, what is seen, and what is on the way
    asker.work()
    asker.easel.show(opened(), None)
    asker.work()
    assert aside() == [asker.session.base.root]


def test_pictures_are_made_of_the_steps_in_sight_alone_and_again_when_it_is_opened_again():
    asker = Asker(opened())
    asker.ask(p.ShowPast())
    steps = asker.scene.steps
    asker.studio.do(p.ShowPast(True, (steps[2].index, steps[5].index)))
    asker.studio.step()
    asker.ask(p.ShowPast(False))  # before they are made
    asker.ask(p.ShowPast(True, (steps[2].index,)))
    asker.ask(p.ShowPast(True, (steps[4].index, steps[9].index)))
    shown = [result.ident for result in step_pictures(asker)]
    assert sorted(set(shown)) == sorted({steps[n].picture for n in (2, 4, 9)})


def test_a_picture_is_made_in_a_few_milliseconds():
    session = Session(cache=TileCache(64 << 20))
    for n in range(30):
        points = [[40.0 * n, 200.0 + 10 * k, 0.8] for k in range(40)]
        session.do(c.parse({"do": "stroke", "level": n % 3, "points": points, "brush": {"radius": 30}}))
    step, spent, painter = session.steps.done[-1], [], StepPainter()
    for _ in range(20):
        before = time.process_time()
        painter.made(step, session.painting, session.cache)
        spent.append(time.process_time() - before)
    assert min(spent) < 0.005, spent  # 0.4 ms where nothing else runs


def test_layers_that_stay_are_read_anew_where_they_change():
    session, painter = Session(cache=TileCache(64 << 20)), StepPainter()
    session.do(STROKES[0])
    session.do(c.parse({"do": "layer", "add": "Above"}))
    for n, command in enumerate(STROKES):
        session.do(replace(command, layer=("Layer 1", "Above")[n // 3 % 2]))
        step = session.steps.done[-1]
        made = painter.made(step, session.painting, session.cache)
        assert np.array_equal(made, StepPainter().made(step, session.painting, None))


def test_a_held_step_is_seen_in_thirty_milliseconds():
    asker = Asker()
    asker.ask(q.New(Rect.at(0, 0, 512, 512)), *map(q.Do, STROKES * 4), p.ShowPast())
    tiles = tuple((0, x, y, -1) for x in range(2) for y in range(2))
    asker.studio.look(q.Look(tiles))
    asker.work()
    spent = []
    for number in (40, 12, 30, 3):
        before = time.process_time()
        asker.studio.do(p.Jump(number))
        asker.studio.look(q.Look(tuple((*tile[:3], asker.easel.viewer.sight.revision - 1) for tile in tiles)))
        while asker.easel.viewer.sight.open:
            asker.studio.step()
        spent.append(time.process_time() - before)
    assert min(spent) < 0.03, spent


def test_what_strokes_over_one_another_hold_is_counted_once():
    session = Session(cache=TileCache(64 << 20))
    session.do(STROKES[0])
    before = session.painting
    for command in STROKES[:3] * 5:
        session.do(command)
    (layer,) = layers(session.painting.root)
    lost, gained = difference(before.root, session.painting.root)
    assert 0 < gained <= layer.pyramid.nbytes + sum(waits.nbytes for waits in layer.pyramid.waiting())
    (layer,) = layers(before.root)
    assert 0 < lost <= layer.pyramid.nbytes


def test_kept_states_are_bounded_and_each_leads_on():
    session = Session(cache=TileCache(16 << 20))
    session.history.lessens = False  # as of those that are played anew
    states = KeptStates(session.painting)
    kept = {}
    for n in range(40):
        session.do(stroke(90 * n, 60 * n))
        states.keep(n + 1, session.painting)
        kept[n + 1] = session.painting
    assert STEPS_APART == 200
    assert states.nearest(session.log, 33) == (33, kept[33])
    states._most = states.held - 1
    session.do(stroke(7, 7))
    states.keep(41, session.painting)
    session.do(c.Undo())
    assert len(states._states) == 21
    assert states.nearest(session.log, 40) == (40, kept[40])
    assert states.nearest(session.log, 33) == (32, kept[32])
    session.do(c.Undo(5))
    session.do(stroke(0, 0))
    at, painting = states.nearest(session.log, len(session.log))
    assert at <= 36, "what is undone later cannot be begun with"
    assert painting in (*kept.values(), states._states[0])


def test_strokes_that_show_are_told_piece_by_piece_the_newest_first(monkeypatch):
    monkeypatch.setattr("engine.studio.past.here._PIECE", 0.0)
    monkeypatch.setattr("engine.session.here.painted_here._AT_FIRST", 8)
    stack = [c.AddLayer("Below"), c.AddLayer("Above")]
    for n in range(60):
        told = {"do": "stroke", "layer": ("Below", "Above")[n % 2], "points": [[20, 20], [30, 20 + n % 3]]}
        stack.append(c.parse({**told, "brush": {"radius": 6, "opacity": 0.02, "colour": f"#{n:06x}"}}))
    asker = Asker()
    asker.ask(q.New(FRAME), *map(q.Do, stack))
    asker.studio.do(p.AskHere(0, 25, 20))
    while asker.studio.pending:
        asker.studio.step()
    told = [result for result in asker.sent if isinstance(result, p.Here)]
    assert len(told) > 2
    assert [here.more for here in told] == [True] * (len(told) - 1) + [False]
    for one, other in pairwise(told):
        assert other.strokes[: len(one.strokes)] == one.strokes
    numbers = [stroke.step.number for stroke in told[-1].strokes]
    assert numbers == sorted(numbers, reverse=True)
    session = asker.session
    wanted = PaintedHere().at(CanvasPixel(0, 25, 20), session.painting, session.steps)
    assert [(one.step.number, one.share) for one in wanted] == [(s.step.number, s.share) for s in told[-1].strokes]


def test_a_search_ends_where_another_begins_or_the_painting_goes(monkeypatch):
    monkeypatch.setattr("engine.studio.past.here._PIECE", 0.0)
    asker = Asker()
    asker.ask(q.New(FRAME), *map(q.Do, STROKES))
    asker.studio.do(p.AskHere(0, 4, 4))
    asker.ask(p.AskHere(0, 9, 6))
    assert asker.last(p.Here).place == (0, 9, 6)
    assert not asker.last(p.Here).more
    asker.studio.do(p.AskHere(0, 4, 4))
    count = len(asker.sent)
    asker.easel.show(opened(), None)
    asker.work()
    assert not any(isinstance(result, p.Here) for result in asker.sent[count:])


def test_the_list_keeps_what_it_shows_while_the_same_place_is_looked_at_anew():
    step = p.PastStep(0, 1, "", "")
    row = p.HereStroke(step, "Layer 1", 1.0, 0, ())
    state, place = PastState(), (0, 3, 4)
    for here, shown in (
        (p.Here(place, (row,), True), 1),
        (p.Here(place, (row, row)), 2),
        (p.Here(place, (), True), 2),
        (p.Here(place, (row,), True), 2),
        (p.Here(place, (row,)), 1),
        (p.Here((0, 9, 9), (), True), 0),
    ):
        state.take(here)
        assert state.here is not None
        assert len(state.here.strokes) == shown
