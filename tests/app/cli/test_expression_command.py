"""`inkfall texture expression`: what it draws, and what it refuses in one line."""

import json

import numpy as np
import pytest
from command_line import refused
from PIL import Image

from app.__main__ import main
from engine.numeric.address import Rect
from engine.texture.expression.defined import expression

TEXT = "a = slider(0.5, 0, 1)\nc = pick(#ff8000)\nmix(#000000, c, noise(x*4, y*4)*a)\n"


def drawn(path):
    return np.asarray(Image.open(path))


def test_it_draws_what_a_recording_has(tmp_path, capsys):
    file, out = tmp_path / "a.txt", tmp_path / "a.png"
    file.write_text(TEXT)
    words = ["texture", "expression", str(file), "--out", str(out), "--size", "40x30", "--level", "2"]
    assert (
        main([*words, "--origin", "-7,5", "--period", "32", "--seed", "3", "--set", "a=0.75", "--set", "c=#00ff00"])
        == 0
    )
    assert "40 x 30 pixels, colour, 8 bits" in capsys.readouterr().out
    values = {"a": 0.75, "c": "#00ff00"}
    made = expression({"text": TEXT, "period": 32, "seed": 3, "values": values}, 0)
    seen = made.appearance(2, Rect.at(-7, 5, 40, 30))[:3]
    assert (drawn(out) == np.moveaxis(np.floor(np.clip(seen, 0, 1).astype(np.float64) * 255 + 0.5), 0, -1)).all()


@pytest.mark.parametrize(("text", "channels", "bits"), [("x", 1, 16), ("fade(#ff0000, x)", 4, 8)])
def test_grey_and_what_is_clear_have_channels_of_their_own(text, channels, bits, tmp_path, capsys):
    out, sheet = tmp_path / "a.png", tmp_path / "sheet.png"
    words = ["texture", "expression", "--text", text, "--out", str(out), "--size", "64x2", "--depth", str(bits)]
    assert main([*words, "--debug", str(sheet), "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    assert (told["channels"], told["bits"], told["samples"]) == (channels, bits, 1)
    assert [line["row"] for line in told["lines"]] == [1]
    assert drawn(out).shape == ((2, 64) if channels == 1 else (2, 64, channels))
    assert drawn(sheet).shape[2] == 3
    if channels == 4:
        assert (drawn(out)[:, 9:, 0] == 255).all()


def test_it_draws_what_a_stroke_of_a_pressure_mixes(tmp_path):
    out = tmp_path / "a.png"
    words = ["texture", "expression", "--text", "pressure*pressure + 0*x", "--out", str(out), "--size", "2x2"]
    for told, value in ((["--pressure", "0.5"], 0.25), (["--pressure", "0.5", "--stages", "2"], 0.5), ([], 1.0)):
        assert main([*words, *told]) == 0
        assert (drawn(out) == int(value * 255 + 0.5)).all()


def test_it_draws_what_a_text_names(tmp_path, capsys):
    picture, text, out = tmp_path / "a.png", tmp_path / "b.txt", tmp_path / "out.png"
    Image.fromarray(np.arange(48, dtype=np.uint8).reshape(6, 8) * 5).save(picture)
    text.write_text('1 - luma("a"(x, y))')
    words = ["texture", "expression", "--out", str(out), "--size", "16x12", "--period", "16", "--depth", "16"]
    named = ["--texture", f"a={picture}", "--texture", f"b={text}"]
    assert main([*words, "--text", 'luma("a"()) + "b"()', *named]) == 0
    assert (drawn(out) == 65535).all()
    assert main([*words, "--text", '"b"()', *named]) == 0
    assert len(np.unique(drawn(out))) > 40


def test_it_tells_its_words(capsys):
    assert main(["texture", "expression", "--words"]) == 0
    assert "noise(x, y, seed): " in capsys.readouterr().out


WRONG = (
    (["--text", "pressure", "--stages", "1"], "--stages: found 1, expected an integer from 2 to 9"),
    (["--text", "x", "--pressure", "2"], "--pressure: found '2', expected a number from 0 to 1"),
    (["--text", '"a"()'], '--text, line 1, column 1: found "a", expected the name of a texture'),
    (["--text", '"a"()', "--texture", "a=gone.txt"], "gone.txt: No such file"),
    (["--text", '"a"()', "--texture", "a"], "--texture: found 'a', expected NAME=FILE"),
    (["--text", "a = noise(x, y)\nnoyse(x, y)"], '--text, line 2, column 1: found "noyse"'),
    (["--text", "x", "--set", "a=1"], "--set"),
    (["--text", "a = slider(0, 0, 1); a", "--set", "a=2"], "--set a: found 2"),
    (["--text", "a = slider(0, 0, 1); a", "--set", "a"], "--set: found 'a'"),
    (["--text", "x", "--period", "0"], "--period: found 0"),
    (["--text", "x", "--level", "1e9"], "--level"),
    (["nowhere.txt"], "nowhere.txt: "),
    ([], "expected FILE or --text T"),
)


@pytest.mark.parametrize(("words", "told"), WRONG, ids=range(len(WRONG)))
def test_what_is_wrong_is_told_in_one_line(words, told, tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert told in refused(capsys, "texture", "expression", *words, "--out", "a.png")
    assert not list(tmp_path.iterdir())
