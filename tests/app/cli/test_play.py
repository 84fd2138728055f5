"""`inkfall play`: pictures and paintings of recordings, and refusals that leave nothing."""

import json
import os
import time

import numpy as np
import pytest
from command_line import HEADER, pixels, refused

from app.__main__ import main


def test_play_writes_painting_and_picture(script, tmp_path, capsys):
    ora, png = tmp_path / "p.ora", tmp_path / "p.png"
    assert main(["play", str(script), "--save", str(ora), "--png", str(png), "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    assert told["commands"] == 7
    assert told["written"] == [str(ora), str(png)]
    assert pixels(png).shape == (48, 64, 4)
    assert pixels(png)[..., 3].max() == 255


RECTANGLES = [
    ("0,0,0,64,48", ["--rect", "0,0,0,64,48"], (48, 64)),
    ("negative level", ["--rect", "-4,0,0,4,3"], (3, 4)),
    ("negative level joined", ["--rect=-4,0,0,4,3"], (3, 4)),
    ("negative corner", ["--rect", "2,-8,-9,16,17"], (17, 16)),
    ("deep", ["--rect", f"60,{30 << 60},{25 << 60},20,10"], (10, 20)),
    ("far", ["--rect", f"200,{10**75},{-(10**75)},5,4"], (4, 5)),
]


@pytest.mark.parametrize(("words", "size"), [row[1:] for row in RECTANGLES], ids=[row[0] for row in RECTANGLES])
def test_rectangles(script, tmp_path, words, size):
    out = tmp_path / "p.png"
    assert main(["play", str(script), "--png", str(out), *words]) == 0
    assert pixels(out).shape[:2] == size


def test_until_and_seed(script, tmp_path):
    shown = {}
    for name, words in {
        "all": [],
        "again": ["--seed", "7"],
        "other": ["--seed", "-8"],
        "two": ["--until", "2"],
        "none": ["--until", "0"],
    }.items():
        out = tmp_path / f"{name}.png"
        assert main(["play", str(script), "--png", str(out), *words]) == 0
        shown[name] = pixels(out)
    assert np.array_equal(shown["all"], shown["again"])
    assert not np.array_equal(shown["all"], shown["other"])
    assert not np.array_equal(shown["all"], shown["two"])
    assert not shown["none"].any()


WRONG = {
    "no file": ["play", "{dir}/none.jsonl"],
    "a folder": ["play", "{dir}"],
    "no recording": ["play"],
    "unknown option": ["play", "{script}", "--fast"],
    "abbreviated option": ["play", "{script}", "--unt", "1"],
    "until a word": ["play", "{script}", "--until", "x"],
    "until negative": ["play", "{script}", "--until=-1"],
    "seed a float": ["play", "{script}", "--seed", "1.5"],
    "rect without png": ["play", "{script}", "--rect", "0,0,0,8,8"],
    "rect of four": ["play", "{script}", "--png", "{dir}/o.png", "--rect", "0,0,8,8"],
    "rect of floats": ["play", "{script}", "--png", "{dir}/o.png", "--rect", "0,0.5,0,8,8"],
    "rect empty": ["play", "{script}", "--png", "{dir}/o.png", "--rect", "0,0,0,0,8"],
    "rect huge": ["play", "{script}", "--png", "{dir}/o.png", "--rect", "0,0,0,9999999999,8"],
    "rect level": ["play", "{script}", "--png", "{dir}/o.png", "--rect", "99999,0,0,8,8"],
    "rect arabic digits": ["play", "{script}", "--png", "{dir}/o.png", "--rect", "0,0,0,٤,8"],
    "rect very long": ["play", "{script}", "--png", "{dir}/o.png", "--rect", "0," + "9" * 5000 + ",0,8,8"],
    "wrong ending": ["play", "{script}", "--save", "{dir}/o.xcf"],
    "png ending": ["play", "{script}", "--png", "{dir}/o.ora"],
    "unknown command": ["paint", "x"],
    "two files": ["{script}", "{script}"],
    "no such file": ["{dir}/none.ora"],
    "unknown bench": ["bench", "everything"],
    "texture": ["texture", "spectrum", "a.png"],
    "analyse": ["analyse", "none.png"],
    "unknown option alone": ["--fast"],
}


@pytest.mark.parametrize("words", WRONG.values(), ids=WRONG)
def test_wrong_arguments(script, tmp_path, capsys, words):
    words = [word.format(dir=tmp_path, script=script) for word in words]
    refused(capsys, *words)
    assert list(tmp_path.iterdir()) == []


HOSTILE = {
    "not json": "{",
    "nan": '{"do": "view", "level": NaN}',
    "infinity": '{"do": "stroke", "points": [[0, 1e999]]}',
    "far": '{"do": "stroke", "points": [[0, 1e300]]}',
    "negative radius": '{"do": "stroke", "points": [[0, 0]], "brush": {"radius": -1}}',
    "huge radius": '{"do": "stroke", "points": [[0, 0]], "brush": {"radius": 1e9}}',
    "negative spacing": '{"do": "stroke", "points": [[0, 0]], "brush": {"spacing": -1}}',
    "deep level": '{"do": "stroke", "level": 100000, "points": [[0, 0]]}',
    "no layer": '{"do": "stroke", "layer": "x", "points": [[0, 0]]}',
    "locked": '{"do": "layer", "add": "a"}\n{"do": "layer", "set": "a", "locked": true}\n'
    '{"do": "stroke", "points": [[0, 0]]}',
    "missing image": '{"do": "texture", "name": "t", "maker": "image", "path": "../none.png"}',
    "image is a device": '{"do": "texture", "name": "t", "maker": "image", "path": "/dev/zero"}',
    "later maker": '{"do": "texture", "name": "t", "maker": "solid"}',
    "raster op": '{"do": "stroke", "points": [[0, 0]], "brush": {"mode": "raster", "op": "dissolve"}}',
    "endless stroke": '{"do": "stroke", "points": [[0, 0], [16777216, 16777216]], "brush": {"radius": 4000}}',
}


@pytest.mark.parametrize("text", HOSTILE.values(), ids=HOSTILE)
def test_hostile_recordings(tmp_path, capsys, text):
    path = tmp_path / "a.jsonl"
    path.write_text(HEADER + text + "\n")
    told = refused(capsys, "play", path, "--save", tmp_path / "o.ora")
    assert f"{path}: line {1 + len(text.splitlines())}: " in told
    assert [p.name for p in tmp_path.iterdir()] == ["a.jsonl"]


def test_brushes_at_their_limits_are_quick(tmp_path):
    path = tmp_path / "a.jsonl"
    brushes = [
        '{"radius": 0}',
        '{"radius": 1e-9}',
        '{"spacing": 0, "radius": 0.5}',
        '{"spacing": 0}',
        '{"radius": 4000}',
    ]
    rows = [f'{{"do": "stroke", "points": [[0, 0], [500, 0]], "brush": {brush}}}' for brush in brushes]
    path.write_text(HEADER + "\n".join(rows))
    before = time.process_time()
    assert main(["play", str(path)]) == 0
    assert time.process_time() - before < 60  # without limits it takes hours


def test_what_cannot_be_written_is_a_failure(script, tmp_path, capsys):
    assert "there is no folder" in refused(capsys, "play", script, "--save", tmp_path / "no" / "o.ora", status=1)
    (tmp_path / "taken.png").mkdir()
    assert "a folder" in refused(capsys, "play", script, "--png", tmp_path / "taken.png", status=1)
    assert [p.name for p in tmp_path.iterdir()] == ["taken.png"]


def test_what_cannot_be_written_is_told_before_the_work(tmp_path, capsys, monkeypatch):
    """A recording that is none would be told first if it were read first."""
    (tmp_path / "taken.png").mkdir()
    nothing = tmp_path / "nothing.jsonl"
    assert "a folder" in refused(capsys, "play", nothing, "--png", tmp_path / "taken.png", status=1)
    monkeypatch.setattr(os, "access", lambda path, mode: False)
    line = refused(capsys, "play", nothing, "--png", tmp_path / "a.png", status=1)
    assert "a.png: cannot be written: Permission denied" in line
