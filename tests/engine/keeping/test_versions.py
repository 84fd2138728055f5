"""Earlier versions: what a save replaced is there, no more of it than was asked for, never touched by what follows."""

import os

import pytest
from hypothesis import given
from hypothesis import strategies as st

from engine.keeping import versions
from engine.keeping.preferences import Preferences
from engine.keeping.versions import Kept, keep_version, kept_versions, let_go, too_much, versions_folder

THREE = Preferences()


@pytest.fixture(autouse=True)
def state(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "state"))


def put(path, data, when):
    part = path.with_name("part")
    part.write_bytes(data)
    os.utime(part, (when, when))
    part.replace(path)


def saved(path, count, size=1, most=3):
    """Saves a file so many times, one second apart."""
    for n in range(count):
        if path.exists():
            keep_version(path, most)
        put(path, bytes([n]) * size, 1000 + n)


def told(path):
    return [(one.read_bytes()[0], one.stat().st_mtime) for one in kept_versions(versions_folder(path))]


def test_the_last_three_are_kept_the_newest_first(tmp_path):
    path = tmp_path / "lake.ora"
    saved(path, 6)
    assert told(path) == [(4, 1004), (3, 1003), (2, 1002)]
    assert [one.name for one in kept_versions(versions_folder(path))] == ["lake, 5.ora", "lake, 4.ora", "lake, 3.ora"]
    assert versions_folder(path).stat().st_mode & 0o077 == 0


def test_a_version_is_the_old_file_itself_or_a_copy_where_it_has_other_names(tmp_path):
    path = tmp_path / "lake.ora"
    put(path, b"old", 1000)
    inode = path.stat().st_ino
    keep_version(path, 3)
    put(path, b"new", 1001)
    assert kept_versions(versions_folder(path))[0].stat().st_ino == inode
    os.link(path, tmp_path / "other name")
    keep_version(path, 3)
    put(path, b"newest", 1002)
    (tmp_path / "other name").write_bytes(b"written in place")
    assert [one.read_bytes() for one in kept_versions(versions_folder(path))] == [b"new", b"old"]
    assert kept_versions(versions_folder(path))[0].stat().st_mtime == 1001


def test_it_is_copied_from_another_disk(tmp_path, monkeypatch):
    def no_link(*_paths):
        raise OSError(18, "Invalid cross-device link")

    monkeypatch.setattr("engine.keeping.versions.os.link", no_link)
    path = tmp_path / "lake.ora"
    saved(path, 3)
    assert told(path) == [(1, 1001), (0, 1000)]


def test_a_save_that_was_stopped_after_it_kept_the_file_keeps_it_once(tmp_path):
    path = tmp_path / "lake.ora"
    put(path, b"old", 1000)
    keep_version(path, 3)
    keep_version(path, 3)
    assert len(kept_versions(versions_folder(path))) == 1


def test_all_together_take_no_more_than_is_allowed_but_the_newest_of_each_stays(tmp_path, monkeypatch):
    one, two, three = (tmp_path / f"{name}.ora" for name in ("one", "two", "three"))
    for path in (one, two, three):
        saved(path, 4, 1000)
        for version in kept_versions(versions_folder(path)):
            about = version.stat().st_mtime + 100 * (one, two, three).index(path)
            os.utime(version, (about, about))
    most = 5500.0
    monkeypatch.setattr(versions, "most_bytes", lambda preferences: most)
    assert let_go(THREE) == []
    assert [len(kept_versions(versions_folder(path))) for path in (one, two, three)] == [1, 1, 3]
    most = 0.0
    binned = Kept(50.0, 10, tmp_path / "bin")
    assert let_go(THREE, [binned]) == [binned]
    assert [len(kept_versions(versions_folder(path))) for path in (one, two, three)] == [1, 1, 1]
    assert [told(path)[0][0] for path in (one, two, three)] == [2, 2, 2]


@given(st.lists(st.tuples(st.floats(0, 1e9), st.integers(0, 1000)), max_size=12), st.integers(-5, 4000))
def test_what_goes_is_the_oldest_and_no_more_than_must(rows, most):
    kept = [Kept(when, size, n) for n, (when, size) in enumerate(rows)]
    gone = too_much(kept, most)
    stays = [one for one in kept if one not in gone]
    assert sum(one.size for one in stays) <= max(0, most)
    assert not gone or sum(one.size for one in stays) + gone[-1].size > most
    assert all(old.when <= young.when for old in gone for young in stays)
