"""No version is replaced that nobody has seen: by two processes that save in any order, killed at any time."""

import os
import random
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from engine.files.atomic import replacing
from engine.keeping.fingerprint import fingerprint
from engine.keeping.on_disk import OnDisk, Overtaken
from engine.keeping.preferences import Preferences
from engine.keeping.unfinished import sweep_unfinished
from engine.keeping.versions import kept_versions, versions_folder

ROOT = Path(__file__).resolve().parents[3]


@pytest.fixture(autouse=True)
def state(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "state"))


def save(files, path, data, sure=False):
    with files.saving(path, sure) as one, replacing(path, verify=one.ready) as file:
        file.write(data)
    return one


def test_what_changed_after_the_first_look_is_not_replaced(tmp_path):
    path, files = tmp_path / "a.ora", OnDisk(Preferences())
    save(files, path, b"mine")

    def overtaken():
        with files.saving(path, False) as one, replacing(path, verify=one.ready) as file:
            path.write_bytes(b"theirs")
            file.write(b"mine again")

    with pytest.raises(Overtaken, match="another program"):
        overtaken()
    assert [one.name for one in tmp_path.iterdir() if one.is_file()] == ["a.ora"]
    assert path.read_bytes() == b"theirs"
    save(files, path, b"mine again", sure=True)
    assert [one.read_bytes() for one in kept_versions(versions_folder(path))] == [b"theirs"]
    files.release()


def test_a_link_that_leads_to_another_file_by_now_is_asked_about(tmp_path):
    link, files = tmp_path / "link.ora", OnDisk(Preferences())
    (tmp_path / "a.ora").write_bytes(b"a")
    (tmp_path / "b.ora").write_bytes(b"b")
    link.symlink_to("a.ora")
    assert files.opened(link, fingerprint(link))
    save(files, link, b"a2")
    link.unlink()
    link.symlink_to("b.ora")
    with pytest.raises(Overtaken, match="another program"):
        save(files, link, b"a3")
    assert (tmp_path / "b.ora").read_bytes() == b"b"
    save(files, tmp_path / "a.ora", b"a3")
    link.unlink()
    link.symlink_to("c.ora")
    save(files, link, b"a4")
    assert (tmp_path / "c.ora").read_bytes() == b"a4"
    (tmp_path / "d.ora").write_bytes(b"d")
    save(files, tmp_path / "d.ora", b"d2")  # another name, which the dialog asks about
    files.release()


def test_other_names_of_a_file_keep_what_it_was_and_that_is_told(tmp_path):
    path, other, files = tmp_path / "a.ora", tmp_path / "b.ora", OnDisk(Preferences())
    assert not save(files, path, b"a1").linked
    assert not save(files, path, b"a2").linked  # a version is kept of it
    os.link(path, other)
    assert save(files, path, b"a3").linked
    assert other.read_bytes() == b"a2"
    assert not save(files, path, b"a4").linked
    files.release()


def test_a_version_that_cannot_be_kept_is_told_and_keeps_nobody_from_saving(tmp_path):
    path, files = tmp_path / "a.ora", OnDisk(Preferences())
    save(files, path, b"old")
    versions_folder(path).write_text("no folder")
    assert "versions" in save(files, path, b"new").lost
    assert path.read_bytes() == b"new"
    files.release()


def test_a_save_of_the_same_bytes_replaces_no_version(tmp_path):
    path, files = tmp_path / "a.ora", OnDisk(Preferences())
    for data in (b"1", b"2", b"2", b"2"):
        save(files, path, data)
    assert [one.read_bytes() for one in kept_versions(versions_folder(path))] == [b"1"]
    files.release()


def test_a_painting_that_is_closed_holds_no_file(tmp_path):
    path, one, two = tmp_path / "a.ora", OnDisk(Preferences()), OnDisk(Preferences())
    save(one, path, b"1")
    with pytest.raises(Overtaken, match="another window"):
        save(two, path, b"2")
    save(one, tmp_path / "b.ora", b"1")  # as "save as" does
    save(two, path, b"2")
    two.release()
    save(two, path, b"3")  # it waited, and its painting is closed by now
    assert one.opened(path, None)
    one.release()


