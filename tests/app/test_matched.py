"""`inkfall texture match`, `mix` and `solid` on pictures of all kinds, and on what is none."""

import json
import os
import pty
import subprocess
import sys
from contextlib import suppress
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from app.__main__ import main
from app.cli import match_command, solid_command
from engine.makers import heeger_bergen
from engine.texture import solid as engines

ROOT = Path(__file__).parents[2]
KINDS = {"L": 1, "RGB": 3, "RGBA": 4}


def picture(folder, mode="RGB", size=(40, 36), name="in.png", seed=5):
    """A PNG with coarse grain in it; "L16" has 16 bits, "grey" is grey as RGB, "flat" has one colour."""
    rng = np.random.default_rng(seed)
    if mode == "L16":
        image = Image.fromarray(rng.integers(0, 65536, size, np.uint16))
    elif mode == "flat":
        image = Image.new("RGB", size[::-1], (200, 100, 50))
    else:
        values = rng.integers(0, 256, (*size, KINDS.get(mode, 1)), np.uint8)
        values[::2] = values[::2] // 3
        image = Image.fromarray(
            np.repeat(values, 3, axis=2) if mode == "grey" else values.squeeze(2 if mode == "L" else ())
        )
    image.save(folder / name)
    return folder / name


def made(folder, *words, out="out.png"):
    path = folder / out
    assert main(["texture", *map(str, words), "--out", str(path)]) == 0
    return np.asarray(Image.open(path)) if path.suffix == ".png" else path


def bits(path):
    """Of a PNG's samples; Pillow reads colours of 16 bits as of 8."""
    return path.read_bytes()[24]


@pytest.mark.parametrize("size", [(1, 1), (1, 12), (8, 8), (17, 31), (40, 36)])
@pytest.mark.parametrize("mode", [*KINDS, "L16", "grey", "flat"])
def test_examples_of_any_kind_and_size(tmp_path, mode, size):
    path = picture(tmp_path, mode, size)
    found = made(tmp_path, "match", path, "--size", "37x29")
    assert found.shape == (29, 37, KINDS[mode]) if KINDS.get(mode, 1) > 1 else found.shape[:2] == (29, 37)
    assert bits(tmp_path / "out.png") == (16 if mode == "L16" else 8)
    if mode == "flat":
        assert (found == (200, 100, 50)).all()
    if size == (40, 36) and mode in ("L", "L16", "grey"):
        own = np.asarray(Image.open(path)).astype(float)
        assert found.ndim == 2
        assert found.mean() == pytest.approx(own.mean(), rel=0.05)
        assert found.std() == pytest.approx(own.std(), rel=0.05)


@pytest.mark.parametrize("mode", [*KINDS, "L16", "grey", "flat"])
def test_a_structure_of_examples_of_any_kind(tmp_path, mode, capsys):
    found = made(tmp_path, "match", picture(tmp_path, mode), "--size", "37x29", "--structure", "objects", "--json")
    told = json.loads(capsys.readouterr().out)
    assert found.shape[:2] == (29, 37)
    assert bits(tmp_path / "out.png") == (16 if mode == "L16" else 8)
    assert (told["structure"], told["channels"], told["size"]) == (
        "objects",
        1 if found.ndim == 2 else found.shape[2],
        [37, 29],
    )
    assert 0.0 <= told["copied"] <= 1.0


def test_a_mixture_with_a_structure_lies_between_both(tmp_path):
    one, other = (picture(tmp_path, mode, (40, 36), f"{mode}.png", 3) for mode in ("L", "RGBA"))
    words = ("mix", one, other, "--how", "average", "--structure", "statistics", "--size", "32x32", "--weight")
    ends = [made(tmp_path, *words, weight, out=f"{weight}.png") for weight in ("0", "0.5", "1")]
    alphas = [end[..., 3].mean() for end in ends]
    assert alphas[0] == 255
    assert alphas[0] > alphas[1] > alphas[2]


