"""Recordings with raster-ops from the command line: the same pixels played and reopened, mistakes in one line."""

import json
import os
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest

from app.__main__ import main

ROOT = Path(__file__).resolve().parents[2]
HEADER = {"inkfall": 1, "frame": [0, 0, 64, 48], "seed": 7}
GROUND = {"radius": 90, "hardness": 1, "colour": "#507090", "dynamics": {}}
ROCK = [{"texture": "rock", "amount": 0.8, "period": 16}]
OPS = (
    "multiply",
    {"name": "contrast", "gain": 3, "pivot": 0.4},
    {"name": "gradient", "by": "texture", "ramp": [[0, "#200020"], [1, "#ffe080"]]},
    {"name": "clone", "layer": "Low", "offset": [9, 4]},
    {"name": "displace", "distance": 6, "by": "texture"},
    {"formula": "pressure * (0.5 + 0.5*sin(x/5)*noise(floor(y/4), 3) - pic) if tex > 0.4 else d*(colour - luma)"},
)


def stroke(op, **members):
    brush = {"mode": "raster", "op": op, "radius": 14, "colour": "#e0a040", "ink": ROCK}
    return {"do": "stroke", "points": [[6, 10, 0.3], [56, 40, 1]], "brush": brush, **members}


def recording(path, *commands):
    lines = (HEADER, {"do": "layer", "add": "Low"}, {"do": "stroke", "points": [[32, 24]], "brush": GROUND}, *commands)
    path.write_text("".join(json.dumps(line) + "\n" for line in lines))
    return path


def test_played_reopened_and_played_again_they_are_the_same(tmp_path):
    script = recording(tmp_path / "a.jsonl", *(stroke(op) for op in OPS), {"do": "undo", "count": 2}, {"do": "redo"})
    first, again, ora, opened = (tmp_path / name for name in ("a.png", "b.png", "a.ora", "c.png"))
    rect = ["--rect", "2,40,40,150,120"]
    assert main(["play", str(script), "--png", str(first), *rect, "--save", str(ora)]) == 0
    assert main(["play", str(script), "--png", str(again), *rect]) == 0
    assert main(["export", str(ora), str(opened), *rect]) == 0
    assert first.read_bytes() == again.read_bytes() == opened.read_bytes()


def test_what_is_saved_plays_as_it_was(tmp_path):
    script = recording(tmp_path / "a.jsonl", *(stroke(op, level=2, origin=[40, 30]) for op in OPS))
    ora, written, first, again = (tmp_path / name for name in ("a.ora", "b.jsonl", "a.png", "b.png"))
    assert main(["play", str(script), "--png", str(first), "--save", str(ora)]) == 0
    with zipfile.ZipFile(ora) as archive:
        [member] = [name for name in archive.namelist() if name.endswith(".jsonl")]
        written.write_bytes(archive.read(member))
    told = [json.loads(line) for line in written.read_text().splitlines()]
    assert [line["brush"]["op"] for line in told if line.get("brush", {}).get("mode") == "raster"] == list(OPS)
    assert main(["play", str(written), "--png", str(again)]) == 0
    assert first.read_bytes() == again.read_bytes()


FUR = {"do": "texture", "name": "fur", "maker": "spectrum", "size": [32, 32], "shapes": [{"shape": "noise", "b": 1}]}
THINNED = {
    "density": {"texture": "fur", "amount": 0.7, "shaping": "threshold"},
    "grain": {"texture": "rock", "amount": 0.8, "period": 6},
    "shaping": [[0, 0.2], [0.4, 1], [1, 0.1]],
    "edge": "wet",
}


def test_another_process_with_another_number_of_threads_paints_the_same(tmp_path):
    brushes = [{"radius": 20, "ink": [{"texture": "fur", "shaping": "power"}], **THINNED}]
    brushes += [{"mode": "raster", "op": op, "radius": 14, "ink": ROCK, **THINNED} for op in (*OPS, "predict")]
    lines = [{"do": "stroke", "points": [[6, 10, 0.3], [56, 40, 1]], "brush": brush} for brush in brushes]
    script = recording(tmp_path / "a.jsonl", FUR, *lines)
    first, again = tmp_path / "a.png", tmp_path / "b.png"
    assert main(["play", str(script), "--png", str(first)]) == 0
    words = [sys.executable, "-m", "app", "play", str(script), "--png", str(again), "--threads", "3"]
    environment = os.environ | {"OMP_NUM_THREADS": "1", "PYTHONHASHSEED": "5"}
    assert subprocess.run(words, cwd=ROOT, env=environment, check=False).returncode == 0
    assert first.read_bytes() == again.read_bytes()


WRONG = (
    ("moss", 'brush.op: found "moss", expected one of toward, multiply, '),
    ({"name": "contrast", "gain": 9}, "brush.op.gain: found 9, expected a number from 0 to 4"),
    ({"name": "clone"}, "brush.op.layer: found none, expected one: the layer that is copied"),
    ({"name": "clone", "layer": "High"}, "brush.op.layer: found 'High', none of that name, expected a layer: 'Low'"),
    ({"formula": "1 + pic.real"}, 'brush.op.formula, column 8: found ".", expected a number, a name or one of'),
    ({"formula": "open(x)"}, 'brush.op.formula, column 1: found "open", expected a name: pic, luma'),
)


@pytest.mark.parametrize(("op", "line"), WRONG, ids=range(len(WRONG)))
def test_mistakes_are_one_line(tmp_path, capsys, op, line):
    script = recording(tmp_path / "a.jsonl", stroke(op))
    assert main(["play", str(script), "--png", str(tmp_path / "a.png")]) != 0
    told = capsys.readouterr().err
    assert line in told
    assert told.count("\n") == 1
    assert not (tmp_path / "a.png").exists()
