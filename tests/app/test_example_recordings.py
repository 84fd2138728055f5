"""Recordings with example textures from the command line: the same whatever the threads, mistakes in one line."""

import json
import shutil
from pathlib import Path

import numpy as np
import platformdirs
import pytest
from PIL import Image

from app.__main__ import main

EXAMPLES = Path(__file__).parents[2] / "palettes" / "examples"
HEADER = {"inkfall": 1, "frame": [0, 0, 160, 120], "seed": 7}


@pytest.fixture(autouse=True)
def own_cache(tmp_path_factory, monkeypatch):
    """Analyses go to a folder of the test's own."""
    folder = tmp_path_factory.mktemp("cache")
    monkeypatch.setattr(platformdirs, "user_cache_path", lambda name: folder / name)


def recording(folder, *commands):
    path = folder / "a.jsonl"
    path.write_text("".join(json.dumps(line) + "\n" for line in (HEADER, *commands)))
    return path


def texture(name, **members):
    return {"do": "texture", "name": name, "maker": "example", **members}


def stroke(*points, example="felt", **brush):
    given = {"radius": 16, "mode": "example", "example": example, "dynamics": {}, **brush}
    return {"do": "stroke", "points": [list(point) for point in points], "brush": given}


def play(script, out, *words):
    assert main(["play", str(script), "--png", str(out), *words]) == 0
    return np.asarray(Image.open(out))


def test_threads_and_files_make_no_difference(tmp_path, capsys):
    for ending in (".png", ".mask.png", ".toml"):
        shutil.copy(EXAMPLES / f"bread{ending}", tmp_path)
    script = recording(
        tmp_path,
        texture("felt", bundled="felt"),
        texture("own", path="bread.png", mask="bread.mask.png", params="bread.toml"),
        stroke((30, 30), (130, 30)),
        stroke((80, 10), (80, 110), example="own", depth=1),
        {"do": "undo"},
        {"do": "redo"},
        stroke((10, 100), mode="erase", depth=0),
        {"do": "view", "level": 2, "origin": [0, 0], "size": [64, 64]},
        {"do": "swap", "at": [30, 30], "example": "own"},
    )
    ora, opened = tmp_path / "a.ora", tmp_path / "c.png"
    one = play(script, tmp_path / "a.png", "--threads", "1", "--save", str(ora))
    two = play(script, tmp_path / "b.png", "--threads", "2")
    assert np.array_equal(one, two)
    assert one[30, 30, 3] == 255
    assert main(["export", str(ora), str(opened)]) == 0
    assert np.array_equal(one, np.asarray(Image.open(opened)))
    for words in (["--until", "3"], ["--seed", "8"]):
        assert not np.array_equal(one, play(script, tmp_path / "b.png", *words))
    near = play(script, tmp_path / "d.png", "--rect", "2,60,60,200,160")
    assert near[..., 3].any()


WRONG = {
    "no texture": ([stroke((9, 9))], "line 2: brush.example: found 'felt', nothing of that name"),
    "another kind": (
        [{"do": "texture", "name": "felt", "maker": "rock"}, stroke((9, 9))],
        "line 3: brush.example: found 'felt', a texture of kind rock",
    ),
    "no example": ([stroke((9, 9), example=None)], "line 2: brush.example: found none"),
    "depth": ([stroke((9, 9), depth="deep")], 'line 2: brush.depth: found "deep"'),
    "level": ([texture("felt", bundled="felt"), stroke((9, 9), example_level=20)], "line 3: brush.example_level"),
    "detail": ([stroke((9, 9), example_detail=9)], "line 2: brush.example_detail: found 9"),
    "swap without a place": ([{"do": "swap", "example": "felt"}], "line 2: at: found nothing"),
    "swap of nothing": (
        [{"do": "layer", "add": "a"}, {"do": "swap", "at": [3, 3], "example": "felt"}],
        "line 3: swap: found nothing painted",
    ),
    "huge": ([texture("felt", bundled="felt"), stroke((0, 0), (1e7, 0))], "line 3: stroke: found one that meets"),
    "missing": ([texture("felt", path="none.png")], "line 2: "),
}


@pytest.mark.parametrize(("commands", "told"), WRONG.values(), ids=WRONG)
def test_mistakes_are_told_in_a_line(tmp_path, capsys, commands, told):
    script = recording(tmp_path, *commands)
    assert main(["play", str(script), "--png", str(tmp_path / "o.png")]) == 2
    error = capsys.readouterr().err
    assert told in error
    assert error.count("\n") == 1
    assert "fault in Inkfall" not in error
    assert [path.name for path in tmp_path.iterdir()] == ["a.jsonl"]
