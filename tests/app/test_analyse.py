"""`inkfall analyse` on pictures of all kinds, and on what is none."""

import json

import numpy as np
import pytest
from PIL import Image

from app.__main__ import main

SIZES = [(1, 1), (2, 3), (17, 40), (65, 33)]


def written(tmp_path, mode, size, ending=".png"):
    """A picture file of some mode, with grain in it."""
    height, width = size
    rng = np.random.default_rng(1)
    if mode == "I;16":
        picture = Image.fromarray(rng.integers(0, 65536, (height, width), np.uint16))
    elif mode == "1":
        picture = Image.fromarray(rng.random((height, width)) < 0.5)
    else:
        bands = len(Image.new(mode, (1, 1)).getbands())
        values = rng.integers(0, 256, (height, width, bands), np.uint8)
        picture = Image.fromarray(values[..., 0] if bands == 1 else values, mode)
    path = tmp_path / f"picture{ending}"
    picture.save(path)
    return path


def told(capsys, *words):
    assert main(["analyse", *map(str, words), "--json"]) == 0
    return json.loads(capsys.readouterr().out)


@pytest.mark.parametrize("size", SIZES)
@pytest.mark.parametrize("mode", ["1", "L", "LA", "RGB", "RGBA", "I;16"])
@pytest.mark.filterwarnings("ignore:'mode' parameter:DeprecationWarning")
def test_pictures_of_any_kind(tmp_path, capsys, mode, size):
    path, out = written(tmp_path, mode, size), tmp_path / "sheet.png"
    found = told(capsys, path, "--png", out)
    assert found["image"] == [size[1], size[0]]
    assert found["pixels"] == size[0] * size[1] >= found["regions"] >= found["colours"] >= 1
    assert found["bits"] == (16 if mode == "I;16" else 8)
    assert found["all_pole"]["stable"] is True
    sheet = np.asarray(Image.open(out))
    assert sheet.ndim == 3
    assert sheet.std() > 5


@pytest.mark.parametrize("ending", [".jpg", ".tif"])
def test_other_formats(tmp_path, capsys, ending):
    path = written(tmp_path, "RGB", (20, 30), ending)
    found = told(capsys, path)
    assert found["image"] == [30, 20]
    pixels = np.asarray(Image.open(path)).reshape(-1, 3)
    assert found["colours"] == len(np.unique(pixels, axis=0))


def test_a_rectangle_is_as_the_picture_cut(tmp_path, capsys):
    path, cut = written(tmp_path, "RGB", (40, 50)), tmp_path / "cut.png"
    Image.open(path).crop((7, 9, 30, 39)).save(cut)
    part, alone = told(capsys, path, "--rect", "7,9,23,30"), told(capsys, cut)
    for name in ("colours", "regions", "mean", "slope", "spectrum", "autocorrelation", "all_pole"):
        assert part[name] == alone[name]


def test_a_painting_is_seen_in_its_frame(tmp_path, capsys):
    script, ora, png = (tmp_path / f"a{ending}" for ending in (".jsonl", ".ora", ".png"))
    script.write_text(
        '{"inkfall": 1, "frame": [0, 0, 40, 30]}\n'
        '{"do": "stroke", "points": [[5, 5], [30, 20]], "brush": {"radius": 9, "ink": [{"texture": "rock"}]}}\n'
    )
    assert main(["play", str(script), "--save", str(ora), "--png", str(png)]) == 0
    capsys.readouterr()
    painting, picture = told(capsys, ora), told(capsys, png)
    assert painting["colours"] == picture["colours"]
    assert painting["regions"] == picture["regions"]


def test_it_says_it_in_words(tmp_path, capsys):
    assert main(["analyse", str(written(tmp_path, "RGB", (30, 30)))]) == 0
    assert "900 distinct colours, 900 regions of one colour" in capsys.readouterr().out


WRONG = {
    "no file": ["{dir}/none.png"],
    "a folder": ["{dir}"],
    "no picture": ["{dir}/text.png"],
    "no painting": ["{dir}/none.ora"],
    "rect of five": ["{dir}/picture.png", "--rect", "0,0,0,5,5"],
    "rect of words": ["{dir}/picture.png", "--rect", "a,b,c,d"],
    "rect empty": ["{dir}/picture.png", "--rect", "0,0,0,5"],
    "rect too wide": ["{dir}/picture.png", "--rect", "5,5,10,6"],
    "rect outside": ["{dir}/picture.png", "--rect", "-1,0,5,5"],
    "wrong ending": ["{dir}/picture.png", "--png", "{dir}/out.jpg"],
    "nothing": [],
}


@pytest.mark.parametrize("words", WRONG.values(), ids=WRONG)
def test_what_is_wrong_takes_one_line(tmp_path, capsys, words):
    written(tmp_path, "L", (10, 12))
    (tmp_path / "text.png").write_text("no picture")
    capsys.readouterr()
    assert main(["analyse", *(word.format(dir=tmp_path) for word in words)]) == 2
    out = capsys.readouterr()
    assert out.out == ""
    assert out.err.startswith("inkfall: ")
    assert out.err.count("\n") == 1
    assert any(word in out.err for word in ("found", "cannot be read", "no such file", "required", "damaged", "starts"))
    assert sorted(p.name for p in tmp_path.iterdir()) == ["picture.png", "text.png"]


def test_whether_the_filter_is_stable_is_said(tmp_path, capsys):
    x = np.mgrid[:120, :120][1]
    wave = np.sin(2 * np.pi * x / 10) + 0.01 * np.random.default_rng(1).standard_normal((120, 120))
    for name, values, words in (
        ("wave", wave, "outermost pole at 0.99"),
        ("wave", wave, "made stable by 0.9"),
        ("noise", np.random.default_rng(2).standard_normal((120, 120)) / 3, "stable as fitted"),
    ):
        Image.fromarray((128 + 100 * values.clip(-1.2, 1.2)).astype(np.uint8)).save(tmp_path / f"{name}.png")
        assert main(["analyse", str(tmp_path / f"{name}.png")]) == 0
        assert words in capsys.readouterr().out
