"""Disks that are full, gone, or refuse: painting goes on, and all of it is on disk as soon as that can be."""

import errno
import os
import shutil
import subprocess
import time

import numpy as np
import pytest
from PIL import Image
from test_answers import draw, idle
from test_killed import pixels
from test_recovering import left, painter, saved

from engine.archive.opening import open_painting
from engine.journal import entries
from engine.journal.frames import frames_in
from engine.journal.heads import head_of_new
from engine.journal.journal import Journal
from engine.journal.records import told_command
from engine.journal.story import read_story
from engine.journal.volume import End
from engine.painting import commands as c
from engine.studio import requests as q
from engine.studio import results
from engine.studio.filing.recovering import recovered
from opens import opens_in


@pytest.fixture(autouse=True)
def soon(monkeypatch):
    """What could not be written is tried again at once, and synced."""
    monkeypatch.setattr("engine.journal.writing.RETRY", 0.1)
    monkeypatch.setattr("engine.journal.writing.SYNC_UP", 0.05)


@pytest.fixture
def small_disk(tmp_path):
    """A disk of 4 MB."""
    folder = tmp_path / "disk"
    folder.mkdir()
    command = ["mount", "-t", "tmpfs", "-o", "size=4m", "tmpfs", folder]
    mounted = subprocess.run(command, capture_output=True, text=True)
    if mounted.returncode:
        pytest.skip(f"no disk can be mounted here: {mounted.stderr.strip()}")
    yield folder
    subprocess.run(["umount", "-l", folder], check=True)


def until(condition, seconds=120.0):
    end = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < end
        time.sleep(0.02)


def test_a_disk_fills_while_one_paints_and_saves(small_disk):
    file, told = small_disk / "lake.ora", []
    worker = painter(small_disk / "p")
    draw(worker, 40, 0)
    saved(worker, file)
    old = file.read_bytes()
    room = shutil.disk_usage(small_disk).free
    (small_disk / "filler").write_bytes(bytes(room - 3000))  # the journal has some of it, then nothing
    for n in range(1, 12):
        draw(worker, 60, n)
    worker.post(q.Save(file))
    until(lambda: told.extend(idle(worker)) or any(getattr(note, "about", "") == "save" for note in told))
    notes = [note for note in told if isinstance(note, results.Note)]
    assert file.read_bytes() == old
    until(lambda: notes.extend(idle(worker)) or any(getattr(note, "about", "") == "journal" for note in notes))
    (full,) = [note for note in notes if getattr(note, "about", "") == "journal"]
    assert full.stays
    assert full.text == "What you paint is kept in memory only: the disk is full"
    folder = worker.entry
    assert len(read_story(folder).commands) < 12
    (small_disk / "filler").unlink()
    until(lambda: any(getattr(note, "text", "") == "What you paint is on disk again" for note in worker.results()))
    assert len(read_story(folder).commands) == 12
    draw(worker, 60, 12)
    saved(worker, file)
    left(worker)
    found = recovered(folder)
    assert found.missing == []
    assert np.array_equal(pixels(found.session.painting), pixels(open_painting(file).painting))


def test_what_was_opened_is_kept_as_soon_as_there_is_room(small_disk, tmp_path, monkeypatch):
    monkeypatch.setattr("engine.studio.journalled.opened.RETRY", 0.1)
    file = tmp_path / "photo.png"
    Image.fromarray(np.random.default_rng(5).integers(0, 255, (600, 800, 3), np.uint8)).save(file)
    worker = painter(small_disk / "p")
    idle(worker)
    (small_disk / "filler").write_bytes(bytes(shutil.disk_usage(small_disk).free - 200_000))
    opens_in(worker, file)
    draw(worker, 40, 1)
    until(lambda: idle(worker) is not None and worker.entry is not None)
    folder = worker.entry
    until(lambda: len(read_story(folder).commands) == 1)
    time.sleep(0.5)  # it is tried now and then
    assert read_story(folder).base is None
    (small_disk / "filler").unlink()
    until(lambda: read_story(folder).base is not None)  # though nothing is painted
    file.unlink()
    left(worker)
    found = recovered(folder)
    assert found.missing == []
    assert pixels(found.session.painting)[:, 500:, 700:].any()  # of the picture: nothing was painted there


def asked(journal, count):
    """So many commands, asked for."""
    for n in range(count):
        journal.ask(told_command(c.AddLayer(f"layer {n}")))


def test_a_folder_that_cannot_be_made_is_made_later(tmp_path):
    (tmp_path / "p").write_text("in the way")
    told = []
    journal = Journal(head_of_new(), tmp_path / "p")
    journal.hear(told.append)
    asked(journal, 5)
    until(lambda: told)
    (tmp_path / "p").unlink()
    until(lambda: journal.settled)
    until(lambda: told[-1] is None)
    journal.close(End.STAYS)
    (entry,) = entries.listed(tmp_path / "p")
    assert len(read_story(entry.folder).asked) == 5


def test_a_folder_that_vanishes_is_made_anew(tmp_path):
    journal = Journal(head_of_new(), tmp_path / "p")
    asked(journal, 5)
    until(lambda: journal.settled)
    shutil.rmtree(tmp_path / "p")
    asked(journal, 2)
    until(lambda: journal.entry.folder is not None and journal.settled and entries.listed(tmp_path / "p"))
    journal.close(End.STAYS)
    (entry,) = entries.listed(tmp_path / "p")
    assert len(read_story(entry.folder).asked) == 7


def test_what_a_disk_refused_to_sync_is_written_again_elsewhere(tmp_path, monkeypatch):
    told, real, refuse = [], os.fdatasync, []
    lost = []

    def fdatasync(descriptor):
        if refuse:
            refuse.pop()
            kept = os.fstat(descriptor).st_size - 60
            lost.append(kept)
            os.ftruncate(descriptor, kept)  # as a disk that dropped what it could not write
            raise OSError(errno.EIO, os.strerror(errno.EIO))
        real(descriptor)

    monkeypatch.setattr(os, "fdatasync", fdatasync)
    journal = Journal(head_of_new(), tmp_path)
    journal.hear(told.append)
    asked(journal, 5)
    until(lambda: journal.settled)
    refuse += [1, 1]
    asked(journal, 3)
    until(lambda: not refuse and journal.settled)
    asked(journal, 1)
    journal.close(End.STAYS)
    (entry,) = entries.listed(tmp_path)
    assert len(lost) == 2
    assert sorted(path.name for path in entry.folder.glob("journal-*")) == ["journal-1", "journal-2", "journal-3"]
    story = read_story(entry.folder)
    assert (len(story.asked), story.faults) == (9, [])


def test_a_write_that_stops_within_a_frame_is_taken_back(tmp_path, monkeypatch):
    """A disk that becomes full within a record: what is there of it goes before anything else comes."""
    real, short = os.write, []

    def write(descriptor, data):
        if short and len(data) > short[0]:
            return real(descriptor, data[: short.pop()])
        return real(descriptor, data)

    monkeypatch.setattr(os, "write", write)
    journal = Journal(head_of_new(), tmp_path)
    asked(journal, 3)
    until(lambda: journal.settled)
    short.append(20)
    asked(journal, 4)
    until(lambda: journal.settled)
    journal.close(End.STAYS)
    (entry,) = entries.listed(tmp_path)
    data = (entry.folder / "journal-1").read_bytes()
    assert frames_in(data)[1] == len(data)
    assert len(read_story(entry.folder).asked) == 7
