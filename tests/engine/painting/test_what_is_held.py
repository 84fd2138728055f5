"""What a painting keeps in memory: what nothing leads to any more is gone."""

import gc
import weakref

import numpy as np

from engine.brush.settings import Brush
from engine.canvas import layers
from engine.canvas.commit import _MOST_WAITING
from engine.canvas.tile_cache import TileCache
from engine.numeric.address import Rect
from engine.painting import commands as c
from engine.painting.value import Painting
from engine.session.history import History
from engine.session.session import Session
from engine.studio import requests as q
from engine.studio.held import holding
from engine.studio.held.held_records import Held
from engine.studio.studio import Studio

POINTS = np.array([[10.0, 10, 1, 0, 0, 0], [40, 30, 1, 0, 0, 0.1]])


def stroke(level, n=0):
    points = POINTS.copy()
    points[:, 0] += n % 5
    return c.Stroke(level, (0, 0), points, Brush(radius=6.0, opacity=0.5))


def pyramid_of(session):
    return next(layers.layers(session.painting.root)).pyramid


def test_what_waited_for_finer_detail_is_gone_when_it_was_applied_and_no_step_leads_back():
    session = Session(Painting(Rect.at(0, 0, 64, 64), 7), TileCache(4 << 20), history=History(0))
    session.do(stroke(1))
    held = []
    before, now = set(), set()
    for n in range(_MOST_WAITING + 6):
        session.do(stroke(0, n))
        waiting = [a for waits in pyramid_of(session).waiting() for a in waits.keep.values()]
        held += map(weakref.ref, waiting)
        before, now = now, set(map(id, waiting))
        del waiting
    assert len(held) > 2 * _MOST_WAITING
    gc.collect()
    assert {id(ref()) for ref in held if ref() is not None} <= now | before  # the last step leads back to one more
    assert len(now) <= _MOST_WAITING


def test_a_stroke_is_not_kept_when_it_is_paint():
    studio = Studio(lambda result: None, lambda request: None)
    studio.do(q.New(Rect.at(0, 0, 96, 96)))
    strokes = []
    for drop in (False, True, False):
        studio.do(q.Begin(0, (0, 0), Brush(radius=6.0)))
        strokes.append(weakref.ref(studio.easel.live))
        studio.do(q.Points(POINTS))
        studio.look(q.Look(((0, 0, 0, -1),)))
        while studio.step():
            pass
        studio.do(q.Abandon() if drop else q.Finish())
    gc.collect()
    assert [ref() for ref in strokes] == [None, None, None]
    studio.close()


def test_the_window_is_told_who_holds_what(monkeypatch):
    sent, taken = [], [100 << 20]
    monkeypatch.setattr(holding.memory, "resident", lambda: taken[0])
    monkeypatch.setattr(holding, "_APART", 0.0)
    monkeypatch.setattr(holding, "_SHARE", 0)
    studio = Studio(sent.append, lambda request: None)
    studio.holding = holding.Holding(studio.easel)
    studio.do(q.New(Rect.at(0, 0, 96, 96)))
    for more in (0, 0, 50 << 20):
        taken[0] += more
        studio.do(q.Do(stroke(0)))
        studio.look(q.Look(((0, 0, 0, -1),)))
        while studio.step():
            pass
    assert len([r for r in sent if isinstance(r, Held)]) == 2  # the process did not grow the second time
    told = [r for r in sent if isinstance(r, Held)][-1]
    session, rows = studio.easel.session, dict(told.rows)
    assert told.resident == taken[0]
    assert rows["Painting"] == pyramid_of(session).nbytes > 0
    assert rows["Undo"] == session.history.held > 0
    assert rows["What is on the screen"] == session.cache.held
    assert rows["Strokes as they were drawn"] == 3 * POINTS.nbytes
    assert rows["Pictures"] == 0
    studio.close()
