"""A painting that was not closed is opened again, goes on in its entry, and can be opened again after that."""

import json
import shutil
import threading
import time
from types import SimpleNamespace

import numpy as np
import pytest
from headless import pen
from test_answers import draw, idle, points
from test_killed import pixels

from app.__main__ import main
from engine.archive.opening import open_painting
from engine.brush.copies import Copy, symmetric
from engine.brush.settings import Brush
from engine.canvas.placing.pose import Pose
from engine.journal import entries
from engine.journal.heads import FileStamp, head_of_new
from engine.journal.journal import Journal
from engine.journal.kept import keep_file, kept_file
from engine.journal.records import Touch, told_brush, told_touch
from engine.journal.story import read_story
from engine.journal.volume import End, Volume
from engine.painting import commands as c
from engine.painting.layering.mask_member import MASK_FULL, MaskOp
from engine.painting.layering.onto_member import ONTO_MASK
from engine.studio import requests as q
from engine.studio import results
from engine.studio.filing import recovering
from engine.studio.filing.opening_requests import CancelOpening, Show
from engine.studio.filing.recovering import recovered
from engine.studio.journalled import opened
from engine.studio.journalled.posts import Posts
from engine.studio.selecting.tint_records import MaskBegin, MaskEnd, MaskPoints
from engine.studio.worker import Worker
from opens import opens_in, recovers_in


def painter(folder):
    """A worker with a journal."""
    return Worker(lambda: None, posts=Posts(Journal(head_of_new(), folder)))


def left(worker):
    """Ends it as a signal would."""
    idle(worker)
    worker.close(60, by_choice=False)


def copied(folder, tmp_path):
    """A copy of a folder in which others write; None if anything came or went meanwhile: no moment was ever like it."""
    copy = tmp_path / f"then-{time.monotonic_ns()}"
    try:
        return shutil.copytree(folder, copy)
    except OSError:
        return None


def left_over(worker, tmp_path):
    """A copy of its entry, as a `kill -9` would leave it now that all is on disk."""
    end = time.monotonic() + 90
    while not (worker.journal.settled and (copy := copied(worker.entry, tmp_path))):
        assert time.monotonic() < end
        time.sleep(0.02)
    return copy


def first(worker, kind):
    """The first result of this kind that comes; the others are dropped."""
    while True:
        came = worker.results()
        worker.loaded = getattr(worker, "loaded", False) or any(isinstance(one, results.Ready) for one in came)
        if found := [one for one in came if isinstance(one, kind)]:
            return found[0]
        time.sleep(0.01)


def saved(worker, path):
    """Saves, and waits until that is done."""
    worker.post(q.Save(path))
    found = []
    while not any(isinstance(result, results.Saved) for result in found):
        found += idle(worker)
        time.sleep(0.002)


def test_the_copies_of_a_stroke_are_recovered_of_one_in_hand_too(tmp_path):
    folder, copies = tmp_path / "p", symmetric((80.0, 90.0), 3, (0.6, 0.8))
    one = painter(folder)
    draw(one, 40, 1, copies=copies)
    draw(one, 40, 2, end=False, copies=copies)
    left(one)
    (entry,) = entries.listed(folder)
    assert [command.copies for command in recovered(entry.folder).session.log] == [copies, copies]


