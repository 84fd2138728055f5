"""What is seen of a file tells whether somebody wrote to it."""

import os

import pytest

from engine.keeping.fingerprint import TAIL, fingerprint

OLD = b"".join(bytes([n % 251]) for n in range(3 * TAIL))


def appended(path):
    with path.open("ab") as file:
        file.write(b"x")


def cut(path):
    os.truncate(path, len(OLD) - 1)


def overwritten(path):
    with path.open("r+b") as file:
        file.seek(-TAIL, os.SEEK_END)
        file.write(b"\xff")
    os.utime(path, ns=(1, 1_000_000_007))  # whatever the clock says


def touched(path):
    os.utime(path, ns=(1, 2_000_000_000))


def replaced(path):
    other = path.with_name("other")
    other.write_bytes(OLD[:-1] + b"\xff")
    os.utime(other, ns=(1, 1_000_000_007))
    other.replace(path)


@pytest.fixture
def file(tmp_path):
    path = tmp_path / "a.ora"
    path.write_bytes(OLD)
    os.utime(path, ns=(1, 1_000_000_007))
    return path


@pytest.mark.parametrize("change", [appended, cut, overwritten, touched, replaced])
def test_what_another_program_does_is_seen(file, change):
    before = fingerprint(file)
    change(file)
    assert not fingerprint(file).same_file(before)


def test_reading_renaming_and_copying_with_its_time_change_nothing(file):
    before = fingerprint(file)
    copy = file.with_name("copy")
    copy.write_bytes(file.read_bytes())
    os.utime(copy, ns=(1, 1_000_000_007))
    copy.replace(file)
    assert fingerprint(file).same_file(before)
    assert fingerprint(file).place != before.place


def test_what_is_no_file_has_none(file, tmp_path):
    os.mkfifo(tmp_path / "fifo")
    (tmp_path / "link").symlink_to("gone")
    assert [fingerprint(p) for p in (tmp_path, tmp_path / "fifo", tmp_path / "link", file / "below")] == [None] * 4
