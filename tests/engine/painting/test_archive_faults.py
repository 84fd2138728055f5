"""Files of paintings that lie, are cut or cannot be written: refused in one line, and the old file stays."""

import hashlib
import json
import threading
import zipfile

import numpy as np
import pytest
from archived import assert_same, session_of_all, stroke
from sown import opened, rewritten

from engine.archive import jobs
from engine.archive.opening import open_painting
from engine.archive.saving import Snapshot, save
from engine.canvas.tile_cache import TileCache
from engine.files.fault import Cancelled, FileError, WriteError
from engine.files.zip_writer import MemberSink
from engine.painting import commands as c
from engine.session.session import Session


@pytest.fixture(scope="module")
def session(tmp_path_factory):
    return session_of_all(tmp_path_factory.mktemp("pictures"))


@pytest.fixture(scope="module")
def saved(session, tmp_path_factory):
    path = tmp_path_factory.mktemp("saved") / "a.ora"
    save(path, Snapshot(session.painting, session.recording()))
    return path


@pytest.fixture(scope="module")
def members(saved):
    with zipfile.ZipFile(saved) as file:
        assert file.testzip() is None
        return {name: file.read(name) for name in file.namelist()}


# ---- what lies ----


def altered(members, path, value):
    manifest = json.loads(members["inkfall/manifest.json"])
    place = manifest
    for step in path[:-1]:
        place = place[step]
    if value is None:
        del place[path[-1]]
    else:
        place[path[-1]] = value
    return {"inkfall/manifest.json": json.dumps(manifest).encode()}


LIES = {
    "no frame": (("frame",), None),
    "frame of text": (("frame",), "all"),
    "endless frame": (("frame",), [0, 0, 1 << 50, 1]),
    "other byte order": (("byteorder",), "big"),
    "layer of unknown kind": (("layers", 0, "kind"), "mask"),
    "layer without a name": (("layers", 0, "name"), ""),
    "two layers of a name": (("layers", 0, "name"), "Group"),
    "two layers of an id": (("layers", 0, "id"), 2),
    "opacity 2": (("layers", 0, "opacity"), 2),
    "mode": (("layers", 0, "blend"), "pigment"),
    "visible maybe": (("layers", 0, "visible"), 1),
    "active layer that is not there": (("active",), "nobody"),
    "packs of text": (("layers", 0, "packs"), ["x"]),
    "pack that is no member": (("layers", 0, "packs", 0, 0), "inkfall/none"),
    "pack that is a picture": (("layers", 0, "packs", 0, 0), "mergedimage.png"),
    "pack of fewer tiles": (("layers", 0, "packs", 0, 1), 1),
    "pack of more bytes": (("layers", 0, "packs", 0, 2), 1 << 30),
    "pack beyond all memory": (("layers", 0, "packs", 0, 2), 1 << 60),
    "texture of unknown kind": (("textures", "leaf", "kind"), "marble"),
    "texture without its picture": (("textures", "leaf", "picture"), "0" * 64),
    "texture of period 0": (("textures", "fine", "parameters", "period"), 0),
    "members of text": (("members",), "all"),
}


@pytest.mark.parametrize("name", LIES)
def test_manifests_that_lie(members, tmp_path, name):
    with pytest.raises(FileError) as caught:
        opened(rewritten(members, altered(members, *LIES[name])), tmp_path)
    assert str(caught.value).startswith(str(tmp_path / "x.ora") + ": ")
    assert "\n" not in str(caught.value)
    assert len(str(caught.value)) < 500


def test_a_pack_twice_is_refused(members, tmp_path):
    manifest = json.loads(members["inkfall/manifest.json"])
    layer = next(v for v in manifest["layers"] if v.get("packs"))
    layer["packs"] *= 2
    data = rewritten(members, {"inkfall/manifest.json": json.dumps(manifest).encode()})
    with pytest.raises(FileError, match="there twice"):
        opened(data, tmp_path)


