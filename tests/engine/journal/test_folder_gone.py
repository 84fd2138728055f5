"""The state folder is removed while one paints: the journal is made anew with all that was painted since the start."""

import errno
import os
import shutil
import time

import numpy as np
import pytest
from PIL import Image
from test_answers import draw, idle, points
from test_disk_full import until
from test_killed import pixels
from test_recovering import copied, left, painter, saved

from engine.archive.opening import open_painting
from engine.journal import entries
from engine.painting import commands as c
from engine.studio import requests as q
from engine.studio import results
from engine.studio.filing.recovering import recovered
from opens import opens_in, recovers_in


@pytest.fixture(autouse=True)
def soon(monkeypatch):
    """What could not be written is tried again at once, and synced; no kernel is waited for."""
    monkeypatch.setattr("engine.journal.writing.RETRY", 0.1)
    monkeypatch.setattr("engine.journal.writing.SYNC_UP", 0.05)
    monkeypatch.setattr("engine.studio.preparing.processes.Preparing.busy", False)


def new(tmp_path, monkeypatch):
    """A painting that began with nothing."""
    return painter(tmp_path / "p"), []


def own_file(tmp_path, monkeypatch):
    """One of a file, which was saved since: what was opened lay beside the journal alone."""
    worker = painter(tmp_path / "p")
    draw(worker, 40, 21)
    saved(worker, tmp_path / "lake.ora")
    opens_in(worker, tmp_path / "lake.ora")
    draw(worker, 40, 22)
    saved(worker, tmp_path / "lake.ora")
    return worker, [40, 40]


def picture(tmp_path, monkeypatch):
    """One of a picture, which is gone since."""
    rng = np.random.default_rng(4)
    Image.fromarray(rng.integers(0, 255, (60, 80, 4), np.uint8)).save(tmp_path / "photo.png")
    worker = painter(tmp_path / "p")
    idle(worker)
    opens_in(worker, tmp_path / "photo.png")
    draw(worker, 40, 23)
    idle(worker)
    (tmp_path / "photo.png").unlink()
    return worker, [40]


def taken_again(tmp_path, monkeypatch):
    """One that was recovered: its journal is in its second file."""
    worker = painter(tmp_path / "p")
    draw(worker, 40, 24)
    left(worker)
    (entry,) = entries.listed(tmp_path / "p")
    worker = painter(tmp_path / "p")
    idle(worker)
    recovers_in(worker, entry.folder)
    return worker, [40]


def picture_again(tmp_path, monkeypatch):
    """One of a picture that is gone, recovered from a checkpoint: nobody knows how it was made."""
    monkeypatch.setattr("engine.studio.journalled.beside.LIMIT", 1e-9)
    worker, _ = picture(tmp_path, monkeypatch)
    folder = worker._posts.journal.entry.folder
    until(lambda: list(folder.glob("checkpoint-*.ora")))
    left(worker)
    worker = painter(tmp_path / "p")
    idle(worker)
    recovers_in(worker, folder)
    idle(worker)
    return worker, []


def refused(tmp_path, monkeypatch):
    """One that a disk refused to sync: its journal is in its second file."""
    real, refuse = os.fdatasync, [1]

    def fdatasync(descriptor):
        if refuse:
            refuse.pop()
            raise OSError(errno.EIO, os.strerror(errno.EIO))
        real(descriptor)

    monkeypatch.setattr(os, "fdatasync", fdatasync)
    worker = painter(tmp_path / "p")
    draw(worker, 40, 25)
    idle(worker)
    until(lambda: not refuse and worker._posts.journal.settled)
    draw(worker, 40, 26)
    return worker, [40, 40]


def removed(folder):
    """Removes it at once, though somebody is writing there."""
    shutil.rmtree(folder.rename(folder.with_name(f"gone-{time.monotonic_ns()}")))