def test_strokes_in_hand_on_a_mask_and_on_the_quick_mask_are_recovered_as_such(tmp_path):
    posts = Posts(Journal(head_of_new(), tmp_path / "p"))  # no engine answers, as where one was killed at once
    for command in (c.AddLayer("sky"), c.SetLayer("sky", mask=MaskOp(MASK_FULL))):
        posts.tell(q.Do(command))
    brush, line, copies = Brush(radius=8.0), points(20), (Copy(1.0, 0.0, 5.0, 0.0, True),)
    posts.tell(q.Begin(0, (3, 4), brush, onto=ONTO_MASK, seen=Pose((7, -2), 1, -1, 3, mirror=True)))
    posts.tell(q.Points(line))
    posts.tell(q.Finish())
    for takes, dropped in ((False, True), (False, False)):
        posts.tell(MaskBegin(1, (5, 6), brush, takes, copies))
        posts.tell(MaskPoints(line))
        if dropped:
            posts.tell(MaskEnd())
    posts.close(stays=True)
    (entry,) = entries.listed(tmp_path / "p")
    found = recovered(entry.folder)
    _, _, stroke, select = found.session.log
    assert (stroke.onto, stroke.seen) == (ONTO_MASK, Pose((7, -2), 1, -1, 3, mirror=True))
    assert (select.op, select.level, select.source.origin, len(select.source.points)) == ("add", 1, (5, 6), 20)
    assert select.source.copies == copies
    assert found.session.painting.selection is not None
    assert len(found.missing) == 1


def test_a_recovered_painting_goes_on_and_is_recovered_again(tmp_path):
    folder = tmp_path / "p"
    one = painter(folder)
    draw(one, 40, 1)
    draw(one, 40, 2, end=False)  # in hand
    left(one)
    (entry,) = entries.listed(folder)
    first = recovered(entry.folder)
    assert [len(command.points) for command in first.session.log] == [40, 40]
    two = painter(folder)
    idle(two)
    recovers_in(two, entry.folder)
    draw(two, 30, 3)
    scenes = [result for result in idle(two) if isinstance(result, results.Scene)]
    assert scenes[-1].modified
    assert scenes[-1].path is None
    end = time.monotonic() + 90
    while [alive.alive for alive in entries.listed(folder)] != [True]:  # the one that was left is ended meanwhile
        assert time.monotonic() < end
        time.sleep(0.02)
    two.post(q.Do(c.Undo(1)))
    two.post(q.Do(c.AddLayer("sky")))
    left(two)
    (entry,) = entries.listed(folder)
    assert entry.name == "untitled, recovered"
    again = recovered(entry.folder)
    assert again.missing == []
    assert [type(command) for command in again.session.log] == [c.Stroke, c.Stroke, c.Stroke, c.Undo, c.AddLayer]
    assert np.array_equal(pixels(again.session.painting), pixels(first.session.painting))


def recovered_alone(tmp_path, monkeypatch, count=6):
    """An entry of so many strokes, and what lets its recovery go on after the first of them, on its thread."""
    monkeypatch.setattr("engine.studio.journalled.beside.LIMIT", np.inf)  # no checkpoint: all is left to be done
    one = painter(tmp_path)
    for n in range(count):
        draw(one, 20, n)
    left(one)
    (entry,) = entries.listed(tmp_path)
    begun, goes_on = threading.Event(), threading.Event()
    carried_out = recovering._do

    def held(*told):
        carried_out(*told)
        begun.set()
        assert goes_on.wait(200)

    monkeypatch.setattr(recovering, "_do", held)
    return entry, begun, goes_on


def test_painting_goes_on_while_another_is_recovered_and_is_asked_about(tmp_path, monkeypatch):
    entry, begun, goes_on = recovered_alone(tmp_path / "p", monkeypatch)
    two = painter(tmp_path / "other")
    two.post(q.Recover(entry.folder, "lake"))
    assert begun.wait(90)
    draw(two, 30, 9)
    scenes = [result for result in idle(two) if isinstance(result, results.Scene)]
    assert scenes[-1].can_undo  # it is on the painting that is there
    goes_on.set()
    whole = first(two, results.Whole)
    assert whole.name == "lake"
    two.post(Show(whole.file))
    asked = [result for result in idle(two) if isinstance(result, results.Whole)]
    assert asked[0].changed
    two.post(Show(whole.file, sure=True))
    scenes = [result for result in idle(two) if isinstance(result, results.Scene)]
    assert scenes[-1].name == "untitled, recovered"
    draw(two, 30, 10)
    left(two)
    assert [len(command.points) for command in recovered(entry.folder).session.log] == [20] * 6 + [30]
    (other,) = entries.listed(tmp_path / "other")
    assert (other.strokes, other.in_bin) == (1, True)