def test_tiles_of_other_bytes_are_refused(members, tmp_path):
    name = next(n for n in members if n.endswith(".tiles"))
    other = bytearray(members[name])
    other[-1] ^= 1
    with pytest.raises(FileError, match="not those that the manifest names"):
        opened(rewritten(members, {name: bytes(other)}), tmp_path)


def test_a_recording_that_cannot_be_read_is_told_with_its_line(members, tmp_path):
    text = members["inkfall/recording.jsonl"] + b'{"do": "stroke", "level": NaN}\n'
    manifest = json.loads(members["inkfall/manifest.json"])
    manifest["members"]["inkfall/recording.jsonl"] = [len(text), hashlib.sha256(text).hexdigest()]
    changes = {"inkfall/recording.jsonl": text, "inkfall/manifest.json": json.dumps(manifest).encode()}
    with pytest.raises(FileError, match=r"recording.jsonl.*line 22.*NaN"):
        opened(rewritten(members, changes), tmp_path)


def test_truncated_files_are_refused(saved, tmp_path):
    data = saved.read_bytes()
    for length in [*range(0, 200, 7), *range(200, len(data), len(data) // 40), len(data) - 1]:
        with pytest.raises(FileError):
            opened(data[:length], tmp_path)


def test_flipped_bits_are_found(session, saved, tmp_path):
    """A flipped bit is refused, or lies where nothing is read from; never a different painting."""
    data = saved.read_bytes()
    rng = np.random.default_rng(4)
    refused = 0
    for place in rng.integers(0, len(data), 60):
        bad = bytearray(data)
        bad[place] ^= 1 << int(rng.integers(8))
        try:
            found = opened(bytes(bad), tmp_path)
        except FileError:
            refused += 1
            continue
        if found.native:
            assert_same(session.painting, found.painting)
    assert refused > 30


@pytest.mark.parametrize("name", ["missing.ora", "."])
def test_places_that_are_no_file(tmp_path, name):
    with pytest.raises(FileError, match=r"no such file|a folder"):
        open_painting(tmp_path / name)


# ---- saving ----


def test_progress_and_threads(session, tmp_path):
    """A save runs on any thread while painting goes on."""
    seen = []
    worker = Session(session.painting, TileCache(1 << 24))
    snapshot = Snapshot(session.painting)
    thread = threading.Thread(target=save, args=(tmp_path / "a.ora", snapshot, seen.append))
    thread.start()
    for i in range(3):
        worker.do(c.parse(stroke(10 * i, 30)))
    thread.join()
    assert seen == sorted(seen)
    assert seen[-1] == 1.0
    assert_same(session.painting, open_painting(tmp_path / "a.ora").painting)


@pytest.mark.parametrize("when", [0, 1, 5, 9])
def test_a_cancelled_save_leaves_the_old_file(session, tmp_path, when):
    path = tmp_path / "a.ora"
    path.write_bytes(b"old")
    asked = []

    def cancelled():
        asked.append(1)
        return len(asked) > when

    with pytest.raises(Cancelled):
        save(path, Snapshot(session.painting), cancelled=cancelled)
    assert path.read_bytes() == b"old"
    assert [p.name for p in tmp_path.iterdir()] == ["a.ora"]


def test_a_job_that_fails_leaves_the_old_file(session, tmp_path, monkeypatch):
    path = tmp_path / "a.ora"
    path.write_bytes(b"old")

    def fail(*args):
        raise MemoryError

    monkeypatch.setattr(jobs, "pack", fail)
    with pytest.raises(WriteError, match="not enough memory"):
        save(path, Snapshot(session.painting))
    assert path.read_bytes() == b"old"
    assert [p.name for p in tmp_path.iterdir()] == ["a.ora"]


def test_a_file_that_cannot_be_read_back_is_not_put_in_place(session, tmp_path, monkeypatch):
    path = tmp_path / "a.ora"
    written = MemberSink.write
    monkeypatch.setattr(MemberSink, "write", lambda sink, data: written(sink, data) and sink._file.seek(-1, 1))
    with pytest.raises(WriteError, match="cannot be read back"):
        save(path, Snapshot(session.painting))
    assert list(tmp_path.iterdir()) == []
