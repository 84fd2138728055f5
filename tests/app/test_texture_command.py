"""`inkfall texture`: pictures of all kinds in, textures of any size out, the same as a recording's ink."""

import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from app.__main__ import main
from engine.painting.commands import parse
from engine.session.apply import Around, Painting, apply

ROOT = Path(__file__).parents[2]
MAKERS = ("spectrum", "sparse", "impulse")
KINDS = {"L": 1, "LA": 2, "RGB": 3, "RGBA": 4}


def picture(folder, mode="L", size=(24, 20), name="in.png"):
    """A PNG with grain in it; "L16" has 16 bits."""
    height, width = size
    rng = np.random.default_rng(5)
    if mode == "L16":
        image = Image.fromarray(rng.integers(0, 65536, size, np.uint16))
    else:
        values = rng.integers(0, 256, (height, width, KINDS[mode]), np.uint8)
        image = Image.fromarray(values[..., 0] if mode == "L" else values)
    image.save(folder / name)
    return folder / name


def made(folder, *words, out="out.png"):
    path = folder / out
    assert main(["texture", *map(str, words), "--out", str(path)]) == 0
    return np.asarray(Image.open(path))


@pytest.mark.parametrize("size", [(1, 1), (2, 3), (3, 2), (1, 30), (31, 17)])
@pytest.mark.parametrize("mode", [*KINDS, "L16"])
@pytest.mark.parametrize("maker", MAKERS)
def test_pictures_of_any_kind_and_size(tmp_path, maker, mode, size):
    found = made(tmp_path, maker, picture(tmp_path, mode, size), "--size", "37x29")
    assert found.shape[:2] == (29, 37)
    coloured = mode.startswith("RGB")
    if size != (1, 1):  # of a single frequency nothing is left, so no colour either
        assert found.ndim == (3 if coloured else 2)
    if min(size) > 16:
        assert found.std() > 15


@pytest.mark.parametrize("maker", MAKERS)
def test_sixteen_bits_are_the_eight_and_more(tmp_path, maker):
    path = picture(tmp_path, "L16", (32, 32))
    fine = made(tmp_path, maker, path, "--size", "40x41", "--depth", "16", out="fine.png")
    coarse = made(tmp_path, maker, path, "--size", "40x41")
    assert fine.dtype == np.uint16
    assert len(np.unique(fine)) > 500
    assert np.abs(fine / 257 - coarse).max() <= 0.51


@pytest.mark.parametrize("maker", ["sparse", "impulse"])
@pytest.mark.parametrize("origin", [(0, 0), (-40, 1013), (10**30, -(10**31))])
def test_windows_of_the_endless_field_agree(tmp_path, maker, origin):
    path, (x, y) = picture(tmp_path, "RGB"), origin
    whole = made(tmp_path, maker, path, "--size", "90x70", "--origin", f"{x},{y}", out="whole.png")
    part = made(tmp_path, maker, path, "--size", "50x33", "--origin", f"{x + 31},{y + 17}", out="part.png")
    assert np.array_equal(part, whole[17:50, 31:81])


