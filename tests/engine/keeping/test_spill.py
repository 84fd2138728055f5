"""What is put away on disk: read as it was written, its place used again, gone with the program."""

import errno
import os
import subprocess
import sys

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from engine.keeping import spill as module
from engine.keeping.spill import Spill


@pytest.fixture
def spill(tmp_path):
    made = Spill(tmp_path)
    yield made
    made.close()


@settings(deadline=None, max_examples=30)
@given(st.lists(st.tuples(st.integers(0, 5000), st.integers(0, 4)), max_size=40))
@example([(0, 3), (1, 0), (0, 0), (0, 3)])
def test_every_piece_is_what_it_was_whatever_became_of_others(tmp_path_factory, acts):
    spill, held = Spill(tmp_path_factory.mktemp("spill")), []
    for n, (size, dropped) in enumerate(acts):
        piece = bytes([n]) * size
        held.append((spill.put(piece), piece))
        for _ in range(min(dropped - 2, len(held))):
            held.pop(dropped % len(held))
        assert all(put.read() == piece for put, piece in held)
    spill.put(b"")
    assert spill.held == sum(len(piece) for _, piece in held)
    spill.close()


def test_a_place_that_is_free_is_used_again(spill):
    for n in range(50):
        put = spill.put(bytes([n]) * (9_000 + n))
        assert put.read()[-1] == n
    assert spill.length < 40_000


def test_what_can_be_made_again_leaves_room_on_the_disk_to_others(spill, monkeypatch):
    held = [spill.put_spare(bytes(9_000)) for _ in range(3)]
    assert None not in held
    monkeypatch.setattr(module, "_SPARE", 1 << 62)
    monkeypatch.setattr(module, "_ASKED", 1 << 14)
    spill._ask_from = 0
    assert spill.put_spare(bytes(9_000)) is None
    held.pop()
    assert spill.put_spare(bytes(9_000)).read() == bytes(9_000)  # where something lay it takes no more
    assert spill.put(bytes(9_000)).read() == bytes(9_000)
    monkeypatch.setattr(module, "_SPARE", 0)
    held += [spill.put_spare(bytes(9_000)) for _ in range(3)]
    monkeypatch.setattr(module, "_SPARE", 1 << 62)
    assert None in [spill.put_spare(bytes(9_000 * n)) for n in range(2, 9)]  # it is asked from time to time


def test_nobody_else_finds_the_file_and_nothing_is_left_of_it(tmp_path, spill):
    put = spill.put(b"paint")
    assert os.name == "nt" or not list(tmp_path.iterdir())
    assert put.read() == b"paint"
    spill.close()
    assert not list(tmp_path.iterdir())
    with pytest.raises(OSError, match="is closed"):
        put.read()


def test_the_program_closes_its_own_file_when_it_ends(tmp_path):
    words = "from engine.keeping.spill import spill; kept = spill().put(bytes(600)); assert kept.read() == bytes(600)"
    command = [sys.executable, "-X", "dev", "-c", words]
    home = {"XDG_STATE_HOME": str(tmp_path), "LOCALAPPDATA": str(tmp_path)}
    ended = subprocess.run(command, env=os.environ | home, capture_output=True, text=True, check=True)
    assert ended.stderr == ""


def test_nothing_is_put_away_where_there_is_no_folder_or_no_room(tmp_path, spill, monkeypatch):
    assert Spill(tmp_path / "gone").put(b"paint") is None
    kept = spill.put(b"k" * 700)
    file = spill._file

    class Full:
        closed = False

        def __getattr__(self, name):
            return getattr(file, name)

        def write(self, piece):
            raise OSError(errno.ENOSPC, "No space left on device")

    class Nearly(Full):
        def write(self, piece):
            return file.write(piece[:100])

    for disk in (Full, Nearly):
        monkeypatch.setattr(spill, "_file", disk())
        assert spill.put(b"x" * 700) is None
    assert kept.read() == b"k" * 700
    monkeypatch.setattr(spill, "_file", file)
    assert spill.put(b"y" * 700).read() == b"y" * 700


def test_other_bytes_than_were_written_are_told(spill):
    put = spill.put(b"p" * 900)
    spill._file.seek(300)
    spill._file.write(b"x")
    with pytest.raises(OSError, match="found other bytes than the 900 that were written"):
        put.read()