def test_sizes_beyond_patience_are_refused_with_the_largest_one(tmp_path, capsys):
    path = picture(tmp_path)
    words = ("match", path, "--structure", "objects", "--out", tmp_path / "o.png", "--size")
    for asked, most in (("6000x4000", "5016 x 3344"), ("1048576x17", "1017268 x 16")):
        assert main(["texture", *map(str, words), asked]) == 2
        found = f"found {asked.replace('x', ' x ')}, expected at most {most} with a structure"
        assert capsys.readouterr().err == f"inkfall: --size: {found}\n"


def test_long_work_is_told_beforehand(tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(match_command, "_LONG", 0.0)
    made(tmp_path, "match", picture(tmp_path), "--size", "37x29")
    assert capsys.readouterr().err == "inkfall: 37 x 29 pixels take some 0 minutes\n"


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("match", "--levels=4"), "--levels: found it, expected --structure none"),
        (("match", "--exact"), "--exact: found it, expected --structure none"),
        (("mix", "--iterations", "5", "--how", "average"), "--iterations: found it, expected --structure none"),
        (("mix",), "--how: found palette, expected average with --structure full"),
    ],
)
def test_options_of_none_are_refused_with_a_structure(tmp_path, capsys, words, message):
    path, (name, *options) = picture(tmp_path), words
    given = [name, str(path), *([str(path)] if name == "mix" else []), *options]
    assert main(["texture", *given, "--structure", "full", "--out", str(tmp_path / "o.png")]) == 2
    told = capsys.readouterr().err
    assert message in told
    assert told.count("\n") == 1
    assert not (tmp_path / "o.png").exists()


@pytest.mark.parametrize("how", ["palette", "bands", "average"])
@pytest.mark.parametrize("modes", [("RGB", "L"), ("L16", "RGBA"), ("RGBA", "flat"), ("grey", "RGB")])
def test_mixtures_of_any_kind(tmp_path, how, modes):
    first, second = (picture(tmp_path, mode, (30, 20 + k), f"{k}.png", k) for k, mode in enumerate(modes))
    found = made(tmp_path, "mix", first, second, "--how", how, "--weight", ".3", "--split", "1")
    assert found.shape[:2] == (30, 21)
    assert bits(tmp_path / "out.png") == (16 if "L16" in modes else 8)


def test_the_whole_command_as_a_program(tmp_path):
    path, out = picture(tmp_path), tmp_path / "out.png"
    words = [
        "texture",
        "match",
        path,
        "--size",
        "24x16",
        "--json",
        "--levels",
        "9",
        "--orientations",
        "3",
        "--seed",
        "-4",
    ]
    done = subprocess.run(
        [sys.executable, "-m", "app", *map(str, words), "--out", out], cwd=ROOT, capture_output=True, text=True
    )
    assert (done.returncode, done.stderr) == (0, "")
    facts = json.loads(done.stdout)
    assert facts["size"] == [24, 16]
    assert (facts["levels"], facts["orientations"], facts["channels"], facts["bits"]) == (2, 3, 3, 8)
    again = made(
        tmp_path, "match", path, "--size", "24x16", "--levels", "9", "--orientations", "3", "--seed", "-4", out="b.png"
    )
    assert np.array_equal(np.asarray(Image.open(out)), again)


@pytest.mark.parametrize("name", ["match", "mix"])
def test_what_is_done_otherwise_than_while_painting_is_told(name, capsys):
    assert main(["texture", name, "--help"]) == 0
    told = " ".join(capsys.readouterr().out.split())
    assert f"longer than {heeger_bergen.SHRUNK} pixels is halved" in told
    assert f"the middle {heeger_bergen.EXAMPLE_SIDE} x {heeger_bergen.EXAMPLE_SIDE}" in told


