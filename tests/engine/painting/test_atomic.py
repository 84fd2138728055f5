"""Replacing a file: whole old or whole new, whatever happens on the way."""

import errno
import os
import signal
import stat
import subprocess
import sys
import time
from pathlib import Path

import pytest

from engine.files.atomic import replacing, sweep
from engine.files.fault import FileError, WriteError, shown

ROOT = Path(__file__).resolve().parents[3]


def names(folder):
    return sorted(os.listdir(folder))


def test_new_file(tmp_path):
    with replacing(tmp_path / "a.bin") as file:
        assert names(tmp_path) != ["a.bin"]
        file.write(b"whole")
    assert (tmp_path / "a.bin").read_bytes() == b"whole"
    assert names(tmp_path) == ["a.bin"]
    assert stat.S_IMODE((tmp_path / "a.bin").stat().st_mode) & 0o600 == 0o600


def test_mode_is_kept(tmp_path):
    target = tmp_path / "a.bin"
    target.write_bytes(b"old")
    target.chmod(0o640)
    with replacing(target) as file:
        file.write(b"new")
    assert stat.S_IMODE(target.stat().st_mode) == 0o640


def test_symbolic_link_is_followed(tmp_path):
    (tmp_path / "deep").mkdir()
    (tmp_path / "deep" / "real").write_bytes(b"old")
    (tmp_path / "link").symlink_to("deep/real")
    with replacing(tmp_path / "link") as file:
        file.write(b"new")
    assert (tmp_path / "link").is_symlink()
    assert (tmp_path / "deep" / "real").read_bytes() == b"new"
    assert names(tmp_path / "deep") == ["real"]


@pytest.mark.parametrize("raised", [RuntimeError("x"), KeyboardInterrupt(), MemoryError()])
def test_an_exception_leaves_everything_as_it_was(tmp_path, raised):
    target = tmp_path / "a.bin"
    target.write_bytes(b"old")

    def attempt():
        with replacing(target) as file:
            file.write(b"half")
            raise raised

    with pytest.raises(type(raised)):
        attempt()
    assert names(tmp_path) == ["a.bin"]
    assert target.read_bytes() == b"old"


def test_verify_can_refuse(tmp_path):
    def refuse(part):
        assert part.read_bytes() == b"new"
        raise WriteError(part, "not what was meant")

    with pytest.raises(WriteError), replacing(tmp_path / "a.bin", verify=refuse) as file:
        file.write(b"new")
    assert names(tmp_path) == []


@pytest.mark.parametrize("call", ["open", "fsync", "replace"])
@pytest.mark.parametrize(
    ("number", "told"),
    [(errno.ENOSPC, "the disk is full")] + [(number, os.strerror(number)) for number in (errno.EIO, errno.EACCES)],
)
def test_failing_system_calls(tmp_path, monkeypatch, call, number, told):
    target = tmp_path / "a.bin"
    target.write_bytes(b"old")

    def fail(*args, **kwargs):
        raise OSError(number, os.strerror(number))

    def attempt():
        with monkeypatch.context() as patch:
            patch.setattr(f"engine.files.atomic.os.{call}", fail)
            with replacing(target) as file:
                file.write(b"new")

    with pytest.raises(WriteError) as caught:
        attempt()
    assert str(caught.value) == f"{target}: cannot be written: {told}"
    assert names(tmp_path) == ["a.bin"]
    assert target.read_bytes() == b"old"


def test_folder_that_cannot_be_synced_is_told(tmp_path, monkeypatch):
    def fail(folder):
        raise OSError(errno.EIO, "Input/output error")

    monkeypatch.setattr("engine.files.atomic.sync_folder", fail)
    with pytest.raises(WriteError, match="may not survive"), replacing(tmp_path / "a") as file:
        file.write(b"new")


@pytest.mark.parametrize("place", ["missing/a.bin", "folder", "nul\0name"])
def test_places_that_cannot_be_written(tmp_path, place):
    (tmp_path / "folder").mkdir()
    with pytest.raises(WriteError) as caught, replacing(f"{tmp_path}/{place}") as file:
        file.write(b"x")
    assert "\n" not in str(caught.value)
    assert place.split("\0")[0] in str(caught.value)


def test_long_names(tmp_path):
    name = "ü" * 120  # 240 bytes: a temporary name with more would not fit
    with replacing(tmp_path / name) as file:
        file.write(b"x")
    assert names(tmp_path) == [name]


def test_sweep_takes_only_what_dead_processes_left(tmp_path):
    gone = subprocess.Popen([sys.executable, "-c", ""])
    gone.wait()
    target = tmp_path / "a.bin"
    stale = tmp_path / f".a.bin.{gone.pid}.0123abcd.part"
    mine = tmp_path / f".a.bin.{os.getpid()}.0123abcd.part"
    other = tmp_path / f".b.bin.{gone.pid}.0123abcd.part"
    odd = tmp_path / ".a.bin.notes.part"
    for path in (stale, mine, other, odd):
        path.write_bytes(b"x")
    assert sweep(target) == 1
    assert names(tmp_path) == sorted([mine.name, other.name, odd.name])


CHILD = """
import sys
from engine.files.atomic import replacing
n = 0
while True:
    n += 1
    with replacing(sys.argv[1]) as file:
        for _ in range(8):
            file.write(bytes([n % 251]) * 65536)
    print(n, flush=True)
"""


def test_killed_at_any_time_the_file_is_whole(tmp_path):
    target = tmp_path / "a.bin"
    for trial in range(6):
        child = subprocess.Popen([sys.executable, "-c", CHILD, target], stdout=subprocess.PIPE, cwd=ROOT)
        child.stdout.readline()
        time.sleep(0.011 * trial)
        child.send_signal(signal.SIGKILL)
        child.wait()
        child.stdout.close()
        data = target.read_bytes()
        assert len(data) == 8 * 65536
        assert len(set(data)) == 1
    sweep(target)
    assert names(tmp_path) == ["a.bin"]


def test_messages_are_one_line():
    error = FileError("a.png", "chunk\nIHDR:   found 3")
    assert str(error) == "a.png: chunk IHDR: found 3"
    assert shown("a\nb\x1b[31m\u2028" + "x" * 100).isprintable()
    assert len(shown("\U0001f600" * 100)) < 70
