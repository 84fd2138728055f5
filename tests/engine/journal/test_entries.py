"""Entries as a window lists them: alive or not, damaged or whole, in the bin or to be recovered."""

import fcntl
import os
import subprocess
import sys
import threading
import time

import numpy as np
import pytest

from engine.brush.settings import Brush
from engine.files.fault import WriteError
from engine.journal import entries
from engine.journal.heads import FileStamp, head_of_file, head_of_new
from engine.journal.journal import Journal
from engine.journal.records import Kind, Touch, told_brush, told_command, told_touch
from engine.journal.story import read_story
from engine.journal.volume import End
from engine.journal.writing import Writing
from engine.painting import commands as c
from engine.painting.recording import Header

POINTS = np.arange(24.0).reshape(4, 6)


def stroke(journal, answered=True):
    """A stroke that was asked for."""
    brush = Brush()
    number = journal.begin(told_touch(Touch(0, (0, 0), brush), told_brush(brush)))
    journal.points(number, POINTS)
    journal.end(number, True)
    return number


def settled(journal, folder):
    """The journal's folder, once all is written."""
    end = time.monotonic() + 90
    while not (journal.entry.folder and entries.read_about(journal.entry.folder) and journal.settled):
        assert time.monotonic() < end
        time.sleep(0.01)
    return journal.entry.folder


def test_a_painting_that_was_not_closed_is_listed(tmp_path):
    source, began = tmp_path / "lake.ora", time.time()
    source.write_bytes(b"x" * 100)
    journal = Journal(head_of_file(FileStamp.of(source), True, Header()), tmp_path / "p")
    assert entries.listed(tmp_path / "p") == ()  # nothing was painted
    stroke(journal)
    folder = settled(journal, tmp_path)
    (entry,) = entries.listed(tmp_path / "p")
    assert (entry.name, entry.path, entry.strokes, entry.alive, entry.in_bin) == ("lake.ora", source, 1, True, False)
    assert (entry.number, entry.ident, entry.folder, entry.faults) == (1, folder.name, folder, ())
    assert began <= entry.when <= time.time()
    assert folder.stat().st_mode & 0o777 == 0o700
    with pytest.raises(WriteError, match="is open in a program"):
        entries.discard(entry)
    journal.close(End.STAYS)
    (entry,) = entries.listed(tmp_path / "p")
    assert not entry.alive


def test_what_is_discarded_goes_to_the_bin_and_from_there_for_good(tmp_path):
    journal = Journal(head_of_new(), tmp_path)
    stroke(journal)
    journal.close(End.STAYS)
    entries.discard(entries.listed(tmp_path)[0])
    (entry,) = entries.listed(tmp_path)
    assert entry.in_bin
    assert entries.listed(tmp_path, with_bin=False) == ()
    entries.discard(entry)
    assert not entries.listed(tmp_path)
    assert not entry.folder.exists()


@pytest.mark.parametrize(("end", "bins"), [(End.BIN, [True]), (End.DELETED, []), (End.STAYS, [False])])
def test_how_a_painting_was_closed_decides_where_it_is(tmp_path, end, bins):
    journal = Journal(head_of_new(), tmp_path)
    stroke(journal)
    journal.close(end)
    assert [entry.in_bin for entry in entries.listed(tmp_path)] == bins


def test_another_painting_takes_what_has_no_answer(tmp_path):
    journal = Journal(head_of_new(), tmp_path)
    done, open_one = stroke(journal), stroke(journal)
    journal.answer(done, Kind.REFUSED)
    journal.note(Kind.DID, told_command(c.AddLayer("sky")))
    journal.turn(head_of_new(name="next"), End.BIN)
    last = journal.ask(told_command(c.Undo()))
    journal.close(End.STAYS)
    late, first = entries.listed(tmp_path)
    assert (late.name, late.in_bin, first.in_bin) == ("next", False, True)
    assert list(read_story(late.folder).asked) == [open_one, last]
    assert np.array_equal(read_story(late.folder).asked[open_one].points[0], POINTS)
    assert read_story(late.folder).asked[open_one].finished
    assert not read_story(first.folder).asked


HOLDER = """
import sys, time
from pathlib import Path
from engine.journal.heads import head_of_new
from engine.journal.journal import Journal
from engine.journal.records import told_command
from engine.painting import commands as c
from engine.painting.recording import Header
journal = Journal(head_of_new(), Path(sys.argv[1]))
journal.ask(told_command(c.AddLayer("sky")))
while not journal.settled: time.sleep(0.01)
print("there", flush=True)
time.sleep(600)
"""


