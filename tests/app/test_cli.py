"""The command line from outside: exit status, one line for what is wrong, nothing half-written."""

import json
import os
import signal
import subprocess
import sys
import time
from functools import partial
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from app.__main__ import main
from app.cli import demo
from engine.painting.recording import read

ROOT = Path(__file__).parents[2]
HEADER = '{"inkfall": 1, "frame": [0, 0, 64, 48], "seed": 7}\n'
ROCK = '"ink": [{"texture": "rock", "amount": 0.8, "colour": "#ffffff", "period": 16}]'
STROKES = (
    '{"do": "layer", "add": "Sky"}\n'
    '{"do": "stroke", "points": [[8, 8], [50, 40]], "brush": {"radius": 12, "colour": "#803010", ' + ROCK + "}}\n"
    '{"do": "layer", "add": "Top"}\n'
    '{"do": "stroke", "level": 3, "origin": [200, 160], "points": [[0, 0], [60, 30]], "brush": {"radius": 9}}\n'
    '{"do": "undo"}\n{"do": "redo"}\n{"do": "view", "level": 2.5, "origin": [0, 0], "size": [64, 64]}\n'
)


@pytest.fixture(scope="module")
def script(tmp_path_factory):
    path = tmp_path_factory.mktemp("script") / "a.jsonl"
    path.write_text(HEADER + STROKES)
    return path


@pytest.fixture(scope="module")
def saved(script):
    path = script.with_suffix(".ora")
    assert main(["play", str(script), "--save", str(path)]) == 0
    return path


def refused(capsys, *words, status=2):
    """Runs a command that must fail; the one line it writes."""
    capsys.readouterr()
    assert main([str(word) for word in words]) == status
    told = capsys.readouterr()
    assert told.out == ""
    assert told.err.startswith("inkfall: ")
    assert told.err.count("\n") == 1
    assert "Traceback" not in told.err
    assert "fault in Inkfall" not in told.err
    return told.err


def start(*words, cache=None, **options):
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    if cache is not None:
        environment["NUMBA_CACHE_DIR"] = str(cache)
    environment.pop("DISPLAY", None)
    environment.pop("WAYLAND_DISPLAY", None)
    command = [sys.executable, "-m", "app", *map(str, words)]
    return subprocess.Popen(command, env=environment, text=True, stderr=subprocess.PIPE, **options)


def pixels(path):
    return np.asarray(Image.open(path))


# ---- play ----


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
    before = time.monotonic()
    assert main(["play", str(path)]) == 0
    assert time.monotonic() - before < 30


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


# ---- export, info ----


PLACES = ["-4,0,0,4,3", "0,0,0,64,48", "3,150,130,100,80", "12,90000,70000,64,64", f"60,{30 << 60},{25 << 60},32,24"]


@pytest.mark.parametrize("place", PLACES)
def test_a_reopened_painting_shows_the_same_pixels(script, saved, tmp_path, place):
    played, reopened = tmp_path / "played.png", tmp_path / "reopened.png"
    assert main(["play", str(script), "--png", str(played), "--rect", place]) == 0
    assert main(["export", str(saved), str(reopened), "--rect", place]) == 0
    assert pixels(played).any()
    assert np.array_equal(pixels(played), pixels(reopened))


def test_endings_depths_and_layers(saved, tmp_path, capsys):
    shown = {}
    for name, words in {
        "a.png": [],
        "b.tif": [],
        "c.tiff": ["--layer", "Sky"],
        "d.PNG": ["--depth", "16"],
    }.items():
        assert main(["export", str(saved), str(tmp_path / name), *words]) == 0
        shown[name] = pixels(tmp_path / name)
    assert np.array_equal(shown["a.png"], shown["b.tif"])
    assert not np.array_equal(shown["a.png"], shown["c.tiff"])
    capsys.readouterr()


