"""What waits for a kernel keeps its place: the order of commands is that in which they were asked for."""

import json
import time
from types import SimpleNamespace

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st
from immutables import Map

from engine import kernel_cache
from engine.brush.parts import Component
from engine.brush.settings import Brush
from engine.kernel_cache import NotCompiled
from engine.makers import definitions
from engine.numeric.address import Rect
from engine.numeric.colour import to_premul8
from engine.painting import commands as c
from engine.painting.textures import Texture
from engine.painting.value import Painting
from engine.studio import requests as q
from engine.studio import results
from engine.studio.preparing import waiting as waits
from engine.studio.preparing.job_queue import SEEN_DETAIL
from engine.studio.preparing.sketch import Sketch
from engine.studio.preparing.waiting import Waiting
from engine.studio.studio import Studio
from engine.texture.image import ImageSource

PLAIN, ROCK = Brush(), Brush(radius=3.0, hardness=0.5)


class Kernels:
    """In place of `Preparing`: kernels come when a test says so."""

    def __init__(self):
        self.busy, self.count, self.there, self.jobs, self.done = True, 0, set(), [], set()
        self.closed = False

    def want(self, jobs, soon=False):
        self.jobs += [(job, soon) for job in jobs]

    def ready(self, job):
        return not self.busy or job in self.done

    def painting(self, painting):
        pass

    def come(self, *names):
        self.there.update(names)
        self.count += 1

    def close(self):
        self.closed, self.busy = True, False


class Easel:
    """In place of the studio and its easel: writes down what is done, and lacks kernels."""

    due = None
    behind = False
    session = SimpleNamespace(painting=Painting())

    def __init__(self, kernels):
        self.kernels, self.easel, self.live, self.log = kernels, self, None, []
        self.viewer, self.lab = (
            SimpleNamespace(pending=0, changed=lambda where: None, grew=lambda *area: None),
            SimpleNamespace(pending=0),
        )
        self.pending, self.swatches = 0, []
        self.grower = SimpleNamespace(held=False, pending=False)

    def do(self, request):
        match request:
            case q.Begin():
                self._need(f"begin {request.brush.radius}")
                self.live = [request.brush.radius]
            case q.Points() if self.live is not None:
                self.live.append("half laid")
                self._need(f"lay {self.live[0]}")
                self.live[-1] = float(request.points[0, 0])
            case q.Finish() if self.live is not None:
                live, self.live = self.live, None
                self._need(f"commit {live[0]}")
                self.log.append(tuple(live))
            case q.Abandon():
                self.live = None
            case q.Swatch():
                self._need(f"begin {request.brush.radius}")
                self.swatches.append(request.ident)
            case q.Do():
                self._need("do")
                self.log.append(request.command)
            case q.Save():
                self.log.append(request.path)

    def _need(self, name):
        if self.kernels.busy and name not in self.kernels.there:
            raise NotCompiled(name)

    def look(self, request):
        self.viewer.pending = self.pending = len(request.tiles)

    def step(self):
        return False

    def close(self):
        self.log.append("closed")


def made():
    kernels, sent = Kernels(), []
    easel = Easel(kernels)
    return kernels, easel, Waiting(easel, kernels, sent.append), sent


def points(x):
    return q.Points(np.full((1, 6), float(x)))


def stroke(brush, *xs):
    return [q.Begin(0, (0, 0), brush), *map(points, xs), q.Finish()]


def test_a_later_stroke_whose_kernels_are_there_is_committed_after_one_that_waits():
    kernels, easel, waiting, _ = made()
    kernels.come("begin 12.0", "lay 12.0", "commit 12.0")
    for request in [*stroke(ROCK, 1, 2), *stroke(Brush(radius=12.0), 3)]:
        waiting.do(request)
    assert easel.log == []
    assert waiting.waits
    for name in ("begin 3.0", "lay 3.0"):
        kernels.come(name)
        waiting.play()
        assert easel.log == []
    kernels.come("commit 3.0")
    waiting.play()
    assert easel.log == [(3.0, 1.0, 2.0), (12.0, 3.0)]
    assert not waiting.waits


def test_what_waits_is_looked_at_again_by_itself():
    """When nothing else is asked for, too: the worker asks again and again when that is due."""
    kernels, easel, waiting, _ = made()
    for request in stroke(ROCK, 1):
        waiting.do(request)
    kernels.come("begin 3.0", "lay 3.0", "commit 3.0")
    end = time.monotonic() + 90
    while easel.log == [] and time.monotonic() < end:
        due = waiting.due
        assert due is not None
        time.sleep(max(0.0, due - time.monotonic()))
        if waiting.due <= time.monotonic():
            waiting.play()
    assert easel.log == [(3.0, 1.0)]


