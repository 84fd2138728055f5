"""Saves as the window asks for them: one at a time, and none over what somebody else has saved."""

import os
import stat
import threading
import time
from collections import deque

import pytest

from engine.archive.opening import open_painting
from engine.canvas import layers
from engine.journal.entries import change_about, new_entry, paintings_folder
from engine.keeping.preferences import Preferences
from engine.keeping.versions import kept_versions, versions_folder
from engine.numeric.address import Rect
from engine.painting import commands as c
from engine.studio import requests as q
from engine.studio import results
from engine.studio.filing import documents
from engine.studio.filing.bounds import bound_kept
from engine.studio.studio import Studio
from opens import opens


class Window:
    """A studio, and what it tells."""

    def __init__(self):
        self.told, self._posted = [], deque()
        self.studio = Studio(self.told.append, self._posted.append)

    def do(self, *requests):
        for request in requests:
            self.studio.do(request)

    def open(self, path, untitled=False):
        opens(self.studio, self._posted, path, untitled=untitled)

    def add(self, name):
        self.do(q.Do(c.AddLayer(name)))

    def of(self, kind):
        return [one for one in self.told if isinstance(one, kind)]

    def written(self):
        """Waits until no file is being written; what was told since the last call, but of that."""
        end = time.monotonic() + 90
        while self.of(results.Writing) and self.of(results.Writing)[-1].files:
            self.deliver()
            time.sleep(0.002)
            assert time.monotonic() < end
        told, self.told[:] = self.of(results.Saved | results.Overtaken | results.Note), []
        return told

    def deliver(self):
        while self._posted:
            self.studio.do(self._posted.popleft())

    def save(self, path, sure=False):
        self.do(q.Save(path, sure))
        return self.written()

    def close(self):
        self.studio.close()
        self.deliver()


@pytest.fixture
def window(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "state"))
    opened = []

    def make():
        opened.append(Window())
        opened[-1].do(q.New(Rect(0, 0, 64, 64)))
        return opened[-1]

    yield make
    for one in opened:
        one.close()


def somebody_saves(window, path):
    """Another program writes there; what it wrote."""
    other = path.with_name("theirs.ora")
    window.add("theirs")
    window.save(other)
    path.write_bytes(other.read_bytes())
    return other.read_bytes()


def names(path):
    return [layer.name for layer in layers.layers(open_painting(path).painting.root)]


@pytest.fixture
def gate(monkeypatch):
    """Holds up saves until it is set; each has written its painting by then."""
    event, real = threading.Event(), documents.save

    def held(path, *rest):
        event.wait(90)
        real(path, *rest)

    monkeypatch.setattr(documents, "save", held)
    return event


def test_saves_that_are_asked_for_while_one_runs_are_one_more(window, tmp_path, gate):
    one, path = window(), tmp_path / "lake.ora"
    for name in ("first", "second", "third"):
        one.add(name)
        one.do(q.Save(path))
    one.add("after")
    gate.set()
    assert one.written() == [results.Saved(path)] * 2
    assert names(path)[-1] == "third"
    assert one.studio.easel.modified
    assert one.save(path) == [results.Saved(path)]
    assert not one.studio.easel.modified


def test_what_waits_is_saved_when_the_window_closes(window, tmp_path, gate):
    one = window()
    for name, file in (("first", "a.ora"), ("second", "a.ora"), ("third", "b.ora")):
        one.add(name)
        one.do(q.Save(tmp_path / file))
    gate.set()
    one.close()
    assert names(tmp_path / "a.ora")[-1] == "second"
    assert names(tmp_path / "b.ora")[-1] == "third"
    assert len(one.of(results.Saved)) == 3


def test_a_file_that_another_program_changed_is_asked_about(window, tmp_path):
    one, path = window(), tmp_path / "lake.ora"
    one.add("mine")
    assert one.save(path) == [results.Saved(path)]
    one.open(path)
    theirs = somebody_saves(window(), path)
    one.add("more")
    one.do(q.Save(path), q.Save(path))  # it is asked about once
    assert one.written() == [results.Overtaken(path)]
    assert path.read_bytes() == theirs
    assert one.studio.easel.modified
    assert one.save(path, sure=True) == [results.Saved(path)]
    assert kept_versions(versions_folder(path))[0].read_bytes() == theirs
    one.open(kept_versions(versions_folder(path))[0].rename(tmp_path / "x.ora"), untitled=True)
    assert one.of(results.Scene)[-1].path is None


def test_a_file_that_was_moved_or_deleted_is_written_again_and_that_is_told(window, tmp_path):
    one, path = window(), tmp_path / "lake.ora"
    (tmp_path / "link.ora").symlink_to("lake.ora")
    one.save(tmp_path / "link.ora")
    path.chmod(0o640)
    one.add("more")
    one.open(tmp_path / "link.ora")
    path.rename(tmp_path / "moved.ora")
    (saved,) = one.save(tmp_path / "link.ora")
    assert saved.told == "link.ora had been moved or deleted: it is there again"
    assert (tmp_path / "link.ora").is_symlink()
    path.chmod(0o640)
    one.open(tmp_path / "link.ora")
    one.add("again")
    assert one.save(tmp_path / "link.ora") == [results.Saved(tmp_path / "link.ora")]
    assert stat.S_IMODE(os.stat(path).st_mode) == 0o640
    assert names(path)[-1] == "again"


