"""Files that tell what cannot be, of all that lies, selects, fills and shows: opened, or refused in one line."""

import zipfile
from itertools import islice

import hostile
import hostile_paintings
import hostile_tables
import numpy as np
import pytest
from PIL import Image

from app.__main__ import main

LONGEST = 800  # characters of the line, but for the file's own path
# What can be done, and takes longer than the rest: seconds, where many layers, pixels or levels are asked for.
PATIENT = {
    "selecting: a stroke of 4000 px",
    "painting: a fill of 2^24 px",
    "layering: paint of two levels 8192 apart merged",
    "layering: paint of two levels 8192 apart flattened",
    "placing: of itself, of a rect at level -4096",
}


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """A folder with the picture that some of them name."""
    folder = tmp_path_factory.mktemp("hostile")
    y, x = np.mgrid[:20, :30]
    Image.fromarray(np.stack([x * 8, y * 12, x + y], axis=2).astype(np.uint8)).save(folder / "spots.png")
    return folder


@pytest.fixture(scope="module")
def members(folder):
    """The members of a painting that holds all of it."""
    told, path = folder / "held.jsonl", folder / "held.ora"
    told.write_bytes(hostile.lines(hostile_paintings.HELD))
    assert main(["play", str(told), "--save", str(path)]) == 0
    with zipfile.ZipFile(path) as file:
        return {name: file.read(name) for name in file.namelist()}


def judged(capsys, *words):
    """Runs a command: whether it was done; else it says why in one line."""
    capsys.readouterr()
    status, told = main(list(map(str, words))), capsys.readouterr().err
    if status:
        assert told.startswith("inkfall: "), told
        assert told.count("\n") == 1, told
        assert len(told) < LONGEST + len(str(words[1])), told
    assert "fault in Inkfall" not in told
    assert "Traceback" not in told
    return status == 0


def opened(folder, capsys, members, changes):
    """Whether a painting of changed members opens; if it does, it is told of and shown."""
    path = folder / "a.ora"
    with zipfile.ZipFile(path, "w") as file:
        for name, data in {**members, **changes}.items():
            file.writestr(name, data)
    found = judged(capsys, "info", path)
    assert judged(capsys, "export", path, folder / "a.png", "--rect", "0,0,0,64,48") == found
    judged(capsys, "info", "--salvage", path)
    return found


def played(folder, capsys, commands):
    """Whether a recording can be played; if it can, its picture is shown, and it is saved and opened again."""
    path, saved = folder / "a.jsonl", folder / "a.saved.ora"
    path.write_bytes(hostile.lines(commands))
    saved.unlink(missing_ok=True)
    words = ("--save", saved, "--png", folder / "a.png", "--rect", "0,0,0,64,48")
    if not judged(capsys, "play", path, *words):
        assert not saved.exists()
        return False
    assert judged(capsys, "info", saved)
    return True


QUICK, ALL = 5, 1  # every fifth of them, or each


@pytest.mark.parametrize("each", [QUICK, pytest.param(ALL, marks=pytest.mark.nightly)])
def test_recordings_are_played_or_refused_in_one_line(folder, capsys, each):
    names = sorted(set(hostile_tables.RECORDED) - PATIENT)[::each]
    done = [played(folder, capsys, hostile_tables.RECORDED[name]) for name in names]
    assert 0 < sum(done) < len(done)


@pytest.mark.parametrize("each", [QUICK, pytest.param(ALL, marks=pytest.mark.nightly)])
def test_paintings_are_opened_or_refused_in_one_line(folder, members, capsys, each):
    table = list(hostile_paintings.lying(members).items())[::each]
    done = [opened(folder, capsys, members, changes) for _, changes in table]
    assert 0 < sum(done) < len(done)


@pytest.mark.parametrize("name", ["a placement of itself", "a selection twice", "a selection of no name"])
def test_what_cannot_be_is_refused(folder, members, capsys, name):
    assert not opened(folder, capsys, members, hostile_paintings.lying(members)[name])


@pytest.mark.parametrize("name", ["a fan of 2^60", "a fan of 2^20 of which one is seen"])
def test_what_nobody_could_wait_for_is_refused_before_it_is_drawn(folder, capsys, name):
    assert not played(folder, capsys, hostile_tables.MANY[name])


def test_a_chain_of_exact_placements_is_drawn_as_one(folder, capsys):
    assert played(folder, capsys, hostile_tables.MANY["a chain of 3,000 exact placements"][:302])


@pytest.mark.nightly
@pytest.mark.parametrize("name", sorted(PATIENT))
def test_what_takes_long_is_done_or_refused(folder, capsys, name):
    played(folder, capsys, hostile_tables.RECORDED[name])


@pytest.mark.nightly
@pytest.mark.parametrize("name", hostile.RIGHT)
def test_each_member_of_each_new_command_may_be_wrong(folder, capsys, name):
    for _, commands in hostile.wrong_members(name):
        played(folder, capsys, commands)


@pytest.mark.nightly
def test_each_member_of_the_manifest_may_be_wrong(folder, members, capsys):
    for _, changes in islice(hostile_paintings.wrong_manifests(members), 0, None, 7):
        opened(folder, capsys, members, changes)