def test_options_change_what_is_made(tmp_path, capsys):
    path, other = picture(tmp_path), picture(tmp_path, size=(60, 50), name="other.png", seed=9)
    words = [
        [],
        ["--pyramid", "laplacian"],
        ["--levels", "1"],
        ["--orientations", "2"],
        ["--iterations", "1"],
        ["--exact"],
    ]
    words += [["--seed", "1"], ["--start", other, "--size", "36x40"]]
    found = [made(tmp_path, "match", path, *more).tobytes() for more in words]
    assert len(set(found)) == len(words)
    assert made(tmp_path, "match", path, "--start", other).shape == (60, 50, 3)
    made(tmp_path, "match", path, "--depth", "16")
    assert bits(tmp_path / "out.png") == 16
    assert made(tmp_path, "match", path).shape == (40, 36, 3)
    capsys.readouterr()
    made(tmp_path, "match", path, "--levels", "9")
    assert capsys.readouterr().out.startswith("3 levels: the pictures have no room for 9\n")
    made(tmp_path, "match", path, "--size", "8x8")
    assert capsys.readouterr().out.startswith("1 level: the pictures have no room for 4\n")


def test_solids_are_made_in_as_many_turns_as_the_engine_says():
    assert solid_command.ITERATIONS == engines.ITERATIONS


