"""`--salvage` of `play`, `export` and `info`: what can be had of a damaged file, and a list of what is missing."""

import json

import numpy as np
import pytest
from command_line import HEADER, STROKES, pixels, refused

from app.__main__ import main

LINES = (HEADER + STROKES).splitlines(keepends=True)
TORN = {
    "cut within a line": (LINES[:4], LINES[4][:30], 3),
    "a flipped byte": (LINES[:5], LINES[5].replace('"do"', '"dn"') + LINES[6], 4),
    "a command that cannot be done": (LINES[:3], '{"do": "layer", "select": "nobody"}\n' + LINES[3], 2),
}


def told_by(capsys, *words):
    """What a command that does its work says: on standard output, and on standard error, a line each."""
    capsys.readouterr()
    assert main([str(word) for word in words]) == 0
    told = capsys.readouterr()
    return told.out, told.err.splitlines()


@pytest.mark.parametrize(("whole", "rest", "count"), TORN.values(), ids=TORN)
def test_a_torn_recording_is_played_to_its_last_whole_line(tmp_path, capsys, whole, rest, count):
    path, torn, part = tmp_path / "a.jsonl", tmp_path / "torn.png", tmp_path / "part.png"
    path.write_text("".join(whole) + rest)
    error = refused(capsys, "play", path, "--png", torn)
    assert error.startswith(f"inkfall: {path}: line {count + 2}: ")
    assert ("--salvage" in error) == ("select" not in rest)
    assert not torn.exists()
    out, missing = told_by(capsys, "play", path, "--png", torn, "--salvage", "--json")
    assert json.loads(out)["commands"] == count
    assert len(missing) == 1
    assert missing[0].startswith(f"inkfall: {path}: line {count + 2}: ")
    assert missing[0].endswith("what comes before was played, the rest is missing")
    path.write_text("".join(whole))
    assert main(["play", str(path), "--png", str(part)]) == 0
    assert np.array_equal(pixels(torn), pixels(part))


def test_until_reads_no_further_than_it_plays(tmp_path, capsys):
    path, torn, whole = tmp_path / "torn.jsonl", tmp_path / "torn.png", tmp_path / "whole.png"
    path.write_text("".join(LINES[:5]) + LINES[5][:9])
    out, missing = told_by(capsys, "play", path, "--png", torn, "--until", "4")
    assert out.startswith("4 commands")
    assert not missing
    assert "--salvage" in refused(capsys, "play", path, "--until", "5")
    assert len(told_by(capsys, "play", path, "--until", "5", "--salvage")[1]) == 1
    path.write_text("".join(LINES))
    assert main(["play", str(path), "--png", str(whole), "--until", "4"]) == 0
    assert np.array_equal(pixels(torn), pixels(whole))


@pytest.fixture
def damaged(saved, tmp_path):
    """The painting with a bit flipped in the first pack of its paint, and without its end."""
    data = bytearray(saved.read_bytes())
    data[data.index(b"inkfall\x03") + 400] ^= 4
    path = tmp_path / "damaged.ora"
    path.write_bytes(data[:-500])
    return path


def test_a_damaged_painting_is_exported_and_told_of(saved, damaged, tmp_path, capsys):
    whole, again = tmp_path / "whole.png", tmp_path / "again.png"
    for words in (["export", damaged, again], ["info", damaged]):
        assert "--salvage" in refused(capsys, *words)
    out, missing = told_by(capsys, "export", damaged, again, "--salvage")
    assert out == f"wrote {again}\n"
    assert [line.partition(": the file is damaged")[0] for line in missing] == [f"inkfall: {damaged}"]
    assert main(["export", str(saved), str(whole)]) == 0
    assert np.array_equal(pixels(whole), pixels(again))
    facts, missing = told_by(capsys, "info", damaged, "--salvage", "--json")
    assert json.loads(facts)["commands"] == 7
    assert json.loads(facts)["native"] is False
    assert json.loads(facts)["notes"] == [line.removeprefix(f"inkfall: {damaged}: ") for line in missing]
    assert len(missing) == 1


def test_an_undamaged_one_is_opened_as_without(saved, tmp_path, capsys):
    assert told_by(capsys, "info", saved, "--salvage") == told_by(capsys, "info", saved)
    assert not told_by(capsys, "export", saved, tmp_path / "a.ora", "--salvage")[1]


def test_what_is_no_painting_stays_refused(tmp_path, capsys):
    path = tmp_path / "text.ora"
    path.write_text("nothing but words " * 999)
    for words in (["info", path], ["export", path, tmp_path / "a.png"]):
        assert "no end record" in refused(capsys, *words, "--salvage")
    path = tmp_path / "empty.jsonl"
    path.write_text("")
    assert "no line" in refused(capsys, "play", path, "--salvage")
    assert "no such file" in refused(capsys, "info", tmp_path / "none.ora")
    assert "--salvage" not in refused(capsys, "info", tmp_path / "none.ora")
