"""What the engine makes of requests is told in the journal, so that the same commands stand in it as in its log."""

import time

import numpy as np
import pytest

from engine.brush.settings import Brush
from engine.journal.heads import head_of_new
from engine.journal.journal import Journal
from engine.journal.story import read_story
from engine.painting import commands as c
from engine.studio import requests as q
from engine.studio import results
from engine.studio.journalled.posts import Posts
from engine.studio.worker import Worker


@pytest.fixture
def worker(tmp_path):
    one = Worker(lambda: None, posts=Posts(Journal(head_of_new(), tmp_path / "p")))
    yield one
    one.close(60, by_choice=False)


def points(n, seed=0):
    """So many points of a pen."""
    told = np.random.default_rng(seed)
    line = np.cumsum(told.uniform(-6, 8, (n, 2)), axis=0) + 60
    return np.column_stack([line, told.uniform(0.2, 1, n), np.zeros((n, 2)), np.arange(n) * 0.008])


def draw(worker, count=20, seed=0, brush=None, end=True, copies=()):
    """A stroke, as a window posts it."""
    worker.post(q.Begin(0, (0, 0), brush or Brush(radius=8.0), time=1000.5, copies=copies))
    for part in np.array_split(points(count, seed), 4):
        worker.post(q.Points(part))
    if end:
        worker.post(q.Finish())


def idle(worker, seconds=120):
    """The results, once all is carried out."""
    end, found = time.monotonic() + seconds, []
    while worker.behind or not getattr(worker, "loaded", False):
        found += worker.results()
        worker.loaded = getattr(worker, "loaded", False) or any(isinstance(result, results.Ready) for result in found)
        assert time.monotonic() < end
        time.sleep(0.01)
    return found + worker.results()


def test_strokes_and_commands_stand_in_it_as_in_the_log(worker, tmp_path):
    worker.post(q.Do(c.AddLayer("sky"), time=999.25))
    draw(worker, 50, 1)
    draw(worker, 50, 2, end=False)
    worker.post(q.Abandon())
    draw(worker, 30, 3, Brush(mode="erase"))
    worker.post(q.Do(c.RemoveLayer("no such layer")))
    worker.post(q.Begin(0, (0, 0), Brush(example="none", mode="example")))  # refused
    worker.post(q.Points(points(5)))
    worker.post(q.Finish())
    worker.post(q.Do(c.Undo(7)))
    draw(worker, 40, 4)
    worker.post(q.Begin(0, (0, 0), Brush()))
    worker.post(q.Points(points(5, 5)))
    worker.post(q.Do(c.SetLayer("sky", opacity=0.5)))  # ends the stroke
    worker.post(q.Save(tmp_path / "p.ora"))
    found = idle(worker)
    while not any(isinstance(result, results.Saved) for result in found):
        found += worker.results()
        time.sleep(0.01)
    worker.close(60, by_choice=False)
    (folder,) = (tmp_path / "p").iterdir()
    story = read_story(folder)
    from engine.archive.opening import open_painting

    log = open_painting(tmp_path / "p.ora").recording.commands
    assert [type(command) for command in log][1:4] == [c.Stroke, c.Stroke, c.Undo]
    assert tuple(story.commands) == log
    assert (story.asked, story.faults) == ({}, [])
    assert story.saved == {"path": str(tmp_path / "p.ora"), "commands": len(log)}


def test_a_stroke_too_long_for_one_command_is_told_in_parts(worker, tmp_path, monkeypatch):
    monkeypatch.setattr("engine.strokes.live_stroke.POINTS_CAP", 30)
    draw(worker, 100, 6)
    worker.post(q.Begin(0, (0, 0), Brush()))
    worker.post(q.Points(points(60, 7)))
    worker.post(q.Abandon())  # what is over 30 points stays
    idle(worker)
    worker.close(60, by_choice=False)
    (folder,) = (tmp_path / "p").iterdir()
    story = read_story(folder)
    assert [len(command.points) for command in story.commands] == [50, 50, 60]
    assert not story.asked
    assert not story.faults