def test_its_brush_jumps_the_queue():
    kernels, _, waiting, _ = made()
    waiting.do(q.Begin(0, (0, 0), ROCK))
    job, soon = kernels.jobs[-1]
    assert soon
    assert '"radius": 3.0' in job.line


def test_a_brush_is_exercised_with_the_textures_of_the_painting_that_it_names():
    """Without them it would be refused, and so be ready at once, its kernels left to the engine's thread."""
    kernels, easel, waiting, _ = made()
    told = c.DefineTexture("Rust", "expression", Map({"text": "noise(x, y)"}))
    held = Map({name: Texture(told.maker, told.arguments) for name in (told.name, "another")})
    easel.session = SimpleNamespace(painting=Painting(textures=held))
    brush = Brush(radius=3.0, ink=(Component("Rust"), Component("gabor")))
    waiting.do(q.Begin(0, (0, 0), brush))
    waiting.do(q.Swatch("picked", brush, (8, 8)))
    waiting.do(q.Swatch("lent", brush, (8, 8), textures=(told,)))
    assert len(kernels.jobs) == 3
    assert {definitions.read(json.loads(job.line)["textures"], "") for job, _ in kernels.jobs} == {(told,)}


def test_a_stroke_that_could_be_laid_stays_in_sight_until_it_can_be_committed():
    kernels, easel, waiting, _ = made()
    kernels.come("begin 3.0", "lay 3.0")
    for request in stroke(ROCK, 1, 2):
        waiting.do(request)
    assert easel.live == [3.0, 1.0, 2.0]
    kernels.come("commit 3.0")
    waiting.play()
    assert easel.log == [(3.0, 1.0, 2.0)]


def test_the_pen_may_still_be_down_when_the_kernels_come():
    kernels, easel, waiting, _ = made()
    for request in stroke(ROCK, 1, 2)[:-1]:
        waiting.do(request)
    kernels.come("begin 3.0", "lay 3.0", "commit 3.0")
    waiting.play()
    assert easel.live == [3.0, 1.0, 2.0]
    waiting.do(points(3))
    waiting.do(q.Finish())
    assert easel.log == [(3.0, 1.0, 2.0, 3.0)]


def test_what_its_exercise_left_out_is_compiled_in_the_end():
    kernels, easel, waiting, _ = made()
    for request in stroke(ROCK, 1):
        waiting.do(request)
    kernels.busy = False
    waiting.play()
    assert easel.log == [(3.0, 1.0)]


def test_a_stroke_that_cannot_be_shown_is_sketched_at_once():
    """Nothing is compiled meanwhile: the picture is looked at again without it."""
    kernels, easel, waiting, _ = made()
    kernels.come("begin 3.0", "lay 3.0")
    for request in stroke(ROCK, 1)[:-1]:
        waiting.do(request)
    easel.pending = easel.viewer.pending = 1
    easel.step = lambda: easel._need("see") if easel.live is not None else easel.log.append("seen")
    waiting.step()
    assert easel.live is None
    assert waiting.waits
    assert kernels.jobs[-1][1]
    assert waiting.pending == 1
    waiting.step()
    assert easel.log == ["seen"]
    kernels.come("see")
    waiting.play()
    assert easel.live == [3.0, 1.0]


def test_closing_does_what_waits():
    kernels, easel, waiting, _ = made()
    for request in [*stroke(ROCK, 1), q.Save("p.ora")]:
        waiting.do(request)
    waiting.close()
    assert kernels.closed
    assert easel.log == [(3.0, 1.0), "p.ora", "closed"]


def test_swatches_wait_for_their_brushes_only():
    kernels, easel, waiting, sent = made()
    swatches = [q.Swatch(f"s{brush.radius}", brush, (8, 8)) for brush in (ROCK, PLAIN)]
    waiting.do(q.Prepare(tuple(swatches)))
    for swatch in swatches:
        waiting.do(swatch)
    assert not waiting.step()
    assert easel.swatches == []
    kernels.come(f"begin {PLAIN.radius}")
    kernels.done.add(next(job for job, _ in kernels.jobs if f'"radius": {PLAIN.radius}' in job.line))
    assert waiting.pending == 1
    assert waiting.step()
    assert easel.swatches == [f"s{PLAIN.radius}"]
    assert not waiting.step()
    assert results.Prepared(1, 2) in sent


