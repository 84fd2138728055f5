"""Checkpoints: a recovery begins at the newest that is whole, and gives the same pixels as the whole journal does."""

import time
from dataclasses import replace

import numpy as np
import pytest
from test_answers import draw, idle
from test_disk_full import until
from test_killed import pixels
from test_recovering import left, painter

from engine.canvas import layers
from engine.journal import entries
from engine.journal.checkpoints import checkpoint_file
from engine.journal.story import read_story
from engine.painting import commands as c
from engine.painting.recording import Header, Recording
from engine.session.replay import replay
from engine.session.session import Session
from engine.studio import requests as q
from engine.studio.filing.recovering import recovered
from opens import recovers_in


@pytest.fixture
def often(monkeypatch):
    """A checkpoint after every command, and no kernel that it would wait for."""
    monkeypatch.setattr("engine.studio.preparing.processes.Preparing.busy", False)
    for name in ("LIMIT", "PAUSE_FACTOR", "PICTURE_PAUSE"):
        monkeypatch.setattr(f"engine.studio.journalled.beside.{name}", 1e-9)


def paint(folder, rounds=6):
    """A painting with checkpoints between its strokes; its entry."""
    worker = painter(folder)
    for n in range(rounds):
        draw(worker, 30, n)
        idle(worker)
        end_of_checkpoint(worker)
    worker.post(q.Do(c.AddLayer("sky")))
    idle(worker)
    end_of_checkpoint(worker)
    left(worker)
    return entries.listed(folder)[0]


def end_of_checkpoint(worker):
    """Waits until nothing is being written beside the journal."""

    def newest():
        story = read_story(worker.entry)
        return any(point.commands == len(story.commands) for point in story.checkpoints)

    until(lambda: worker.entry is not None and newest())


def whole(session):
    """What all commands of a session give from nothing."""
    return replay(Recording(Header(), tuple(session.log))).painting


@pytest.mark.usefixtures("often")
def test_a_recovery_begins_at_the_newest_that_is_whole(tmp_path, monkeypatch):
    entry = paint(tmp_path)
    story = read_story(entry.folder)
    assert [point.commands for point in story.checkpoints] == [1, 2, 3, 4, 5, 6, 7]
    assert len({point.generation % 2 for point in story.checkpoints}) == 2
    assert entry.picture is not None
    begun = []
    done = Session.do
    monkeypatch.setattr(Session, "do", lambda *told: begun.append(told[1]) or done(*told))
    found = recovered(entry.folder)
    assert begun == []  # nothing was left to be done
    assert (found.missing, len(found.session.log), found.known) == ([], 7, True)
    expected = pixels(whole(found.session))
    assert np.array_equal(pixels(found.session.painting), expected)
    newest, older = story.checkpoints[-1], story.checkpoints[-2]
    for point, left_over in ((newest, 1), (older, 7)):
        data = bytearray(checkpoint_file(entry.folder, point.generation).read_bytes())
        data[len(data) // 2] ^= 4
        checkpoint_file(entry.folder, point.generation).write_bytes(data)
        begun.clear()
        found = recovered(entry.folder)
        assert len(begun) == left_over
        assert np.array_equal(pixels(found.session.painting), expected)


@pytest.mark.usefixtures("often")
def test_nothing_that_needs_kernels_is_begun_while_others_compile_them_and_then_by_itself(tmp_path):
    worker = painter(tmp_path)
    idle(worker)  # the engine is loaded, and has told who compiles
    compiling = [True]
    worker._posts.is_compiling = lambda: compiling[0]
    draw(worker, 30, 0)
    idle(worker)
    until(lambda: worker.entry is not None)
    folder = worker.entry
    time.sleep(0.3)
    assert not read_story(folder).checkpoints
    assert not (folder / entries.PICTURE_FILE).exists()
    compiling[0] = False
    end_of_checkpoint(worker)
    until((folder / entries.PICTURE_FILE).exists)
    left(worker)


@pytest.mark.usefixtures("often")
def test_an_undo_behind_the_newest_begins_before_it(tmp_path):
    entry = paint(tmp_path, 3)
    worker = painter(tmp_path)
    idle(worker)
    recovers_in(worker, entry.folder)
    draw(worker, 30, 9)
    idle(worker)
    worker.post(q.Do(c.Undo(1)))
    left(worker)
    found = recovered(entry.folder)
    assert [type(command) for command in found.session.log][-2:] == [c.Stroke, c.Undo]
    assert np.array_equal(pixels(found.session.painting), pixels(whole(found.session)))
    # and one that goes back behind both, which only the whole journal tells
    worker = painter(tmp_path / "other")
    for n in range(3):
        draw(worker, 30, n)
        idle(worker)
        end_of_checkpoint(worker)
    worker.post(q.Do(c.Undo(3)))
    worker.post(q.Do(c.Redo(2)))
    left(worker)
    found = recovered(entries.listed(tmp_path / "other")[0].folder)
    assert np.array_equal(pixels(found.session.painting), pixels(whole(found.session)))
    assert pixels(found.session.painting).any()


@pytest.mark.usefixtures("often")
def test_what_was_copied_is_pasted_though_all_went_down_in_between(tmp_path, monkeypatch):
    aside = c.parse({"do": "layer", "duplicate": "Layer 1", "to": "Copied", "selected": "copy", "aside": True})
    worker = painter(tmp_path)
    draw(worker, 30, 0)
    worker.post(q.Do(aside))  # as older recordings have it, which stays a layer
    worker.post(q.Do(c.CopyPaint("Layer 1")))
    worker.post(q.Do(c.ClearLayer("Layer 1")))
    idle(worker)
    end_of_checkpoint(worker)
    left(worker)
    worker = painter(tmp_path)
    idle(worker)
    recovers_in(worker, entries.listed(tmp_path)[0].folder)
    worker.post(q.Do(c.PastePaint("New")))
    idle(worker)
    left(worker)
    begun, done = [], Session.do
    monkeypatch.setattr(Session, "do", lambda *told: begun.append(type(told[1])) or done(*told))
    found = recovered(entries.listed(tmp_path)[0].folder)
    assert (begun, found.missing) == ([c.PastePaint][len(begun) == 0 :], [])
    painting = found.session.painting
    assert [node.name for node in painting.root.children] == ["Copied", "Layer 1", "New"]
    found.session.do(c.parse({"do": "layer", "duplicate": "Copied", "to": "Other"}))
    found.session.do(c.PastePaint("Again"))
    planes = [
        pixels(replace(painting, root=replace(painting.root, children=(node,))))
        for node in (layers.find(found.session.painting.root, name) for name in ("New", "Other", "Again"))
    ]
    assert planes[0].any()
    assert all(np.array_equal(planes[0], one) for one in planes[1:])
    assert np.array_equal(pixels(found.session.painting), pixels(whole(found.session)))