def whole(worker, folder):
    """Waits until all that was painted is on disk where no power cut takes it, in the one folder that there is: what is
    begun anew has one beside it, that was written again at once and goes as soon as the other is on disk."""
    journal = worker._posts.journal

    def is_whole():
        idle(worker)
        entry = journal.entry  # one for all looks: another one may take its place meanwhile
        return journal.settled and not entry.lost and not entry._recent and [entry.folder] == list(folder.glob("*"))

    until(is_whole)


def then(worker, tmp_path):
    """What a `kill -9` would leave now: the one entry, recovered."""
    found = []
    until(lambda: found.append(copied(tmp_path / "p", tmp_path)) or found[-1])
    (entry,) = entries.listed(found[-1])
    assert not entry.in_bin
    assert not entry.faults
    return entry, recovered(entry.folder)


def same(worker, found, tmp_path):
    """Tells whether what was recovered is what is on the easel, bit for bit."""
    saved(worker, tmp_path / "seen.ora")
    expected = pixels(open_painting(tmp_path / "seen.ora").painting)
    return np.array_equal(pixels(found.session.painting), expected) and expected.any()


def strokes(found):
    """The points of each stroke that the journal tells of; of a picture, a session does not know those before its
    checkpoint."""
    return [len(command.points) for command in found.story.commands if isinstance(command, c.Stroke)]


@pytest.mark.parametrize("begins", [new, own_file, picture, taken_again, picture_again, refused])
def test_nothing_is_lost_when_the_folder_is_removed(tmp_path, monkeypatch, begins):
    worker, before = begins(tmp_path, monkeypatch)
    draw(worker, 30, 1)
    draw(worker, 31, 2)
    whole(worker, tmp_path / "p")
    removed(tmp_path / "p")
    draw(worker, 32, 3)
    draw(worker, 33, 4, end=False)  # the pen is down
    time.sleep(0.2)
    worker.post(q.Finish())
    whole(worker, tmp_path / "p")
    entry, found = then(worker, tmp_path)
    assert (strokes(found), found.missing) == ([*before, 30, 31, 32, 33], [])
    removed(tmp_path / "p")  # and once more
    worker.post(q.Do(c.Undo(3)))  # behind where it began anew
    draw(worker, 34, 5)
    whole(worker, tmp_path / "p")
    again, found = then(worker, tmp_path)
    assert (strokes(found), found.missing) == ([*before, 30, 31, 32, 33, 34], [])
    assert (entry.name, entry.path) == (again.name, again.path)
    assert same(worker, found, tmp_path)
    worker.close(60)
    assert [one for one in entries.listed(tmp_path / "p") if not one.in_bin] == []


def test_it_is_told_until_it_is_kept_again(tmp_path, monkeypatch):
    worker, _ = taken_again(tmp_path, monkeypatch)
    draw(worker, 30, 1, end=False)
    idle(worker)
    removed(tmp_path / "p")
    worker.post(q.Points(points(5, 2)))
    told = []
    until(lambda: told.extend(journal_notes(idle(worker))) or told)
    assert told == ["What you paint is kept in memory only: the folder of the journal is gone"]
    time.sleep(0.3)
    assert entries.listed(tmp_path / "p") == ()  # of a stroke in progress nothing can be told twice
    worker.post(q.Finish())
    until(lambda: told.extend(journal_notes(idle(worker))) or len(told) > 1)
    assert told[1:] == ["What you paint is on disk again"]
    left(worker)


def test_a_painting_that_its_file_holds_is_not_offered(tmp_path):
    worker = painter(tmp_path / "p")
    draw(worker, 30, 1)
    saved(worker, tmp_path / "lake.ora")
    removed(tmp_path / "p")
    worker.post(q.Do(c.View(0.0, (0, 0), (100, 100))))
    journal = worker._posts.journal
    until(lambda: idle(worker) is not None and journal.settled and not journal.entry.lost)
    until(lambda: entries.listed(tmp_path / "p") == () and (tmp_path / "p").exists())
    draw(worker, 30, 2)
    whole(worker, tmp_path / "p")
    entry, found = then(worker, tmp_path)
    assert (entry.name, entry.path) == ("lake.ora", tmp_path / "lake.ora")
    assert strokes(found) == [30, 30]
    left(worker)