@pytest.mark.parametrize("mode", ["L", "RGB", "RGBA", "L16"])
def test_solids_as_an_array_and_as_slices(tmp_path, mode):
    path = picture(tmp_path, mode)
    words = ["solid", path, "--size", "12", "--iterations", "2"]
    array = np.load(made(tmp_path, *words, "--png", tmp_path / "sheet.png", out="a.npy"))
    assert array.shape == ((12,) * 3 if mode.startswith("L") else (12, 12, 12, KINDS[mode]))
    assert array.dtype == (np.uint16 if mode == "L16" else np.uint8)
    folder = made(tmp_path, *words, out="slices")
    names = sorted(os.listdir(folder))
    assert names == [f"slice-{z:04}.png" for z in range(12)]
    assert np.array_equal(np.stack([np.asarray(Image.open(folder / name)) for name in names]), array)
    sheet = np.asarray(Image.open(tmp_path / "sheet.png"))
    assert sheet.shape[2] == 3
    assert sheet[len(sheet) // 2, 20:100].std() > 10
    assert sorted(p.name for p in tmp_path.iterdir()) == ["a.npy", "in.png", "sheet.png", "slices"]


def test_the_cube_shows_three_faces():
    """Planes of x, y and z in red, green and blue: each face lacks the one that ends there."""
    z, y, x = np.mgrid[:16, :16, :16] / 15.0
    drawn = solid_command.cube(np.stack([x, y, z], axis=-1), 32)
    assert drawn.shape == (64, 55, 3)
    assert drawn[32, 27] == pytest.approx([1.0, 1.0, 0.0], abs=0.35)  # the corner that is nearest
    assert drawn[2, 27] == pytest.approx([0.0, 0.0, 0.0], abs=0.15)
    assert drawn[62, 26] == pytest.approx([0.86, 0.86, 0.86], abs=0.15)
    assert (drawn[0, 0] == 1.0).all()
    assert (drawn[16, 27, 2], drawn[48, 20, 1] > 0.8, drawn[48, 35, 0] > 0.65) == (0.0, True, True)


def test_an_empty_folder_is_taken_and_a_full_one_refused(tmp_path, capsys):
    path = picture(tmp_path)
    (tmp_path / "empty").mkdir()
    made(tmp_path, "solid", path, "--size", "4", "--iterations", "1", out="empty")
    assert len(os.listdir(tmp_path / "empty")) == 4
    assert main(["texture", "solid", str(path), "--size", "4", "--out", str(tmp_path / "empty")]) == 2
    assert "expected a new folder or an empty one" in capsys.readouterr().err
    assert len(os.listdir(tmp_path / "empty")) == 4


WRONG = {
    "no file": ["match", "{dir}/none.png"],
    "no picture": ["match", "{dir}/text.png"],
    "no second": ["mix", "{dir}/in.png"],
    "second missing": ["mix", "{dir}/in.png", "{dir}/none.png"],
    "start missing": ["match", "{dir}/in.png", "--start", "{dir}/none.png"],
    "size of words": ["match", "{dir}/in.png", "--size", "big"],
    "size of nothing": ["match", "{dir}/in.png", "--size", "0x5"],
    "beyond memory": ["match", "{dir}/in.png", "--size", "1000000x1000000"],
    "beyond memory, mixed": ["mix", "{dir}/in.png", "{dir}/in.png", "--size", "1000000x200000"],
    "solid beyond memory": ["solid", "{dir}/in.png", "--size", "2048"],
    "solid too small": ["solid", "{dir}/in.png", "--size", "3"],
    "solid of two sizes": ["solid", "{dir}/in.png", "--size", "8x8"],
    "levels": ["match", "{dir}/in.png", "--levels", "-1"],
    "orientations": ["match", "{dir}/in.png", "--orientations", "0"],
    "iterations": ["match", "{dir}/in.png", "--iterations", "many"],
    "weight": ["mix", "{dir}/in.png", "{dir}/in.png", "--weight", "1.5"],
    "weight of nothing": ["mix", "{dir}/in.png", "{dir}/in.png", "--weight", "."],
    "split": ["mix", "{dir}/in.png", "{dir}/in.png", "--split", "x"],
    "how": ["mix", "{dir}/in.png", "{dir}/in.png", "--how", "stirred"],
    "pyramid": ["match", "{dir}/in.png", "--pyramid", "cheops"],
    "itself": ["match", "{dir}/in.png", "--out", "{dir}/in.png"],
    "wrong ending": ["match", "{dir}/in.png", "--out", "{dir}/out.jpg"],
    "solid as a picture": ["solid", "{dir}/in.png", "--size", "4", "--out", "{dir}/out.png"],
    "solid's sheet": ["solid", "{dir}/in.png", "--size", "4", "--out", "{dir}/a.npy", "--png", "{dir}/sheet.jpg"],
}


@pytest.mark.parametrize("words", WRONG.values(), ids=WRONG)
def test_what_is_wrong_takes_one_line(tmp_path, capsys, words):
    picture(tmp_path)
    (tmp_path / "text.png").write_text("no picture")
    given = [word.format(dir=tmp_path) for word in words]
    if "--out" not in given:
        given += ["--out", str(tmp_path / ("out" if "solid" in given else "out.png"))]
    assert main(["texture", *given]) == 2
    out = capsys.readouterr()
    assert out.out == ""
    assert out.err.startswith("inkfall: ")
    assert out.err.count("\n") == 1
    assert any(word in out.err for word in ("expected", "cannot be read", "required", "invalid choice", "starts"))
    assert sorted(p.name for p in tmp_path.iterdir()) == ["in.png", "text.png"]


def test_long_work_shows_a_bar_and_can_be_stopped(tmp_path):
    """On a terminal; interrupted as by Ctrl+C, nothing is left behind."""
    import signal

    path = picture(tmp_path)
    ours, theirs = pty.openpty()
    words = ["texture", "solid", str(path), "--size", "64", "--iterations", "500", "--out", str(tmp_path / "out")]
    with subprocess.Popen(
        [sys.executable, "-m", "app", *words],
        cwd=ROOT,
        stderr=theirs,
        stdout=subprocess.PIPE,
    ) as run:
        os.close(theirs)
        seen = b""
        while b"growing [" not in seen:
            seen += os.read(ours, 1000)
        run.send_signal(signal.SIGINT)
        with suppress(OSError):  # it has ended
            while os.read(ours, 1000):  # else it would wait for room for its last words
                pass
        assert run.wait(90) == 1
    os.close(ours)
    assert [p.name for p in tmp_path.iterdir()] == ["in.png"]