def test_another_program_makes_the_same_field(tmp_path):
    path, part = picture(tmp_path, "RGB"), tmp_path / "part.png"
    whole = made(tmp_path, "sparse", path, "--size", "90x70", "--origin", f"{10**30},{-(10**31)}", out="whole.png")
    words = ["texture", "sparse", path, "--size", "50x33", "--origin", f"{10**30 + 31},{17 - 10**31}", "--out", part]
    done = subprocess.run([sys.executable, "-m", "app", *map(str, words)], cwd=ROOT, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert done.stderr == ""
    assert np.array_equal(np.asarray(Image.open(part)), whole[17:50, 31:81])


def test_long_strips_join(tmp_path):
    path = picture(tmp_path)
    whole = made(tmp_path, "sparse", path, "--size", "2100x300", out="whole.png")
    assert np.array_equal(
        whole[250:, 2000:], made(tmp_path, "sparse", path, "--size", "100x50", "--origin", "2000,250")
    )


@pytest.mark.parametrize("size", [(1, 1), (3, 5), (2, 2), (1, 7), (7, 1), (17, 33)])
def test_a_spectrum_makes_a_texture_as_large_as_itself(tmp_path, size):
    found = made(tmp_path, "spectrum", picture(tmp_path, "L", size))
    assert found.shape[:2] == size


def test_a_spectrum_tiles(tmp_path):
    found = made(tmp_path, "spectrum", picture(tmp_path, size=(20, 24)), "--size", "72x60")
    assert np.array_equal(found[:20, :24], found[40:, 48:])


@pytest.mark.parametrize("words", [("--part", p) for p in ("imag", "magnitude", "log", "phase")] + [("--forward",)])
def test_the_parts_and_the_forward_variant_differ(tmp_path, words):
    path = picture(tmp_path, size=(32, 32))
    plain, other = made(tmp_path, "spectrum", path), made(tmp_path, "spectrum", path, *words, out="other.png")
    assert other.std() > 10
    assert not np.array_equal(plain, other)


def test_forward_is_the_transform_of_the_pattern_as_it_is(tmp_path):
    """Lewis 1984, figure 5: magnitudes, symmetric about the middle."""
    pattern = np.zeros((32, 48), np.uint8)
    pattern[5:9, 30:41] = 255
    Image.fromarray(pattern).save(tmp_path / "pattern.png")
    found = made(tmp_path, "spectrum", tmp_path / "pattern.png", "--forward", "--part", "magnitude").astype(float)
    plain = np.abs(np.fft.fftshift(np.fft.fft2(pattern - pattern.mean())))
    shown = (found > 0) & (found < 255)
    assert shown.mean() > 0.5
    assert np.corrcoef(found[shown], plain[shown])[0, 1] > 0.999
    random = made(
        tmp_path, "spectrum", tmp_path / "pattern.png", "--forward", "--part", "magnitude", "--phase", "random"
    )
    assert np.abs(found - random).mean() > 10


def test_phases_random_zero_and_painted(tmp_path):
    path = picture(tmp_path, size=(33, 32))
    phases = picture(tmp_path, size=(33, 32), name="phases.png")
    found = [
        made(tmp_path, "spectrum", path, *words)
        for words in ((), ("--seed", "1"), ("--phase", "zero"), ("--phase", phases))
    ]
    for i, one in enumerate(found):
        assert not any(np.array_equal(one, other) for other in found[:i])
    zero = found[2].astype(float)
    assert zero[16, 16] == zero.max()


def test_a_wave_of_two_bright_points(tmp_path):
    """Two quadrants are enough: one point makes a wave, of the frequency and direction where it lies."""
    points = np.zeros((64, 64), np.uint8)
    points[32 + 3, 32 + 8] = 255
    Image.fromarray(points).save(tmp_path / "points.png")
    found = made(tmp_path, "spectrum", tmp_path / "points.png").astype(float)
    power = np.abs(np.fft.fft2(found - found.mean())) ** 2
    assert power[3, 8] + power[-3, -8] > 0.95 * power.sum()


def test_the_field_has_the_mean_the_spread_and_the_spectrum_it_should(tmp_path):
    y, x = np.mgrid[0:64, 0:64]
    Image.fromarray((128 + 100 * np.sin(2 * np.pi * x / 8) + 0 * y).astype(np.uint8)).save(tmp_path / "in.png")
    path = tmp_path / "in.png"
    found = made(tmp_path, "sparse", path, "--size", "600x600", "--mean", "0.2", "--spread", "0.5").astype(float)
    assert found.mean() == pytest.approx(255 * 0.6, abs=2)
    assert found.std() == pytest.approx(255 * 0.09, rel=0.12)
    power = np.abs(np.fft.rfft(found - found.mean(), axis=1)).mean(axis=0)
    assert power.argmax() == pytest.approx(75, abs=3)
    few = made(tmp_path, "sparse", path, "--size", "300x300", "--quantise", "2", "--density", "0.5")
    assert (few == 128).mean() > 0.3


def test_a_coloured_photograph_keeps_its_mean_colour(tmp_path):
    rng = np.random.default_rng(1)
    photo = np.clip(np.array([180, 90, 40]) + 20 * rng.standard_normal((90, 90, 1)), 0, 255).astype(np.uint8)
    Image.fromarray(photo).save(tmp_path / "photo.png")
    found = made(tmp_path, "impulse", tmp_path / "photo.png", "--size", "400x400").astype(float)
    assert found.mean(axis=(0, 1)) == pytest.approx(photo.mean(axis=(0, 1)), abs=3)
    assert found.std(axis=(0, 1)) == pytest.approx(photo.std(axis=(0, 1)), rel=0.25)
    assert np.corrcoef(found.reshape(-1, 3).T).min() > 0.95


def test_what_is_transparent_adds_nothing(tmp_path):
    rng = np.random.default_rng(1)
    pixels = np.zeros((32, 32, 4), np.uint8)
    pixels[4:28, 4:28, :3] = rng.integers(0, 256, (24, 24, 1))
    pixels[4:28, 4:28, 3] = 255
    shown = {}
    for hidden in (0, 255):
        pixels[..., :3][pixels[..., 3] == 0] = hidden
        Image.fromarray(pixels).save(tmp_path / "in.png")
        shown[hidden] = made(tmp_path, "sparse", tmp_path / "in.png", "--size", "100x100")
    assert np.array_equal(shown[0], shown[255])


def test_the_window_is_told(tmp_path, capsys):
    path = picture(tmp_path, size=(90, 80))
    made(tmp_path, "impulse", path, "--json")
    told = json.loads(capsys.readouterr().out)
    assert told["average"] == 4
    assert told["sample"] == [told["window"]] * 2
    made(tmp_path, "impulse", path, "--window", "21", "--average", "1")
    out = capsys.readouterr().out
    assert "window of 21 x 21 pixels; 1 averaged" in out
    assert "wrote" in out
    made(tmp_path, "impulse", path, "--window", "512")
    assert "window of 80 x 90 pixels; 4 averaged" in capsys.readouterr().out  # there is no more of it
    made(tmp_path, "sparse", path)
    assert "window of 80 x 90 pixels, the sample's" in capsys.readouterr().out


@pytest.mark.parametrize("maker", MAKERS)
def test_the_ink_of_a_recording_is_the_same_texture(tmp_path, maker):
    path = picture(tmp_path, "RGB", (32, 32))
    found = made(tmp_path, maker, path, "--size", "64x48", "--seed", "3")
    command = {"do": "texture", "name": "t", "maker": maker, "path": path.name, "seed": 3}
    stroke = {
        "do": "stroke",
        "points": [[0, 24], [64, 24]],
        "brush": {"radius": 60, "hardness": 1, "dynamics": {}, "ink": [{"texture": "t", "colour": "#ffffff"}]},
    }
    lines = [{"inkfall": 1, "frame": [0, 0, 64, 48]}, command, stroke]
    script = tmp_path / "a.jsonl"
    script.write_text("\n".join(map(json.dumps, lines)))
    assert main(["play", str(script), "--png", str(tmp_path / "p.png")]) == 0
    painted = np.asarray(Image.open(tmp_path / "p.png"))
    inside = painted[..., 3] == 255
    assert inside.mean() > 0.9
    assert np.abs(painted[..., :3].astype(int) - found)[inside].max() <= 1
    texture = apply(Painting(), parse(command), Around(folder=tmp_path)).textures["t"]
    assert texture.kind == ("spectrum" if maker == "spectrum" else "sparse")


WRONG = {
    "no maker": [],
    "unknown maker": ["moss", "in.png", "--out", "o.png"],
    "example without a region": ["example", "in.png", "--out", "o.png"],
    "no picture": ["spectrum", "--out", "o.png"],
    "no out": ["spectrum", "in.png"],
    "missing picture": ["spectrum", "none.png", "--out", "o.png"],
    "a folder": ["spectrum", ".", "--out", "o.png"],
    "damaged picture": ["sparse", "text.png", "--out", "o.png"],
    "wrong ending": ["sparse", "in.png", "--out", "o.jpg"],
    "over itself": ["sparse", "in.png", "--out", "in.png"],
    "size of one": ["sparse", "in.png", "--out", "o.png", "--size", "7"],
    "size zero": ["sparse", "in.png", "--out", "o.png", "--size", "0x7"],
    "size huge": ["sparse", "in.png", "--out", "o.png", "--size", "99999999x7"],
    "no name": ["sparse", "", "--out", "o.png"],
    "seed": ["sparse", "in.png", "--out", "o.png", "--seed", "1.5"],
    "depth": ["sparse", "in.png", "--out", "o.png", "--depth", "12"],
    "density zero": ["sparse", "in.png", "--out", "o.png", "--density", "0"],
    "density nan": ["sparse", "in.png", "--out", "o.png", "--density", "nan"],
    "density a word": ["sparse", "in.png", "--out", "o.png", "--density", "x"],
    "quantise": ["sparse", "in.png", "--out", "o.png", "--quantise", "-1"],
    "origin": ["sparse", "in.png", "--out", "o.png", "--origin", "1"],
    "origin of a spectrum": ["spectrum", "in.png", "--out", "o.png", "--origin", "1,1"],
    "window zero": ["impulse", "in.png", "--out", "o.png", "--window", "0"],
    "average zero": ["impulse", "in.png", "--out", "o.png", "--average", "0"],
    "phase of impulse": ["impulse", "in.png", "--out", "o.png", "--phase", "up"],
    "phase missing": ["spectrum", "in.png", "--out", "o.png", "--phase", "up.png"],
    "phase of another size": ["spectrum", "in.png", "--out", "o.png", "--phase", "small.png"],
    "part": ["spectrum", "in.png", "--out", "o.png", "--part", "half"],
    "option of another maker": ["spectrum", "in.png", "--out", "o.png", "--density", "3"],
}


@pytest.mark.parametrize("words", WRONG.values(), ids=WRONG)
def test_what_is_wrong_takes_one_line(tmp_path, capsys, monkeypatch, words):
    monkeypatch.chdir(tmp_path)
    picture(tmp_path)
    picture(tmp_path, size=(3, 3), name="small.png")
    Path("text.png").write_text("no picture")
    before = Path("in.png").read_bytes()
    capsys.readouterr()
    assert main(["texture", *words]) == 2
    out = capsys.readouterr()
    assert out.out == ""
    assert out.err.startswith("inkfall: ")
    assert out.err.count("\n") == 1
    assert "fault in Inkfall" not in out.err
    assert sorted(p.name for p in tmp_path.iterdir()) == ["in.png", "small.png", "text.png"]
    assert Path("in.png").read_bytes() == before


def test_no_folder_to_write_to_is_a_failure(tmp_path, capsys):
    path = picture(tmp_path)
    assert main(["texture", "sparse", str(path), "--out", str(tmp_path / "none" / "o.png")]) == 1
    assert capsys.readouterr().err.count("\n") == 1


def test_the_doctor_tells_what_suits_a_picture(tmp_path, capsys):
    example, sheet = picture(tmp_path, "RGB", (24, 20)), tmp_path / "sheet.png"
    assert main(["texture", "doctor", str(example), "--png", str(sheet), "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    assert told["looked_at"] == [20, 24]
    assert told["kinds"] == ["stochastic"]
    assert told["advice"] in told["trials"]
    assert told["trials"]["grown"]["copied"] > told["trials"]["histograms"]["copied"]
    assert np.asarray(Image.open(sheet)).shape[2] == 3
    assert main(["texture", "doctor", str(example), "--flat"]) == 0
    assert "advice: " in capsys.readouterr().out


def test_the_doctor_says_what_is_no_picture(tmp_path, capsys):
    clear = tmp_path / "clear.png"
    Image.fromarray(np.zeros((20, 20, 4), np.uint8)).save(clear)
    assert main(["texture", "doctor", str(clear)]) == 2
    assert capsys.readouterr().err == f"inkfall: {clear}: found nothing but transparency, expected a picture\n"
    assert main(["texture", "doctor", str(picture(tmp_path)), "--png", str(tmp_path / "in.png")]) == 2
    assert "the example itself" in capsys.readouterr().err