@pytest.mark.parametrize("known", [False, True])
def test_it_is_begun_anew_where_the_program_ends_at_once(tmp_path, monkeypatch, known):
    worker, before = taken_again(tmp_path, monkeypatch)
    draw(worker, 30, 1)
    whole(worker, tmp_path / "p")
    removed(tmp_path / "p")
    draw(worker, 31, 2, end=not known)
    if known:  # that it is gone, while a stroke is in progress
        until(lambda: idle(worker) is not None and worker._posts.journal.entry.lost)
        worker.post(q.Finish())
    left(worker)
    assert strokes(then(worker, tmp_path)[1]) == [*before, 30, 31]


@pytest.mark.parametrize("gone", ["journal-1", "journal-2", "all"])
@pytest.mark.parametrize("down", [False, True])
def test_nothing_is_lost_when_the_engine_stops_before_it_is_begun_anew(tmp_path, monkeypatch, faults, gone, down):
    worker, before = taken_again(tmp_path, monkeypatch)
    draw(worker, 30, 1)
    whole(worker, tmp_path / "p")
    if down:  # the pen is down
        draw(worker, 31, 2, end=False)
        idle(worker)
    monkeypatch.setattr("engine.studio.studio.Studio.look", stopped)
    if gone == "all":
        removed(tmp_path / "p")
    else:
        (worker.entry / gone).unlink()
    worker.post(q.Look(()))
    until(lambda: any(isinstance(result, results.Stopped) for result in worker.results()))
    assert worker.close(60, by_choice=False)
    assert strokes(then(worker, tmp_path)[1]) == [*before, 30, *([31] if down else [])]
    assert [record.getMessage() for record in faults] == ["a fault that ends the engine's thread"]
    faults.clear()


def stopped(studio, look):
    raise SystemExit  # what no command raises


def test_what_is_left_of_a_folder_that_is_removed_in_part_is_not_offered(tmp_path, monkeypatch):
    worker, before = taken_again(tmp_path, monkeypatch)
    draw(worker, 30, 1)
    whole(worker, tmp_path / "p")
    folder = worker.entry
    (folder / "journal-1").unlink()
    draw(worker, 31, 2)
    until(lambda: worker.entry not in (None, folder))
    whole(worker, tmp_path / "p")
    assert strokes(then(worker, tmp_path)[1]) == [*before, 30, 31]
    left(worker)
    assert len(list((tmp_path / "p").iterdir())) == 1


def test_what_was_never_painted_on_is_not_offered_and_how_long_it_took_is_kept(tmp_path, monkeypatch):
    monkeypatch.setattr("engine.journal.writing.LOOK", 0.1)
    worker = painter(tmp_path / "p")
    idle(worker)
    until(lambda: worker.entry is not None)
    folder = worker.entry
    removed(tmp_path / "p")
    until(
        lambda: idle(worker) is not None and worker.entry not in (None, folder) and not worker._posts.journal.entry.lost
    )
    assert entries.listed(tmp_path / "p") == ()
    for name, clock in (("sky", 1000.0), ("sea", 1030.0), ("land", 5000.0)):  # away after the second
        worker.post(q.Do(c.AddLayer(name), time=clock))
    whole(worker, tmp_path / "p")
    folder = worker.entry
    removed(tmp_path / "p")
    until(lambda: worker.entry not in (None, folder))
    whole(worker, tmp_path / "p")
    assert 90.0 <= entries.listed(tmp_path / "p")[0].seconds < 150.0
    left(worker)


def test_it_is_seen_though_nobody_paints(tmp_path, monkeypatch):
    monkeypatch.setattr("engine.journal.writing.LOOK", 0.1)
    worker = painter(tmp_path / "p")
    draw(worker, 30, 1)
    whole(worker, tmp_path / "p")
    removed(tmp_path / "p")
    whole(worker, tmp_path / "p")
    assert strokes(then(worker, tmp_path)[1]) == [30]
    left(worker)


def journal_notes(found):
    return [result.text for result in found if getattr(result, "about", "") == "journal"]