_requests = st.lists(
    st.one_of(
        st.builds(stroke, st.sampled_from([PLAIN, ROCK]), st.integers(0, 9), st.integers(0, 9)),
        st.sampled_from([[q.Do(c.Undo())], [q.Save("p.ora")]]),
    ),
    max_size=8,
).map(lambda groups: [request for group in groups for request in group])
_names = [f"{what} {brush.radius}" for what in ("begin", "lay", "commit") for brush in (PLAIN, ROCK)] + ["do"]


@settings(deadline=None)
@given(_requests, st.permutations(_names), st.lists(st.integers(0, 12), min_size=7, max_size=7))
def test_the_order_of_commands_is_kept_whenever_kernels_come(requests, names, pauses):
    kernels, easel, waiting, _ = made()
    left = iter(requests)
    for name, pause in zip(names, pauses, strict=True):
        for _, request in zip(range(pause), left, strict=False):
            waiting.do(request)
        kernels.come(name)
        waiting.play()
    for request in left:
        waiting.do(request)
    waiting.play()
    assert not waiting.waits

    plain = Easel(SimpleNamespace(busy=False))
    for request in requests:
        plain.do(request)
    assert easel.log == plain.log
    assert easel.live == plain.live


def test_a_sketch_of_plain_strokes_is_what_they_will_be():
    """Two plain strokes that wait look as the painting does when they are done."""
    sketch, sent = Sketch(), []
    studio = Studio(sent.append, sent.append)
    rows = [(PLAIN, 10.0), (Brush(radius=9.0, hardness=0.4, opacity=0.7, colour="#c04020"), 30.0)]
    rect, level = Rect.at(-20, -20, 120, 120), 0
    requests = []
    for brush, y in rows:
        points = np.zeros((6, 6))
        points[:, 0], points[:, 1], points[:, 2] = np.arange(6) * 12.0, y, np.linspace(0.3, 1.0, 6)
        requests += [q.Begin(level, (0, 0), brush), q.Points(points), q.Finish()]
    sketch.begin(requests)
    seen = sketch.over(level, rect, studio.easel.picture(level, rect))
    for request in requests:
        studio.do(request)
    done = studio.easel.picture(level, rect)
    studio.close()
    assert done[3].max() == 1.0
    assert np.array_equal(to_premul8(seen[:, :39]), to_premul8(done[:, :39]))  # where one stroke lies alone
    assert np.abs(to_premul8(seen).astype(int) - to_premul8(done)).max() <= 1
    assert sketch.rects(level)
    sketch.begin(requests[3:])
    assert np.array_equal(sketch.over(level, Rect.at(0, -20, 9, 9), done[:, :9, :9]), done[:, :9, :9])


def test_a_process_is_asked_for_the_kernels_of_learnt_detail_and_waited_for(monkeypatch):
    """A picture waits for it, for as long as it takes; without learnt detail no longer than PATIENCE."""
    monkeypatch.setattr(waits, "PATIENCE", 0.0)
    learnt = Texture("image", Map(), maps=ImageSource("", ""))
    for texture, asked in ((learnt, [(SEEN_DETAIL, True)]), (Texture("image", Map()), [])):
        kernels, easel, waiting, _ = made()
        easel.session, looked = SimpleNamespace(painting=Painting(textures=Map(a=texture))), []

        def step(looked=looked):
            if kernel_cache._local.watch is not None:
                raise NotCompiled("seen")
            return looked.append("compiled here") is None

        easel.step = step
        for _ in range(3):
            waiting.look(q.Look(((0, 0, 0, -1),)))
            waiting.step()
        assert kernels.jobs == asked
        assert bool(looked) != bool(asked)
        kernels.done.add(SEEN_DETAIL)
        waiting.step()
        assert looked


def test_a_process_is_asked_for_the_kernels_of_what_grows_and_waited_for():
    kernels, easel, waiting, _ = made()
    waiting.step()
    assert kernels.jobs == []
    easel.grower.pending = True
    for _ in range(2):
        waiting.step()
        assert easel.grower.held
        assert waiting.unseen
        assert waiting.due is not None  # it looks again
    ((job, soon),) = kernels.jobs
    assert soon
    kernels.done.add(job)
    waiting.play()
    assert not easel.grower.held
    assert not waiting.unseen
    kernels.busy = False
    waiting.step()
    assert not easel.grower.held