def test_a_recovery_that_is_given_up_leaves_its_entry_to_others(tmp_path, monkeypatch):
    entry, begun, goes_on = recovered_alone(tmp_path / "p", monkeypatch)
    two = painter(tmp_path / "other")
    for shown in (False, True):  # given up as it is read, and when it is whole
        begun.clear()
        two.post(q.Recover(entry.folder))
        assert begun.wait(90)
        assert entries.is_alive(entry.folder)
        if shown:
            goes_on.set()
            first(two, results.Whole)
        two.post(CancelOpening())
        idle(two)
        goes_on.set()
        end = time.monotonic() + 90
        while entries.is_alive(entry.folder):
            assert time.monotonic() < end
            time.sleep(0.002)
        goes_on.clear()
    left(two)
    assert entries.listed(tmp_path / "p") == (entry,)


def test_what_another_program_has_is_refused_and_what_is_asked_for_at_once_comes_first(tmp_path):
    one = painter(tmp_path / "p")
    draw(one, 20, 1)
    idle(one)
    (entry,) = entries.listed(tmp_path / "p")
    two = painter(tmp_path / "other")
    idle(two)
    two.post(q.Recover(entry.folder))
    note = first(two, results.Note)
    assert (note.text.endswith("is open in another window"), note.stays) == (True, True)
    left(one)
    idle(two)
    two.post(q.Recover(entry.folder, at_once=True))
    draw(two, 30, 2)
    left(two)
    assert [len(command.points) for command in recovered(entry.folder).session.log] == [20, 30]


def test_an_opened_file_is_what_it_was_though_it_was_replaced(tmp_path):
    folder, file = tmp_path / "p", tmp_path / "lake.ora"
    one = painter(folder)
    draw(one, 40, 1)
    saved(one, file)
    one.close(60)
    assert entries.listed(folder) == ()  # saved, so nothing is left
    two = painter(folder)
    idle(two)
    opens_in(two, file)
    draw(two, 40, 2)
    saved(two, file)  # the file that was opened is gone
    draw(two, 40, 3)
    left(two)
    (entry,) = entries.listed(folder)
    assert (entry.name, entry.path) == ("lake.ora", file)
    found = recovered(entry.folder)
    assert found.name == "lake, recovered"
    assert [len(command.points) for command in found.session.log] == [40, 40, 40]
    assert found.missing == []
    assert found.known


@pytest.mark.parametrize("first", ["a stroke", "a save"])
def test_a_save_replaces_what_was_opened_only_when_that_is_kept(tmp_path, monkeypatch, first):
    """However long that takes: killed as soon as it is saved, the strokes since are still on what was opened."""
    folder, file, keep = tmp_path / "p", tmp_path / "lake.ora", opened.keep_file
    one = painter(folder)
    draw(one, 40, 1)
    saved(one, file)
    one.close(60)

    def kept_late(folder, stamp):
        end = time.monotonic() + 1.0
        while FileStamp.of(file) == stamp and time.monotonic() < end:
            time.sleep(0.01)
        return keep(folder, stamp)

    monkeypatch.setattr(opened, "keep_file", kept_late)
    make = Volume.make
    monkeypatch.setattr(Volume, "make", lambda self: time.sleep(0.3) or make(self))  # its folder is late, too
    two = painter(folder)
    idle(two)
    opens_in(two, file)
    if first == "a save":
        saved(two, file)
    draw(two, 40, 2)
    saved(two, file)
    draw(two, 40, 3)
    idle(two)
    then = left_over(two, tmp_path)
    two.close(60)
    found = recovered(then)
    assert (found.missing, found.known) == ([], True)
    assert [len(command.points) for command in found.session.log] == [40, 40, 40]