# Two processes: each says which version it saw as it saved the next.
SAVES = """
import random, sys, time
from pathlib import Path
from engine.files.atomic import replacing
from engine.keeping.fingerprint import fingerprint
from engine.keeping.on_disk import OnDisk, Overtaken
from engine.keeping.preferences import Preferences
name, count, path = sys.argv[1], int(sys.argv[2]), Path(sys.argv[3])
files, rng, number = OnDisk(Preferences()), random.Random(name), 0
def look():
    files.opened(path, fingerprint(path))
    return path.read_text()
def save(text, sure):
    with files.saving(path, sure) as one, replacing(path, verify=one.ready) as file:
        file.write(text.encode())
print("ready", flush=True)
sys.stdin.readline()
save(name + "first", True)
seen = look()
print("looked", flush=True)
sys.stdin.readline()
while number < count:
    time.sleep(rng.random() * 0.004)
    try:
        save(f"{name}{number}", False)
    except Overtaken:
        print("asked", flush=True)
        seen = look()
    else:
        print(seen, f"{name}{number}", flush=True)
        seen, number = f"{name}{number}", number + 1
"""


def goes_on(child):
    child.stdin.write("\n")
    child.stdin.flush()


def two_that_save(path, count):
    children = [
        subprocess.Popen(
            [sys.executable, "-c", SAVES, name, str(count), path],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
            cwd=ROOT,
        )
        for name in "ab"
    ]
    for child in children:
        assert child.stdout.readline() == "ready\n"
    for child in children:  # the second replaces what the first has looked at
        goes_on(child)
        assert child.stdout.readline() == "looked\n"
    for child in children:
        goes_on(child)
    lines = [line.split() for child in children for line in child.communicate(timeout=120)[0].splitlines()]
    assert [child.returncode for child in children] == [0, 0]
    return [line for line in lines if len(line) == 2], lines.count(["asked"])


@pytest.mark.parametrize("count", [15, pytest.param(200, marks=pytest.mark.nightly)])
def test_two_that_save_into_one_file_never_replace_what_they_have_not_seen(tmp_path, count):
    saved, asked = two_that_save(tmp_path / "a.ora", count)
    assert len(saved) == 2 * count
    replaced = [before for before, _ in saved]
    assert len(set(replaced)) == len(replaced)  # each version was replaced by one who had seen it, and by no other
    assert asked > 0


KILLED = """
import os, sys
from pathlib import Path
from engine.files.atomic import replacing
from engine.keeping.on_disk import OnDisk
from engine.keeping.preferences import Preferences
files, path = OnDisk(Preferences()), Path(sys.argv[1])
while True:
    word = os.urandom(8)
    with files.saving(path, True) as one, replacing(path, verify=one.ready) as file:
        for _ in range(4):
            file.write(word * 8192)
    print(word.hex(), flush=True)
"""


@pytest.mark.parametrize("trials", [5, pytest.param(300, marks=pytest.mark.nightly)])
def test_killed_at_any_time_the_file_and_its_versions_are_whole_and_nothing_is_left(tmp_path, trials):
    folder, rng = tmp_path / "paintings", random.Random(trials)
    folder.mkdir()
    path = folder / "a.ora"
    for _ in range(trials):
        child = subprocess.Popen([sys.executable, "-c", KILLED, path], stdout=subprocess.PIPE, cwd=ROOT)
        first = child.stdout.readline()
        time.sleep(0.03 * rng.random())
        child.send_signal(signal.SIGKILL)
        told = (first + child.communicate()[0]).split()
        sweep_unfinished()
        assert [one.name for one in folder.iterdir()] == ["a.ora"]
        kept = kept_versions(versions_folder(path))
        assert len(kept) <= 4  # one more where it was killed before the oldest went
        now, *before = [whole(one) for one in (path, *kept)]
        assert now == told[-1] or now not in told  # what was told to be saved last, or what came after it
        assert len({*before}) == len(kept)
    files = OnDisk(Preferences())
    assert files.opened(path, fingerprint(path))
    files.release()


def whole(path):
    data = path.read_bytes()
    assert len(data) == 4 * 65536
    assert data == data[:8] * 32768
    return data[:8].hex().encode()