def test_a_rectangle_as_a_painting(saved, tmp_path, capsys):
    out = tmp_path / "part.ora"
    assert main(["export", str(saved), str(out), "--rect", "1,20,20,60,41", "--layer", "Sky"]) == 0
    capsys.readouterr()
    assert main(["info", str(out), "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    assert told["frame"] == [10, 10, 30, 21]
    assert [row["name"] for row in told["layers"]] == ["Sky"]
    whole, part = tmp_path / "whole.png", tmp_path / "part.png"
    for path, picture in ((saved, whole), (out, part)):
        assert main(["export", str(path), str(picture), "--layer", "Sky", "--rect", "4,320,320,99,99"]) == 0
    assert np.array_equal(pixels(whole), pixels(part))


def test_a_group_as_a_painting_can_be_painted_on(tmp_path, capsys):
    script, whole, part = (tmp_path / name for name in ("a.jsonl", "a.ora", "b.ora"))
    script.write_text(
        HEADER + '{"do": "layer", "add": "Both", "kind": "group"}\n'
        '{"do": "layer", "add": "one", "group": "Both"}\n{"do": "stroke", "points": [[9, 9]], "brush": {}}\n'
    )
    assert main(["play", str(script), "--save", str(whole)]) == 0
    assert main(["export", str(whole), str(part), "--layer", "Both"]) == 0
    capsys.readouterr()
    assert main(["info", str(part), "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["active"] == "one"


def test_info(saved, capsys):
    assert main(["info", str(saved), "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    assert told["native"] is True
    assert [row["name"] for row in told["layers"]] == ["Sky", "Top"]
    assert told["inks"] == [["rock", 0, 16.0, 0.5, 7]]
    assert told["commands"] == 7
    assert max(told["levels"]) == 3
    assert told["bytes"] == sum(row["bytes"] for row in told["layers"]) > 1000
    level, x, y, width, _ = told["layers"][1]["bounds"]
    assert level == 3
    assert (x, y) == (191, 151)
    assert 75 < width < 82
    assert main(["info", str(saved)]) == 0
    assert "layer 'Top'" in capsys.readouterr().out


WRONG_PAINTINGS = {
    "no file": ["info", "{dir}/none.ora"],
    "a folder": ["info", "{dir}"],
    "a recording": ["info", "{script}"],
    "exr": ["export", "{saved}", "{dir}/o.exr"],
    "no ending": ["export", "{saved}", "{dir}/o"],
    "no such layer": ["export", "{saved}", "{dir}/o.png", "--layer", "x"],
    "depth": ["export", "{saved}", "{dir}/o.png", "--depth", "12"],
    "deep painting": ["export", "{saved}", "{dir}/o.ora", "--depth", "16"],
    "onto itself": ["export", "{saved}", "{saved}"],
    "export of nothing": ["export", "{dir}/none.ora", "{dir}/o.png"],
}


@pytest.mark.parametrize("words", WRONG_PAINTINGS.values(), ids=WRONG_PAINTINGS)
def test_wrong_paintings_and_endings(script, saved, tmp_path, capsys, words):
    refused(capsys, *(word.format(dir=tmp_path, script=script, saved=saved) for word in words))
    assert list(tmp_path.iterdir()) == []


def test_a_cut_painting_is_refused(saved, tmp_path, capsys):
    whole = saved.read_bytes()
    for part in (0, 1, 100, len(whole) // 2, len(whole) - 1):
        path = tmp_path / "cut.ora"
        path.write_bytes(whole[:part])
        assert str(path) in refused(capsys, "info", path)
        assert str(path) in refused(capsys, "export", path, tmp_path / "o.png")
    assert not (tmp_path / "o.png").exists()


# ---- the rest ----


def test_help_and_version(capsys):
    for words in (["--help"], ["-h"], ["--version"], ["play", "--help"], ["export", "--help"], ["bench", "-h"]):
        assert main(words) == 0
        assert "inkfall" in capsys.readouterr().out


def test_doctor_prepares_what_is_not_ready(tmp_path, monkeypatch, capsys):
    """One line on a pipe; what is ready is not done again; where nothing can be kept, that is said."""
    from engine.studio import preparing

    monkeypatch.setenv("NUMBA_CACHE_DIR", str(tmp_path))
    program = "import sys\nfor line in sys.stdin: print('{\"done\": true}', flush=True)"
    monkeypatch.setattr(preparing.Preparing.__init__, "__defaults__", (2, print, ("-c", program), True))
    assert main(["doctor", "--prepare"]) == 0
    assert capsys.readouterr() == ("all brushes are ready\n", "")
    assert len(json.loads((tmp_path / preparing.NOTE).read_text())["ready"]) >= 60
    monkeypatch.setattr(preparing.Preparing.__init__, "__defaults__", (2, print, ("-c", "raise SystemExit(1)"), True))
    assert main(["doctor", "--prepare"]) == 0
    capsys.readouterr()
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(tmp_path / "none"))
    assert main(["doctor", "--prepare"]) == 1
    told = capsys.readouterr()
    assert told.out == ""
    assert told.err.count("\n") == 1
    assert "cannot be written to" in told.err


def test_doctor(capsys, monkeypatch):
    monkeypatch.delenv("DISPLAY", raising=False)
    monkeypatch.delenv("WAYLAND_DISPLAY", raising=False)
    assert main(["doctor", "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["display"] == "none"
    assert isinstance(found["opengl"], str)
    assert main(["doctor"]) == 0
    assert "config" in capsys.readouterr().out


def test_a_window_without_display_is_one_line(script):
    done = start(script)
    told = done.communicate(timeout=60)[1]
    assert done.returncode == 1
    assert told.count("\n") == 1
    assert "the window cannot be opened" in told


def test_a_reader_that_goes_away_is_one_line(script):
    done = start("play", script, stdout=subprocess.PIPE)
    done.stdout.close()
    done.stdout = None
    told = done.communicate(timeout=60)[1]
    assert done.returncode == 1
    assert told == "inkfall: whoever read standard output has gone\n"


def test_a_full_disk_behind_standard_output_is_one_line(script):
    with open("/dev/full", "w") as full:
        done = start("play", script, stdout=full)
        told = done.communicate(timeout=60)[1]
    assert done.returncode == 1
    assert told.count("\n") == 1


def test_a_damaged_cache_of_kernels_is_cleared(tmp_path):
    """Compiled kernels are read with pickle: a file cut short must not keep the program from working."""
    path = tmp_path / "empty.jsonl"
    path.write_text('{"inkfall": 1, "frame": [0, 0, 8, 8]}\n')
    words = ["play", path, "--png", tmp_path / "o.png"]
    cache = tmp_path / "kernels"
    assert start(*words, stdout=subprocess.DEVNULL, cache=cache).communicate(timeout=120)[1] == ""
    damaged = list(cache.rglob("*.kernel"))
    assert damaged
    for number, file in enumerate(damaged):
        file.write_bytes(file.read_bytes()[: (0, 30, 60)[number % 3]])
    done = start(*words, stdout=subprocess.DEVNULL, cache=cache)
    told = done.communicate(timeout=120)[1]
    assert (done.returncode, told) == (0, "")


def test_an_interrupt_is_one_line_and_leaves_nothing(tmp_path):
    path = tmp_path / "long.jsonl"
    stroke = '{"do": "stroke", "points": [[0, 0], [900, 700]], "brush": {"radius": 300}}\n'
    path.write_text(HEADER + stroke * 3000)
    # A test run started in the background hands down SIGINT ignored; a shell's foreground does not.
    heard = partial(signal.signal, signal.SIGINT, signal.SIG_DFL)
    done = start("play", path, "--save", tmp_path / "o.ora", stdout=subprocess.DEVNULL, preexec_fn=heard)
    time.sleep(3)
    done.send_signal(signal.SIGINT)
    told = done.communicate(timeout=60)[1]
    assert done.returncode == 1
    assert told == "inkfall: interrupted; nothing half-written is left\n"
    assert [p.name for p in tmp_path.iterdir()] == ["long.jsonl"]


def test_demo_without_a_display_writes_files(script, tmp_path, capsys, monkeypatch):
    places = tmp_path / "demo.json"
    places.write_text('{"zoom": [[0, 0, 0, 64, 48], [3, 150, 130, 90, 60]]}')
    monkeypatch.setattr(demo, "RECORDING", script)
    monkeypatch.setattr(demo, "PLACES", places)
    monkeypatch.delenv("DISPLAY", raising=False)
    monkeypatch.delenv("WAYLAND_DISPLAY", raising=False)
    monkeypatch.chdir(tmp_path)
    assert main(["demo"]) == 0
    told = capsys.readouterr().out
    assert "No display" in told
    assert "inkfall-demo/" in told
    out = tmp_path / "inkfall-demo"
    assert sorted(p.name for p in out.iterdir()) == ["demo-zoom-00.png", "demo-zoom-01.png", "demo.ora", "demo.png"]
    assert pixels(out / "demo-zoom-01.png").shape == (60, 90, 4)
    assert main(["demo", "--out", str(tmp_path / "other"), "--json"]) == 0
    assert len(json.loads(capsys.readouterr().out)["written"]) == 4


def test_the_bundled_demo_is_a_recording_with_places_to_zoom_to():
    found = read(demo.RECORDING)
    assert len(found.commands) > 10
    places = json.loads(demo.PLACES.read_text())["zoom"]
    assert len(places) >= 4
    for place in places:
        assert len(place) == 5
        assert all(isinstance(value, int) for value in place)
        assert min(place[3:]) >= 1
