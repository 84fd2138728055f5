"""The real studio while kernels come one by one: what was asked for is done in its order, once, and seen as it is."""

import sys
from contextlib import contextmanager

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numba.core.dispatcher import Dispatcher

from engine.brush.settings import Brush
from engine.kernel_cache import NotCompiled
from engine.numeric.colour import to_premul8
from engine.numeric.stand_in import Kernel
from engine.painting import commands as c
from engine.studio import requests as q
from engine.studio import results
from engine.studio.preparing import sketch, waiting, waiting_line
from engine.studio.preparing.waiting import Waiting
from engine.studio.sight import tile_rect
from engine.studio.studio import Studio

TILES = ((-1, -1, 0), (-1, 0, 0))
BRUSH = Brush(radius=5.0, opacity=0.8)


class Preparing:
    """In place of `preparing.processes`: kernels are there when a test says so."""

    def __init__(self):
        self.busy, self.refused, self.count, self.there = True, False, 0, set()

    def want(self, jobs, soon=False):
        pass

    def ready(self, job):
        return not self.busy

    def painting(self, painting):
        pass

    def close(self):
        self.busy = False

    def come(self, name):
        self.there.add(name)
        self.count += 1

    @contextmanager
    def refusing(self, whether=True):
        before, self.refused = self.refused, whether
        try:
            yield
        finally:
            self.refused = before


class Lacking:
    """A kernel that is there when it has come."""

    def __init__(self, name, real, kernels, missed):
        self._name, self._real, self._kernels, self._missed = name, real, kernels, missed

    def __call__(self, *arguments):
        kernels = self._kernels()
        if kernels is not None and kernels.refused and self._name not in kernels.there:
            self._missed.add(self._name)
            if isinstance(self._real, Kernel):
                return self._real.plain(*arguments)
            raise NotCompiled(self._name)
        return self._real(*arguments)

    def __getattr__(self, name):
        return getattr(self._real, name)


class Window:
    """What posts requests and remembers the tiles that it was sent."""

    def __init__(self, kernels):
        self.tiles, self.revisions = {}, {}
        self.studio = Studio(self.take, lambda request: None)
        self.bench = Waiting(self.studio, kernels, self.take)

    def take(self, result):
        if isinstance(result, results.Patch):
            tile = self.tiles.setdefault(result.tile, np.zeros((q.SCREEN_TILE, q.SCREEN_TILE, 4), np.uint8))
            a = result.area
            tile[a.y0 : a.y1, a.x0 : a.x1] = result.pixels
            self.revisions[result.tile] = result.revision
        elif isinstance(result, results.Same):
            self.revisions.update(dict.fromkeys(result.tiles, result.revision))

    def look(self):
        self.bench.look(q.Look(tuple((*tile, self.revisions.get(tile, -1)) for tile in TILES)))

    def work(self, most=1000):
        for _ in range(most):
            if not self.bench.pending:
                self.bench.play()
                if not self.bench.pending:
                    return
            self.bench.step()


def stroke(y):
    points = np.zeros((4, 6))
    points[:, 0], points[:, 1], points[:, 2] = np.arange(4) * 30.0 - 40.0, y, 1.0
    return [q.Begin(-1, (0, 0), BRUSH), q.Points(points[:2]), q.Points(points[2:]), q.Finish()]


@pytest.fixture(scope="module")
def missed():
    """All that is asked for is done once, so that every kernel is loaded; then those that it needs can be missed."""
    found, holder = set(), [None]
    patched = []
    plain(ASKED)
    for module in [m for name, m in sys.modules.items() if name.startswith("engine.") and m is not None]:
        for name, value in list(vars(module).items()):
            if isinstance(value, Dispatcher | Kernel):
                real = value.compiled if isinstance(value, Kernel) else value
                key = f"{real.py_func.__module__}.{real.py_func.__name__}"
                setattr(module, name, Lacking(key, value, lambda: holder[0], found))
                patched.append((module, name, value))
    used = set()
    holder[0] = probe = Preparing()
    for module in (waiting, waiting_line, sketch):
        patched.append((module, "refusing", module.refusing))
        module.refusing = lambda whether=True: holder[0].refusing(whether)
    while True:  # each try tells the next ones that are missing
        window = Window(probe)
        window.look()
        for request in ASKED:
            window.bench.do(request)
            window.work(20)
        new = found - probe.there
        if not new:
            break
        for name in new:
            probe.come(name)
        window.studio.close()
    used |= found
    yield holder, sorted(used)
    for module, name, value in patched:
        setattr(module, name, value)


ASKED = [*stroke(0.0), *stroke(60.0), q.Do(c.Undo())]


def plain(requests):
    studio = Studio(lambda result: None, lambda request: None)
    for request in requests:
        studio.do(request)
    for tile in TILES:
        studio.easel.picture(tile[0], tile_rect(tile))
    return studio


@settings(deadline=None, max_examples=20)
@given(st.data())
def test_whenever_kernels_come_the_window_ends_up_with_what_was_asked_for(missed, data):
    holder, names = missed
    kernels = holder[0] = Preparing()
    window = Window(kernels)
    window.look()
    left, coming = list(ASKED), data.draw(st.permutations(names))
    deeds = data.draw(
        st.lists(st.sampled_from(["ask", "ask", "come", "come", "play", "look", "work", "step"]), max_size=60)
    )
    for deed in deeds:
        if deed == "ask" and left:
            window.bench.do(left.pop(0))
        elif deed == "come" and coming:
            kernels.come(coming.pop())
        elif deed == "play":
            window.bench.play()
        elif deed == "look":
            window.look()
        elif deed == "work":
            window.work(30)
        elif deed == "step" and window.bench.pending:
            window.bench.step()
    for request in left:
        window.bench.do(request)
        window.work(3)
    for name in coming:
        kernels.come(name)
        window.bench.play()
        window.work(5)
    kernels.busy = False
    window.bench.play()
    window.work()
    window.look()
    window.work()
    assert [type(command).__name__ for command in window.studio.easel.session.log] == ["Stroke", "Stroke", "Undo"]
    first, second, _ = window.studio.easel.session.log
    assert first.points[0, 1] == 0.0
    assert second.points[0, 1] == 60.0
    for tile in TILES:
        assert np.array_equal(window.tiles[tile], to_premul8(window.studio.easel.picture(tile[0], tile_rect(tile)))), (
            tile
        )
    window.studio.close()