def test_a_file_that_is_open_in_another_window_is_told_at_opening_and_asked_about_at_saving(window, tmp_path):
    first, second, path = window(), window(), tmp_path / "lake.ora"
    first.save(path)
    second.open(path)
    (note,) = second.written()
    assert note.stays
    assert note.text == "lake.ora is open in another window: each saves over what the other has saved"
    assert note.offers == ("save_as",)
    second.add("theirs")
    assert second.save(path) == [results.Overtaken(path, elsewhere=True)]
    assert second.save(path, sure=True) == [results.Saved(path)]
    second.add("more")
    assert second.save(path) == [results.Saved(path)]  # it is known by now
    assert first.save(path) == [results.Overtaken(path)]
    first.do(q.New(Rect(0, 0, 8, 8)))
    third = window()
    third.open(path)
    assert third.written() == []  # the first has let go of it
    second.close()


def test_the_bin_and_the_versions_have_their_bounds_together(window, tmp_path, monkeypatch):
    one, path = window(), tmp_path / "lake.ora"
    for name in "abcd":
        one.add(name)
        one.save(path)
    paintings = [new_entry(paintings_folder()) for _ in range(3)]
    for number, (folder, lock) in enumerate(paintings):
        os.close(lock)
        (folder / "journal-0").write_bytes(bytes(1000))
        os.utime(folder / "journal-0", (number, number))
        if number < 2:
            change_about(folder, state="closed")
    kept = kept_versions(versions_folder(path))
    monkeypatch.setattr("engine.keeping.versions.most_bytes", lambda told: sum(k.stat().st_size for k in kept) + 1500)
    bound_kept(Preferences())
    assert [folder.exists() for folder, _ in paintings] == [False, True, True]
    assert kept_versions(versions_folder(path)) == kept
    one.do(q.New(Rect(0, 0, 64, 64)))
    monkeypatch.setattr("engine.keeping.versions.most_bytes", lambda told: 0)
    there, real = [], documents.save
    monkeypatch.setattr(documents, "save", lambda *told: (there.append(kept_versions(folder)), real(*told)))
    folder = versions_folder(path)
    one.save(path)  # makes room for itself before, and looks after what it kept
    assert there == [kept[:1]]
    assert [folder.exists() for folder, _ in paintings] == [False, False, True]
    assert len(kept_versions(folder)) == 1
    assert kept_versions(folder) != kept[:1]


def test_without_a_state_folder_it_is_saved_and_told_that_no_version_is_kept(window, tmp_path):
    (tmp_path / "state").write_text("no folder")
    one, path = window(), tmp_path / "lake.ora"
    assert one.save(path) == [results.Saved(path)]
    one.add("more")
    (saved,) = one.save(path)
    assert saved.told.startswith("lake.ora is saved; its earlier version could not be kept (")
    assert names(path)[-1] == "more"


def test_a_save_of_a_painting_that_is_gone_asks_nothing(window, tmp_path, gate):
    one, path = window(), tmp_path / "lake.ora"
    gate.set()
    one.save(path)
    gate.clear()
    one.add("more")
    one.do(q.Save(path), q.New(Rect(0, 0, 8, 8)))
    path.write_bytes(b"theirs")
    gate.set()
    (note,) = one.written()
    assert note.bad
    assert note.text == "lake.ora was not saved: another program changed it"


def test_pictures_are_exported_one_at_a_time_and_of_each_file_the_newest(tmp_path, monkeypatch):
    window, written, at_once = Window(), [], []
    go_on = threading.Event()

    def write(request, painting):
        at_once.append(request)
        assert len(at_once) == 1
        assert go_on.wait(60)
        written.append((request.path.name, sum(1 for _ in layers.layers(painting.root))))
        at_once.pop()

    monkeypatch.setattr(documents, "write_picture", write)
    for name in ("a.png", "b.png", "a.png", "a.png", "b.png"):
        window.do(q.Export(tmp_path / name))
        window.add(f"{len(window.told)}")
    aside = [root for told in window.studio.easel.session.room.aside for root in told()]
    assert sorted(sum(1 for _ in layers.layers(root)) for root in aside)[-3:] == [0, 3, 4]
    go_on.set()
    told = window.written()
    assert written == [("a.png", 0), ("a.png", 3), ("b.png", 4)]
    assert [one.text for one in told] == ["Wrote a.png", "Wrote a.png", "Wrote b.png"]
    for name in ("a.png", "b.png"):
        window.do(q.Export(tmp_path / name))
    window.studio.close()
    assert [name for name, _ in written[3:]] == ["a.png", "b.png"]