def test_what_was_kept_is_found_though_the_journal_does_not_tell(tmp_path):
    """A power cut may leave the bytes, and take the record of them."""
    file = tmp_path / "lake.ora"
    file.write_bytes(b"as it was")
    stamp = FileStamp.of(file)
    sha = keep_file(tmp_path, stamp)
    (tmp_path / "kept" / f"{'0' * 64}.ora").write_bytes(b"as it wax")  # half written, or damaged
    file.write_bytes(b"as it is now")
    assert kept_file(tmp_path, stamp, None).name == f"{sha}.ora"
    assert kept_file(tmp_path, stamp, None).read_bytes() == b"as it was"


@pytest.fixture
def state(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "state"))
    return tmp_path / "state" / "inkfall" / "paintings"


def test_the_command_line_lists_saves_and_discards(tmp_path, state, capsys):
    assert main(["recover"]) == 0
    assert "no painting" in capsys.readouterr().out
    one = painter(None)
    draw(one, 40, 1)
    left(one)
    (entry,) = entries.listed()
    assert main(["recover", "--json"]) == 0
    (told,) = json.loads(capsys.readouterr().out)["paintings"]
    assert (told["id"], told["strokes"], told["open"]) == (entry.ident, 1, False)
    assert main(["recover", "1", "--save", str(tmp_path / "out.ora")]) == 0
    painting = open_painting(tmp_path / "out.ora")
    assert np.array_equal(pixels(painting.painting), pixels(recovered(entry.folder).session.painting))
    assert len(painting.recording.commands) == 1
    assert main(["recover", entry.ident, "--discard"]) == 0
    assert entries.listed()[0].in_bin
    assert main(["recover", entry.ident, "--discard"]) == 0
    assert entries.listed() == ()
    capsys.readouterr()
    assert main(["recover", entry.ident, "--discard"]) == 2
    assert "found no such painting" in capsys.readouterr().err


def test_points_are_given_back_as_they_were_told(tmp_path):
    """Six float64 each, those that no decimal tells too."""
    journal = Journal(head_of_new(), tmp_path)
    posts = Posts(journal)
    told = pen(np.random.default_rng(3), 500) + np.pi / 7
    posts.tell(q.Begin(3, (1 << 90, -5), Brush()))
    for part in np.array_split(told, 70):
        posts.tell(q.Points(part))
    posts.close(True)
    (entry,) = entries.listed(tmp_path)
    (asked,) = recovered(entry.folder).story.asked.values()
    assert np.array_equal(np.concatenate(asked.points), told)
    assert asked.touch.origin == (1 << 90, -5)


def test_points_wait_no_longer_than_fifty_milliseconds_though_the_journals_thread_is_late(tmp_path, monkeypatch):
    """Whoever tells of more writes those that would be too old by the time that the next come."""
    journal = Journal(head_of_new(), tmp_path)
    number = journal.begin(told_touch(Touch(0, (0, 0), Brush()), told_brush(Brush())))
    while not journal.settled:
        time.sleep(0.01)
    now, between = [time.monotonic() + 1e6], 0.008  # seconds; the thread waits for this clock
    monkeypatch.setattr("engine.journal.journal.time", SimpleNamespace(monotonic=lambda: now[0], time=time.time))
    posted = []
    for row in pen(np.random.default_rng(1), 40):
        now[0] += between
        posted.append(now[0])
        journal.points(number, row[None])
        there = sum(map(len, read_story(journal.entry.folder).asked[number].points))
        assert there == len(posted) or now[0] + between - posted[there] <= 0.05
    journal.close(End.STAYS)


def test_the_turns_of_a_barrel_come_back_from_a_stroke_that_was_cut_off(tmp_path):
    journal = Journal(head_of_new(), tmp_path)
    number = journal.begin(told_touch(Touch(0, (0, 0), Brush()), told_brush(Brush())))
    told = np.arange(21.0).reshape(3, 7)
    for row in told:
        journal.points(number, row[None])
    while not journal.settled:
        time.sleep(0.01)
    journal.close(End.STAYS)
    asked = read_story(journal.entry.folder).asked[number]
    assert np.array_equal(np.concatenate(asked.points), told)
    assert asked.fitted().shape == (3, 7)