def test_another_program_is_seen_alive_until_it_is_killed(tmp_path):
    program = subprocess.Popen([sys.executable, "-c", HOLDER, tmp_path], stdout=subprocess.PIPE)
    try:
        assert program.stdout.readline() == b"there\n"
        (entry,) = entries.listed(tmp_path)
        assert entry.alive
        entries.tidy(tmp_path, today=99)
        assert entry.folder.exists()
        with pytest.raises(BlockingIOError):
            entries.lock_entry(entry.folder)
    finally:
        program.kill()
        program.wait()
        program.stdout.close()
    (entry,) = entries.listed(tmp_path)
    assert not entry.alive


def test_an_entry_is_given_up_at_once_and_taken_though_it_is_being_looked_at(tmp_path):
    lock = entries.lock_entry(tmp_path)
    copy = os.dup(lock)  # as a process has it that is just being started
    entries.unlock_entry(lock)
    assert not entries.is_alive(tmp_path)
    os.close(copy)
    looks = os.open(tmp_path / entries.LOCK_FILE, os.O_RDONLY)
    fcntl.flock(looks, fcntl.LOCK_SH)
    threading.Timer(0.03, os.close, (looks,)).start()  # who lists entries
    entries.unlock_entry(entries.lock_entry(tmp_path))


def test_nothing_is_settled_while_a_disk_brings_it_there(tmp_path, monkeypatch):
    begun, goes_on, sync = threading.Event(), threading.Event(), os.fdatasync

    def slow(descriptor):
        begun.set()
        goes_on.wait(90)
        sync(descriptor)

    monkeypatch.setattr(os, "fdatasync", slow)
    journal = Journal(head_of_new(), tmp_path)
    stroke(journal)
    assert begun.wait(90)
    assert not journal.settled
    goes_on.set()
    settled(journal, tmp_path)
    journal.close(End.STAYS)


def test_a_painting_that_was_left_just_before_the_end_is_kept_in_the_bin(tmp_path, monkeypatch):
    gate, wait = threading.Event(), Writing._wait

    def late(writing):
        gate.wait()
        return wait(writing)

    monkeypatch.setattr(Writing, "_wait", late)
    journal = Journal(head_of_new(name="before"), tmp_path)
    journal.note(Kind.DID, told_command(c.AddLayer("sky")))
    journal.turn(head_of_new(name="after"), End.BIN)
    journal.note(Kind.DID, told_command(c.AddLayer("sea")))
    threading.Timer(0.2, gate.set).start()  # close waits for the thread, which then does all at once
    journal.close(End.STAYS)
    assert {(entry.name, entry.in_bin) for entry in entries.listed(tmp_path)} == {("before", True), ("after", False)}


def test_a_broken_entry_hides_no_other_and_says_so(tmp_path):
    for name in ("whole", "broken"):
        journal = Journal(head_of_new(name=name), tmp_path)
        stroke(journal)
        stroke(journal)
        journal.close(End.STAYS)
    broken = next(entry for entry in entries.listed(tmp_path) if entry.name == "broken").folder
    data = (broken / "journal-1").read_bytes()
    (broken / "journal-1").write_bytes(data[:-30])
    (broken / "about.json").write_bytes(b'{"name": "bro')
    found = {entry.name: entry for entry in entries.listed(tmp_path)}
    assert found["broken"].strokes == 2  # the pen-up of the last is missing
    assert "damaged or incomplete" in found["broken"].faults[0]
    (broken / "journal-1").write_bytes(b"\0" * 200)
    assert {entry.name for entry in entries.listed(tmp_path)} == {"whole", "Untitled"}


def test_the_bin_is_emptied_after_days_of_use(tmp_path, monkeypatch):
    for name in ("first", "second", "kept"):
        journal = Journal(head_of_new(name=name), tmp_path)
        stroke(journal)
        journal.close(End.STAYS if name == "kept" else End.BIN)
    read, glance = [], entries.glance
    monkeypatch.setattr(entries, "glance", lambda folder: read.append(folder) or glance(folder))
    for day in range(100, 130):
        entries.tidy(tmp_path, today=day)
        entries.tidy(tmp_path, today=day)
    assert len(set(read)) == 1, "a journal in the bin was read"
    assert len(entries.listed(tmp_path)) == 3
    entries.tidy(tmp_path, today=130)
    assert [entry.name for entry in entries.listed(tmp_path)] == ["kept"]
